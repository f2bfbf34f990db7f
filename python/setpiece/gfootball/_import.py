"""`setpiece import grf FILE.py`: a scenario script of Google Research Football as a `.pitch` text."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout

import setpiece
from setpiece import _native, gfootball
from setpiece._errors import SetpieceError
from setpiece._options import check_path
from setpiece.gfootball._translation import TranslationError, identifier, to_pitch
from setpiece.gfootball.env.scenario_builder import Script, load_script, record, script_of
from setpiece.gfootball.env.scenario_config import FIXED_SEED, ScenarioConfig

EVEN, ODD = 2, 1
LATER = (3, 4, 5, 6)
"""Episodes that must equal the first ones."""


def import_script(path: str) -> str:
    """Returns the text of a script's file; it compiles and has the layout of `setpiece fmt`.

    Raises `FileError`, `TranslationError` for what a text can't express, `CompileError` for what no
    scenario may contain, `GrfScriptError` if the script fails.
    """
    script = script_of(load_script(path), path)
    even, odd = record(script, EVEN), record(script, ODD)
    _check_later(script, even, odd)
    if even.deterministic and even.game_engine_random_seed != FIXED_SEED:
        raise TranslationError(
            f"`game_engine_random_seed` is {even.game_engine_random_seed}; a text has no seed of its own",
            help="leave it out and give the seed to `reset`, or to `setpiece run --seed`",
        )
    text = to_pitch(even, identifier(path), odd)
    setpiece.compile(text, f"{identifier(path)}.pitch")
    return text


def _check_later(script: Script, even: ScenarioConfig, odd: ScenarioConfig) -> None:
    """Raises `TranslationError` if episodes don't alternate."""
    for episode in (*LATER, EVEN, ODD):
        if record(script, episode) != (odd if episode % 2 else even):
            drawn = record(script, EVEN) != even or record(script, ODD) != odd
            raise TranslationError(
                "the script draws at random, and a text can't call it"
                if drawn
                else f"episode {episode} is neither as the first one nor as the second; a text can only take turns",
                help="import it with constants, and write the draw in the text: `uniform(-0.1, 0.1)`"
                if drawn
                else "let the script look at `EpisodeNumber() % 2` alone",
            )


def main(arguments: Sequence[str]) -> int:
    """Runs the command and returns its exit code: 0, 1 (input) or 2 (usage)."""
    parser = argparse.ArgumentParser(
        prog="setpiece import", description="Write a scenario of another engine as a .pitch file"
    )
    kinds = parser.add_subparsers(dest="kind", required=True, metavar="KIND")
    grf = kinds.add_parser(
        "grf", help="a Python script of Google Research Football, with `build_scenario(builder)`"
    )
    grf.add_argument("file", metavar="FILE.py", help="the script; it is run")
    grf.add_argument(
        "-o", "--output", metavar="OUT.pitch", help="where to write; else to standard output"
    )
    try:
        parsed = parser.parse_args(arguments)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 2
    try:
        gfootball.install()
        # Standard output is for the text, so the script's own output goes elsewhere.
        with redirect_stdout(sys.stderr):
            text = import_script(parsed.file)
        if parsed.output is None:
            sys.stdout.write(text)
        else:
            _write(parsed.output, text)
    except SetpieceError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    return 0


def _write(path: str, text: str) -> None:
    _native.write(check_path("output", path), text.encode())
