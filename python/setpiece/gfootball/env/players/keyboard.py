"""A person at the keyboard: needs a window, which isn't supported in this version."""

from __future__ import annotations

from typing import Any

from setpiece.gfootball._unavailable import unavailable
from setpiece.gfootball.env.player_base import PlayerBase


class Player(PlayerBase):
    """Raises `UnavailableError`."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:  # noqa: ARG002
        raise unavailable(
            "players",
            "a player at the keyboard",
            "`bot`, `builtin_ai`, `lazy` and `replay` play alone",
        )
