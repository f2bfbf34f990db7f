"""Writes a video of a whole episode's dump.

`python -m setpiece.gfootball.dump_to_video --trace_file=FILE.dump`
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from setpiece.gfootball import _flags
from setpiece.gfootball.env.script_helpers import ScriptHelpers


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    parser = _flags.parser("dump_to_video", "Write a video of a dump")
    parser.add_argument(
        "--trace_file",
        metavar="FILE.dump",
        required=True,
        help="the dump of a whole episode; reading it runs what it says",
    )
    parser.add_argument(
        "--directory", metavar="FOLDER", help="where the video goes [default: as the dump says]"
    )
    return _flags.run(parser, arguments, _write)


def _write(given: argparse.Namespace) -> None:
    sys.stdout.write(f"{ScriptHelpers().dump_to_video(given.trace_file, given.directory)}\n")


if __name__ == "__main__":
    sys.exit(main())
