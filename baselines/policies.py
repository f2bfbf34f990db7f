"""Makes the policies in the box: trains, picks the best, measures it, and writes file and card.

    python baselines/policies.py                       what is missing
    python baselines/policies.py --again               all of them, after a change of the game
    python baselines/policies.py --only academy_corner
    python baselines/policies.py --describe            only the words of the cards, without training

`policies/SCENARIO.onnx` is the policy that `--agent baseline` plays in a scenario, and
`policies/SCENARIO.json` its card. An interrupted run continues from its checkpoint in
`target/baselines/policies`; `--again` removes it first.

A card's words say what the policy does and its weaknesses. They are drawn from the episodes that
its score is measured on, as `setpiece profile` shows them.

It needs `torch`, `onnx` and `onnxruntime`; `--describe` needs none of them.
"""

from __future__ import annotations

import argparse
import json
import math
import shutil
import statistics
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import setpiece

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
    from command import train
    from ppo import Training

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
    write(card, kept.with_suffix(".json"))
    return card


def write(card: dict[str, Any], path: Path) -> None:
    """Writes a card."""
    path.write_text(json.dumps(card, indent=1) + "\n", encoding="utf-8")


def profiled(path: Path, scenario: str) -> dict[str, Any]:
    """Returns the figures of `setpiece profile` of a file, for the measured episodes."""
    with TemporaryDirectory() as folder:
        out = Path(folder) / "figures.json"
        line = [sys.executable, "-P", "-m", "setpiece", "profile", str(path), scenario]
        line += ["--episodes", str(MEASURED), "--seed", str(MEASURING_SEED), "--output", str(out)]
        subprocess.run(line, capture_output=True, check=True)
        found: dict[str, Any] = json.loads(out.read_text(encoding="utf-8"))
    return found


def describe(path: Path, scenario: str, repeat: int) -> dict[str, str]:
    """Returns the words of a card: what a file does, and its weaknesses."""
    return words(profiled(path, scenario), repeat)


def words(figures: dict[str, Any], repeat: int) -> dict[str, str]:
    """Returns the words for the figures of a profile; a decision lasts `repeat` steps."""
    n = figures["episodes"]
    passes, shots, touches = figures["passes"], figures["shots"], figures["touches"]
    steps, length_s = sum(figures["actions"].values()), figures["length_s"]["value"]
    most = list(figures["actions"].items())
    most = sorted(most, key=lambda one: -one[1])[:3]
    pressed = ", ".join(f"`{name}` {count / steps:.0%}" for name, count in most)
    ends = sorted(figures["ends"], key=lambda end: -end["count"])
    won = sum(end["count"] for end in ends if end["verdict"] == "success")
    does = [
        f"It succeeds in {won / n:.1%} of {n} episodes, which last {length_s:.1f} s on average.",
        f"It decides {steps / repeat / n:.1f} times an episode; the actions are mostly {pressed}.",
        f"Its players touch the ball {len(touches) / n:.1f} times an episode, "
        f"pass {len(passes) / n:.2f} times and shoot {len(shots) / n:.2f} times.",
    ]
    if touches:
        does.append(f"{where(touches, figures['pitch'])}.")
    if shots:
        goal = figures["pitch"]["length"] / 2
        far = [math.hypot(goal - x, y) for x, y in (shot["at"] for shot in shots)]
        does.append(
            f"Half of its shots come from within {statistics.median(far):.0f} m of the goal, the "
            f"farthest from {max(far):.0f} m."
        )
    return {"does": " ".join(does), "weaknesses": " ".join(weaknesses(figures, ends, n))}


def where(touches: list[list[float]], pitch: dict[str, float]) -> str:
    """Returns in which third of the pitch's width the ball is touched."""
    edge = pitch["width"] / 6
    thirds = {
        "on the left": sum(y < -edge for _, y in touches),
        "in the middle": sum(-edge <= y <= edge for _, y in touches),
        "on the right": sum(y > edge for _, y in touches),
    }
    shares = [
        f"{count / len(touches):.0%} are {place}"
        for place, count in thirds.items()
        if count >= len(touches) / 200
    ]
    return f"Of its touches, {', '.join(shares)}"


def weaknesses(figures: dict[str, Any], ends: list[dict[str, Any]], n: int) -> list[str]:
    """Returns how the other episodes end, which shots are no goals, and what isn't tried."""
    other = [end for end in ends if end["verdict"] != "success"]
    said = [f"`{end['name']}` {end['count'] / n:.1%}" for end in other]
    found = [f"Other episodes end with {', '.join(said)}." if said else "Every episode succeeds."]
    shots = figures["shots"]
    missed = Counter(shot["outcome"] for shot in shots if shot["outcome"] != "successful")
    if missed:
        kinds = ", ".join(f"{kind} {count}" for kind, count in missed.most_common())
        found.append(f"{sum(missed.values())} of {len(shots)} shots are no goals ({kinds}).")
    passes = figures["passes"]
    if other and len(passes) < n / 100:
        found.append("It all but never passes." if passes else "It never passes.")
    elif lost := sum(not one["completed"] for one in passes):
        found.append(f"{lost} of {len(passes)} passes reach no teammate.")
    return found


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
        "words": describe(kept, boxed.scenario, found["settings"]["repeat"]),
        "versions": found["versions"],
    }


def main(argv: list[str] | None = None) -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--again", action="store_true", help="also those that are there")
    parser.add_argument("--describe", action="store_true", help="only the words of the cards")
    parser.add_argument("--only", nargs="+", metavar="SCENARIO", help="only these")
    args = parser.parse_args(argv)
    names = [boxed.scenario for boxed in BOX]
    if unknown := sorted({*(args.only or ())} - {*names}):
        parser.error(f"no policy for `{unknown[0]}`; there are {', '.join(names)}")
    for boxed in BOX:
        if args.only and boxed.scenario not in args.only:
            continue
        card_file = POLICIES / f"{boxed.scenario}.json"
        if args.describe:
            if card_file.is_file():
                card = json.loads(card_file.read_text(encoding="utf-8"))
                kept = card_file.with_suffix(".onnx")
                card["words"] = describe(kept, boxed.scenario, card["settings"]["repeat"])
                write(card, card_file)
                print(f"{boxed.scenario}: {card['words']['does']}", flush=True)
            continue
        if args.again:
            for seed in boxed.seeds:
                shutil.rmtree(CHECKPOINTS / f"{boxed.scenario}-{seed}", ignore_errors=True)
        elif card_file.is_file():
            continue
        card = make(boxed)
        found = card["score"]
        print(
            f"{boxed.scenario}: {found['mean']:.3f} ({found['low']:.3f} to {found['high']:.3f})",
            flush=True,
        )


if __name__ == "__main__":
    main()
