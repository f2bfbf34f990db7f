"""Plays the match of a dump again, in a window.

`python -m setpiece.gfootball.replay --trace_file=FILE.dump`
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from setpiece.gfootball import _flags
from setpiece.gfootball.env.script_helpers import FPS, ScriptHelpers


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    parser = _flags.parser("replay", "Play the match of a dump again")
    parser.add_argument(
        "--trace_file",
        metavar="FILE.dump",
        required=True,
        help="the dump of a whole episode; reading it runs what it says",
    )
    parser.add_argument("--fps", type=int, default=FPS, help=f"frames per second: {FPS}")
    _flags.add_switch(parser, "render", True, "whether it is shown in a window")
    return _flags.run(parser, arguments, _play)


def _play(given: argparse.Namespace) -> None:
    ScriptHelpers().replay(given.trace_file, given.fps, render=given.render)


if __name__ == "__main__":
    sys.exit(main())
