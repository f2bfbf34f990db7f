"""Turns observations and actions by 180°: every agent sees itself attacking to the right."""

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
    *(
        "_team_tired_factor",
        "_team_active",
        "_team_yellow_card",
        "_team_roles",
        "_team_designated_player",
    ),
    "_agent_controlled_player",
)
_STICKY = "_agent_sticky_actions"


def flip_team_observation(
    observation: dict[str, Any],
    result: dict[str, Any],
    config: Config | dict[str, Any],
    from_team: str,
    to_team: str,
) -> None:
    """Writes a team of an observation into another one, turned, as team `left` or `right`."""
    for key in _TURNED:
        result[to_team + key] = rotate_points(observation[from_team + key])
    for key in _KEPT:
        if from_team + key in observation:
            result[to_team + key] = observation[from_team + key]
    if from_team + _STICKY in observation:
        sticky = observation[from_team + _STICKY]
        result[to_team + _STICKY] = [rotate_sticky_actions(each, config) for each in sticky]


def flip_observation(
    observation: dict[str, Any], config: Config | dict[str, Any]
) -> dict[str, Any]:
    """Returns an observation as the other side sees it: of the whole match, or an agent's own.

    Turned points are arrays, even if the observation has lists. Arrays keep their dtypes, and
    flipping twice returns the same values.
    """
    result = dict(observation)
    flip_team_observation(observation, result, config, "left", "right")
    flip_team_observation(observation, result, config, "right", "left")
    for key in ("ball", "ball_direction"):
        result[key] = rotate_3d_point(observation[key])
    owner = observation["ball_owned_team"]
    result["ball_owned_team"] = owner if owner == -1 else 1 - owner
    result["score"] = [observation["score"][1], observation["score"][0]]
    if "sticky_actions" in observation:
        result["sticky_actions"] = rotate_sticky_actions(observation["sticky_actions"], config)
    return result


def rotate_3d_point(point: Any) -> NDArray[Any]:
    """Returns a point `(3,)` turned about the centre spot, with the same dtype."""
    return np.array([-point[0], -point[1], point[2]])


def rotate_points(points: Any) -> NDArray[Any]:
    """Returns points turned about the centre spot, with the same shape and dtype."""
    return -np.asarray(points)


def rotate_sticky_actions(sticky_actions_state: Any, config: Config | dict[str, Any]) -> Any:
    """Returns the held actions, 10 or 13 values, with the direction turned.

    An array gives an array of its dtype, a list gives a list of the same values, and an empty state
    stays empty.
    """
    state = sticky_actions_state
    if not len(state):
        return state
    names = [action.name for action in get_sticky_actions(config)]
    order = [names.index(_OPPOSITE.get(name, name)) for name in names]
    return state[order] if isinstance(state, np.ndarray) else [state[at] for at in order]


def flip_single_action(action: Any, config: Config | dict[str, Any]) -> Any:
    """Returns an action turned by 180°: only directions change; a number gives a number."""
    actions = get_action_set(config)
    named = named_action_from_action_set(actions, action)
    turned = _ACTIONS[_OPPOSITE.get(named.name, named.name)]
    return turned if isinstance(held_by(action), CoreAction) else actions.index(turned)


def flip_action(action: Any, config: Config | dict[str, Any]) -> Any:
    """Returns an action turned by 180°, or a list of them for a list or an array of actions."""
    if isinstance(action, list) or (isinstance(action, np.ndarray) and action.ndim):
        return [flip_single_action(each, config) for each in action]
    return flip_single_action(action, config)
