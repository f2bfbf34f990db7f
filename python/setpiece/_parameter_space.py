"""The parameters of a scenario as a space: to sample, to search, to mutate levels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium import spaces
from numpy.typing import ArrayLike, NDArray

from setpiece._errors import ParameterError
from setpiece._level import read_level
from setpiece._options import ParamValue

if TYPE_CHECKING:
    from setpiece._native import Param, Scenario

Value = bool | int | float | str


class Range(spaces.Box):
    """Numbers between two bounds, in SI units; whole ones if `whole`."""

    def __init__(self, low: float, high: float, whole: bool) -> None:
        super().__init__(low, high, (), np.float64)
        self.whole = whole

    def sample(self, mask: None = None, probability: None = None) -> Any:  # noqa: ARG002
        """Returns a number, uniform over what is allowed."""
        return self.at(float(self.np_random.random()))

    def contains(self, x: Any) -> bool:
        """Whether a number is allowed."""
        if isinstance(x, bool) or not isinstance(x, int | float | np.number):
            return False
        inside = float(self.low) <= x <= float(self.high)
        return bool(inside) and (not self.whole or float(x).is_integer())

    def at(self, share: float) -> float | int:
        """Returns the number at a share of the way from the least to the greatest one."""
        low, high = float(self.low), float(self.high)
        if self.whole:
            return int(low) + min(int(share * (high - low + 1)), int(high - low))
        return low + share * (high - low)

    def share(self, value: Any) -> float:
        """Returns where a number is on that way: the middle of its part, for whole ones."""
        low, high = float(self.low), float(self.high)
        if self.whole:
            return (float(value) - low + 0.5) / (high - low + 1)
        return (float(value) - low) / (high - low) if high > low else 0.0


class Choice(spaces.Space[Value]):
    """One of some values."""

    def __init__(self, values: Sequence[Value]) -> None:
        super().__init__()
        self.values = tuple(values)

    @property
    def is_np_flattenable(self) -> bool:
        """False: words have no numbers."""
        return False

    def sample(self, mask: None = None, probability: None = None) -> Value:  # noqa: ARG002
        """Returns a value, uniform over all of them."""
        return self.at(float(self.np_random.random()))

    def contains(self, x: Any) -> bool:
        """Whether a value is one of them."""
        return x in self.values

    def at(self, share: float) -> Value:
        """Returns the value of a part of 0..1."""
        return self.values[min(int(share * len(self.values)), len(self.values) - 1)]

    def share(self, value: Any) -> float:
        """Returns the middle of a value's part of 0..1."""
        return (self.values.index(value) + 0.5) / len(self.values)

    def __repr__(self) -> str:
        """Returns the values."""
        return f"Choice({', '.join(map(repr, self.values))})"


class ParameterSpace(spaces.Dict):
    """The parameters of a scenario that have a range or a list of values, by name.

    Samples are accepted as `params` everywhere: numbers in SI units, words, truth values.
    """

    def __init__(self, scenario: Scenario) -> None:
        """Makes the space of a scenario: `scenario.parameter_space`."""
        self.scenario = scenario
        found = {name: _space(param) for name, param in scenario.params.items()}
        self._parts = {name: space for name, space in found.items() if space is not None}
        super().__init__(dict(self._parts))

    def to_vector(self, params: Mapping[str, ParamValue]) -> NDArray[np.float64]:
        """Returns parameters as numbers in 0..1, float64 `(n,)`; those not named have defaults.

        Raises `ParameterError` for a parameter or value that the scenario doesn't allow.
        """
        bound = self.scenario.with_params(**params).params
        return np.array([part.share(bound[name].default) for name, part in self._parts.items()])

    def from_vector(self, vector: ArrayLike) -> dict[str, Value]:
        """Returns the parameters of numbers, which are clipped to 0..1.

        Raises `ParameterError` for another number of them.
        """
        shares = np.clip(np.asarray(vector, np.float64), 0.0, 1.0)
        if shares.shape != (len(self._parts),) or not np.isfinite(shares).all():
            raise ParameterError(
                f"expected {len(self._parts)} finite numbers, found {vector!r}", name="vector"
            )
        parts = zip(self._parts.items(), shares, strict=True)
        return {name: part.at(float(share)) for (name, part), share in parts}

    def mutate(
        self, level: str | Mapping[str, Any], rng: np.random.Generator, scale: float = 0.1
    ) -> dict[str, Any]:
        """Returns a level with the same seed whose parameters are changed.

        Numbers move by a normal step of `scale` times their range; a value of a list is drawn again
        with a chance of `scale`. Raises `LevelError` for a level of another scenario,
        `ParameterError` for a `scale` that isn't finite or is below 0.
        """
        if not isinstance(scale, int | float | np.integer | np.floating) or not 0 <= scale < float(
            "inf"
        ):
            raise ParameterError(
                f"`scale` is {scale!r}; it can be a number from 0 up", name="scale"
            )
        old = read_level(level)
        old.check(self.scenario)
        params = {
            name: p.default for name, p in self.scenario.with_params(**old.params).params.items()
        }
        for name, part in self._parts.items():
            if isinstance(part, Range):
                share = part.share(params[name]) + scale * rng.normal()
                params[name] = part.at(min(max(share, 0.0), 1.0))
            elif rng.random() < scale:
                params[name] = part.at(rng.random())
        return {
            "scenario": old.scenario,
            "params": params,
            "seed": old.seed,
            "episode": old.episode,
        }


def _space(param: Param) -> Range | Choice | None:
    if param.choices:
        return Choice(param.choices)
    if param.type == "bool":
        return Choice((False, True))
    if param.range is not None:
        return Range(*param.range, whole=param.type == "int")
    return None
