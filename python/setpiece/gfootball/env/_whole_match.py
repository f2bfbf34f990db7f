"""A slot's observation, and the whole match combined from these, in GRF's conventions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from setpiece.gfootball.env.config import has_bug
from setpiece.gfootball.env.football_action_set import get_sticky_actions
from setpiece.gfootball.env.observation_rotation import flip_observation

if TYPE_CHECKING:
    from setpiece.gfootball.env.config import Config

KICK_OFF = 1
"""The `game_mode` of a pending kick-off."""
OWNERLESS = (1, 2, 3, 4, 6)
"""The `game_mode`s in which GRF shows no owner of the ball: all set pieces but the throw-in."""


def slot_view(native: dict[str, Any], config: Config | dict[str, Any]) -> dict[str, Any]:
    """Returns a raw observation of the engine with GRF's types and conventions."""
    mode = native["game_mode"]
    owner = {"ball_owned_team": -1, "ball_owned_player": -1} if mode in OWNERLESS else {}
    return {
        **native,
        **owner,
        "game_mode": 0 if mode == KICK_OFF and has_bug(config, "kick_off_mode") else mode,
        "score": [int(goals) for goals in native["score"]],
        "steps_left": int(native["steps_left"]),
        "sticky_actions": native["sticky_actions"][: len(get_sticky_actions(config))],
    }


def whole_match(
    first: dict[str, Any],
    left: list[dict[str, Any]],
    right: list[dict[str, Any]],
    config: Config | dict[str, Any],
    *,
    seen_by_left: bool,
) -> dict[str, Any]:
    """Returns the whole match, in the frame of the pitch.

    - `first`: a view in that frame, and whether it is one of the left team's own.
    - `left`, `right`: what each slot sees, in its team's own frame.
    """
    whole = {
        key: value
        for key, value in first.items()
        if key not in ("active", "designated", "sticky_actions")
    }
    for side, views in (("left", left), ("right", right)):
        whole[f"{side}_agent_controlled_player"] = [view["active"] for view in views]
        whole[f"{side}_team_designated_player"] = views[0]["designated"] if views else -1
    if seen_by_left:
        whole["left_team_designated_player"] = first["designated"]
    whole["left_agent_sticky_actions"] = [view["sticky_actions"] for view in left]
    whole["right_agent_sticky_actions"] = [
        flip_observation(view, config)["sticky_actions"] for view in right
    ]
    return whole
