"""Plays the recorded scenes in Google Research Football and writes what was seen, one episode a line.

    python record.py FILE... --into FOLDER [--first I] [--count N] [--rows A:B]

`lab recorded FILE TRACES` makes figures of them, by the same functions that make ours.
"""

import argparse
import json
import pathlib
import random
import sys

from game import Game
from keys import Keys

DATA = pathlib.Path(__file__).parent.parent / "data"


def frac_offset(episode, largest):
    """The offset of an episode's start: a sequence that fills the rectangle evenly."""
    at = [2 * ((0.5 + (episode + 1) * step) % 1) - 1 for step in (0.7548776662, 0.5698402910)]
    return [largest[0] * at[0], largest[1] * at[1]]


def stage(scene, row, episode):
    """Everybody's place in an episode."""
    offset = frac_offset(episode, scene.get("jitter", [0, 0]))
    mirror = -1 if mirrored(scene, episode) else 1

    def place(x, y, moved):
        return x + (offset[0] if moved else 0), mirror * (y + (offset[1] if moved else 0))

    def team(name):
        return [
            (role, *place(x, y, "jitter" in flags.split()), flags.split())
            for role, x, y, flags in scene[name]
        ]

    return {
        "ball": place(*scene["ball"], scene.get("ball_jitter", True)),
        "left": team("left"),
        "right": team("right"),
        "difficulty": (row.get("left", 1.0), row.get("right", 0.6)),
        "offside": scene.get("offside", False),
    }


def mirrored(scene, episode):
    """Whether an episode is mirrored top to bottom."""
    return scene.get("mirror", False) and episode % 2 == 1


def stops(trace, words):
    """Whether an episode stops here."""
    now = len(trace) - 1

    def past(first, number):
        return first is not None and now >= first + number

    for line in words:
        word, _, number = line.partition(" ")
        number = int(number or 0)
        if word in ("lost", "won"):
            team = 1 if word == "lost" else 0
            holds = past(
                next((i for i in range(1, now + 1) if trace[i]["owner"] == team), None), number
            )
        elif word == "over":
            begins = next((i for i in range(now + 1) if trace[i]["mode"] != 0), None)
            over = None
            if begins is not None:
                over = next((i for i in range(begins, now + 1) if trace[i]["mode"] == 0), None)
            holds = past(over, number)
        else:
            holds = {
                "goal": trace[now]["score"] != trace[0]["score"],
                "out": trace[now]["mode"] != 0,
            }[word]
        if holds:
            return True
    return False


def play(game, scene, plans, row, episode, seed):
    """Plays an episode; returns its views."""
    trace = [game.reset(stage(scene, row, episode), seed)]
    left = scene["agents"][0]
    hands = [
        Keys(plan, agent, int(agent >= left), mirrored(scene, episode))
        for agent, plan in enumerate(plans)
    ]
    for _ in range(row["steps"]):
        trace.append(game.step([hand.press(trace[-1]) for hand in hands], trace[-1]))
        if stops(trace, row.get("stop", [])):
            break
    return trace


def packed(view):
    """A view as a list, rounded."""
    flat = [*view["ball"], *view["vel"]]
    teams = [[round(v, 3) for place in team for v in place] for team in view["teams"]]
    whose = [view["owner"], view["who"], view["mode"]]
    return [
        [round(v, 3) for v in flat],
        whose,
        teams,
        view["pressed"],
        view["active"],
        view["score"],
    ]


def record(name, games, args):
    """Plays the rows of a file."""
    file = json.loads((DATA / name).read_text())
    begin, end = (int(at) if at else None for at in args.rows.split(":"))
    with (pathlib.Path(args.into) / name).open("w") as into:
        for number in range(len(file["rows"]))[begin:end]:
            row = file["rows"][number]
            scene = file["scenes"][row["scene"]]
            agents = tuple(scene["agents"])
            if agents not in games:
                games[agents] = Game(agents)
            seeds = random.Random(f"{name} {number} {args.first}")
            for episode in range(args.first, args.first + (args.count or row["n"])):
                trace = play(
                    games[agents],
                    scene,
                    file["plans"][row["plan"]],
                    row,
                    episode,
                    seeds.randrange(2**31),
                )
                into.write(
                    json.dumps([number, [packed(view) for view in trace]], separators=(",", ":"))
                    + "\n"
                )


def main():
    """Plays the files that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--into", required=True)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--rows", default=":")
    args = parser.parse_args()
    games = {}
    for name in args.files:
        record(name, games, args)
        print(name, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
