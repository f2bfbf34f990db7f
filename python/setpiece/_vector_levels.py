"""The levels of a vector: where they come from, and which scenarios they are of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from setpiece import _native
from setpiece._casting import scripted_scenario
from setpiece._env_options import EnvOptions
from setpiece._errors import CompileError, ParameterError
from setpiece._level import Level
from setpiece._levels import (
    FunctionLevels,
    GivenLevel,
    LevelsArgument,
    LevelSource,
    ListedLevels,
    read_levels,
)
from setpiece._native import Scenario
from setpiece._options import ParamValue
from setpiece._source import Source, is_file, is_text

Params = Mapping[str, ParamValue] | Sequence[Mapping[str, ParamValue]] | None
"""Parameters of all environments, or of each."""


class VectorLevels:
    """What chooses the levels of a vector, if it isn't its environments themselves."""

    native: _native.Levels | FunctionLevels | None = None
    """What the batch asks for levels."""
    source: LevelSource | None = None
    """The same, if it is one of the package."""

    def __init__(
        self,
        levels: LevelsArgument | None,
        params: Params,
        source: Source,
        scenario: Scenario,
        options: EnvOptions,
    ) -> None:
        """Reads `levels` of a vector of a scenario, or raises `ParameterError`."""
        self._source, self._scenario, self._options = source, scenario, options
        self.chosen = levels is not None
        if levels is None:
            return
        read = read_levels(levels, source, scenario.name, self._load, options.allow_outside)
        is_given = isinstance(read, FunctionLevels | ListedLevels)
        if isinstance(params, list | tuple) or (params is not None and not is_given):
            raise ParameterError(
                "`levels` chooses the parameters",
                name="params",
                help="bind them in the level, the curriculum, or the scenario of the sampler",
            )
        if isinstance(read, FunctionLevels):
            self.native = read
            return
        if options.scripted and not is_given:
            raise ParameterError(
                "behaviours play against the vector's scenario, and `levels` brings its own",
                name="opponents",
                help="give them to players in the text: `ai: NAME`",
            )
        self.source, self.native = read, read.native

    def _load(self, name: str) -> Scenario:
        """The scenario of a level's name: the vector's, another one of its file, or the library's."""
        if name == self._scenario.name:
            return self._scenario
        if is_text(self._source) or is_file(self._source):
            try:
                return scripted_scenario(self._source, self._options, {}, name)
            except CompileError as error:
                if error.code != "SP0214":
                    raise
        return scripted_scenario(name, self._options, {})

    def given(
        self, levels: Sequence[Level | None], scenarios: Sequence[Scenario]
    ) -> list[GivenLevel | None]:
        """Returns levels with their scenarios, which the vector knows."""
        # The vector's own knows its digest without bound parameters.
        known = {self._scenario.name: self._scenario}
        for scenario in scenarios:
            known.setdefault(scenario.name, scenario)
        return [
            None
            if level is None
            else GivenLevel.of(level, known.get(level.scenario, self._scenario))
            for level in levels
        ]

    def lacks_seed(self, begun: bool) -> bool:
        """Whether nobody has given a seed yet; `begun`: whether the vector has."""
        return not begun if self.source is None else self.source.seed is None
