"""Samplers: levels of a scenario whose parameters are drawn.

```python
import setpiece

levels = setpiece.samplers.Prioritized("academy_3_vs_1_with_keeper", ["difficulty"])
envs = setpiece.make_vec("academy_3_vs_1_with_keeper", 64, levels=levels)
```
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any, Literal

from setpiece import _native
from setpiece._errors import ParameterError
from setpiece._level import read_level
from setpiece._levels import LevelSource, check_seed
from setpiece._native import Scenario
from setpiece._source import Source, load
from setpiece._words import check_word, similar

__all__ = ["Prioritized", "Randomized"]

CAPACITY_MAX = 100_000


class Randomized(LevelSource):
    """Domain randomisation: every level draws parameters from what they may be, uniformly."""

    def __init__(
        self, scenario: Source, params: Sequence[str] | None = None, *, seed: int | None = None
    ) -> None:
        """Prepares levels of a scenario.

        - `params`: the names of the parameters that are drawn; None: all with a range or a list of
          values. The others keep the values that `scenario` has: bind them with `with_params`.
        - `seed`: the seed of the levels; None: that of the first vector that plays them.

        Raises `ParameterError` for a parameter that the scenario doesn't have, or without a range.
        """
        self.scenario = load(scenario)
        super().__init__(
            _native.Levels.randomized(
                self.scenario, _varied(self.scenario, params), check_seed(seed)
            )
        )


@dataclass(frozen=True)
class _Replay:
    """The options of a replay; the native module reads its attributes."""

    capacity: int
    replay: float
    staleness: float
    temperature: float
    edit: float
    scale: float
    learnability: bool


class Prioritized(LevelSource):
    """Prioritized level replay: levels that still teach something are played again.

    New levels are drawn as by `Randomized`. Once half of the `capacity` is kept, the share `replay`
    of the levels are kept ones. The level of rank r by its score has the weight
    (1/r)^(1/temperature), and a share `staleness` goes to those that weren't played for long (Jiang
    et al. 2021). With `edit` that share of the replayed levels is changed, each parameter by about
    `scale` of its range (ACCEL: Parker-Holder et al. 2022).

    - `score="learnability"`: p(1-p) of the chance of success p (Rutherford et al. 2024). It needs
      nothing from the learner.
    - `score="given"`: the learner calls `update` with its own score, such as the positive value
      loss.
    """

    def __init__(
        self,
        scenario: Source,
        params: Sequence[str] | None = None,
        *,
        score: Literal["learnability", "given"] = "learnability",
        capacity: int = 1000,
        replay: float = 0.5,
        staleness: float = 0.1,
        temperature: float = 0.3,
        edit: float = 0.0,
        scale: float = 0.1,
        seed: int | None = None,
    ) -> None:
        """Prepares levels of a scenario; `params` and `seed` are those of `Randomized`."""
        self.scenario = load(scenario)
        if isinstance(capacity, bool) or not isinstance(capacity, int):
            raise ParameterError(
                f"expected an integer as `capacity`, found `{capacity!r}`", name="capacity"
            )
        if not 1 <= capacity <= CAPACITY_MAX:
            raise ParameterError(
                f"`capacity` is {capacity}, outside 1..{CAPACITY_MAX}", name="capacity"
            )
        options = _Replay(
            capacity,
            _share("replay", replay),
            _share("staleness", staleness),
            _share("temperature", temperature, least=0.01),
            _share("edit", edit),
            _share("scale", scale),
            check_word("score", score, ("learnability", "given")) == "learnability",
        )
        super().__init__(
            _native.Levels.prioritized(
                self.scenario, _varied(self.scenario, params), check_seed(seed), options
            )
        )

    @property
    def kept(self) -> int:
        """How many levels are kept."""
        return self._native.kept()

    def update(self, levels: Sequence[str | Mapping[str, Any]], scores: Sequence[float]) -> None:
        """Gives levels that have ended their scores; `infos["setpiece"]["level"]` names them.

        Raises `LevelError` for a level of another scenario, `ParameterError` for a score that isn't
        finite, or for another number of scores than levels; then none is given.
        """
        if len(levels) != len(scores):
            raise ParameterError(
                f"expected a score for each of {len(levels)} levels, found {len(scores)}",
                name="scores",
            )
        read = [read_level(given) for given in levels]
        for level, given, score in zip(read, levels, scores, strict=True):
            level.check(self.scenario)
            if not isfinite(score):
                raise ParameterError(f"the score of `{given}` is {score}", name="scores")
        for level, score in zip(read, scores, strict=True):
            self._native.score(level.params, *level.key, float(score))


def _varied(scenario: Scenario, params: Sequence[str] | None) -> list[int]:
    """The places of the parameters that are drawn."""
    known = [*scenario.params]
    can = [
        name
        for name, param in scenario.params.items()
        if param.range is not None or param.choices or param.type == "bool"
    ]
    if params is None:
        params = can
    if isinstance(params, str):
        raise ParameterError(f"expected a list of names, found `{params!r}`", name="params")
    for name in params:
        if name not in can:
            why = (
                "has neither a range nor a list of values"
                if name in known
                else f"isn't one of `{'`, `'.join(known)}`"
            )
            raise ParameterError(
                f"the parameter `{name}` {why}", name=str(name), help=similar(str(name), can)
            )
    if not params:
        raise ParameterError(
            f"`{scenario.name}` has no parameter that could be drawn", name="params"
        )
    return [known.index(name) for name in params]


def _share(name: str, value: float, least: float = 0.0) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= 1:
        raise ParameterError(f"`{name}` is {value!r}, outside {least:g}..1", name=name)
    return float(value)
