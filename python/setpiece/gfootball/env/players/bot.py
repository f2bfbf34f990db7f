"""A simple attacker: runs at goal, shoots near it, and passes or sidesteps opponents."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import ParameterError
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env.football_action_set import CoreAction
from setpiece.gfootball.env.player_base import PlayerBase

GOAL = np.array([0.85, 0.0])
"""The point it runs to."""
SHOOTING = 0.15
"""Distance from there at which it shoots."""
IN_THE_WAY = 0.08
"""Distance at which it must pass an opponent ahead."""
MATE = 0.3
"""Reach of its passes."""

# Clockwise in the picture, from straight ahead: y grows downwards.
_COMPASS = (
    actions.action_right,
    actions.action_bottom_right,
    actions.action_bottom,
    actions.action_bottom_left,
    actions.action_left,
    actions.action_top_left,
    actions.action_top,
    actions.action_top_right,
)


class Player(PlayerBase):
    """Plays one player; needs the action set `full`, since it presses."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:
        super().__init__(player_config)
        if env_config["action_set"] != "full":
            raise ParameterError(
                "the player `bot` presses, and so needs the action set `full`",
                name="action_set",
                help="other_config_options={'action_set': 'full'}; `builtin_ai` plays in any set",
            )
        if self.num_controlled_players() != 1:
            raise ParameterError(
                "a `bot` plays one player", name="players", help="write one definition for each"
            )
        self._pressing = False
        self._turned = False

    def reset(self) -> None:
        """Begins an episode."""
        self._pressing = False
        self._turned = False

    def take_action(self, observations: list[dict[str, Any]]) -> Any:
        """Returns its player's next action."""
        return [self._next(observations[0])]

    def _next(self, seen: dict[str, Any]) -> CoreAction:
        """The next action, in the frame in which its own team attacks towards +x."""
        if seen["active"] == -1:
            return actions.action_idle
        if seen["game_mode"] != 0:
            return actions.action_long_pass
        if seen["ball_owned_team"] == 1:
            self._pressing, self._turned = not self._pressing, False
            return actions.action_pressure if self._pressing else actions.action_sprint
        if self._pressing:
            self._pressing = False
            return actions.action_release_pressure
        me = seen["left_team"][seen["active"]]
        if np.linalg.norm(GOAL - me) < SHOOTING:
            return actions.action_shot
        ahead = _nearest_ahead(me, seen["right_team"])
        if ahead is None or np.linalg.norm(ahead - me) >= IN_THE_WAY:
            self._turned = False
            return _towards(GOAL - me)
        mate = _best_mate(seen, me)
        if mate is None:
            return _aside(me, ahead)
        # It faces the teammate first, and passes in the next step.
        self._turned = not self._turned
        return _towards(mate - me) if self._turned else actions.action_short_pass


def _towards(way: NDArray[np.float64]) -> CoreAction:
    """The one of the eight directions nearest to a vector."""
    return _COMPASS[round(float(np.arctan2(way[1], way[0])) / (np.pi / 4)) % 8]


def _aside(me: NDArray[np.float64], other: NDArray[np.float64]) -> CoreAction:
    """The direction across the way to the goal, away from an opponent."""
    way = GOAL - me
    across = np.array([-way[1], way[0]])
    return _towards(across if across @ (other - me) < 0 else -across)


def _nearest_ahead(
    me: NDArray[np.float64], team: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    before = team[(team - me) @ (GOAL - me) > 0]
    return None if not len(before) else before[np.argmin(np.linalg.norm(before - me, axis=1))]


def _best_mate(seen: dict[str, Any], me: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """The teammate within reach who is most free and nearest to the goal."""
    best, best_value = None, 0.0
    for number, mate in enumerate(seen["left_team"]):
        if (
            number == seen["active"]
            or not seen["left_team_active"][number]
            or np.linalg.norm(mate - me) > MATE
        ):
            continue
        opponents = seen["right_team"]
        room = float(np.min(np.linalg.norm(opponents - mate, axis=1))) if len(opponents) else 1.0
        value = room - float(np.linalg.norm(GOAL - mate) - np.linalg.norm(GOAL - me))
        if best is None or value > best_value:
            best, best_value = mate, value
    return best
