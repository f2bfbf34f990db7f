"""What keyboards and gamepads have in common: held keys become one action per step."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection
from types import ModuleType
from typing import Any

from setpiece._errors import UnavailableError
from setpiece._window import pygame_ce
from setpiece.gfootball.env.football_action_set import CoreAction, get_action_set
from setpiece.gfootball.env.player_base import PlayerBase

WAYS = {
    (0, 0): "release_direction",
    (-1, 0): "left",
    (-1, -1): "top_left",
    (0, -1): "top",
    (1, -1): "top_right",
    (1, 0): "right",
    (1, 1): "bottom_right",
    (0, 1): "bottom",
    (-1, 1): "bottom_left",
}
"""The action of a direction: x to the right, y down."""

KEYS = (
    *("long_pass", "high_pass", "short_pass", "shot", "switch"),
    *("keeper_rush", "sliding", "pressure", "team_pressure", "sprint", "dribble"),
)
"""What a key can mean, the more urgent first. (GRF's order; its `switch` is never sent.)"""

STICKY = ("keeper_rush", "pressure", "team_pressure", "sprint", "dribble")
"""What is held until it is released."""


def pygame_of(what: str) -> ModuleType:
    """Imports pygame and begins to listen; raises `MissingPackageError` without it."""
    pygame = pygame_ce(what)
    pygame.display.init()
    return pygame


def joystick(pygame: ModuleType, number: int) -> Any:
    """Returns a gamepad, or raises `UnavailableError` if it isn't connected."""
    pygame.joystick.init()
    if number >= pygame.joystick.get_count():
        raise UnavailableError(
            f"no gamepad {number}: {pygame.joystick.get_count()} are connected",
            name="players",
            help="connect it first, or play with `keyboard`",
        )
    stick = pygame.joystick.Joystick(number)
    stick.init()
    return stick


class Hands(PlayerBase, ABC):
    """A person who holds keys.

    Every step sends one action: a changed direction first, then the most urgent changed key.
    Directions are those of the picture, for either side.
    """

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:
        super().__init__(player_config)
        self._actions = {action.name: action for action in get_action_set(env_config)}
        self._can_play_right = True
        self._way = (0, 0)
        self._down: frozenset[str] = frozenset()

    def reset(self) -> None:
        """Begins an episode with nothing held."""
        self._way, self._down = (0, 0), frozenset()

    @abstractmethod
    def held(self) -> tuple[tuple[int, int], Collection[str]]:
        """Returns the direction (x to the right, y down, -1..1) and what the held keys mean."""

    def take_action(self, observations: list[dict[str, Any]]) -> CoreAction:
        """Returns the action of the next step."""
        del observations
        way, keys = self.held()
        if way != self._way:
            self._way = way
            return self._actions[WAYS[way]]
        down = frozenset(key for key in keys if key in self._actions)
        for key in KEYS:
            if (key in down) != (key in self._down):
                self._down = self._down ^ {key}
                name = key if key in down else f"release_{key}"
                if name in self._actions:
                    return self._actions[name]
        # A kick's key is sent for as long as it is held: that is its power. (GRF sends it once.)
        kick = next((key for key in KEYS if key in down and key not in STICKY), "idle")
        return self._actions[kick]
