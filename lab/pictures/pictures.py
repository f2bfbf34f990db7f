"""Draws the pictures of docs/examples.md: `cargo xtask pictures`.

Bots play episodes of the files in examples/. The same engine gives the same pictures.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import setpiece
from numpy.typing import NDArray

from drawing import CYAN, GOLD, RED, USUAL_M, WHITE, Panel, save, sheet

ROOT = Path(__file__).resolve().parents[2]
METRES = np.array([54.4, 83.6])
"""What a normalised x and y of 1 are."""
SMALL = (317, 207)
"""A panel of four, pixels."""
UPRIGHT = (210, 246)
LARGE = (511, 553)
EPISODES = 1_000
"""How many are searched for a moment."""
LEAST = 0.015
"""Payments that get a ring."""
COLUMNS = {1: 1, 3: 3}
"""How many panels stand side by side, if not two."""


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

    @property
    def places(self) -> list[NDArray[Any]]:
        """The place of every agent's player, metres."""
        places = []
        for name, raw in zip(self.env.agents, self.env.look("raw"), strict=True):
            turn = -1 if name.startswith("right_") else 1
            places.append(turn * np.array(raw["left_team"][raw["active"]]) * METRES)
        return places

    def team(self, side: str) -> NDArray[Any]:
        """The places of a team's players, metres."""
        return np.array(self.raw[f"{side}_team"]) * METRES

    @property
    def me(self) -> NDArray[Any]:
        """The place of the first agent's player."""
        place: NDArray[Any] = self.team("left")[self.raw["active"]]
        return place

    def pays(self, term: str) -> bool:
        """Whether a term of the reward has paid an agent in the last step."""
        return bool(np.max(self.info["reward_terms"].get(term, 0)) > 0)

    def step(self) -> None:
        """Plays a step."""
        self.seen, paid, terminated, truncated, self.info = self.env.step(self.actions)
        self.paid = np.atleast_1d(paid)
        self.over = terminated or truncated
        self.path.append(self.ball)

    def play_to(self, step: int) -> None:
        """Plays until this many steps are over."""
        while len(self.path) <= step and not self.over:
            self.step()

    def panel(
        self,
        middle: Any,
        width_m: float,
        size: tuple[int, int] = SMALL,
        pitch_m: tuple[float, float] = USUAL_M,
    ) -> Panel:
        """The match as it is now."""
        panel = Panel(middle, width_m, size)
        panel.show(self.env, pitch_m)
        return panel


class Stretch:
    """A part of an episode, and the ball's way in it."""

    def __init__(self, match: Match) -> None:
        self.match = match
        self.begun = len(match.path) - 1
        self.path: list[Any] = []

    def play(self, until: Callable[[], bool], middle: Any, width_m: float) -> Panel:
        """Plays until something holds or the episode ends; draws the step before.

        After a goal or a stop of play everybody has been placed for the restart.
        """
        panel = self.match.panel(middle, width_m)
        while not self.match.over:
            self.match.step()
            if until() or self.match.over:
                break
            panel = self.match.panel(middle, width_m)
        self.path = self.match.path[self.begun : -1]
        return panel


def heat(panel: Panel, shares: NDArray[Any]) -> None:
    """Draws a table over the pitch: nothing at 0, gold in the middle, red for the greatest."""
    rows, columns = shares.shape
    column = np.floor((panel.x / 110 + 0.5) * columns).astype(int)
    row = np.floor((panel.y / 72 + 0.5) * rows).astype(int)
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    cell = shares[row.clip(0, rows - 1), column.clip(0, columns - 1)]
    share = np.sqrt(cell / shares.max()) * inside
    panel.wash(GOLD, 0.75 * np.minimum(2 * share, 1))
    panel.wash(RED, 0.85 * np.maximum(2 * share - 1, 0))


def rondo() -> list[Panel]:
    """An episode with its square, and the ball's way so far."""
    match, panels = Match("rondo", 26), []
    for step in (0, 8, 15, 22):
        match.play_to(step)
        panel = match.panel((0, 0), 33)
        panel.line([(-8, -8), (8, -8), (8, 8), (-8, 8), (-8, -8)], 1.5, WHITE, 0.8)
        panel.line(match.path, 2, GOLD)
        panels.append(panel)
    return panels


def shoot_out() -> list[Panel]:
    """Four kicks in turn, each with the ball's way."""
    match, panels = Match("shoot_out", 1), []
    for _ in range(4):
        kick, spot = Stretch(match), np.sign(match.ball) * (44, 0)
        panel = kick.play(lambda spot=spot: bool(match.ball @ spot < 0), spot, 30)
        panel.line(kick.path, 2, GOLD)
        panels.append(panel)
    return panels


def expected_threat() -> list[Panel]:
    """The table."""
    panel = Match("expected_threat", 0).panel((22.5, 0), 73, LARGE)
    table = np.loadtxt(ROOT / "examples/expected_threat.csv", delimiter=",")
    heat(panel, table)
    return [panel]


def pitch_control() -> list[Panel]:
    """The points of the half that the attackers reach first, in three moments."""
    match, panels = Match("pitch_control", 0), []
    for step in (0, 20, 40):
        match.play_to(step)
        panel = match.panel((27.5, 0), 66, UPRIGHT)
        ways = []
        for side in ("left", "right"):
            velocity = np.array(match.raw[f"{side}_team_direction"]) * METRES * 10
            place = match.team(side) + 0.7 * velocity
            away = np.hypot(panel.x[..., None] - place[:, 0], panel.y[..., None] - place[:, 1])
            ways.append(away.min(-1))
        half = (panel.x > 0) & (panel.x < 55) & (abs(panel.y) < 36)
        panel.wash(GOLD, 0.45 * (half & (ways[0] < ways[1])))
        panels.append(panel)
    return panels


def drawn_formations() -> list[Panel]:
    """The starts of four episodes."""
    return [Match("drawn_formations", episode).panel((0, 0), 119) for episode in (1, 6, 12, 17)]


def substitution() -> list[Panel]:
    """Four moments of a match, with a ring around the striker: red while they are tired."""
    match, panels = Match("substitution", 0), []
    striker = int(np.flatnonzero(match.raw["left_team_roles"] == CENTRE_FORWARD)[0])
    while not match.over and len(panels) < 4:
        tired = match.raw["left_team_tired_factor"][striker] > 0.1
        if len(panels) == 1 and tired:
            match.step()
            continue
        panel = match.panel((0, 0), 119)
        panel.ring(match.team("left")[striker], 9, RED if tired else GOLD)
        panels.append(panel)
        match.play_to(len(match.path) + 30)
    return panels


def drawn_opponents() -> list[Panel]:
    """The starts of four episodes."""
    size = (SMALL[0], 300)
    return [Match("drawn_opponents", episode).panel((30, 0), 76, size) for episode in range(4)]


def randomised_world() -> list[Panel]:
    """Shots on four days: the ball's way, and the wind as an arrow, one metre for each m/s."""
    panels = []
    for episode in episodes_with("randomised_world", ["scoring/goal"], 4):
        match = Match("randomised_world", episode, observation="vector")
        wind, shot = match.seen[6:8] * 10, Stretch(match)
        panel = shot.play(lambda: False, (40, 0), 40)
        panel.line(shot.path, 2, GOLD)
        panel.arrow((27, -8), wind, CYAN)
        panels.append(panel)
    return panels


def small_sided() -> list[Panel]:
    """The starts of four episodes, at one scale."""
    panels = []
    for episode in range(4):
        match = Match("small_sided", episode, observation="vector")
        # The agents see the way to a corner.
        length, width = 2 * np.abs(match.places[0] + match.seen[0][8:10])
        panels.append(match.panel((0, 0), 68, pitch_m=(length, width)))
    return panels


def noisy_eyes() -> list[Panel]:
    """What the agent sees: the cone, the last looks at the ball, and the marker's place."""
    match, panels = Match("noisy_eyes", 5, observation="vector"), []
    looks, mine = [], [match.me]
    for step in range(1, 49):
        match.step()
        mine.append(match.me)
        looks.append(match.me + match.seen[9:11])
        if step % 12:
            continue
        panel = match.panel(np.add(match.me, (4, 0)), 30)
        heading = match.seen[2] * np.pi
        turn = np.arctan2(panel.y - match.me[1], panel.x - match.me[0]) - heading
        panel.wash(WHITE, 0.16 * (np.cos(turn) > np.cos(np.radians(75))))
        for look in looks[-12:]:
            panel.dot(look, 2, GOLD)
        if match.seen[13] > 0:
            panel.ring(mine[-3] + match.seen[11:13], 9, RED)
        panels.append(panel)
    return panels


def effort() -> list[Panel]:
    """Four dribbles: red where sprinting costs, with a dot for each change of the action."""
    panels = []
    for episode in range(4):
        match = Match("effort", episode)
        ways: list[tuple[Any, Any, dict[str, float]]] = []
        dribble, before = Stretch(match), match.me

        def note(match: Match = match, ways: list[Any] = ways) -> bool:
            ways.append((match.me, match.info["reward_terms"]))
            return False

        panel = dribble.play(note, (34, 0), 48)
        for after, terms in ways[:-1]:
            panel.line([before, after], 3, RED if terms["saved_effort/sprint"] < 0 else WHITE)
            if terms["saved_effort/switch"] < 0:
                panel.dot(before, 2.5, GOLD)
            before = after
        panels.append(panel)
    return panels


def own_part() -> list[Panel]:
    """The first moments in which four terms pay: gold rings get something, red rings lose it."""
    panels = []
    for term in ("attack/received", "defence/won", "defence/cleared", "attack/scorer"):
        episode, step = first_pay("own_part", term)
        match = Match("own_part", episode)
        match.play_to(step - 1)
        panel, places = match.panel((30, 0), 60), match.places
        match.step()
        for place, paid in zip(places, match.paid, strict=True):
            if abs(paid) > LEAST:
                panel.ring(place, 13, GOLD if paid > 0 else RED)
        panels.append(panel)
    return panels


def first_pay(name: str, term: str) -> tuple[int, int]:
    """The first episode in which a term pays, and the step."""
    for episode in range(EPISODES):
        match = Match(name, episode)
        while not match.over:
            match.step()
            if match.pays(term):
                return episode, len(match.path) - 1
    raise LookupError(f"`{term}` of {name} pays nothing in {EPISODES} episodes")


def episodes_with(name: str, terms: Sequence[str], count: int) -> list[int]:
    """The first episodes in which these terms pay, one after the other."""
    found = []
    for episode in range(EPISODES):
        match, left = Match(name, episode), [*terms]
        while left and not match.over:
            match.step()
            if match.pays(left[0]):
                left.pop(0)
        if not left:
            found.append(episode)
        if len(found) == count:
            return found
    raise LookupError(f"{', '.join(terms)} of {name} pay too seldom in {EPISODES} episodes")


def phases() -> list[Panel]:
    """The start and the end of each phase, with the ball's way in that phase."""
    phases = ["attack/won", "attack/advanced", "scoring/goal"]
    match = Match("phases", episodes_with("phases", phases, 1)[0])
    panels = [match.panel((10, 0), 100)]
    for term, colour in (("attack/won", WHITE), ("attack/advanced", GOLD), ("", RED)):
        phase = Stretch(match)
        panel = phase.play(lambda term=term: match.pays(term), (10, 0), 100)
        panel.line(phase.path, 2, colour)
        panels.append(panel)
    return panels


CENTRE_FORWARD = 9
"""The number of the role in `raw`."""

PICTURES: dict[str, Callable[[], list[Panel]]] = {
    "rondo": rondo,
    "shoot_out": shoot_out,
    "expected_threat": expected_threat,
    "pitch_control": pitch_control,
    "drawn_formations": drawn_formations,
    "drawn_opponents": drawn_opponents,
    "randomised_world": randomised_world,
    "small_sided": small_sided,
    "noisy_eyes": noisy_eyes,
    "substitution": substitution,
    "effort": effort,
    "own_part": own_part,
    "phases": phases,
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
        save(args.out / f"{name}.png", sheet(panels, COLUMNS.get(len(panels), 2)))


if __name__ == "__main__":
    main()
