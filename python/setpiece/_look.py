"""A match as it stands, in another observation than its environment's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from setpiece import _native
from setpiece._native import Scenario


class Look:
    """Observes an environment's match in any observation, for all its agents; looking changes nothing."""

    def __init__(self, native: _native.Environment, scenario: Scenario, rewards: Sequence[str] | None) -> None:
        self._native, self._scenario, self._rewards = native, scenario, rewards
        self._twins: dict[str, _native.Environment] = {}

    def sees(self, native: _native.Environment, scenario: Scenario) -> bool:
        """Whether it is the look of this match of this scenario."""
        return self._native is native and self._scenario is scenario

    def __call__(self, observation: str) -> Any:
        """Returns the observation of all agents; raises `SnapshotError` where a script's memory holds a function."""
        self.prepare(observation)
        return self._twins[observation].restore(self._native.snapshot())[0]

    def prepare(self, observation: str) -> None:
        """Raises `ParameterError` for an observation that the scenario hasn't got."""
        if observation not in self._twins:
            self._twins[observation] = _native.Environment(
                self._scenario,
                observation=observation,
                rewards=self._rewards,
                events=False,
                copy=True,
                action_set="default",
                bot_action=False,
            )
