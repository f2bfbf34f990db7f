"""The interface of Gym before 0.26 on Gymnasium's classes.

`reset` returns an observation, `step` four values.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium

from setpiece._errors import ParameterError

Stepped = tuple[Any, Any, bool, dict[str, Any]]
"""Observation, reward, done and info."""


def refuse_seed(seed: int | None, options: Mapping[str, Any] | None) -> None:
    """Raises `ParameterError` for arguments that only Gymnasium's `reset` has; wrappers pass None."""
    if seed is not None or options is not None:
        raise ParameterError(
            "`reset` takes neither a seed nor options here",
            name="seed" if options is None else "options",
            help="other_config_options={'game_engine_random_seed': 7}, or random.seed(7), which every episode draws on",
        )


class Wrapper(gymnasium.Wrapper[Any, Any, Any, Any]):
    """A wrapper whose `reset` returns an observation, with all attributes of its environment."""

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins an episode and returns its observation."""
        refuse_seed(seed, options)
        return self.env.reset()

    def step(self, action: Any) -> Any:
        """Plays 100 ms and returns observation, reward, done and info."""
        return self.env.step(action)

    def render(self, mode: str = "human") -> Any:
        """Draws the match."""
        env: Any = self.env
        return env.render(mode)

    def _stepped(self, action: Any) -> Stepped:
        stepped: Any = self.env.step(action)
        observation, reward, done, info = stepped
        return observation, reward, bool(done), info

    def get_state(self, to_pickle: dict[str, Any] | None = None) -> bytes:
        """Returns the whole state, with the outer wrappers' content of `to_pickle`."""
        state: bytes = self.env.get_state({} if to_pickle is None else to_pickle)  # type: ignore[attr-defined]
        return state

    def set_state(self, state: bytes) -> dict[str, Any]:
        """Continues from a state of `get_state` and returns what the wrappers had put into it."""
        kept: dict[str, Any] = self.env.set_state(state)  # type: ignore[attr-defined]
        return kept

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "env":
            raise AttributeError(f"`{type(self).__name__}` has no attribute `{name}`")
        return getattr(self.env, name)


class ObservationWrapper(Wrapper):
    """A wrapper that shows another observation of the same match."""

    def observation(self, observation: Any) -> Any:
        """Returns what is shown instead of an observation."""
        raise NotImplementedError

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins an episode and returns its observation."""
        return self.observation(super().reset(seed=seed, options=options))

    def step(self, action: Any) -> Any:
        """Plays 100 ms and returns observation, reward, done and info."""
        observation, reward, done, info = self._stepped(action)
        return self.observation(observation), reward, done, info


class RewardWrapper(Wrapper):
    """A wrapper that changes the rewards of the same match."""

    def reward(self, reward: Any) -> Any:
        """Returns what is paid instead of a reward."""
        raise NotImplementedError

    def step(self, action: Any) -> Any:
        """Plays 100 ms and returns observation, reward, done and info."""
        observation, reward, done, info = self._stepped(action)
        return observation, self.reward(reward), done, info
