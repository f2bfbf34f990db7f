"""Policies from ONNX files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import FileError, FormatError, ParameterError
from setpiece._native import Scenario, baseline_file
from setpiece._optional import need
from setpiece._options import check_path
from setpiece._spaces import OBSERVATIONS

TYPES = {
    "tensor(float)": np.float32,
    "tensor(double)": np.float64,
    "tensor(uint8)": np.uint8,
    "tensor(bool)": np.bool_,
}
ACTION_COUNTS = (19, 20)


MASK = "mask"
"""The name of a model's input for masks."""

REPEAT = "repeat"
"""The key of a model's metadata that says how many steps a decision lasts."""

REPEAT_MAX = 1_000
"""The most steps that a decision lasts."""

OBSERVATION, SCALE, STACK = "observation", "scale", "stack"
"""The keys that say what a model sees: the name, whether it is scaled, how many at once."""


@dataclass(frozen=True)
class OnnxPolicy:
    """A policy from an ONNX file; `onnx_policy` makes one."""

    path: str
    session: Any
    given: Any
    """The input of the model."""
    repeat: int
    """How many steps a decision lasts."""
    mask: Any = None
    """The input for masks, if the model has one."""
    observation: str | None = None
    """The observation that the model names; None also for a stack, which the caller provides."""
    scale: bool = False
    """Whether that observation is scaled."""

    @property
    def masks(self) -> bool:
        """Whether the model takes masks."""
        return self.mask is not None

    def __call__(
        self, observation: NDArray[Any], masks: NDArray[Any] | None = None
    ) -> NDArray[np.int64]:
        """Returns the actions of greatest logit, int64 `(n,)`, for observations `(n, …)`.

        A model with masks takes those of the actions too, `(n, 19)` or more. Raises `FormatError`
        if the model sees another shape, can't be computed or returns something else.
        """
        if self.masks and masks is None:
            raise ParameterError(f"`{self.path}` takes masks of the actions too", name="masks")
        observation = np.asarray(observation)
        if not _fits(observation.shape[1:], self.given.shape[1:]):
            found, wanted = _shape(observation.shape[1:]), _shape(self.given.shape[1:])
            raise fault(
                self.path,
                f"it sees {wanted} numbers, and is shown {found}",
                "name what it sees: `setpiece.Policy(FILE, observation=…)`, or the key "
                f"`{OBSERVATION}` of the file's metadata",
            )
        given = {self.given: observation}
        if self.mask is not None and masks is not None:
            given[self.mask] = masks[:, : self.mask.shape[1]]
        n = len(observation)
        if n == 0:
            return np.zeros(0, np.int64)
        parts = (
            [slice(at, at + 1) for at in range(n)] if self.given.shape[:1] == [1] else [slice(n)]
        )
        logits = np.concatenate(
            [self._logits({one: rows[part] for one, rows in given.items()}) for part in parts]
        )
        if np.isnan(logits).any():
            raise fault(self.path, NAN)
        actions: NDArray[np.int64] = logits.argmax(axis=1)
        return actions

    def _logits(self, given: dict[Any, NDArray[Any]]) -> NDArray[Any]:
        """Returns what the model computes of its inputs, logits `(n, 19)` or `(n, 20)`."""
        shown: dict[str, NDArray[Any]] = {
            one.name: np.asarray(rows, TYPES[one.type]) for one, rows in given.items()
        }
        try:
            logits = np.asarray(self.session.run(None, shown)[0])
        except Exception as error:
            raise fault(self.path, f"it can't be computed: {_first_line(error)}") from error
        n = len(next(iter(shown.values())))
        if logits.dtype.kind != "f" or logits.shape not in [(n, count) for count in ACTION_COUNTS]:
            found = f"{list(logits.shape)} of {logits.dtype}"
            raise fault(
                self.path,
                f"it returns {found}; expected the logits of 19 or 20 actions, [{n}, 19]",
            )
        return logits

    def try_out(self) -> None:
        """Computes the model once, if its input has a known shape; raises `FormatError`."""
        shape = self.given.shape[1:]
        if not all(isinstance(length, int) for length in shape):
            return
        nan = True
        # What is undefined for one observation may not be for another.
        for number in (0.0, 0.5):
            given = {self.given: np.full((1, *shape), number)}
            if self.mask is not None:
                given[self.mask] = np.ones((1, self.mask.shape[1]))
            nan = nan and bool(np.isnan(self._logits(given)).any())
        if nan:
            raise fault(self.path, NAN)


NAN = "it returns logits that are no numbers (NaN)"


def fault(path: str, why: str, help: str | None = None) -> FormatError:
    """Builds the error for a policy that can't be played, as the command words it."""
    return FormatError(f"the policy `{path}` can't be played: {why}", code="SP0023", help=help)


def _fits(found: tuple[int, ...], wanted: Sequence[Any]) -> bool:
    """Whether a shape is that of an input, whose free axes aren't integers."""
    return len(found) == len(wanted) and all(
        not isinstance(length, int) or length == known
        for known, length in zip(found, wanted, strict=True)
    )


def _shape(lengths: Sequence[Any]) -> str:
    return " by ".join(str(length) if isinstance(length, int) else "n" for length in lengths) or "0"


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]


def onnx_policy(path: str | PathLike[str]) -> OnnxPolicy:
    """Returns a policy from an ONNX file: observations `(n, …)` to the actions of greatest logit.

    Actions are int64 `(n,)`. The model has one input, the observation with a batch axis in front
    (`(batch, 115)` for `simple115v2`, `(batch, 72, 96, 4)` for `smm`; the batch free, or 1), as
    float, double or uint8. A second input called `mask` gets the masks of the actions, `(batch, 19)`
    or `(batch, 20)`, also as bool. The first output is the logits `(batch, 19)` or `(batch, 20)`. Of
    equal logits the first wins. It runs on the CPU in one thread, so results are always the same.

    If the model's metadata has the key `repeat`, a whole number, a decision lasts so many steps:
    whoever plays the policy presses its action in all of them. The policy has the attribute
    `repeat`, 1 without that key. `observation` is the name of what the policy sees, and with `scale`
    as `true` it is scaled. Opponents and evaluated policies then see that, whatever the caller sees;
    not if the key `stack` says that several are seen at once.

    Raises `FileError`, `FormatError`, `MissingPackageError`, and `ParameterError` if `path` isn't a
    path.
    """
    file = check_path("path", path)
    # Reported before what a file that isn't there would need.
    need("onnxruntime", "onnx", "a policy from an `.onnx` file")
    if not file.is_file():
        if file.is_dir():
            raise FileError(f"`{fspath(path)}` is a directory", path=fspath(path), code="SP0006")
        raise FileError(f"there is no file `{fspath(path)}`", path=fspath(path), code="SP0001")
    return _policy(fspath(path), fspath(path))


def baseline_policy(scenario: Scenario) -> OnnxPolicy:
    """Returns the policy that a scenario comes with, or raises `ParameterError`."""
    try:
        name, model = baseline_file(scenario)
    except ParameterError as error:
        error.name = "opponents"
        raise
    return _policy(f"baseline/{name}.onnx", model)


def _policy(path: str, model: str | bytes) -> OnnxPolicy:
    """Returns the policy of a model: its path or its bytes."""
    runtime = need("onnxruntime", "onnx", "a policy from an `.onnx` file")
    options = runtime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    try:
        session = runtime.InferenceSession(model, options, providers=["CPUExecutionProvider"])
    except Exception as error:
        # Bytes of something else can't be decoded; those of nothing have no graph.
        is_other = type(error).__name__ == "InvalidProtobuf" or not _has_graph(model)
        why = "" if is_other else f" that `onnxruntime` runs: {_first_line(error)}"
        help = "`torch.onnx.export` writes one"
        raise fault(path, f"it is no ONNX model{why}", help) from error
    inputs = session.get_inputs()
    masks = [one for one in inputs if one.name == MASK and one.shape[1:] in ([19], [20])]
    shown = [one for one in inputs if one not in masks]
    if len(shown) != 1 or any(one.type not in TYPES for one in inputs):
        found = "`, `".join(f"{one.name}: {one.type}" for one in inputs)
        raise fault(
            path,
            f"expected one input, and perhaps a `{MASK}`; found `{found}`",
            f"inputs are {', '.join(f'`{name}`' for name in TYPES)}",
        )
    metadata = session.get_modelmeta().custom_metadata_map
    said = metadata.get(REPEAT, "1")
    if not (said.isdecimal() and 1 <= int(said) <= REPEAT_MAX):
        raise fault(path, f"its metadata says `{REPEAT}` is `{said}`; expected a number of steps")
    name = metadata.get(OBSERVATION)
    if name is not None and name not in OBSERVATIONS:
        raise fault(
            path,
            f"its metadata says `{OBSERVATION}` is `{name}`",
            f"it can be {', '.join(f'`{known}`' for known in OBSERVATIONS)}",
        )
    if metadata.get(STACK, "1") != "1":
        name = None
    policy = OnnxPolicy(
        path,
        session,
        shown[0],
        int(said),
        masks[0] if masks else None,
        name,
        name is not None and metadata.get(SCALE) == "true",
    )
    policy.try_out()
    return policy


def _has_graph(model: str | bytes) -> bool:
    """Whether a model has any bytes."""
    return len(model) > 0 if isinstance(model, bytes) else Path(model).stat().st_size > 0
