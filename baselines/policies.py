"""Makes the policies in the box: trains, picks the best, measures it, and writes file and card.

    python baselines/policies.py                       what is missing
    python baselines/policies.py --again               all of them, after a change of the game
    python baselines/policies.py --only academy_corner

`policies/SCENARIO.onnx` is the policy that `--agent baseline` plays in a scenario, and
`policies/SCENARIO.json` its card. An interrupted run continues from its checkpoint in
`target/baselines/policies`; `--again` removes it first.

It needs `torch`, `onnx` and `onnxruntime`.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import setpiece

from command import train
from ppo import Training

HERE = Path(__file__).parent
POLICIES = HERE / "policies"
CHECKPOINTS = HERE.parent / "target" / "baselines" / "policies"

RULE = (
    "of the training seeds, the policy with the highest mean score of its likeliest actions in "
    "the first 300 episodes of the seed 2000000; of equal ones, that of the lowest seed"
)
"""How the policy is picked. Its score is measured on other episodes."""
PICKED, PICKING_SEED = 300, 2_000_000
MEASURED, MEASURING_SEED = 500, 1_000_000

BYTES_MAX = 200_000
"""The most that a policy in the box may have."""


@dataclass(frozen=True)
class Boxed:
    """What a policy in the box is trained with; the rest are the settings of `settings.py`."""

    scenario: str
    steps: int
    seeds: tuple[int, ...] = (1, 2)
    settings: dict[str, Any] = field(default_factory=dict)


BOX = (
    Boxed("academy_empty_goal_close", 500_000),
    Boxed("academy_empty_goal", 1_000_000),
    Boxed("academy_run_to_score", 1_000_000),
    Boxed("academy_run_to_score_with_keeper", 3_000_000),
    Boxed("academy_3_vs_1_with_keeper", 3_000_000),
)


def score(path: Path, scenario: str, episodes: int, seed: int) -> setpiece.Estimate:
    """Returns the mean score of a file's likeliest actions, with its interval."""
    return setpiece.evaluate(path, scenario, episodes=episodes, seed=seed).rows[0].mean_score


def shown(path: Path, scenario: str) -> dict[str, Any]:
    """Returns what `setpiece run` measures of a file."""
    line = [sys.executable, "-P", "-m", "setpiece", "run", scenario, "--agent", str(path)]
    line += ["--episodes", str(MEASURED), "--seed", str(MEASURING_SEED), "--format", "json"]
    found: dict[str, Any] = json.loads(subprocess.run(line, capture_output=True, check=True).stdout)
    return found


def make(boxed: Boxed) -> dict[str, Any]:
    """Trains a policy with every seed, keeps the best with its card, and returns the card."""
    tried = []
    for seed in boxed.seeds:
        chosen = {"scenario": boxed.scenario, "steps": boxed.steps, "seed": seed}
        settings = Training.options(**chosen, **boxed.settings)
        out = CHECKPOINTS / f"{boxed.scenario}-{seed}"
        found = train(Training, settings, out, episodes=PICKED)
        path = out / "policy.onnx"
        picked = score(path, boxed.scenario, PICKED, PICKING_SEED).value
        tried.append((picked, -seed, path, found))
    _, _, path, found = max(tried, key=lambda one: one[:2])
    kept = POLICIES / f"{boxed.scenario}.onnx"
    if path.stat().st_size > BYTES_MAX:
        raise SystemExit(f"{path} has more than {BYTES_MAX} bytes")
    POLICIES.mkdir(exist_ok=True)
    shutil.copyfile(path, kept)
    card = card_of(boxed, kept, found, {-seed: value for value, seed, *_ in tried})
    text = json.dumps(card, indent=1) + "\n"
    kept.with_suffix(".json").write_text(text, encoding="utf-8")
    return card


def card_of(
    boxed: Boxed, kept: Path, found: dict[str, Any], picked: dict[int, float]
) -> dict[str, Any]:
    """Returns the card of a policy: what it was trained with, how it was picked, what it does."""
    measured = score(kept, boxed.scenario, MEASURED, MEASURING_SEED)
    played = shown(kept, boxed.scenario)
    figures = played["match_stats"]
    return {
        "scenario": boxed.scenario,
        "settings": found["settings"],
        "steps": found["steps"],
        "picked": {"rule": RULE, "scores": {str(seed): value for seed, value in picked.items()}},
        "score": {
            "episodes": MEASURED,
            "seed": MEASURING_SEED,
            "mean": measured.value,
            "low": round(measured.low, 4),
            "high": round(measured.high, 4),
        },
        "ends": {
            name: round(count / MEASURED, 3) for name, count in played["outcomes"].items() if count
        },
        "mean_length_s": round(played["mean_length"] / 10, 2),
        "passes": figures["passes_by_team"][0],
        "shots": figures["shots_by_team"][0],
        "versions": found["versions"],
    }


def main(argv: list[str] | None = None) -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--again", action="store_true", help="also those that are there")
    parser.add_argument("--only", nargs="+", metavar="SCENARIO", help="only these")
    args = parser.parse_args(argv)
    names = [boxed.scenario for boxed in BOX]
    if unknown := sorted({*(args.only or ())} - {*names}):
        parser.error(f"no policy for `{unknown[0]}`; there are {', '.join(names)}")
    for boxed in BOX:
        if args.only and boxed.scenario not in args.only:
            continue
        if args.again:
            for seed in boxed.seeds:
                shutil.rmtree(CHECKPOINTS / f"{boxed.scenario}-{seed}", ignore_errors=True)
        elif (POLICIES / f"{boxed.scenario}.json").is_file():
            continue
        card = make(boxed)
        found = card["score"]
        print(
            f"{boxed.scenario}: {found['mean']:.3f} ({found['low']:.3f} to {found['high']:.3f})",
            flush=True,
        )


if __name__ == "__main__":
    main()
