"""Writes a dump as text.

`python -m setpiece.gfootball.dump_to_txt --trace_file=FILE.dump --output=FILE.txt`
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from setpiece._errors import SetpieceError
from setpiece.gfootball.env.script_helpers import ScriptHelpers

_FLAGS = {"true": True, "false": False, "1": True, "0": False}


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    parser = argparse.ArgumentParser(
        prog="dump_to_txt", description="Write a dump as text", allow_abbrev=False
    )
    parser.add_argument(
        "--trace_file",
        metavar="FILE.dump",
        required=True,
        help="the dump; reading it runs what it says",
    )
    parser.add_argument(
        "--output", metavar="FILE.txt", required=True, help="where the text is written"
    )
    # All three ways to write GRF's flags.
    parser.add_argument(
        "--include_debug", type=_flag, nargs="?", const=True, default=True, metavar="true|false"
    )
    parser.add_argument(
        "--noinclude_debug",
        dest="include_debug",
        action="store_false",
        help="without what was pressed",
    )
    try:
        parsed = parser.parse_args(arguments)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 2
    try:
        ScriptHelpers().dump_to_txt(parsed.trace_file, parsed.output, parsed.include_debug)
    except SetpieceError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    return 0


def _flag(word: str) -> bool:
    if word.lower() not in _FLAGS:
        raise argparse.ArgumentTypeError(f"`{word}` is neither true nor false")
    return _FLAGS[word.lower()]


if __name__ == "__main__":
    sys.exit(main())
