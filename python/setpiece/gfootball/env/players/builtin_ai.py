"""Players controlled by the engine's own bot."""

from __future__ import annotations

from typing import Any

from setpiece.gfootball.env import football_action_set
from setpiece.gfootball.env.player_base import PlayerBase


class Player(PlayerBase):
    """Hands every step over to the engine's bot."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:  # noqa: ARG002
        super().__init__(player_config)

    def take_action(self, observations: list[dict[str, Any]]) -> Any:
        """Returns `builtin_ai` for each."""
        return [football_action_set.action_builtin_ai] * len(observations)
