"""The base class of everything in `players`: it plays some of the players."""

from __future__ import annotations

from typing import Any


class PlayerBase:
    """Plays as many players as its definition says.

    - `player_config`: the definition's settings: `left_players`, `right_players`, `index`, the
      first of its slots, `player_NAME`, its number among those of its name, and all other settings
      of the definition.
    """

    def __init__(self, player_config: dict[str, Any] | None = None) -> None:
        self._num_left_controlled_players = 1
        self._num_right_controlled_players = 0
        self._can_play_right = False
        if player_config:
            self._num_left_controlled_players = int(player_config["left_players"])
            self._num_right_controlled_players = int(player_config["right_players"])

    def num_controlled_left_players(self) -> int:
        """Returns how many players of the left team it plays."""
        return self._num_left_controlled_players

    def num_controlled_right_players(self) -> int:
        """Returns how many players of the right team it plays."""
        return self._num_right_controlled_players

    def num_controlled_players(self) -> int:
        """Returns how many players it plays."""
        return self.num_controlled_left_players() + self.num_controlled_right_players()

    def can_play_right(self) -> bool:
        """Whether it sees the right team on the right, and sends directions in the pitch's frame."""
        return self._can_play_right

    def take_action(self, observations: list[dict[str, Any]]) -> Any:
        """Returns an action for each of its players, from one observation each, left team first."""
        raise NotImplementedError

    def reset(self) -> None:
        """Begins an episode."""
