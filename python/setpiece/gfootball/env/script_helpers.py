"""Reads dumps: as records, as text, and as matches to play again."""

from __future__ import annotations

from pprint import pformat
from typing import Any

from setpiece import _native
from setpiece._errors import FormatError, ParameterError
from setpiece._options import check_path
from setpiece.gfootball._unavailable import unavailable
from setpiece.gfootball.env.config import Config
from setpiece.gfootball.env.football_env import FootballEnv
from setpiece.gfootball.env.observation_processor import read_dump

FPS = 10


class ScriptHelpers:
    """The functions of GRF's scripts for dumps, as methods."""

    def load_dump(self, dump_file: str) -> list[dict[str, Any]]:
        """Returns the records of a dump.

        Unpickling runs code from the file, so only read dumps that you trust.
        """
        return read_dump(dump_file)

    def dump_to_txt(self, dump_file: str, output: str, include_debug: bool = True) -> None:
        """Writes the records of a dump as text.

        - `include_debug`: whether debugging data, such as actions and times, is written too.
        """
        records = read_dump(dump_file)
        if not include_debug:
            records = [
                {key: value for key, value in record.items() if key != "debug"}
                for record in records
            ]
        text = "".join(f"{pformat(record)}\n" for record in records)
        _native.write(check_path("output", output), text.encode())

    def build_players(self, dump_file: str, spec: list[str] | None = None) -> list[str]:
        """Returns a definition for each player with actions in a dump.

        The definitions are `replay`, or those of `spec` in order.
        """
        config = _config_of(dump_file)
        left, right = config.number_of_left_players(), config.number_of_right_players()
        sides = ["left_players"] * left + ["right_players"] * right
        given = list(spec or [])
        if len(given) > len(sides):
            raise ParameterError(
                f"{len(given)} players are given, the dump has {len(sides)}", name="spec"
            )
        return [*given, *(f"replay:path={dump_file},{side}=1" for side in sides[len(given) :])]

    def replay(
        self,
        dump: str,
        fps: int = FPS,
        config_update: dict[str, Any] | None = None,
        directory: str | None = None,
        render: bool = True,
    ) -> list[dict[str, Any]]:
        """Plays the match of a whole episode's dump again; returns its info of every step.

        - `config_update`: settings that differ from the dump's.
        - `directory`: where dumps of the repetition go.
        - `render`: whether the match is shown in a window (needs `setpiece[human]`).

        Raises `UnavailableError` for other `fps` than 10.
        """
        if fps != FPS:
            raise unavailable(
                "fps", "another length of a step than 100 ms", f"leave `fps` at {FPS}"
            )
        config = _config_of(dump)
        config["players"] = self.build_players(dump)
        config.update(config_update or {})
        if directory is not None:
            config["tracesdir"] = directory
        env = FootballEnv(config)
        if render:
            env.render()
        env.reset()
        infos = []
        for _ in read_dump(dump):
            _, _, done, info = env.step([])
            infos.append(info)
            if done:
                break
        env.close()
        return infos

    def dump_to_video(self, dump_file: str, directory: str | None = None) -> str:
        """Writes a video of a whole episode's dump; returns its path.

        - `directory`: where it goes; None: the dump's `tracesdir`.

        The match is played again, as `replay` does.
        """
        update = {"write_video": True, "dump_full_episodes": True, "dump_scores": False}
        infos = self.replay(dump_file, config_update=update, directory=directory, render=False)
        for info in infos:
            for dump in info.get("dumps", []):
                video: str = dump["video"]
                return video
        raise FormatError(f"`{dump_file}` ends before its episode does")


def _config_of(dump_file: str) -> Config:
    """Returns the settings of a dumped episode, so that the next `reset` begins that episode."""
    debug = read_dump(dump_file)[0]["debug"]
    if "config" not in debug:
        raise FormatError(f"`{dump_file}` has no settings in its first record")
    values = dict(debug["config"])
    # Making a config counts one episode, and `reset` another.
    values["episode_number"] -= 2
    # GRF dumps may come with a video.
    values["write_video"] = False
    return Config(values)
