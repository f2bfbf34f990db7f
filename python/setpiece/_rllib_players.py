"""The players of many matches as environments of their own, for RLlib."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import Space
from gymnasium.spaces import Box, Discrete, MultiDiscrete
from gymnasium.vector import VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from setpiece._vector import FootballVectorEnv


class Players(VectorEnv[Any, Any, Any]):
    """Many matches in which every agent is an environment: a row of every array.

    Infos stay those of the matches, except for `final_obs`, a row for each player whose match has
    ended; the next one has begun.
    """

    closed = True
    """Until it is made."""

    def __init__(self, config: dict[str, Any], matches: int) -> None:
        """`config` holds the arguments of `setpiece.make_vec`."""
        arguments = {"threads": 1, **config}
        arguments.pop("num_envs", None)
        self.envs = FootballVectorEnv(num_envs=matches, autoreset_mode="same_step", **arguments)
        self.matches, self.players = matches, len(self.envs.agents)
        self.num_envs = matches * self.players
        self.single_observation_space = alone(self.envs.single_observation_space, self.players)
        self.single_action_space = alone(self.envs.single_action_space, self.players)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.metadata = self.envs.metadata
        self.closed = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begins an episode of every match."""
        observations, infos = self.envs.reset(seed=seed, options=options)
        return self._rows(observations), infos

    def step(
        self, actions: NDArray[Any]
    ) -> tuple[Any, NDArray[Any], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Plays 100 ms of every match."""
        shape = self.envs.action_space.shape
        observations, rewards, terminated, truncated, infos = self.envs.step(
            actions.reshape(shape or actions.shape)
        )
        if "final_obs" in infos:
            last = np.full(self.num_envs, None, dtype=object)
            for at in np.flatnonzero(infos["_final_obs"]).tolist():
                first = at * self.players
                for player, shown in enumerate(self._rows(infos["final_obs"][at])):
                    last[first + player] = shown
            infos["final_obs"] = last
        return (
            self._rows(observations),
            rewards.reshape(-1),
            np.repeat(terminated, self.players),
            np.repeat(truncated, self.players),
            infos,
        )

    def close_extras(self, **kwargs: Any) -> None:
        """Closes the matches."""
        self.envs.close(**kwargs)

    def _rows(self, observations: NDArray[Any]) -> NDArray[Any]:
        return observations.reshape(-1, *(self.single_observation_space.shape or ()))


def alone(space: Space[Any], players: int) -> Space[Any]:
    """Returns one player's part of a space of several."""
    if players == 1:
        return space
    if isinstance(space, MultiDiscrete):
        return Discrete(int(space.nvec[0]))
    assert isinstance(space, Box)
    return Box(space.low[0], space.high[0], dtype=space.dtype.type)
