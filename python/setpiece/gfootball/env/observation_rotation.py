"""Turns observations and actions by 180°: every agent believes that it attacks from left to right."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from setpiece.gfootball.env.football_action_set import (
    CoreAction,
    action_set_dict,
    get_action_set,
    get_sticky_actions,
    held_by,
    named_action_from_action_set,
)

if TYPE_CHECKING:
    from setpiece.gfootball.env.config import Config

_OPPOSITE = {
    **{"left": "right", "top_left": "bottom_right", "top": "bottom", "top_right": "bottom_left"},
    **{"right": "left", "bottom_right": "top_left", "bottom": "top", "bottom_left": "top_right"},
}
_ACTIONS = {action.name: action for action in action_set_dict["full"]}
_TURNED = ("_team", "_team_direction")
_KEPT = (
    *("_team_tired_factor", "_team_active", "_team_yellow_card", "_team_roles", "_team_designated_player"),
    "_agent_controlled_player",
)
_STICKY = "_agent_sticky_actions"


def flip_team_observation(
    observation: dict[str, Any], result: dict[str, Any], config: Config | dict[str, Any], from_team: str, to_team: str
) -> None:
    """Writes a team of an observation into another one, turned, as the other team: `left` or `right`."""
    for key in _TURNED:
        result[to_team + key] = -np.asarray(observation[from_team + key])
    for key in _KEPT:
        if from_team + key in observation:
            result[to_team + key] = observation[from_team + key]
    if from_team + _STICKY in observation:
        sticky = observation[from_team + _STICKY]
        result[to_team + _STICKY] = [rotate_sticky_actions(each, config) for each in sticky]


def flip_observation(observation: dict[str, Any], config: Config | dict[str, Any]) -> dict[str, Any]:
    """Returns an observation as the other side sees it: that of the whole match, or an agent's own.

    What is turned is an array, of a list too.
    """
    result = dict(observation)
    flip_team_observation(observation, result, config, "left", "right")
    flip_team_observation(observation, result, config, "right", "left")
    turn = np.array([-1.0, -1.0, 1.0])
    result["ball"] = observation["ball"] * turn
    result["ball_direction"] = observation["ball_direction"] * turn
    owner = observation["ball_owned_team"]
    result["ball_owned_team"] = owner if owner == -1 else 1 - owner
    result["score"] = [observation["score"][1], observation["score"][0]]
    if "sticky_actions" in observation:
        result["sticky_actions"] = rotate_sticky_actions(observation["sticky_actions"], config)
    return result


def rotate_sticky_actions(sticky_actions_state: Any, config: Config | dict[str, Any]) -> NDArray[np.uint8]:
    """Returns what is held, uint8 `(10,)` or `(13,)`, with the direction turned round; nothing held stays nothing."""
    names = [action.name for action in get_sticky_actions(config)]
    state = np.asarray(sticky_actions_state, np.uint8)
    if not len(state):
        return state
    return state[[names.index(_OPPOSITE.get(name, name)) for name in names]]


def flip_single_action(action: Any, config: Config | dict[str, Any]) -> Any:
    """Returns an action turned round: only the eight directions change; a number gives a number."""
    actions = get_action_set(config)
    named = named_action_from_action_set(actions, action)
    turned = _ACTIONS[_OPPOSITE.get(named.name, named.name)]
    return turned if isinstance(held_by(action), CoreAction) else actions.index(turned)
