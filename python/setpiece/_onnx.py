"""Policies from ONNX files."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import FileError, FormatError, ParameterError
from setpiece._native import BASELINES, baseline_file
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

        A model with masks takes those of the actions too, `(n, 19)` or more.
        """
        if self.masks and masks is None:
            raise ParameterError(f"`{self.path}` takes masks of the actions too", name="masks")
        given = {self.given: observation}
        if self.mask is not None and masks is not None:
            given[self.mask] = masks[:, : self.mask.shape[1]]
        n = len(observation)
        parts = (
            [slice(at, at + 1) for at in range(n)] if self.given.shape[:1] == [1] else [slice(n)]
        )
        logits = np.concatenate(
            [
                self.session.run(
                    None,
                    {
                        one.name: np.asarray(rows[part], TYPES[one.type])
                        for one, rows in given.items()
                    },
                )[0]
                for part in parts
            ]
        )
        if logits.ndim != 2 or logits.shape[1] not in ACTION_COUNTS:
            raise FormatError(
                f"`{self.path}` returns {logits.shape}; expected logits (batch, 19) or (batch, 20)"
            )
        actions: NDArray[np.int64] = logits.argmax(axis=1)
        return actions


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
        raise FileError(f"there is no file `{fspath(path)}`", path=fspath(path))
    return _policy(fspath(path), fspath(path))


def baseline_policy(scenario: str) -> OnnxPolicy:
    """Returns the policy that a scenario comes with, or raises `ParameterError`."""
    model = baseline_file(scenario)
    if model is None:
        raise ParameterError(
            f"the scenario `{scenario}` has no baseline",
            name="opponents",
            code="SP0024",
            help=f"these have one: `{'`, `'.join(BASELINES)}`",
        )
    return _policy(f"baseline/{scenario}.onnx", model)


def _policy(path: str, model: str | bytes) -> OnnxPolicy:
    """Returns the policy of a model: its path or its bytes."""
    runtime = need("onnxruntime", "onnx", "a policy from an `.onnx` file")
    options = runtime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    try:
        session = runtime.InferenceSession(model, options, providers=["CPUExecutionProvider"])
    except Exception as error:
        raise FormatError(f"`{path}` is no ONNX model that can be run: {error}") from error
    inputs = session.get_inputs()
    masks = [one for one in inputs if one.name == MASK and one.shape[1:] in ([19], [20])]
    shown = [one for one in inputs if one not in masks]
    if len(shown) != 1 or any(one.type not in TYPES for one in inputs):
        found = ", ".join(f"{one.name}: {one.type}" for one in inputs)
        raise FormatError(
            f"`{path}` has the inputs {found}; expected one, and perhaps a `{MASK}`: "
            f"{', '.join(TYPES)}"
        )
    metadata = session.get_modelmeta().custom_metadata_map
    said = metadata.get(REPEAT, "1")
    if not (said.isdecimal() and int(said) >= 1):
        raise FormatError(f"`{path}` has the `{REPEAT}` {said!r}; expected a count of steps")
    name = metadata.get(OBSERVATION)
    if name is not None and name not in OBSERVATIONS:
        raise FormatError(
            f"`{path}` has the `{OBSERVATION}` {name!r}; expected {', '.join(OBSERVATIONS)}"
        )
    if metadata.get(STACK, "1") != "1":
        name = None
    return OnnxPolicy(
        path,
        session,
        shown[0],
        int(said),
        masks[0] if masks else None,
        name,
        name is not None and metadata.get(SCALE) == "true",
    )
