"""Scenarios for PufferLib: a native environment, and one whose groups overlap with the policy.

```python
import setpiece.pufferlib

env = setpiece.pufferlib.make("academy_3_vs_1_with_keeper", 64, groups=2, rewards="scoring")
env.async_reset(seed=1)
observations, rewards, terminals, truncations, infos, agent_ids, masks = env.recv()
```

PufferLib counts agents: environment k with n agents has the agents k · n to k · n + n - 1. Episodes
begin again in the step in which they end. `infos` has a dict for each episode that has ended:
`episode_return` (of its first agent), `episode_length`, `success`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from setpiece._groups import FootballGroups
from setpiece._native import Scenario
from setpiece._optional import need
from setpiece._source import Source
from setpiece._spaces import action_of_one_agent, box_of_one_agent
from setpiece._vector import FootballVectorEnv
from setpiece._vector_levels import Params

need("pufferlib", "pufferlib", "`setpiece.pufferlib`")
import pufferlib  # noqa: E402
import pufferlib.spaces  # noqa: E402
import pufferlib.vector  # noqa: E402

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from setpiece._env_options import VectorArguments

__all__ = ["FootballPuffer", "FootballPufferGroups", "make"]

Infos = list[dict[str, float]]
PufferStep = tuple[Any, NDArray[np.float32], NDArray[np.bool_], NDArray[np.bool_], Infos]


class FootballPuffer(pufferlib.PufferEnv):
    """`num_envs` matches as a native `PufferEnv`, for `pufferlib.vector.make`."""

    def __init__(
        self,
        scenario: Source,
        num_envs: int = 1,
        *,
        threads: int | None = None,
        params: Params = None,
        buf: Any = None,
        **arguments: Unpack[VectorArguments],
    ) -> None:
        """Makes the matches.

        - `buf`: PufferLib's buffers; it also passes `seed`, that of the first `reset`.
        - The rest is as in `setpiece.make_vec`.
        """
        self.vector = FootballVectorEnv(
            scenario,
            num_envs,
            threads=threads,
            autoreset_mode=AutoresetMode.SAME_STEP,
            params=params,
            **arguments,
        )
        self.n_agents = len(self.vector.agents)
        self.num_agents = num_envs * self.n_agents
        self.single_observation_space = box_of_one_agent(self.vector)
        self.single_action_space = action_of_one_agent(self.vector)
        super().__init__(buf)

    def reset(self, seed: int | None = None) -> tuple[Any, Infos]:
        """Begins an episode of every match; match k gets the seed s + k."""
        observed, _ = self.vector.reset(seed=seed)
        self._show(observed)
        self.rewards[:] = 0
        self.terminals[:] = self.truncations[:] = False
        return self.observations, []

    def step(self, actions: NDArray[Any]) -> PufferStep:
        """Plays 100 ms of every match."""
        given = np.asarray(actions).reshape(self.vector.action_space.shape)
        observed, rewards, terminated, truncated, infos = self.vector.step(given)
        self._show(observed)
        self.rewards[:] = np.asarray(rewards, np.float32).ravel()
        self.terminals[:] = np.repeat(terminated, self.n_agents)
        self.truncations[:] = np.repeat(truncated, self.n_agents)
        results = _ended(infos)
        return self.observations, self.rewards, self.terminals, self.truncations, results

    def close(self) -> None:
        """Closes the matches."""
        self.vector.close()

    def _show(self, observed: NDArray[Any]) -> None:
        self.observations[:] = observed.reshape(self.observations.shape)


class FootballPufferGroups:
    """Matches in groups, with the interface of PufferLib's vectors.

    `recv` returns the group that was sent first; `send` begins its next step in the background.
    """

    reset = pufferlib.vector.reset
    step = pufferlib.vector.step
    emulated = False

    def __init__(self, groups: FootballGroups) -> None:
        """Takes groups over, which begin episodes in the step in which the last one ends."""
        if groups.autoreset_mode != AutoresetMode.SAME_STEP:
            raise pufferlib.APIUsageError("make the groups with `autoreset_mode='same_step'`")
        self.groups = groups
        self.n_agents = len(groups.agents)
        self.num_agents = groups.num_envs * self.n_agents
        self.agents_per_batch = groups.batch_size * self.n_agents
        self.single_observation_space = box_of_one_agent(groups)
        self.single_action_space = action_of_one_agent(groups)
        joint = pufferlib.spaces.joint_space
        self.observation_space = joint(self.single_observation_space, self.agents_per_batch)
        self.action_space = joint(self.single_action_space, self.agents_per_batch)

    @property
    def num_envs(self) -> int:
        """The agents of a batch, which PufferLib calls environments."""
        return self.agents_per_batch

    @property
    def scenario(self) -> Scenario:
        """The scenario."""
        return self.groups.scenario

    @property
    def driver_env(self) -> FootballPufferGroups:
        """Whatever has the spaces."""
        return self

    def async_reset(self, seed: int | None = None) -> None:
        """Begins an episode of every match, and returns at once."""
        self.groups.async_reset(seed)

    def send(self, actions: NDArray[Any]) -> None:
        """Begins the next step of the group that was received first."""
        self.groups.send(np.asarray(actions).reshape(self.groups.action_space.shape))

    def recv(
        self,
    ) -> tuple[
        Any,
        NDArray[np.float32],
        NDArray[np.bool_],
        NDArray[np.bool_],
        Infos,
        NDArray[np.int64],
        NDArray[np.bool_],
    ]:
        """Waits for the group that was sent first."""
        observed, rewards, terminated, truncated, infos = self.groups.recv()
        n = self.n_agents
        agents = (infos["env_id"][:, None] * n + np.arange(n)).ravel()
        return (
            observed.reshape(self.agents_per_batch, *self.single_observation_space.shape),
            np.asarray(rewards, np.float32).ravel(),
            np.repeat(terminated, n),
            np.repeat(truncated, n),
            _ended(infos),
            agents,
            np.ones(self.agents_per_batch, bool),
        )

    def close(self) -> None:
        """Waits for what is being played, and closes the matches."""
        self.groups.close()


def make(
    scenario: Source,
    num_envs: int = 2,
    *,
    groups: int = 2,
    threads: int | None = None,
    params: Params = None,
    **arguments: Unpack[VectorArguments],
) -> FootballPufferGroups:
    """Makes matches in groups for PufferLib's loop of `recv` and `send`.

    The arguments are those of `setpiece.make_groups`.
    """
    made = FootballGroups(
        scenario,
        num_envs,
        groups=groups,
        threads=threads,
        autoreset_mode=AutoresetMode.SAME_STEP,
        params=params,
        **arguments,
    )
    return FootballPufferGroups(made)


def _ended(infos: dict[str, Any]) -> Infos:
    """What PufferLib logs of the episodes that have just ended."""
    last = infos.get("final_info")
    if last is None:
        return []
    results, summary = [], last["setpiece"]
    for at in np.flatnonzero(infos["_final_info"]).tolist():
        paid = sum(float(np.ravel(terms[at])[0]) for terms in summary["return"].values())
        results.append(
            {
                "episode_return": paid,
                "episode_length": float(summary["length"][at]),
                "success": float(summary["success"][at]),
            }
        )
    return results
