"""`setpiece replay FILE`: plays a recorded episode again, and describes or converts it."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from setpiece._errors import SetpieceError
from setpiece._native import run_command

EXAMPLES = """\
Examples:
  setpiece replay runs/academy_corner_7_0.pitchr
  setpiece replay goal.pitchr --format jsonl | head -1
  setpiece replay goal.pitchr --format cdf -o goal/
  setpiece replay goal.pitchr --format grf -o goal.dump
"""
FORMATS = {
    "text": "in a few lines (the default)",
    "jsonl": "one JSON object per line, for the start and for every step",
    "cdf": "tracking and events, ten frames per second, as Common Data Format; needs -o",
    "csv": "the same as tables; needs -o",
    "grf": "a dump of Google Research Football, for `script_helpers`; needs -o",
}
COLOURS = ("auto", "always", "never")


def main(arguments: Sequence[str]) -> int:
    """Runs the command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    parser = argparse.ArgumentParser(
        prog="setpiece replay",
        description="Play a recorded episode again, bit for bit, and describe it",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("file", metavar="FILE", help="a recorded episode (.pitchr)")
    formats = "; ".join(f"{name}: {what}" for name, what in FORMATS.items())
    parser.add_argument("--format", metavar="FORMAT", choices=FORMATS, default="text", help=formats)
    parser.add_argument(
        "-o", "--output", metavar="OUT", help="where a dump is written; a folder for cdf and csv"
    )
    parser.add_argument(
        "--color", metavar="WHEN", choices=COLOURS, help=f"{', '.join(COLOURS)}: colour the output"
    )
    try:
        parsed, others = parser.parse_known_args(arguments)
        if parsed.format == "grf" and others:
            parser.error(f"unrecognized arguments: {' '.join(others)}")
        if parsed.format == "grf" and parsed.output is None:
            parser.error("a dump is written to a file: -o OUT.dump")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 2
    if parsed.format != "grf":
        return run_command(["replay", *arguments])
    from setpiece._replay import Replay
    from setpiece.gfootball._dump import replay_to_dump

    try:
        replay_to_dump(Replay(parsed.file), parsed.output)
    except SetpieceError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    return 0
