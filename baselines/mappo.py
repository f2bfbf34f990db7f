"""Trains all players of a team by MAPPO, with the same settings for every scenario.

    python baselines/mappo.py --scenario multi_pass_and_shoot_with_keeper --out runs/two

It is PPO with two differences. The policy plays every agent of the scenario, with shared weights:
what a player sees says which player they are. And their returns are predicted from what all of them
see, by a network with an output for each player; it is needed for learning only.

The library's `multi_…` scenarios have an agent for every outfield player. With `--players 3` the
policy plays three players of any other one. The other options and files are those of `ppo.py`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from torch import Tensor, nn

import ppo
from command import command
from networks import body, layer
from settings import setting


@dataclass(frozen=True)
class Settings(ppo.Settings):
    """The settings whose values differ from those of PPO."""

    scenario: str = setting("multi_pass_and_shoot_with_keeper", "a name of the library or a file")
    players: int = setting(0, "of the left team that the policy plays; 0: those of the scenario")
    observation: str = setting("simple115v2+sticky", "numbers or pictures that the policy sees")
    masks: bool = setting(True, "draw only actions that can change something")


class Policy(ppo.Policy):
    """A policy whose returns are predicted from what all players of a match see."""

    def valuer(self, inputs: int, width: int, agents: int) -> nn.Module:
        """Makes the central network: an input for what each player sees, an output for each."""
        return nn.Sequential(*body(agents * inputs, width), layer(width, agents, 1.0))

    def foresee(self, seen: Tensor) -> Tensor:
        """Predicts the standardised returns `(matches, agents)` from `(matches, agents, n)`."""
        foreseen: Tensor = self.critic(seen.flatten(1))
        return foreseen


class Training(ppo.Training):
    """A run of MAPPO."""

    network, options = Policy, Settings


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Reads the command line and trains."""
    return command(__doc__, Training, argv)


if __name__ == "__main__":
    main()
