"""Sources of levels: what a vector plays next."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from setpiece import _native
from setpiece._callbacks import failed
from setpiece._errors import ParameterError, SetpieceError
from setpiece._level import Level, LevelLike, read_level, read_listed
from setpiece._library import list as library_names
from setpiece._native import Scenario
from setpiece._options import ParamValue, check_flag, check_number, check_path
from setpiece._source import Source, is_file, is_text, path_of, text_of


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


class ListedLevels(LevelSource):
    """Levels in their order, again and again."""


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
        return source, is_text(source), name
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
    return is_file(source) or (isinstance(source, str) and is_text(source))


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


class HasLevels(Protocol):
    """What has levels of its own: a suite."""

    @property
    def levels(self) -> LevelSource:
        """Its levels."""


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
        return cls(scenario, level.params, *level.key)


LevelFunction = Callable[[LevelResult | None], LevelLike]
"""From the result of an environment's last level to its next level.

The result is None before the first, and after an episode that has failed.
"""

LevelsArgument = (
    LevelSource
    | LevelFunction
    | Sequence[LevelLike | Scenario]
    | NDArray[Any]
    | HasLevels
    | LevelLike
    | PathLike[str]
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
    given: object,
    source: Source,
    scenario: str,
    load: Callable[[str], Scenario],
    allow_outside: bool,
) -> LevelSource | FunctionLevels:
    """Reads `levels` of a vector of a scenario, or raises `ParameterError`.

    `load` returns the scenario of a level's name: the vector's own, one of its file, or one of the
    library.
    """
    if isinstance(given, LevelSource):
        return given
    if (own := source_of(given)) is not None:
        return own
    if isinstance(given, np.ndarray):
        given = given.tolist()
    if isinstance(given, Level | Mapping) or (isinstance(given, str) and "#" in given):
        given = [given]
    if isinstance(given, str | PathLike):
        if is_plan(given):
            return _planned(given, None, allow_outside)
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
        return _listed(given, scenario, load)
    raise ParameterError(
        f"expected `levels` as a curriculum, a suite, a sampler, a list or a function, "
        f"found `{given!r}`",
        name="levels",
    )


def source_of(given: object) -> LevelSource | None:
    """The levels of a suite; None for anything else."""
    levels = None if isinstance(given, type) else getattr(given, "levels", None)
    return levels if isinstance(levels, LevelSource) else None


def _planned(
    source: str | PathLike[str] | None, name: str | None, allow_outside: bool
) -> LevelSource:
    """The curriculum of a name, or the suite; without a name the only one of a file or text."""
    at = (source, is_text(source), name)
    try:
        return Curriculum(_native.Levels.curriculum(*at, None, allow_outside))
    except ParameterError as no_curriculum:
        try:
            return ListedLevels(_native.Suite(*at, allow_outside).listed())
        except ParameterError as no_suite:
            raise (no_suite if no_suite.help else no_curriculum) from None


def _named(name: str, source: Source, allow_outside: bool) -> LevelSource:
    """A curriculum or a suite that stands beside the vector's scenario, or in the library."""
    text = None if isinstance(source, Scenario) else text_of(source)
    path = path_of(source) if text is None and is_plan(source) else None
    try:
        return _planned(path if text is None else text, name, allow_outside)
    except ParameterError as error:
        said, helped = str(error.args[0]), error.help
        if name in library_names():
            said = f"no curriculum and no suite is called `{name}`"
            helped = f"a scenario stands in a list: `levels=[{name!r}]`"
        elif isinstance(source, Scenario):
            helped = "a loaded scenario has no curricula: give the file or the text instead of it"
        raise ParameterError(said, name="levels", code=error.code, help=helped) from None


def _listed(
    given: Sequence[object], scenario: str, load: Callable[[str], Scenario]
) -> ListedLevels:
    scenarios: dict[object, Scenario] = {}
    levels = []
    for one in given:
        level = Level(one.name) if isinstance(one, Scenario) else read_listed(one, scenario)
        key: object = id(one) if isinstance(one, Scenario) else level.scenario
        if key not in scenarios:
            scenarios[key] = one if isinstance(one, Scenario) else load(level.scenario)
        level.check(scenarios[key])
        episode = None if level.seed is None else level.key
        levels.append(([*scenarios].index(key), level.params, episode))
    return ListedLevels(_native.Levels.listed([*scenarios.values()], levels))
