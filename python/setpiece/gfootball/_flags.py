"""Flags of the scripts, in all three ways to write GRF's."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence

from setpiece._errors import SetpieceError

_WORDS = {"true": True, "false": False, "1": True, "0": False}


def parser(prog: str, description: str) -> argparse.ArgumentParser:
    """Returns a parser without abbreviations."""
    return argparse.ArgumentParser(prog=prog, description=description, allow_abbrev=False)


def add_switch(parser: argparse.ArgumentParser, name: str, default: bool, help: str) -> None:
    """Adds a switch: `--name`, `--name=false` or `--noname`."""
    parser.add_argument(
        f"--{name}",
        type=_switch,
        nargs="?",
        const=True,
        default=default,
        metavar="true|false",
        help=help,
    )
    parser.add_argument(f"--no{name}", dest=name, action="store_false", help=argparse.SUPPRESS)


def run(
    parser: argparse.ArgumentParser,
    arguments: Sequence[str] | None,
    work: Callable[[argparse.Namespace], None],
) -> int:
    """Runs a command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    try:
        parsed = parser.parse_args(arguments)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 2
    try:
        work(parsed)
    except SetpieceError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    return 0


def _switch(word: str) -> bool:
    if word.lower() not in _WORDS:
        raise argparse.ArgumentTypeError(f"`{word}` is neither true nor false")
    return _WORDS[word.lower()]
