"""A scenario prepared for play: who plays it, what they see and what they can do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gymnasium import spaces

from setpiece import _native
from setpiece._native import AgentInfo, Scenario
from setpiece._opponents import Table
from setpiece._spaces import action_space, difference, observation_space

if TYPE_CHECKING:
    from setpiece._env_options import EnvOptions


@dataclass(frozen=True)
class Match:
    """A scenario with its native environment, the caller's agents and their spaces.

    `digest` is the scenario's; `table` seats the opponents, if any; `slots` are the caller's
    agents.
    """

    scenario: Scenario
    digest: str
    native: _native.Environment
    table: Table | None
    slots: Sequence[AgentInfo]
    observation_space: spaces.Space[Any]
    action_space: spaces.Space[Any]

    @property
    def agents(self) -> tuple[str, ...]:
        """The ids of the caller's agents."""
        return tuple(agent.id for agent in self.slots)

    def shown(self, observation: Any, info: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
        """Returns the caller's part of what all agents see."""
        return (observation, info) if self.table is None else self.table.shown(observation, info)

    def end(self, label: str, *, truncated: bool = False) -> dict[str, Any]:
        """Ends the episode for the caller's own reason; returns the caller's part of the summary."""
        summary = self.native.end(label, label == "success", truncated)
        return summary if self.table is None else self.table.info(summary)

    def views(self) -> list[dict[str, Any]]:
        """Returns the raw observation of each of the caller's agents."""
        raws = self.native.look("raw")
        raws = [raws] if isinstance(raws, dict) else raws
        return [*raws] if self.table is None else [raws[at] for at in self.table.mine]

    def change(self, before: Match, *, agents: bool, players: bool) -> str | None:
        """Returns in words why an environment can't switch from another match to this one, or None.

        The spaces must stay; with `agents` the caller's agents too, with `players` how many players
        each side has.
        """
        spaces_of = {
            "action space": (before.action_space, self.action_space),
            "observation space": (before.observation_space, self.observation_space),
        }
        if agents and self.agents != before.agents:
            return f"the agents would change from {', '.join(before.agents)} to {', '.join(self.agents)}"
        if players and self.native.players != before.native.players:
            return f"the number of players would change from {before.native.players} to {self.native.players}"
        return next(
            (f"the {name} {why}" for name, pair in spaces_of.items() if (why := difference(*pair))),
            None,
        )


def match_of(scenario: Scenario, options: EnvOptions) -> Match:
    """Prepares a scenario."""
    native = _native.Environment(scenario, options)
    agents, table = native.agents, None
    if options.opponents is not None:
        table = Table(agents, options.opponents, _native.ACTION_SETS[options.action_set], scenario)
        agents = [agents[at] for at in table.mine]
        for kind in table.observations:
            native.look(*kind)
    spaces_of = (
        observation_space(native, options.observation, agents),
        action_space(len(agents), options.action_set),
    )
    return Match(scenario, scenario.digest, native, table, agents, *spaces_of)
