"""A person with a gamepad."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from setpiece.gfootball.env._hands import Hands, joystick, pygame_of

MEANINGS = (
    ("short_pass", "pressure"),
    ("shot", "team_pressure"),
    ("high_pass", "sliding"),
    ("long_pass", "keeper_rush"),
    ("switch",),
    ("dribble",),
)
"""GRF's buttons, by number. Two meanings: the first with the ball, the second without it."""

TILTED = 0.5
"""From here on a stick counts as pushed."""


class Player(Hands):
    """Plays what a gamepad holds: the left stick, buttons 0 to 5, the right trigger sprints.

    The first `gamepad` among the players has the first gamepad, and so on.
    """

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:
        super().__init__(player_config, env_config)
        self._pygame = pygame_of("the player `gamepad`")
        self._stick = joystick(self._pygame, int(player_config.get("player_gamepad", 0)))

    def held(self) -> tuple[tuple[int, int], Collection[str]]:
        """Returns the direction of the left stick and what the held buttons mean."""
        self._pygame.event.pump()
        stick = self._stick
        axes = stick.get_numaxes()

        def tilt(axis: int) -> int:
            value = stick.get_axis(axis) if axis < axes else 0.0
            return int(value > TILTED) - int(value < -TILTED)

        held = [
            meaning
            for button, meanings in enumerate(MEANINGS)
            if button < stick.get_numbuttons() and stick.get_button(button)
            for meaning in meanings
        ]
        if axes > 5 and stick.get_axis(5) > 0.0:
            held.append("sprint")
        return (tilt(0), tilt(1)), held
