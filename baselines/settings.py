"""What a run depends on."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any


def setting(default: Any, about: str) -> Any:
    """A setting with its default value and its line of `--help`."""
    return field(default=default, metadata={"about": about})


@dataclass(frozen=True)
class Settings:
    """What a run depends on. Each is an option of the command line."""

    scenario: str = setting("academy_empty_goal_close", "a name of the library or a file")
    levels: str = setting("", "a curriculum that is trained on instead: a name or a file")
    rewards: str = setting("scoring,checkpoints", "reward terms, separated by commas")
    seed: int = setting(0, "of the policy and of the first environment")
    steps: int = setting(2_000_000, "of all environments together")
    players: int = setting(1, "of the left team that the policy plays; 0: those of the scenario")
    observation: str = setting("simple115v2", "numbers or pictures that the policy sees")
    stack: int = setting(1, "observations that are seen at once")
    masks: bool = setting(False, "draw only actions that can change something")
    repeat: int = setting(4, "steps that a decision lasts")
    envs: int = setting(128, "environments")
    decisions: int = setting(32, "of an environment between two updates")
    width: int = setting(128, "units of a layer")
    epochs: int = setting(4, "passes over the decisions in an update")
    minibatch: int = setting(1_024, "decisions in a gradient step")
    gamma: float = setting(0.99, "what a reward after the next decision is worth")
    smoothing: float = setting(0.95, "lambda of generalised advantage estimation")
    clip: float = setting(0.2, "how far an update may change the odds of an action")
    entropy: float = setting(0.03, "weight of the entropy; it falls to 0")
    gradient: float = setting(0.5, "greatest norm of a gradient")
    rate: float = setting(7e-4, "learning rate; it falls to 0")
    check: int = setting(0, "evaluate the scenario whenever so many steps are done; 0: never")

    def __post_init__(self) -> None:
        """Raises `ValueError` for a count that isn't one."""
        for one in fields(self):
            if type(one.default) is not int:
                continue
            value, least = getattr(self, one.name), int(one.name not in MAY_BE_0)
            if value < least:
                raise ValueError(f"--{one.name} is {value}; expected at least {least}")


MAY_BE_0 = ("seed", "players", "check")
