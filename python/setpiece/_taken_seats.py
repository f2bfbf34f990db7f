"""The agents of an environment one by one, for `ParallelFootballEnv`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import gymnasium
from gymnasium import spaces

from setpiece._record import Record
from setpiece._spaces import observation_space
from setpiece._state import state_space

if TYPE_CHECKING:
    from setpiece._environment import FootballEnv


class TakenSeats:
    """The agents of an environment one by one: what its public methods don't say."""

    def __init__(self, env: FootballEnv) -> None:
        self._env = env
        slots = env.slots
        self.spaces: dict[str, spaces.Space[Any]] = {
            slot.id: observation_space(env._native, env.observation, [slot]) for slot in slots
        }
        self.state_space = state_space(env._native.players)

    @property
    def playing(self) -> bool:
        """Whether an episode is being played, so that `step` may be called."""
        return self._env._playing

    def sent_off(self) -> set[str]:
        """Returns the ids of the agents whose players have been sent off."""
        native = self._env._native
        return {agent.id for agent, gone in zip(native.agents, native.gone, strict=True) if gone}

    def refuse(self, why: str) -> NoReturn:
        """Raises Gymnasium's `ResetNeeded`.

        A closed environment, or one in the middle of a step, has an error of its own.
        """
        with self._env._turn:
            raise gymnasium.error.ResetNeeded(why)

    def truncate(self, label: str, info: dict[str, Any]) -> None:
        """Ends the episode by the caller's limit; adds the outcome to the last step's `info`."""
        env = self._env
        info.update(env._match.end(label, truncated=True))
        if env._callbacks is not None:
            info["setpiece"]["return"].update(env._callbacks.tally)
        env._playing = False
        env._sum_up(info)

    def record(self, record: Record, info: dict[str, Any]) -> str | None:
        """Records the episode that has ended; returns where, if it is written."""
        return record.end(self._env._native, self._env.scenario.name, info["score"])
