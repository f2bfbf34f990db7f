"""Trained policies in both games: training, playing, and the stored results."""

from __future__ import annotations

import argparse
import hashlib
import json
from collections import Counter
from pathlib import Path

import numpy as np

from games import ENVS_MAX, Here, There, play, there_version
from intervals import mean_interval, share_interval
from options import POLICIES, SCENARIOS, episodes_of, is_match
from policy import Policy
from ppo import train

REWARDS = "scoring,checkpoints"
"""The rewards of training: with goals alone, scenes in which random play never scores teach nothing."""
ENOUGH = 0.97
"""Training on a scene ends at this mean score of the last 1,000 episodes, with drawn actions."""
WANTED = 0.85
"""The share of its score that a policy should keep."""
SEED_HERE = 1_000_000
"""Evaluations here start from this seed, which no training reaches."""
KINDS = ("likeliest", "drawn")
NOT_STORED = Path(__file__).resolve().parents[2] / "target" / "transfer"
"""Weights after training, until their evaluation ends."""


def both(scenario: str, options: argparse.Namespace) -> None:
    """Trains a policy, plays it in both games and stores it with its scores."""
    enough = float("inf") if is_match(scenario) else ENOUGH
    made = train(
        scenario, options.steps, options.seed, REWARDS, enough, lambda text: print(text, flush=True)
    )
    NOT_STORED.mkdir(parents=True, exist_ok=True)
    weights = NOT_STORED / f"{scenario}.npz"
    made.policy.save(weights)
    # The stored policy is played, because saving rounds the weights.
    policy = Policy.load(weights)
    count = episodes_of(scenario, options.episodes)
    record = {
        "scenario": scenario,
        "weights": digest(weights),
        "training": {
            "steps": made.steps,
            "seed": options.seed,
            "rewards": REWARDS,
            "score": made.score,
            "seconds": round(made.seconds),
        },
        "here": scores(policy, scenario, Here, count, SEED_HERE + options.seed),
        "there": scores(policy, scenario, There, count, options.seed) | {"game": there_version()},
    }
    POLICIES.mkdir(parents=True, exist_ok=True)
    (POLICIES / weights.name).write_bytes(weights.read_bytes())
    store(record)


def again(scenario: str, options: argparse.Namespace) -> None:
    """Plays a stored policy here; its scores there stay as recorded."""
    record = json.loads((POLICIES / f"{scenario}.json").read_text())
    weights = POLICIES / f"{scenario}.npz"
    if digest(weights) != record["weights"]:
        raise SystemExit(
            f"{weights} isn't the policy whose scores {weights.with_suffix('.json').name} holds"
        )
    count = episodes_of(scenario, options.episodes)
    record["here"] = scores(Policy.load(weights), scenario, Here, count, SEED_HERE + options.seed)
    store(record)


def scores(
    policy: Policy, scenario: str, game: type[Here] | type[There], episodes: int, seed: int
) -> dict:
    """Plays a policy's likeliest and drawn actions; counts episodes by goal difference."""
    result: dict = {"seed": seed}
    for kind in KINDS:
        matches = game(scenario, min(ENVS_MAX, episodes), seed)
        ends = play(policy, matches, episodes, kind == "drawn", seed)
        matches.close()
        result[kind] = {
            str(goals): count for goals, count in sorted(Counter(ends.tolist()).items())
        }
        print(
            f"{scenario}: {game.__name__.lower()} {kind} {ends.mean():.2f} ({episodes} episodes)",
            flush=True,
        )
    return result


def digest(path: Path) -> str:
    """Returns the first 16 digits of a file's SHA-256."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def store(record: dict) -> None:
    """Writes a policy's results."""
    (POLICIES / f"{record['scenario']}.json").write_text(json.dumps(record, indent=1) + "\n")


def stored() -> list[dict]:
    """Returns the stored results in the order of the scenarios."""
    files = [POLICIES / f"{name}.json" for name in SCENARIOS]
    return [json.loads(file.read_text()) for file in files if file.exists()]


def ends_of(counts: dict[str, int]) -> np.ndarray:
    """Returns the goal differences of stored episodes."""
    return np.repeat([int(goals) for goals in counts], list(counts.values()))


def table(records: list[dict]) -> str:
    """Returns the page's table of policies and its summary."""
    lines = [
        "| scenario | steps | actions | here | there | kept |",
        "|---|---|---|---|---|---|",
    ]
    kept = []
    for record in records:
        for kind in KINDS:
            here, there = (ends_of(record[side][kind]) for side in ("here", "there"))
            share = share_interval(here, there)
            name = record["scenario"] if kind == KINDS[0] else ""
            steps = f"{record['training']['steps']:,}" if kind == KINDS[0] else ""
            ratio = (
                "-"
                if share is None
                else "{:.0%} ({:.0%} to {:.0%})".format(*(round(part, 2) + 0.0 for part in share))
            )
            lines.append(f"| {name} | {steps} | {kind} | {cell(here)} | {cell(there)} | {ratio} |")
            if share is not None:
                kept.append(share[0])
    counts = sorted(
        {sum(record[side][KINDS[0]].values()) for record in records for side in ("here", "there")}
    )
    enough = sum(share >= WANTED for share in kept)
    lines += [
        "",
        f"Episodes for each score: {' or '.join(map(str, counts))}. {enough} of {len(kept)} rows with a positive score "
        f"here keep at least {WANTED:.0%} of it.",
    ]
    return "\n".join(lines) + "\n"


def cell(ends: np.ndarray) -> str:
    """Returns a mean score with its interval."""
    low, high = mean_interval(ends)
    # Adding 0 turns a rounded -0 into 0.
    mean, low, high = (round(value, 2) + 0.0 for value in (float(ends.mean()), low, high))
    return f"{mean:.2f} ({low:.2f} to {high:.2f})"
