"""The options of `cargo xtask transfer`, checked before anything is built.

Uses only the standard library.
"""

from __future__ import annotations

import argparse
import difflib
import sys
from pathlib import Path

POLICIES = Path(__file__).parent / "recorded" / "policies"
"""Stored policies: `NAME.npz` holds the weights, `NAME.json` the scores."""
SCENARIOS = (
    "academy_empty_goal_close",
    "academy_empty_goal",
    "academy_run_to_score",
    "academy_run_to_score_with_keeper",
    "academy_pass_and_shoot_with_keeper",
    "academy_run_pass_and_shoot_with_keeper",
    "academy_3_vs_1_with_keeper",
    "academy_counterattack_easy",
    "academy_counterattack_hard",
    "academy_corner",
    "11_vs_11_easy_stochastic",
)
STEPS = 10_000_000
EPISODES = 100
MATCH_SHARE = 10
"""A whole match counts as this many scenes."""
UPDATE = 128 * 64
"""Steps of an update: no training is shorter."""


def is_match(scenario: str) -> bool:
    """Whether a scenario is a whole match: scores may exceed 1, episodes take 3,000 steps."""
    return scenario.startswith("11_vs_11")


def episodes_of(scenario: str, episodes: int) -> int:
    """Returns the number of episodes of a scenario if scenes get `episodes`."""
    return max(2, episodes // MATCH_SHARE) if is_match(scenario) else episodes


def _scenario(text: str) -> str:
    if text in SCENARIOS:
        return text
    near = difflib.get_close_matches(text, SCENARIOS, 1)
    hint = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(SCENARIOS)}"
    raise argparse.ArgumentTypeError(f"no scenario `{text}`; {hint}")


def _number(least: int, unit: str):
    def read(text: str) -> int:
        try:
            value = int(text.replace("_", ""))
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"expected a whole number of {unit}, found `{text}`"
            ) from None
        if value < least:
            raise argparse.ArgumentTypeError(f"expected at least {least} {unit}, found {value}")
        return value

    return read


def _seed(text: str) -> int:
    if not text.isdecimal() or int(text) > 1_000_000:
        raise argparse.ArgumentTypeError(f"expected a seed from 0 to 1000000, found `{text}`")
    return int(text)


def parser() -> argparse.ArgumentParser:
    """Returns the parser of the command line."""
    made = argparse.ArgumentParser(
        prog="cargo xtask transfer",
        description="Trains policies here on what the super mini map shows, plays them here and in the real game, and "
        "writes docs/transfer.md.",
    )
    made.add_argument(
        "--scenario",
        type=_scenario,
        action="append",
        metavar="NAME",
        help="only this one; can be repeated. The page keeps the stored figures of the others",
    )
    made.add_argument(
        "--steps", type=_number(2 * UPDATE, "steps"), help=f"most steps of a training; {STEPS:,}"
    )
    made.add_argument(
        "--episodes",
        type=_number(2, "episodes"),
        default=EPISODES,
        help=f"of every policy in a scene, {EPISODES}; a tenth of it in whole matches; a quarter for agents by rules",
    )
    made.add_argument(
        "--recorded",
        action="store_true",
        help="plays the stored policies here, beside the scores recorded there: trains nothing, needs no EnvPool",
    )
    made.add_argument(
        "--seed", type=_seed, default=0, help="of the training and of the episodes; 0"
    )
    return made


def parse(argv: list[str]) -> argparse.Namespace:
    """Reads the command line; a mistake ends the program with status 2 and a message."""
    made = parser()
    options = made.parse_args(argv)
    if options.recorded and options.steps is not None:
        made.error("--steps has no meaning with --recorded, which trains nothing")
    if options.recorded:
        for name in options.scenario or ():
            if not (POLICIES / f"{name}.npz").exists():
                made.error(f"no policy is stored for `{name}`; run it once without --recorded")
    options.steps = options.steps or STEPS
    options.scenario = (
        list(dict.fromkeys(options.scenario)) if options.scenario else list(SCENARIOS)
    )
    return options


if __name__ == "__main__":
    parse(sys.argv[1:])
