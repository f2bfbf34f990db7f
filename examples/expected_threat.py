"""Measures from which places bots score, and writes it as a table for the language.

    python examples/expected_threat.py --matches 1000

Bots play matches of `11_vs_11_stochastic`. A moment is a step in which a player has the ball. The
number of a cell is the share of its moments after which the player's team scores within some
seconds (`--seconds`) before an opponent has the ball. Places are in the frame of that team: it
attacks towards +x. Both halves along y are counted together, so the table is symmetric.

`expected_threat.pitch` reads the table. Karun Singh's *expected threat* (2018) is another measure
of the same thing.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import setpiece

SCENARIO = "11_vs_11_stochastic"
COLUMNS, ROWS = 12, 8
METRES = np.array([54.4, 83.6])
"""What a normalised x and y of 1 are."""
HALF_M = np.array([55.0, 36.0])
"""From the centre spot to the goal lines and to the touch lines."""
BALL, OWNER, NORMAL_PLAY = slice(88, 90), slice(94, 97), 108
"""Where `simple115v2` has the ball, who has it, and whether play is on."""
TOGETHER = 50
"""Matches that are played at once."""


@dataclass(frozen=True)
class Watched:
    """Matches, step by step; arrays of `(steps, matches)`."""

    owner: NDArray[np.int8]
    """Who has the ball while play is on: 1 the left team, -1 the right team, 0 nobody."""
    goal: NDArray[np.int8]
    """Who has scored in this step: 1, -1 or 0."""
    ball: NDArray[np.float32]
    """`(steps, matches, 2)`, in the frame of the left team."""


def watch(matches: int, seed: int) -> Watched:
    """Plays whole matches between bots."""
    envs = setpiece.make_vec(
        SCENARIO, matches, seed=seed, observation="simple115v2", action_set="v2", left=1
    )
    bots = np.full(matches, setpiece.Action.BUILTIN_AI)
    over = np.zeros(matches, bool)
    seen, infos = envs.reset()
    score = infos["score"].copy()
    owners, goals, balls = [], [], []
    while not over.all():
        seen, _, terminations, truncations, infos = envs.step(bots)
        counts = ~over & (seen[:, NORMAL_PLAY] > 0)
        owners.append(np.where(counts, seen[:, OWNER] @ [0, 1, -1], 0))
        rose = np.sign(infos["score"] - score) @ [1, -1]
        goals.append(np.where(over, 0, rose))
        balls.append(seen[:, BALL].copy())
        score = infos["score"].copy()
        over |= terminations | truncations
    envs.close()
    return Watched(np.array(owners, np.int8), np.array(goals, np.int8), np.array(balls))


def scores_soon(watched: Watched, team: int, steps: int) -> NDArray[np.bool_]:
    """Whether a team scores within some steps, before an opponent has the ball."""
    soon = np.zeros(watched.owner.shape, bool)
    left = np.zeros(watched.owner.shape[1], int)  # Steps in which an earlier moment still counts.
    for step in reversed(range(len(soon))):
        soon[step] = left > 0
        left = np.where(watched.owner[step] == -team, 0, np.maximum(left - 1, 0))
        left = np.where(watched.goal[step] == team, steps, left)
        left = np.where(watched.goal[step] == -team, 0, left)
    return soon


def counted(watched: Watched, steps: int) -> NDArray[np.int64]:
    """Returns for every cell its moments and those before a goal: `(2, ROWS, COLUMNS)`."""
    counts = np.zeros((2, ROWS, COLUMNS), np.int64)
    size = np.array([COLUMNS, ROWS])
    for team in (1, -1):
        has_ball = watched.owner == team
        place = watched.ball[has_ball] * team * METRES / HALF_M
        cell = np.clip((place + 1) / 2 * size, 0, size - 1).astype(int)
        good = scores_soon(watched, team, steps)[has_ball]
        for layer, weight in enumerate((np.ones_like(good), good)):
            np.add.at(counts[layer], (cell[:, 1], cell[:, 0]), weight.astype(int))
    return counts + counts[:, ::-1]


def threat(matches: int, seconds: float, seed: int) -> NDArray[Any]:
    """Plays matches and returns the table, `(ROWS, COLUMNS)`; the first row has the least y."""
    counts = np.zeros((2, ROWS, COLUMNS), np.int64)
    for first in range(0, matches, TOGETHER):
        watched = watch(min(TOGETHER, matches - first), seed + first)
        counts += counted(watched, round(10 * seconds))
    moments, good = counts
    return np.divide(good, moments, out=np.zeros(moments.shape), where=moments > 0)


def main(argv: list[str] | None = None) -> NDArray[Any]:
    """Reads the command line, plays and writes the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--matches", type=int, default=1000, help="each takes 3,000 steps")
    parser.add_argument("--seconds", type=float, default=10.0, help="how soon the goal must come")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path(__file__).with_suffix(".csv"))
    args = parser.parse_args(argv)
    if args.matches < 1 or args.seconds < 0.1:
        parser.error("it takes at least one match, and 0.1 seconds")
    table = threat(args.matches, args.seconds, args.seed)
    lines = [
        f"# The share of moments after which the team with the ball scores within {args.seconds:g} s",
        "# before it loses the ball. It attacks to the right; the first row has the least y.",
        f"# python examples/expected_threat.py --matches {args.matches}"
        f" --seconds {args.seconds:g} --seed {args.seed}",
        *(", ".join(f"{share:.4f}" for share in row) for row in table),
    ]
    args.out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return table


if __name__ == "__main__":
    main()
