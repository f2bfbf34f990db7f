"""Plays whole matches of bots in Google Research Football and writes counts, one match a line.

python matches.py LEFT RIGHT COUNT [--first I] > LINES
"""

import argparse
import json
import math
import random

from game import Game

SCALE = (54.4, 83.6)
PLACED_M = 1.5
"""No player runs further in a step; a longer way was a placement."""

SET_PIECES = {2: "goal_kicks", 3: "free_kicks", 4: "corners", 5: "throw_ins", 6: "penalties"}
RIGHT_OUT = [
    ("GK", -1, 0), ("RM", 0, 0.02), ("CF", 0, -0.02), ("LB", -0.422, -0.19576), ("CB", -0.5, -0.06356),
    ("CB", -0.5, 0.063559), ("RB", -0.422, 0.19576), ("CM", -0.184212, -0.10568), ("CM", -0.267574, 0),
    ("CM", -0.184212, 0.10568), ("LM", -0.01, -0.21610),
]  # fmt: skip
RIGHT_BACK = [
    ("GK", -1, 0), ("RM", -0.05, 0), ("CF", -0.01, 0.216102), ("LB", -0.422, -0.19576), ("CB", -0.5, -0.06356),
    ("CB", -0.5, 0.063559), ("RB", -0.422, 0.19576), ("CM", -0.184212, -0.10568), ("CM", -0.267574, 0),
    ("CM", -0.184212, 0.10568), ("LM", -0.01, -0.21610),
]  # fmt: skip


def stage(left, right, kicks_off_left):
    """The start of `11_vs_11_stochastic`; the teams kick off in turn."""
    first, second = (RIGHT_OUT, RIGHT_BACK) if kicks_off_left else (RIGHT_BACK, RIGHT_OUT)
    return {
        "ball": (0, 0),
        "left": [(role, x, y, "") for role, x, y in first],
        "right": [(role, -x, -y, "") for role, x, y in second],
        "difficulty": (left, right),
        "offside": True,
    }


def tally(game, left, right, number, seed):
    """Counts a match."""
    view = game.reset(stage(left, right, number % 2 == 0), seed)
    counts = dict.fromkeys(SET_PIECES.values(), 0)
    sums = {
        "nobody": 0,
        "stopped": 0,
        "high": 0,
        "left_third": 0,
        "middle_third": 0,
        "right_third": 0,
        "owned_left": 0,
    }
    spells, team, metres = 0, -1, 0.0
    for _ in range(3000):
        before, view = view, game.step(["builtin_ai"], view)
        mode, owner, x = view["mode"], view["owner"], view["ball"][0]
        if mode in SET_PIECES and before["mode"] != mode:
            counts[SET_PIECES[mode]] += 1
        sums["nobody"] += owner == -1
        sums["stopped"] += mode not in (0, 1)
        sums["high"] += view["ball"][2] > 1
        sums["owned_left"] += owner == 0
        sums[("left" if x < -54.4 / 3 else "right" if x > 54.4 / 3 else "middle") + "_third"] += 1
        if owner != -1 and owner != team:
            spells, team = spells + 1, owner
        for now, then in zip(view["teams"], before["teams"], strict=True):
            ways = (math.dist(a, b) for a, b in zip(now[1:], then[1:], strict=True))
            metres += sum(way for way in ways if way < PLACED_M) / 20
    seen = game.core._observation
    yellow = sum(int(seen[team + "_yellow_card"].sum()) for team in ("left_team", "right_team"))
    red = sum(int((~seen[team + "_active"]).sum()) for team in ("left_team", "right_team"))
    tired = [seen[team + "_tired_factor"] for team in ("left_team", "right_team")]
    return {
        "goals": sum(view["score"]),
        "difference": view["score"][0] - view["score"][1],
        **counts,
        **{name: value / (1 if name == "stopped" else 3000) for name, value in sums.items()},
        "spell": 3000 / max(spells, 1),
        "yellow": yellow,
        "red": red,
        "km": metres / 1000,
        "tired": float(sum(t[1:].mean() for t in tired) / 2),
        "tired_keepers": float(sum(t[0] for t in tired) / 2),
    }


def main():
    """Plays matches of bots and writes their counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("left", type=float)
    parser.add_argument("right", type=float)
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    args = parser.parse_args()
    game = Game((1, 0))
    seeds = random.Random(f"{args.left} {args.right} {args.first}")
    for number in range(args.first, args.first + args.count):
        one = tally(game, args.left, args.right, number, seeds.randrange(2**31))
        print(json.dumps({"left": args.left, "right": args.right, **one}), flush=True)


if __name__ == "__main__":
    main()
