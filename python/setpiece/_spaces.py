"""The spaces of observations and actions."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any

import numpy as np
from gymnasium import spaces

from setpiece import _native
from setpiece._errors import ParameterError

OBSERVATIONS = ("simple115v2", "smm", "raw")


def check_observation(name: object) -> str:
    """Returns the name of an observation, or raises `ParameterError`."""
    if name in OBSERVATIONS:
        return str(name)
    similar = get_close_matches(str(name), OBSERVATIONS, n=1)
    raise ParameterError(
        f"no observation `{name}`; there are `{'`, `'.join(OBSERVATIONS)}`",
        name="observation",
        help=f"did you mean `{similar[0]}`?" if similar else None,
    )


def action_space(n_agents: int) -> spaces.Discrete | spaces.MultiDiscrete:
    """Returns the space of one agent's action, or of several agents' actions."""
    n_actions = len(_native.ACTIONS)
    return spaces.Discrete(n_actions) if n_agents == 1 else spaces.MultiDiscrete([n_actions] * n_agents)


def observation_space(native: _native.Environment, observation: str) -> spaces.Space[Any]:
    """Returns the space of what `reset` and `step` observe.

    With several agents an array gains a leading axis, and a raw observation becomes a tuple with one part per agent.
    """
    n_agents = len(native.agents)
    if observation == "raw":
        parts = [_raw_space(native.players, native.n_steps_max, agent.team) for agent in native.agents]
        return parts[0] if n_agents == 1 else spaces.Tuple(parts)
    if observation == "smm":
        shape = _native.SMM_SHAPE if n_agents == 1 else (n_agents, *_native.SMM_SHAPE)
        return spaces.Box(0, 255, shape, np.uint8)
    low, high = _native.simple115v2_bounds()
    if n_agents > 1:
        low, high = np.tile(low, (n_agents, 1)), np.tile(high, (n_agents, 1))
    return spaces.Box(low, high, dtype=np.float32)
