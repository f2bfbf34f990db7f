"""Players who repeat the actions of a dump."""

from __future__ import annotations

from typing import Any

from setpiece._errors import ActionError, ParameterError
from setpiece.gfootball.env.observation_processor import read_dump
from setpiece.gfootball.env.player_base import PlayerBase


class Player(PlayerBase):
    """Repeats the actions of a dump, `path`, starting with those of its first slot, `index`."""

    def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:  # noqa: ARG002
        super().__init__(player_config)
        if "path" not in player_config:
            raise ParameterError(
                "the player `replay` needs a dump",
                name="players",
                help="write `replay:path=FILE.dump,left_players=1`",
            )
        if self.num_controlled_left_players() and self.num_controlled_right_players():
            raise ParameterError(
                "a `replay` plays on one side",
                name="players",
                help="write one definition for each side",
            )
        self._path = str(player_config["path"])
        self._records = read_dump(self._path)
        self._first = int(player_config["index"])
        self._step = 0
        self._can_play_right = True

    def reset(self) -> None:
        """Starts the dump again."""
        self._step = 0

    def take_action(self, observations: list[dict[str, Any]]) -> Any:
        """Returns the actions of the next step; raises `ActionError` after the dump's end."""
        if self._step >= len(self._records):
            raise ActionError(f"`{self._path}` ends after {len(self._records)} steps")
        recorded = self._records[self._step]["debug"]["action"]
        chosen = recorded[self._first : self._first + len(observations)]
        if len(chosen) != len(observations):
            raise ActionError(f"`{self._path}` has the actions of {len(recorded)} players only")
        self._step += 1
        return chosen
