"""Draws the pictures of docs/examples.md: `cargo xtask pictures`.

Bots play episodes of the files in examples/. The same engine gives the same pictures.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from drawing import CYAN, GOLD, RED, WHITE, Panel, save, sheet
from numpy.typing import NDArray

import setpiece

ROOT = Path(__file__).resolve().parents[2]
METRES = np.array([54.4, 83.6])
"""What a normalised x and y of 1 are."""
SMALL = (317, 207)
"""A panel of four, pixels."""
LARGE = (640, 420)
PENALTY = 6


class Match:
    """An episode of an example in which bots play for all agents."""

    def __init__(self, name: str, episode: int, **arguments: Any) -> None:
        self.env = setpiece.make(
            ROOT / "examples" / f"{name}.pitch", action_set="v2", seed=0, **arguments
        )
        bot, count = int(setpiece.Action.BUILTIN_AI), len(self.env.agents)
        self.actions = bot if count == 1 else [bot] * count
        self.seen, self.info = self.env.reset(options={"episode": episode})
        self.paid: NDArray[Any] = np.zeros(count)
        self.over = False
        self.path = [self.ball]
        """Where the ball has been."""

    @property
    def raw(self) -> dict[str, Any]:
        """The match as the first agent sees it, who plays for the left team."""
        looked = self.env.look("raw")
        first: dict[str, Any] = looked[0] if isinstance(looked, tuple) else looked
        return first

    @property
    def ball(self) -> NDArray[Any]:
        """The place of the ball, metres."""
        return np.array(self.raw["ball"][:2]) * METRES

    def team(self, side: str) -> NDArray[Any]:
        """The places of a team's players, metres."""
        return np.array(self.raw[f"{side}_team"]) * METRES

    @property
    def me(self) -> NDArray[Any]:
        """The place of the first agent's player."""
        place: NDArray[Any] = self.team("left")[self.raw["active"]]
        return place

    def step(self) -> None:
        """Plays a step."""
        self.seen, paid, terminated, truncated, self.info = self.env.step(self.actions)
        self.paid = np.atleast_1d(paid)
        self.over = terminated or truncated
        self.path.append(self.ball)

    def play(self, until: Callable[[], bool]) -> bool:
        """Plays until something holds; returns False at the episode's end."""
        while not self.over:
            self.step()
            if until():
                return True
        return False

    def play_to(self, step: int) -> None:
        """Plays until this many steps are over."""
        self.play(lambda: len(self.path) > step)

    def panel(self, middle: Any, width_m: float, size: tuple[int, int] = SMALL) -> Panel:
        """The match as it is now."""
        panel = Panel(middle, width_m, size)
        panel.show(self.env)
        return panel


def heat(panel: Panel, shares: NDArray[Any], x_m: tuple[float, float], most: float) -> None:
    """Draws a grid over the pitch between two x: nothing at 0, gold in the middle, red at `most`."""
    rows, columns = shares.shape
    column = np.floor((panel.x - x_m[0]) / (x_m[1] - x_m[0]) * columns).astype(int)
    row = np.floor((panel.y + 36) / 72 * rows).astype(int)
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    cell = shares[row.clip(0, rows - 1), column.clip(0, columns - 1)]
    share = np.sqrt(cell / most).clip(0, 1) * inside
    panel.wash(GOLD, 0.75 * np.minimum(2 * share, 1))
    panel.wash(RED, 0.85 * np.maximum(2 * share - 1, 0))


def rondo() -> list[Panel]:
    """An episode with its square: the ball's way between the pictures."""
    match, panels = Match("rondo", 26), []
    for step in (0, 8, 15, 22):
        match.play_to(step)
        panel = match.panel((0, 0), 27)
        panel.line([(-8, -8), (8, -8), (8, 8), (-8, 8), (-8, -8)], 1.5, WHITE, 0.8)
        panel.line(match.path, 2, GOLD)
        panels.append(panel)
    return panels


def shoot_out() -> list[Panel]:
    """Four kicks in turn, each with the ball's way."""
    match, panels = Match("shoot_out", 1), []
    for _ in range(4):
        begun = len(match.path) - 1
        spot = match.ball
        match.play(lambda spot=spot: abs(match.ball[0] - spot[0]) > 8)
        panel = match.panel((np.sign(spot[0]) * 44, 0), 30)
        panel.line(match.path[begun:], 2, GOLD)
        panels.append(panel)
        match.play(lambda: match.raw["game_mode"] == PENALTY)
    return panels


def expected_threat() -> list[Panel]:
    """The table."""
    panel = Match("expected_threat", 0).panel((0, 0), 119, LARGE)
    table = np.loadtxt(ROOT / "examples/expected_threat.csv", delimiter=",")
    heat(panel, table, (-55, 55), float(table.max()))
    return [panel]


def pitch_control() -> list[Panel]:
    """Which points of the half the attackers reach first, in four moments."""
    match, panels = Match("pitch_control", 0), []
    for step in (0, 15, 30, 45):
        match.play_to(step)
        panel = match.panel((27.5, 0), 115)
        panel = match.panel((27.5, 0), 112)
        raw = match.raw
        first = []
        for side in ("left", "right"):
            speed = np.array(raw[f"{side}_team_direction"]) * METRES * 10
            place = match.team(side) + 0.7 * speed
            away = np.hypot(
                panel.x[..., None] - place[:, 0], panel.y[..., None] - place[:, 1]
            )
            first.append(away.min(-1))
        half = (panel.x > 0) & (panel.x < 55) & (abs(panel.y) < 36)
        panel.wash(GOLD, 0.45 * (half & (first[0] < first[1])))
        panels.append(panel)
    return panels


def drawn_opponents() -> list[Panel]:
    """The starts of four episodes."""
    return [Match("drawn_opponents", episode).panel((36, 0), 48) for episode in range(4)]


def randomised_world() -> list[Panel]:
    """Shots on four days: the ball's way, and the wind as an arrow."""
    panels = []
    for episode in (12, 19, 20, 22):
        match = Match("randomised_world", episode, observation="vector")
        wind = match.seen[6:8] * 10
        match.play(lambda match=match: match.info["score"] != [0, 0])
        panel = match.panel((40, 0), 40)
        panel.line(match.path, 2, GOLD)
        panel.arrow((26, -9), wind * 0.8, CYAN)
        panels.append(panel)
    return panels


def noisy_eyes() -> list[Panel]:
    """What the agent sees: the cone, and where it has seen the ball and the marker."""
    match, panels = Match("noisy_eyes", 5, observation="vector"), []
    for step in (5, 25, 45, 65):
        match.play_to(step)
        panel, me = match.panel((40, 0), 40), match.me
        heading = match.seen[2] * np.pi
        turn = np.angle(np.exp(1j * (np.arctan2(panel.y - me[1], panel.x - me[0]) - heading)))
        panel.wash(WHITE, 0.16 * (abs(turn) < np.radians(75)))
        for look in match.seen[3:11].reshape(4, 2) * METRES:
            panel.dot(me + look, 2.5, GOLD)
        if match.seen[13] > 0:
            panel.ring(me + match.seen[11:13] * METRES, 9, RED)
        panels.append(panel)
    return panels


def effort() -> list[Panel]:
    """Four dribbles: red where sprinting costs, with a dot for each change of the action."""
    panels = []
    for episode in (10, 11, 43, 0):
        match = Match("effort", episode)
        ways, changes = [(match.me, match.me, False)], []
        while not match.over:
            before = match.me
            match.step()
            terms = match.info["reward_terms"]
            ways.append((before, match.me, terms["saved_effort/sprint"] < 0))
            if terms["saved_effort/switch"] < 0:
                changes.append(before)
        panel = match.panel((34, 0), 48)
        for start, end, sprints in ways:
            panel.line([start, end], 3, RED if sprints else WHITE)
        for place in changes:
            panel.dot(place, 2.5, GOLD)
        panels.append(panel)
    return panels


PICTURES: dict[str, Callable[[], list[Panel]]] = {
    "rondo": rondo,
    "shoot_out": shoot_out,
    "expected_threat": expected_threat,
    "pitch_control": pitch_control,
    "drawn_opponents": drawn_opponents,
    "randomised_world": randomised_world,
    "noisy_eyes": noisy_eyes,
    "effort": effort,
}
"""The picture of each example."""


def main(argv: list[str] | None = None) -> None:
    """Writes the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "examples")
    parser.add_argument("names", nargs="*", metavar="NAME", help="which of them [default: all]")
    args = parser.parse_args(argv)
    for name in args.names or PICTURES:
        if name not in PICTURES:
            parser.error(f"no picture `{name}`; there are {', '.join(PICTURES)}")
        panels = PICTURES[name]()
        save(args.out / f"{name}.png", sheet(panels, 1 if len(panels) == 1 else 2))


if __name__ == "__main__":
    main()
