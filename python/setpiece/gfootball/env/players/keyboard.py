"""A person at the keyboard."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from setpiece.gfootball.env._hands import Hands, pygame_of

MEANINGS = {
    "s": ("short_pass", "pressure"),
    "d": ("shot", "team_pressure"),
    "a": ("high_pass", "sliding"),
    "w": ("long_pass", "keeper_rush"),
    "q": ("switch",),
    "c": ("dribble",),
    "e": ("sprint",),
}
"""GRF's keys. A key with two meanings has the first with the ball and the second without it."""


class Player(Hands):
    """Plays what the keyboard of pygame's window holds: arrows, and the keys of `MEANINGS`."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:
        super().__init__(player_config, env_config)
        self._pygame = pygame_of("the player `keyboard`")

    def held(self) -> tuple[tuple[int, int], Collection[str]]:
        """Returns the direction of the arrows and what the held keys mean."""
        pygame = self._pygame
        pygame.event.pump()
        down = pygame.key.get_pressed()
        way = (
            int(down[pygame.K_RIGHT]) - int(down[pygame.K_LEFT]),
            int(down[pygame.K_DOWN]) - int(down[pygame.K_UP]),
        )
        keys = [name for name in MEANINGS if down[pygame.key.key_code(name)]]
        return way, [meaning for key in keys for meaning in MEANINGS[key]]
