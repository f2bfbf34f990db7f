"""A policy trained by OpenAI's baselines: needs TensorFlow 1, which isn't supported."""

from __future__ import annotations

from typing import Any

from setpiece.gfootball._unavailable import unavailable
from setpiece.gfootball.env.player_base import PlayerBase


class Player(PlayerBase):
    """Raises `UnavailableError`."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:  # noqa: ARG002
        raise unavailable(
            "players",
            "a player with a checkpoint of OpenAI's baselines",
            "write a module with a class `Player(PlayerBase)` that asks your policy",
        )
