"""The global state of a match, for a centralised critic."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from setpiece._spaces import COUNT_MAX
from setpiece._vocabulary import GameMode

PER_PLAYER = 8
AFTER_PLAYERS = 9 + len(GameMode) + 3
STEPS_UNIT = 1000.0


def state_space(players: tuple[int, int]) -> spaces.Box:
    """Returns the space of the state with this many players, left and right."""
    n_players, n_modes = sum(players), len(GameMode)
    spin, count, time = 1.0, float(COUNT_MAX), COUNT_MAX / STEPS_UNIT
    player, flags, ball = [2.0, 1.5, 1.0, 1.0], [1.0] * 4, [1.0, 1.0, 10.0]
    low = [
        *([-bound for bound in player] + [0.0] * 4) * n_players,
        -2.0,
        -1.5,
        0.0,
        *(-bound for bound in ball),
    ]
    high = [*(player + flags) * n_players, 2.0, 1.5, 100.0, *ball]
    bounds = [
        np.array(low + [-spin] * 3 + [0.0] * (n_modes + 3)),
        np.array(high + [spin] * 3 + [1.0] * n_modes + [count, count, time]),
    ]
    return spaces.Box(bounds[0].astype(np.float32), bounds[1].astype(np.float32), dtype=np.float32)


def state(raw: dict[str, Any], team: int) -> NDArray[np.float32]:
    """Returns the state, float32, from a raw observation of a team's agent: see `parallel_env`."""
    sides = ("left_team", "right_team") if team == 0 else ("right_team", "left_team")
    # The right team's agents see the pitch turned by 180°.
    turn = 1.0 if team == 0 else -1.0
    parts: list[NDArray[Any]] = []
    for number, side in enumerate(sides):
        n_players = len(raw[side])
        has_ball = np.zeros(n_players)
        if raw["ball_owned_team"] == (number if team == 0 else 1 - number):
            has_ball[raw["ball_owned_player"]] = 1.0
        flags = [raw[f"{side}_{flag}"] for flag in ("tired_factor", "yellow_card", "active")]
        rows = [*(turn * raw[side]).T, *(turn * raw[f"{side}_direction"]).T, *flags, has_ball]
        parts.append(np.stack(rows, axis=1).ravel())
    for vector in (raw["ball"], raw["ball_direction"], raw["ball_rotation"]):
        parts.append(vector * (turn, turn, 1.0))
    mode = np.zeros(len(GameMode))
    mode[raw["game_mode"]] = 1.0
    score = raw["score"] if team == 0 else raw["score"][::-1]
    parts += [mode, score, np.array([max(0.0, raw["steps_left"] / STEPS_UNIT)])]
    return np.concatenate(parts).astype(np.float32)
