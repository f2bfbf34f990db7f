"""The ledger: which scenarios are trained on, with which seeds and for how many steps.

Everything else has the values of the learner's settings, unless an entry names another one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

SEEDS = (1, 2, 3, 4, 5)
"""Seeds that are reported. Settings were chosen with others, from 100 on."""


@dataclass(frozen=True)
class Entry:
    """Some runs that differ in their seed only."""

    name: str
    table: str
    settings: dict[str, Any] = field(default_factory=dict)
    seeds: tuple[int, ...] = SEEDS
    learner: str = "ppo"
    """The file that trains: `ppo` or `mappo`."""


def academy(name: str, steps: int, **settings: Any) -> Entry:
    """An Academy scenario, one player, seen as numbers."""
    return Entry(name, "academy", {"scenario": f"academy_{name}", "steps": steps, **settings})


def three(name: str, **settings: Any) -> Entry:
    """Three against one, evaluated while training."""
    chosen = {"steps": 2_000_000, "check": 50_000, **settings}
    return Entry(name, "curriculum", {"scenario": "academy_3_vs_1_with_keeper", **chosen})


def team(name: str, steps: int, **settings: Any) -> Entry:
    """A scenario of the Academy with an agent for every outfield player, played by MAPPO."""
    chosen = {"scenario": f"multi_{name}", "steps": steps, **settings}
    return Entry(f"multi_{name}", "team", chosen, learner="mappo")


ENTRIES = (
    academy("3_vs_1_with_keeper", 5_000_000),
    academy("run_to_score_with_keeper", 2_500_000),
    academy("empty_goal_close", 500_000),
    academy("empty_goal", 1_000_000),
    academy("run_to_score", 1_000_000),
    academy("pass_and_shoot_with_keeper", 3_000_000),
    academy("run_pass_and_shoot_with_keeper", 3_000_000),
    academy("counterattack_easy", 5_000_000),
    three("alone"),
    three("past_the_defender", levels="examples/waking_defender.pitch"),
    team("pass_and_shoot_with_keeper", 3_000_000),
    team("run_pass_and_shoot_with_keeper", 3_000_000),
)
