"""The settings of a scenario in Google Research Football's form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from math import isfinite
from operator import index
from typing import Any

import numpy as np

from setpiece._errors import ParameterError
from setpiece._words import similar
from setpiece.gfootball.scenarios import PlayerRole

NEVER = 999_999_999
"""`second_half` of a match without half-time."""
FIXED_SEED = 42
"""The seed of deterministic scenarios."""


@dataclass
class FormationEntry:
    """A player: the place in the team's own frame, who plays them and whether agents may.

    Place and role are read-only, as in GRF: setting them raises `ParameterError`.
    """

    position: tuple[float, float]
    role: PlayerRole
    lazy: bool = False
    controllable: bool = True

    def __setattr__(self, name: str, value: Any) -> None:
        if name in ("position", "role") and name in self.__dict__:
            raise ParameterError(
                f"a player's `{name}` can only be read", name=name, help="say it in `AddPlayer`"
            )
        super().__setattr__(name, value)


@dataclass
class ScenarioConfig:
    """All settings of a script, with GRF's defaults.

    Another name or kind of value raises `ParameterError`. Players are in their team's own frame,
    the ball is in the left team's.
    """

    ball_position: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    left_team: list[FormationEntry] = field(default_factory=list)
    right_team: list[FormationEntry] = field(default_factory=list)
    left_agents: int = 1
    right_agents: int = 0
    game_duration: int = 3000
    second_half: int = NEVER
    deterministic: bool = False
    offsides: bool = True
    end_episode_on_score: bool = False
    end_episode_on_out_of_play: bool = False
    end_episode_on_possession_change: bool = False
    left_team_difficulty: float = 1.0
    right_team_difficulty: float = 0.6
    control_all_players: bool = False
    use_magnet: bool = True
    game_engine_random_seed: int = FIXED_SEED
    reverse_team_processing: bool = False
    real_time: bool = False

    def __setattr__(self, name: str, value: Any) -> None:
        kinds = {each.name: each.type for each in fields(self)}
        if name not in kinds:
            raise ParameterError(
                f"no scenario setting `{name}`", name=name, help=similar(name, kinds)
            )
        super().__setattr__(name, _checked(name, value, str(kinds[name])))

    def check(self) -> None:
        """Raises `ParameterError` if a list contains what it can't hold."""
        for each in fields(self):
            _checked(each.name, getattr(self, each.name), str(each.type))

    @property
    def controllable_left_players(self) -> int:
        """How many players of the left team agents may control."""
        return sum(entry.controllable for entry in self.left_team)

    @property
    def controllable_right_players(self) -> int:
        """How many players of the right team agents may control."""
        return sum(entry.controllable for entry in self.right_team)

    @property
    def dynamic_player_selection(self) -> bool:
        """Whether an agent switches players, because a team has fewer agents than players for them."""
        left, right = self.controllable_left_players, self.controllable_right_players
        return self.left_agents not in (0, left) or self.right_agents not in (0, right)


def _checked(name: str, value: Any, kind: str) -> Any:
    """Returns a value as the plain type of a setting, or raises `ParameterError`."""
    try:
        return _KINDS[kind][0](value)
    except (TypeError, ValueError, OverflowError):
        raise ParameterError(f"`{name}` is {value!r}; it is {_KINDS[kind][1]}", name=name) from None


def _flag(value: Any) -> bool:
    # 0 and 1 are accepted as flags too.
    return bool(value) if isinstance(value, np.bool_) else bool(index(value))


def _integer(value: Any) -> int:
    return int(index(value))


def _number(value: Any) -> float:
    if isinstance(value, (str, bytes)) or not isfinite(float(value)):
        raise ValueError
    return float(value)


def _ball(value: Any) -> list[float]:
    if len(value) not in (2, 3):
        raise ValueError
    return [_number(number) for number in value]


def _team(value: Any) -> list[FormationEntry]:
    if not all(isinstance(entry, FormationEntry) for entry in value):
        raise TypeError
    return list(value)


# By the types of the fields, as written there.
_KINDS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "bool": (_flag, "True or False"),
    "int": (_integer, "an integer"),
    "float": (_number, "a number"),
    "list[float]": (_ball, "three numbers"),
    "list[FormationEntry]": (_team, "a list of players"),
}
