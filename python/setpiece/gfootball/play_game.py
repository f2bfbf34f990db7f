"""Plays matches by hand, in a window: GRF's keys, or gamepads.

`python -m setpiece.gfootball.play_game --level=academy_3_vs_1_with_keeper`

Arrows run, S passes, A passes high, W passes long, D shoots, E sprints, C dribbles, Q changes the
player. Without the ball S presses, A slides, D sends the team to press, W the keeper.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from setpiece._errors import ParameterError
from setpiece.gfootball import _flags
from setpiece.gfootball.env.config import Config, parse_player_definition
from setpiece.gfootball.env.football_env import FootballEnv


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command until Ctrl-C, or until its window is closed.

    Returns its exit code: 0, 1 (input, Ctrl-C) or 2 (usage).
    """
    parser = _flags.parser("play_game", "Play matches by hand")
    parser.add_argument(
        "--players",
        default="keyboard:left_players=1",
        help="who plays, separated by semicolons [default: keyboard:left_players=1]",
    )
    parser.add_argument("--level", default="", help="the scenario [default: 11_vs_11_stochastic]")
    parser.add_argument("--action_set", choices=("default", "full"), default="default")
    parser.add_argument("--episodes", type=int, default=0, help="how many; 0: until Ctrl-C")
    _flags.add_switch(parser, "real_time", True, "whether a step takes 100 ms")
    _flags.add_switch(parser, "render", True, "whether matches are shown in a window")
    return _flags.run(parser, arguments, _play)


def _play(given: argparse.Namespace) -> None:
    players = [each for each in given.players.split(";") if each]
    if any(parse_player_definition(each)[0] == "agent" for each in players):
        raise ParameterError(
            "nobody calls `step` here, so there is no `agent` among the players", name="players"
        )
    values = {
        "action_set": given.action_set,
        "dump_full_episodes": True,
        "players": players,
        "real_time": given.real_time,
        **({"level": given.level} if given.level else {}),
    }
    env = FootballEnv(Config(values))
    if given.render:
        env.render()
    played = 0
    try:
        while given.episodes == 0 or played < given.episodes:
            env.reset()
            done = False
            while not done:
                _, _, done, _ = env.step([])
                if env.window_closed:
                    env.write_dump("shutdown")
                    return
            played += 1
    except KeyboardInterrupt:
        env.write_dump("shutdown")
        raise SystemExit(1) from None
    finally:
        env.close()


if __name__ == "__main__":
    sys.exit(main())
