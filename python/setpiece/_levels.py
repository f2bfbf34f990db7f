"""Sources of levels: what a vector plays next."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any, NamedTuple

from setpiece import _native
from setpiece._callbacks import failed
from setpiece._errors import ParameterError, SetpieceError
from setpiece._level import Level, read_level
from setpiece._native import Scenario
from setpiece._options import ParamValue, check_flag, check_number, check_path
from setpiece._source import Source, path_of, text_of


class LevelSource:
    """A source of levels: a curriculum or a sampler.

    Pass it to `setpiece.make_vec` as `levels`. Vectors that are made with the same source share it.
    """

    def __init__(self, native: _native.Levels) -> None:
        self._native = native

    @property
    def native(self) -> _native.Levels:
        """What a batch takes levels from."""
        return self._native

    def reseed(self, seed: int) -> None:
        """Numbers the next levels from 0 under a seed; what has been measured stays."""
        self._native.reseed(check_number("seed", seed))

    def __deepcopy__(self, _memo: object) -> LevelSource:
        """Returns the source itself: vectors share it."""
        return self

    @property
    def seed(self) -> int | None:
        """The seed of the levels; None before anybody has given one."""
        return self._native.seed

    def state_dict(self) -> dict[str, Any]:
        """Returns everything that the source remembers, as numbers, texts and lists."""
        state: dict[str, Any] = json.loads(self._native.state())
        return state

    def load_state_dict(self, state: Mapping[str, Any]) -> None:
        """Takes back a `state_dict`; the next levels are those that would have followed.

        Raises `ParameterError` for a state of something else; then nothing has changed.
        """
        try:
            text = json.dumps(state)
        except (TypeError, ValueError):
            raise ParameterError(
                f"expected a `state_dict`, found `{type(state).__name__}`", name="state"
            ) from None
        self._native.set_state(text)


class Curriculum(LevelSource):
    """A curriculum of the language while it is played; `setpiece.curriculum` makes one."""

    @property
    def stages(self) -> tuple[str, ...]:
        """The names of the stages."""
        return tuple(self._native.stages())

    @property
    def stage(self) -> str:
        """The name of the present stage."""
        place = self._native.stage()
        return "" if place is None else place[1]

    @property
    def value(self) -> float | None:
        """The value of the stage's `adapt`, in SI units; None if the stage has none."""
        place = self._native.stage()
        return None if place is None else place[2]

    def __repr__(self) -> str:
        """Returns the stage among the others."""
        stages = [f"[{name}]" if name == self.stage else name for name in self.stages]
        return f"Curriculum({' '.join(stages)})"


def curriculum(
    source: str | PathLike[str],
    name: str | None = None,
    *,
    seed: int | None = None,
    allow_outside: bool = False,
) -> Curriculum:
    """Begins a curriculum of the language.

    - `source`: the name of a curriculum in the library, the path of a `.pitch` file, or a text.
    - `name`: which of several in a file or a text.
    - `seed`: the seed of its levels; None: that of the first vector that plays it.
    - `allow_outside`: as in `setpiece.load`.

    Raises `ParameterError` if there is no such curriculum, `FileError` or `CompileError`.

    >>> import setpiece
    >>> setpiece.curriculum("learn_3_vs_1", seed=1)
    Curriculum([walk] run full)
    """
    outside = check_flag("allow_outside", allow_outside)
    seed = check_seed(seed)
    return Curriculum(_native.Levels.curriculum(*place_of(source, name), seed, outside))


def place_of(
    source: str | PathLike[str], name: str | None
) -> tuple[str | PathLike[str] | None, bool, str | None]:
    """Where a plan stands: its file or text (None: the library), whether a text, and its name."""
    if not isinstance(source, str) or is_plan(source):
        return source, _is_text(source), name
    if name is not None:
        raise ParameterError(
            f"`{source}` is a name of the library, which has no `{name}` in it",
            name="name",
            help="a path ends in `.pitch`",
        )
    return None, False, source


def check_seed(seed: object) -> int | None:
    """Returns a seed, or raises `ParameterError`."""
    return None if seed is None else check_number("seed", seed)


def is_plan(source: object) -> bool:
    """Whether it is a text or the path of a `.pitch` file."""
    if isinstance(source, PathLike):
        source = str(check_path("levels", source))
    return isinstance(source, str) and (source.endswith(".pitch") or _is_text(source))


def _is_text(source: object) -> bool:
    return isinstance(source, str) and text_of(source) is not None


@dataclass(frozen=True)
class LevelResult:
    """How a level has ended, for a function that chooses the next one.

    An episode that failed, in a script for example, has no result.
    """

    level: str
    """The level as text."""
    outcome: str
    success: bool
    length: int
    """Steps."""
    returns: list[float]
    """The return of each agent of the match."""
    records: dict[str, Any]


class GivenLevel(NamedTuple):
    """A level with its scenario; the native module reads its attributes."""

    scenario: Scenario
    params: dict[str, ParamValue]
    seed: int
    episode: int

    @classmethod
    def of(cls, level: Level, scenario: Scenario) -> GivenLevel:
        """Checks that a level is of a scenario, or raises `LevelError`."""
        level.check(scenario)
        return cls(scenario, level.params, level.seed, level.episode)


LevelFunction = Callable[[LevelResult | None], str | Mapping[str, Any]]
"""From the result of an environment's last level to its next level.

The result is None before the first, and after an episode that has failed.
"""

LevelsArgument = (
    LevelSource | LevelFunction | Sequence[str | Mapping[str, Any]] | str | PathLike[str]
)
"""Where the levels of a vector come from: see `setpiece.make_vec`."""


class FunctionLevels:
    """A function of the caller's that chooses levels; the native module calls it."""

    def __init__(self, function: LevelFunction, load: Callable[[str], Scenario]) -> None:
        self._function = function
        self._load = load
        self._known: dict[str, Scenario] = {}

    def __call__(self, ended: dict[str, Any] | None) -> GivenLevel:
        """Returns the next level of an environment whose last episode has ended so."""
        result = None
        if ended is not None:
            result = LevelResult(
                ended["level"],
                ended["outcome"],
                ended["success"],
                ended["length"],
                [sum(terms) for terms in ended["return"]],
                ended["records"],
            )
        try:
            given = self._function(result)
        except SetpieceError:
            raise
        except Exception as error:
            raise failed(self._function, None, error) from error
        level = read_level(given)
        if level.scenario not in self._known:
            self._known[level.scenario] = self._load(level.scenario)
        return GivenLevel.of(level, self._known[level.scenario])


def read_levels(
    given: object, source: Source, load: Callable[[str], Scenario], allow_outside: bool
) -> LevelSource | FunctionLevels:
    """Reads `levels` of a vector of a scenario, or raises `ParameterError`.

    `load` returns the scenario of a level's name: the vector's own, or one of the library.
    """
    if isinstance(given, LevelSource):
        return given
    if isinstance(given, str | PathLike):
        if is_plan(given):
            return curriculum(given, allow_outside=allow_outside)
        return _named(str(given), source, allow_outside)
    if isinstance(given, type):
        raise ParameterError(
            f"`levels` is the class `{given.__name__}`",
            name="levels",
            help=f"make one: `{given.__name__}(…)`",
        )
    if callable(given):
        return FunctionLevels(given, load)
    if isinstance(given, Sequence) and not isinstance(given, bytes):
        return _listed(given, load)
    raise ParameterError(
        f"expected `levels` as a curriculum, a sampler, a list or a function, found `{given!r}`",
        name="levels",
    )


def _named(name: str, source: Source, allow_outside: bool) -> Curriculum:
    """A curriculum that stands beside the vector's scenario, or in the library."""
    text = None if isinstance(source, Scenario) else text_of(source)
    path = path_of(source) if text is None and is_plan(source) else None
    where = path if text is None else text
    try:
        return Curriculum(
            _native.Levels.curriculum(where, text is not None, name, None, allow_outside)
        )
    except ParameterError as error:
        if not isinstance(source, Scenario):
            raise
        raise ParameterError(
            str(error),
            name="levels",
            code=error.code,
            help="a loaded scenario has no curricula: give the file or the text instead of it",
        ) from None


def _listed(given: Sequence[object], load: Callable[[str], Scenario]) -> LevelSource:
    scenarios: dict[str, Scenario] = {}
    levels = []
    for level in map(read_level, given):
        if level.scenario not in scenarios:
            scenarios[level.scenario] = load(level.scenario)
        level.check(scenarios[level.scenario])
        place = [*scenarios].index(level.scenario)
        levels.append((place, level.params, level.seed, level.episode))
    return LevelSource(_native.Levels.listed([*scenarios.values()], levels))
