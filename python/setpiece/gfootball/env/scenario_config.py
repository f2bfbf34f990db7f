"""What a scenario in Google Research Football's form can set."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

from setpiece._errors import ParameterError
from setpiece._words import similar
from setpiece.gfootball.scenarios import PlayerRole

NEVER = 999_999_999
"""`second_half` of a match without half-time."""
FIXED_SEED = 42
"""The seed of deterministic scenarios."""


@dataclass
class FormationEntry:
    """A player: his place in his team's own frame, who plays him and whether agents may."""

    position: tuple[float, float]
    role: PlayerRole
    lazy: bool = False
    controllable: bool = True


@dataclass
class ScenarioConfig:
    """All that a script can set, with GRF's defaults; another name raises `ParameterError`.

    Players are in their team's own frame, the ball is in the left team's.
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
        known = [each.name for each in fields(self)]
        if name not in known:
            raise ParameterError(f"no scenario setting `{name}`", name=name, help=similar(name, known))
        super().__setattr__(name, value)

    @property
    def controllable_left_players(self) -> int:
        """How many of the left team agents may play."""
        return sum(entry.controllable for entry in self.left_team)

    @property
    def controllable_right_players(self) -> int:
        """How many of the right team agents may play."""
        return sum(entry.controllable for entry in self.right_team)

    @property
    def dynamic_player_selection(self) -> bool:
        """Whether an agent changes players: it does where a team has fewer agents than players for them."""
        left, right = self.controllable_left_players, self.controllable_right_players
        return self.left_agents not in (0, left) or self.right_agents not in (0, right)
