"""Whole matches of rule-based agents in one game.

`python matches.py GAME OUT [--scenario S] [--episodes N]`: GAME is `gfootball` (Google Research
Football's package, if installed) or `setpiece.gfootball` (the drop-in).
"""

from __future__ import annotations

import argparse
import importlib
import json
import time
from functools import partial
from pathlib import Path

import numpy as np

from agents import AGENTS, Player
from scene import METRES, scene_of_raw

# A free ball that moves faster has been kicked, metres per step.
KICKED = 1.15
# How many episodes one environment plays. Episodes of one environment of the real game are similar.
EPISODES_EACH = 2
# The counts of a match.
# fmt: off
COUNTED = [
    "goals", "conceded", "shots", "wide", "passes", "completed", "owned", "lost", "box", "third",
    "free", "goal_kicks", "corners", "throw_ins", "free_kicks", "set_piece_steps", "kick_keys",
    "unplayed", "steps",
]
# fmt: on


class Tally:
    """The counts of a match, from raw observations."""

    def __init__(self) -> None:
        self.counts = dict.fromkeys(COUNTED, 0)
        self.speeds: list[float] = []
        self.owner = None
        self.flight = None
        self.mode = 0
        self.pending: list[int] = []

    def see(self, raw: dict, before: np.ndarray, action: int, step: int) -> None:
        """Counts a step."""
        counts = self.counts
        ball = raw["ball"][:2] * METRES
        way = ball - before
        speed = float(np.linalg.norm(way))
        team, player = int(raw["ball_owned_team"]), int(raw["ball_owned_player"])
        mode = int(raw["game_mode"])
        counts["steps"] += 1
        counts["owned"] += team == 0
        counts["free"] += team == -1
        counts["box"] += team == 0 and ball[0] > 38.0 and abs(ball[1]) < 20.0
        counts["third"] += team == 0 and ball[0] > 18.0
        if mode != self.mode and mode:
            name = {2: "goal_kicks", 3: "free_kicks", 4: "corners", 5: "throw_ins"}.get(mode)
            if name:
                counts[name] += 1
        counts["set_piece_steps"] += mode != 0
        self.mode = mode
        if 9 <= action <= 12:
            counts["kick_keys"] += 1
            self.pending.append(step)
        kicked = team == -1 and speed > KICKED and speed < 6.0
        if kicked and self.flight is None and self.owner and self.owner[0] == 0:
            self.flight = self.launch(before, way, step)
            played = [at for at in self.pending if step - at <= 5]
            self.pending = [] if played else self.pending
        late = [at for at in self.pending if step - at > 5]
        counts["unplayed"] += len(late)
        self.pending = [at for at in self.pending if step - at <= 5]
        if self.flight and speed < 6.0:
            self.flight["speed"] = max(self.flight["speed"], speed * 10.0)
        if team >= 0 or mode:
            self.land(team, player, mode)
            if team >= 0:
                if self.owner and self.owner[0] == 0 and team == 1 and self.flight is None:
                    counts["lost"] += 1
                self.owner = (team, player)
            self.flight = None

    def launch(self, at: np.ndarray, way: np.ndarray, step: int) -> dict:
        """A kick of ours: a shot if it goes towards the goal's surroundings and is near enough."""
        shot = False
        if way[0] > 0.3 and at[0] > 15.0:
            y = at[1] + way[1] * (54.4 - at[0]) / way[0]
            shot = abs(y) < 10.0 and abs(at[0]) > 15.0
        kick = {"from": self.owner[1], "shot": shot, "speed": 0.0, "step": step}
        self.counts["shots" if shot else "passes"] += 1
        return kick

    def land(self, team: int, player: int, mode: int) -> None:
        """The end of a kick."""
        if not self.flight:
            return
        if self.flight["shot"]:
            self.speeds.append(self.flight["speed"])
            self.counts["wide"] += mode == 2
        elif team == 0 and player != self.flight["from"]:
            self.counts["completed"] += 1


def play(create, name: str, episodes: int, limit: int) -> dict:
    """Plays episodes of an agent, `EPISODES_EACH` per environment; returns the totals."""
    totals: dict[str, float] = {}
    speeds: list[float] = []
    goals = []
    env = None
    for episode in range(episodes):
        if episode % EPISODES_EACH == 0:
            if env is not None:
                env.close()
            env = create()
        raw = env.reset()[0]
        player, tally, before, done, step = Player(AGENTS[name]), Tally(), None, False, 0
        while not done and step < limit:
            scene = scene_of_raw(raw, before, step)
            before = scene.ball
            action = player.act(scene)
            observation, _, done, _ = env.step(action)
            raw = observation[0]
            tally.see(raw, before, action, step)
            step += 1
        tally.counts["goals"], tally.counts["conceded"] = (int(n) for n in raw["score"])
        goals.append([tally.counts["goals"], tally.counts["conceded"]])
        for key, value in tally.counts.items():
            totals[key] = totals.get(key, 0) + value
        speeds += tally.speeds
    if env is not None:
        env.close()
    row = {key: value / episodes for key, value in totals.items()}
    row["shot_speed"] = float(np.median(speeds)) if speeds else 0.0
    row["episodes"] = episodes
    row["scores"] = goals
    return row


def main() -> None:
    """Plays every agent and writes a file of rows."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("game")
    parser.add_argument("out")
    parser.add_argument("--scenario", default="11_vs_11_stochastic")
    parser.add_argument("--episodes", type=int, default=4)
    parser.add_argument("--limit", type=int, default=3001)
    parser.add_argument("--agents", default=",".join(AGENTS))
    options = parser.parse_args()
    football = importlib.import_module(options.game + ".env")
    rows = {}
    for name in options.agents.split(","):
        began = time.time()
        create = partial(
            football.create_environment,
            env_name=options.scenario,
            representation="raw",
            rewards="scoring",
        )
        rows[name] = play(create, name, options.episodes, options.limit)
        row = rows[name]
        print(
            f"{name:13} {row['goals']:5.2f}:{row['conceded']:5.2f}  shots {row['shots']:5.1f} wide {row['wide']:4.1f} "
            f"passes {row['passes']:5.1f}/{row['completed']:5.1f} owned {row['owned']:6.0f} box {row['box']:5.0f} "
            f"lost {row['lost']:4.0f} speed {row['shot_speed']:4.1f} {time.time() - began:5.0f} s",
            flush=True,
        )
        with Path(options.out).open("w") as file:
            json.dump(
                {"game": options.game, "scenario": options.scenario, "rows": rows}, file, indent=1
            )


if __name__ == "__main__":
    main()
