"""The spaces of observations and actions."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np
from gymnasium import spaces

from setpiece import _native
from setpiece._errors import ParameterError

COUNT_MAX = 2**32 - 1
"""Greatest count of goals or steps: the engine counts in 32 bits."""

OBSERVATIONS = ("simple115v2", "smm", "raw", "vector")

OBSERVED_MAX = 1.0e6
"""Greatest size of a number of a scenario's own observation: what is beyond is held there."""


def check_observation(name: object) -> str:
    """Returns the name of an observation, or raises `ParameterError`."""
    return _check_name("observation", name, OBSERVATIONS)


def check_action_set(name: object) -> str:
    """Returns the name of a set of actions, or raises `ParameterError`."""
    return _check_name("action_set", name, tuple(_native.ACTION_SETS))


def _check_name(option: str, name: object, known: tuple[str, ...]) -> str:
    if isinstance(name, str) and name in known:
        return name
    similar = get_close_matches(str(name), known, n=1)
    raise ParameterError(
        f"no {option.replace('_', ' ')} `{name}`; there are `{'`, `'.join(known)}`",
        name=option,
        help=f"did you mean `{similar[0]}`?" if similar else None,
    )


def action_space(n_agents: int, action_set: str) -> spaces.Discrete | spaces.MultiDiscrete:
    """Returns the space of one agent's action, or of several agents' actions: of none where nobody acts."""
    n_actions = _native.ACTION_SETS[action_set]
    if n_agents == 1:
        return spaces.Discrete(n_actions)
    return spaces.MultiDiscrete(np.full(n_agents, n_actions, np.int64))


def observation_space(
    native: _native.Environment, observation: str, agents: Sequence[_native.AgentInfo] | None = None
) -> spaces.Space[Any]:
    """Returns the space of what `reset` and `step` observe: all agents of an environment, or some of them.

    With several agents, or none, an array gains a leading axis, and a raw observation becomes a tuple with one part per
    agent.
    """
    agents = native.agents if agents is None else agents
    n_agents = len(agents)
    if observation == "raw":
        parts = [_raw_space(native.players, agent.team) for agent in agents]
        return parts[0] if n_agents == 1 else spaces.Tuple(parts)
    if observation == "smm":
        shape = _native.SMM_SHAPE if n_agents == 1 else (n_agents, *_native.SMM_SHAPE)
        return spaces.Box(0, 255, shape, np.uint8)
    if observation == "vector":
        width = len(native.observed)
        return spaces.Box(-OBSERVED_MAX, OBSERVED_MAX, (width,) if n_agents == 1 else (n_agents, width), np.float32)
    low, high = _native.simple115v2_bounds()
    if n_agents != 1:
        low, high = np.tile(low, (n_agents, 1)), np.tile(high, (n_agents, 1))
    return spaces.Box(low, high, dtype=np.float32)


def _raw_space(players: tuple[int, int], team: int) -> spaces.Dict:
    """Returns the space of one agent's raw observation; its own team is the left one, whichever it is."""
    low, high = (bound.astype(np.float64) for bound in _native.simple115v2_bounds())
    places, strides, ball, ball_stride = slice(0, 2), slice(22, 24), slice(88, 91), slice(91, 94)

    def like(block: slice, *size: int) -> spaces.Box:
        shape = (*size, block.stop - block.start)
        return spaces.Box(np.broadcast_to(low[block], shape), np.broadcast_to(high[block], shape), dtype=np.float64)

    parts: dict[str, spaces.Space[Any]] = {
        "ball": like(ball),
        "ball_direction": like(ball_stride),
        "ball_rotation": spaces.Box(-1.0, 1.0, (3,), dtype=np.float64),
        "ball_owned_team": spaces.Discrete(3, start=-1),
        "ball_owned_player": spaces.Discrete(12, start=-1),
        "designated": spaces.Discrete(12, start=-1),
        "active": spaces.Discrete(12, start=-1),
        "sticky_actions": spaces.Box(0, 1, (10,), dtype=np.uint8),
        "score": spaces.Box(0, COUNT_MAX, (2,), dtype=np.int64),
        "steps_left": spaces.Box(-1, COUNT_MAX, (), dtype=np.int64),
        "game_mode": spaces.Discrete(7),
    }
    for side, size in zip(("left_team", "right_team"), players if team == 0 else players[::-1], strict=True):
        parts[side] = like(places, size)
        parts[f"{side}_direction"] = like(strides, size)
        parts[f"{side}_tired_factor"] = spaces.Box(0.0, 1.0, (size,), dtype=np.float64)
        parts[f"{side}_yellow_card"] = spaces.Box(0, 1, (size,), dtype=np.bool_)
        parts[f"{side}_active"] = spaces.Box(0, 1, (size,), dtype=np.bool_)
        parts[f"{side}_roles"] = spaces.Box(0, 9, (size,), dtype=np.int64)
    return spaces.Dict(parts)
