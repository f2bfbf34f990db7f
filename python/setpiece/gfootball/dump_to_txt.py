"""Writes a dump as text.

`python -m setpiece.gfootball.dump_to_txt --trace_file=FILE.dump --output=FILE.txt`
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from setpiece.gfootball import _flags
from setpiece.gfootball.env.script_helpers import ScriptHelpers


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    parser = _flags.parser("dump_to_txt", "Write a dump as text")
    parser.add_argument(
        "--trace_file",
        metavar="FILE.dump",
        required=True,
        help="the dump; reading it runs what it says",
    )
    parser.add_argument(
        "--output", metavar="FILE.txt", required=True, help="where the text is written"
    )
    _flags.add_switch(parser, "include_debug", True, "whether what was pressed is written too")
    return _flags.run(
        parser,
        arguments,
        lambda given: ScriptHelpers().dump_to_txt(
            given.trace_file, given.output, given.include_debug
        ),
    )


if __name__ == "__main__":
    sys.exit(main())
