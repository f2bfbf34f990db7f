"""Scenarios for Ray RLlib.

```python
import setpiece.rllib

setpiece.rllib.register()
config = PPOConfig().environment("setpiece", env_config={"scenario": "academy_corner", "left": "all"})
```

`FootballEnvRunner` steps many matches at once instead, which is faster by far.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from setpiece._errors import ParameterError
from setpiece._optional import need
from setpiece._pettingzoo import parallel_env

need("ray.rllib", "rllib", "`setpiece.rllib`")
from ray.rllib.env.multi_agent_env import MultiAgentEnv  # noqa: E402
from ray.tune import register_env  # noqa: E402

from setpiece._rllib_runner import FootballEnvRunner  # noqa: E402

__all__ = ["FootballEnvRunner", "RllibFootballEnv", "register"]

Step = tuple[
    dict[str, Any], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]
]


class RllibFootballEnv(MultiAgentEnv):
    """A scenario as an RLlib `MultiAgentEnv`, with everything of `setpiece.parallel_env`.

    Agents, observations, rewards and infos are the same. `agents` are those that still play,
    `possible_agents` all; `__all__` is true once `agents` is empty. Its `config` holds the keyword
    arguments of `setpiece.parallel_env`, at least `scenario`.
    """

    def __init__(self, config: Mapping[str, Any]) -> None:
        super().__init__()
        if "scenario" not in config:
            raise ParameterError(
                "`env_config` names no scenario",
                name="env_config",
                help='env_config={"scenario": "academy_corner"}',
            )
        self.env = parallel_env(**config)
        self.possible_agents = self.env.possible_agents
        self.observation_spaces = self.env.observation_spaces
        self.action_spaces = self.env.action_spaces
        self.agents = list(self.possible_agents)
        self.render_mode = self.env.render_mode

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
        """Draws a new start; see `FootballEnv.reset`."""
        observations, infos = self.env.reset(seed=seed, options=options)
        self.agents = list(self.env.agents)
        return observations, infos

    def step(self, action_dict: dict[str, int]) -> Step:
        """Plays 100 ms; one action for each of `agents`."""
        observations, rewards, terminateds, truncateds, infos = self.env.step(action_dict)
        self.agents = list(self.env.agents)
        over = not self.agents
        return (
            observations,
            rewards,
            {**terminateds, "__all__": over and not any(truncateds.values())},
            {**truncateds, "__all__": over and any(truncateds.values())},
            infos,
        )

    def render(self) -> Any:
        """Returns the result of `FootballEnv.render`."""
        return self.env.render()

    def close(self) -> None:
        """Ends the episode."""
        self.env.close()


def register(name: str = "setpiece") -> None:
    """Registers scenarios with Ray Tune; `env_config` holds the arguments of `parallel_env`."""
    register_env(name, RllibFootballEnv)
