"""The player whose actions come from `step`."""

from __future__ import annotations

from typing import Any

from setpiece._errors import ActionError
from setpiece.gfootball.env.player_base import PlayerBase


class Player(PlayerBase):
    """Plays the last action that was set."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:  # noqa: ARG002
        super().__init__(player_config)
        self._action: list[Any] = []

    def set_action(self, action: Any) -> None:
        """Takes one action, or a sequence with one for each player."""
        # A zero-dimensional NumPy array is one action.
        one = not hasattr(action, "__len__") or getattr(action, "ndim", 1) == 0
        self._action = [action] if one else [*action]

    def take_action(self, observations: list[dict[str, Any]]) -> Any:
        """Returns the actions; raises `ActionError` unless there is one for each player."""
        if len(self._action) != len(observations):
            raise ActionError(f"expected {len(observations)} actions, found {len(self._action)}")
        return self._action
