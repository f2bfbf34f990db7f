"""A scenario as a PettingZoo environment, in which every agent keeps its player."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping
from os import PathLike
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from setpiece._actions import array_of, integers
from setpiece._environment import FootballEnv
from setpiece._errors import ActionError, ParameterError, SetpieceError
from setpiece._native import ACTION_SETS, Scenario
from setpiece._record import Record
from setpiece._reset import RESET_OPTIONS
from setpiece._rows import Picker, split_info
from setpiece._spaces import Layout, one_action_space
from setpiece._state import state
from setpiece._vocabulary import Action
from setpiece._words import similar

STANDS = np.array([0, 0, -1, 0], np.float32)
"""The continuous action of an agent that no longer plays."""

SWITCHING = re.compile(r"(left|right)_\d+")
"""The id of an agent that changes players."""

Step = tuple[
    dict[str, Any], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]
]


class ParallelFootballEnv(ParallelEnv[str, Any, int]):
    """One match with simultaneous agents: see `setpiece.parallel_env`."""

    metadata: dict[str, Any]
    env: FootballEnv
    """The same match with all agents in one array: for `played`, `look`."""
    possible_agents: list[str]
    agents: list[str]
    max_cycles: int | None
    render_mode: str | None
    state_space: spaces.Box

    def __init__(
        self, env: FootballEnv, max_cycles: int | None = None, record: Record | None = None
    ) -> None:
        """Takes an environment with fixed agents, and the folder of its recordings."""
        if not env.agents:
            raise ParameterError(
                f"`{env.scenario.name}` leaves the caller no agent",
                name="left",
                help="seat some: `left='all'`",
            )
        for slot in env.slots:
            if SWITCHING.fullmatch(slot.id):
                raise ParameterError(
                    f"the agent `{slot.id}` of `{env.scenario.name}` changes players: here agents keep their players",
                    name="scenario",
                    help='make it with `switching="fixed"`',
                )
        if max_cycles is not None and not integers(max_cycles, (), 2**31):
            raise ParameterError(
                f"`max_cycles` is {max_cycles!r}; expected a count of steps", name="max_cycles"
            )
        self.env = env
        self._seats = env.seats()
        self.max_cycles = max_cycles
        self.metadata = {
            **env.metadata,
            "name": f"setpiece/{env.scenario.name}-v0",
            "is_parallelizable": True,
        }
        self.render_mode = env.render_mode
        self.possible_agents = list(env.agents)
        self.agents = []
        self._n_actions = ACTION_SETS[env.action_set]
        self.observation_spaces = {
            agent: self._seats.spaces[agent] for agent in self.possible_agents
        }
        self.action_spaces: dict[str, spaces.Space[Any]] = {
            agent: one_action_space(env.action_set) for agent in self.possible_agents
        }
        self.state_space = self._seats.state_space
        n_agents = len(self.possible_agents)
        self._pickers = {
            agent: Picker(n_agents, at) for at, agent in enumerate(self.possible_agents)
        }
        self._cycles = 0
        # Recorded here, because an episode also ends with `max_cycles`, or when all have been sent
        # off.
        self._record = record

    @property
    def scenario(self) -> Scenario:
        """The scenario, with the parameters it was made with."""
        return self.env.scenario

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """Returns the space of an agent's observations, always the same object."""
        return self.observation_spaces[self._known(agent)]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """Returns the space of an agent's actions, always the same object."""
        return self.action_spaces[self._known(agent)]

    @property
    def observation_layout(self) -> Layout:
        """The layout of an agent's observation: see `FootballEnv.observation_layout`."""
        return self.env.observation_layout

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
        """Draws a new start; `seed` and `options` are those of `FootballEnv.reset`.

        Another scenario must have the same agents and the same number of players. An unknown option
        causes a warning and is ignored, because PettingZoo's wrappers and tests pass their own.
        """
        if isinstance(options, Mapping):
            for unknown in [key for key in options if key not in RESET_OPTIONS]:
                warnings.warn(f"no reset option `{unknown}`: it does nothing", stacklevel=2)
            options = {key: value for key, value in options.items() if key in RESET_OPTIONS}
        try:
            observation, info = self.env.reset(seed=seed, options=options)
        except SetpieceError:
            if not self._seats.playing:
                self.agents = []
            raise
        self._cycles = 0
        return self._begun(observation, info)

    def step(self, actions: dict[str, Any]) -> Step:
        """Plays 100 ms; `actions` has one for each of `agents`.

        An action is an integer, or four numbers with continuous actions. Raises `ActionError` for
        an invalid, missing or superfluous action; the episode is then unchanged.
        """
        if not self.agents:
            self._seats.refuse("call `reset` before `step`: no agent is playing")
        acting = self.agents
        observation, reward, terminated, truncated, info = self.env.step(self._joined(actions))
        self._cycles += 1
        if (
            self.max_cycles is not None
            and self._cycles >= self.max_cycles
            and not (terminated or truncated)
        ):
            truncated = True
            self._seats.truncate("max_cycles", info)
        infos = self._infos(info, acting)
        gone = self._gone()
        terminations = {agent: terminated or agent in gone for agent in acting}
        truncations = {agent: truncated and not terminations[agent] for agent in acting}
        self.agents = [agent for agent in acting if not (terminations[agent] or truncations[agent])]
        if self._record is not None and not self.agents:
            replay = self._seats.record(self._record, info)
            for one in infos.values():
                one["setpiece"] = {**one.get("setpiece", {}), "replay": replay}
        paid = dict(zip(self.possible_agents, np.atleast_1d(reward).tolist(), strict=True))
        rewards = {agent: paid[agent] for agent in acting}
        return self._parts(observation, acting), rewards, terminations, truncations, infos

    def state(self) -> NDArray[np.float32]:
        """Returns the global state, float32 `(n,)`, in the world's frame: see `parallel_env`."""
        slots = self.env.slots
        seen = self.env.look("raw")
        return state(seen if len(slots) == 1 else seen[0], slots[0].team)

    def save_replay(self, path: str | PathLike[str]) -> None:
        """Writes the episode as far as it has been played: see `FootballEnv.save_replay`."""
        self.env.save_replay(path)

    def snapshot(self) -> bytes:
        """Returns the whole current episode as bytes: see `FootballEnv.snapshot`."""
        return self.env.snapshot()

    def restore(self, snapshot: bytes) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
        """Continues from a snapshot: see `FootballEnv.restore`; `max_cycles` counts from here."""
        observation, info = self.env.restore(snapshot)
        self._cycles = 0
        return self._begun(observation, info)

    def render(self) -> Any:
        """Returns the result of `FootballEnv.render`."""
        return self.env.render()

    def close(self) -> None:
        """Closes the environment; then `reset` and `step` raise `ClosedEnvironmentError`."""
        self.agents = []
        self.env.close()

    def _known(self, agent: str) -> str:
        if agent in self._pickers:
            return agent
        raise ParameterError(
            f"no agent `{agent}`; there are {', '.join(f'`{one}`' for one in self.possible_agents)}",
            name="agent",
            help=similar(agent, self.possible_agents),
        )

    def _begun(
        self, observation: Any, info: dict[str, Any]
    ) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
        """The result of `reset` and `restore`.

        An episode from a snapshot may begin without some player, or at its end.
        """
        infos = self._infos(info, self.possible_agents)
        over, gone = "outcome" in info, self._gone()
        self.agents = [agent for agent in self.possible_agents if not (over or agent in gone)]
        shown = self.possible_agents if over else self.agents
        return self._parts(observation, shown), {agent: infos[agent] for agent in shown}

    def _parts(self, value: Any, agents: list[str]) -> dict[str, Any]:
        return {agent: self._pickers[agent](value) for agent in agents}

    def _infos(self, info: dict[str, Any], agents: list[str]) -> dict[str, dict[str, Any]]:
        infos = dict(
            zip(self.possible_agents, split_info(info, len(self.possible_agents)), strict=True)
        )
        return {agent: infos[agent] for agent in agents}

    def _gone(self) -> set[str]:
        """The agents whose players have been sent off."""
        return self._seats.sent_off().intersection(self.possible_agents)

    def _joined(self, actions: Any) -> Any:
        """Everyone's action, from those of the agents that are left."""
        if not isinstance(actions, Mapping):
            raise ActionError(f"expected a mapping of agents to actions, found `{actions!r}`")
        for agent in actions:
            if agent not in self.agents:
                gone = agent in self._pickers
                raise ActionError(
                    f"an action for `{agent}`, which {'no longer plays' if gone else 'is not an agent'}",
                    help=None if gone else similar(agent, self.agents),
                )
        for agent in self.agents:
            if agent not in actions:
                raise ActionError(f"no action for `{agent}`")
        if self.env.action_set == "continuous":
            return self._steered(actions)
        given = {agent: actions.get(agent, int(Action.IDLE)) for agent in self.possible_agents}
        joined = integers(list(given.values()), (len(given),), self._n_actions)
        if joined is None:
            joined = np.array([self._read(agent, action) for agent, action in given.items()])
        return joined[0] if len(joined) == 1 else joined

    def _steered(self, actions: Mapping[str, Any]) -> Any:
        """Everyone's continuous action; the engine reads the numbers."""
        rows = []
        for agent in self.possible_agents:
            row = array_of(actions.get(agent, STANDS))
            if row is None or row.shape != (4,) or row.dtype.kind not in "fiu":
                raise ActionError(
                    f"expected four numbers for `{agent}`, found `{actions[agent]!r}`"
                )
            rows.append(row.astype(np.float32))
        return rows[0] if len(rows) == 1 else np.stack(rows)

    def _read(self, agent: str, action: Any) -> int:
        """Reads one agent's action; the error names the agent."""
        read = integers(action, (), self._n_actions)
        if read is None:
            raise ActionError(
                f"expected an integer in 0..{self._n_actions - 1} for `{agent}`, found `{action!r}`"
            )
        return int(read)
