"""Reads places from the super mini map: the same numbers for the maps of both games.

A map is `(72, 96, 4)` uint8 with the planes own team, opponents, ball, controlled player; a stack
of maps has the newest one last on its last axis. A marked pixel is a place, known to a cell of 1.13
m by 1.03 m.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

WIDTH, HEIGHT, PLANES = 96, 72, 4
"""Columns, rows and planes of a map."""
EDGES_M = np.array([54.4, 83.6 / 2.25], np.float32)
"""Distance of the map's edges from the centre spot along x and y, metres."""
STACK = 4
"""Maps that the features show: the newest and the three before it."""
JUMP_CELLS = 4.0
"""No player runs this far in a step, cells: play was restarted or the player has left the pitch."""
BALL, ME = 0, 1


def metres(cells: np.ndarray) -> np.ndarray:
    """Converts cells to the places of their centres.

    `cells` is `(…, 2)`, column and row; the result is float32 `(…, 2)`, x and y in metres from the
    centre spot.
    """
    size = np.array([WIDTH, HEIGHT], np.float32)
    return ((np.asarray(cells, np.float32) + 0.5) / size * 2.0 - 1.0) * EDGES_M


def marks(maps: np.ndarray) -> list[np.ndarray]:
    """Finds the marked cells of every plane.

    `maps` is uint8 `(envs, 72, 96, 4 k)`. For each of the four planes the result is float32 `(envs,
    most, 2)`: column and row of every mark, in reading order, and infinity behind the last one of
    an environment.
    """
    envs = len(maps)
    newest = np.ascontiguousarray(maps[..., -PLANES:])
    size = HEIGHT * WIDTH * PLANES
    # Nearly all bytes are 0, so eight at a time are skipped.
    words = newest.reshape(-1).view(np.uint64)
    marked = np.flatnonzero(words != 0)
    word, byte = np.nonzero(words[marked].view(np.uint8).reshape(-1, 8))
    at = marked[word] * 8 + byte
    env, inside = at // size, at % size
    pixel, plane = inside // PLANES, inside % PLANES
    cells = np.stack([pixel % WIDTH, pixel // WIDTH], -1).astype(np.float32)
    found = []
    for one in range(PLANES):
        rows = np.flatnonzero(plane == one)
        counts = np.bincount(env[rows], minlength=envs)
        padded = np.full((envs, max(1, int(counts.max(initial=0))), 2), np.inf, np.float32)
        nth = np.arange(len(rows)) - np.repeat(counts.cumsum() - counts, counts)
        padded[env[rows], nth] = cells[rows]
        found.append(padded)
    return found


def assign(before: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Finds each player among the marked cells: the nearest pairs first.

    `before` is `(envs, players, 2)`, where they were; `cells` `(envs, most, 2)`. Returns where they
    are and whether they are there, `(envs, players)` bool. Players without a cell of their own
    share the nearest one; if that is too far away, they are missing and keep their place.
    """
    with np.errstate(invalid="ignore"):
        away = np.square(before[:, :, None] - cells[:, None]).sum(-1)
    nearest = away.argmin(2)
    ordered = np.sort(nearest, 1)
    envs, players, most = away.shape
    rows, columns = np.arange(envs)[:, None], np.arange(players)[None]
    alone = np.ones((envs, players), bool)
    # Where two players have the same nearest cell, pairs are taken one after another.
    contested = np.flatnonzero((ordered[:, 1:] == ordered[:, :-1]).any(1))
    if len(contested):
        left, every = away[contested], np.arange(len(contested))
        found = np.zeros((len(contested), players), bool)
        for _ in range(min(players, most)):
            player, cell = np.divmod(left.reshape(len(contested), -1).argmin(1), most)
            free = np.isfinite(left[every, player, cell])
            one, player, cell = every[free], player[free], cell[free]
            nearest[contested[one], player], found[one, player] = cell, True
            left[one, player] = np.inf
            left[one, :, cell] = np.inf
        alone[contested] = found
    moved = away[rows, columns, nearest]
    there = np.isfinite(moved) & (alone | (moved <= JUMP_CELLS**2))
    return np.where(there[..., None], cells[rows, nearest], before), there


@dataclass
class Roster:
    """The players, by their places at the start: float32 `(players, 2)`, column and row."""

    own: np.ndarray
    opponents: np.ndarray

    @property
    def players(self) -> int:
        """Number of players of both teams."""
        return len(self.own) + len(self.opponents)

    @property
    def features(self) -> int:
        """Length of the features."""
        return 2 * (2 + self.players) * STACK + 2 + self.players

    @classmethod
    def of(cls, opening: np.ndarray) -> Roster:
        """Reads the players of the first maps of an episode, `(maps, 72, 96, 4 k)`.

        Players who start in the same cell are one mark on the first map; the map with the most
        marks tells how many they are.
        """
        teams = []
        for team in marks(opening)[:2]:
            counts = np.isfinite(team[:, :, 0]).sum(1)
            start, most = team[0, : counts[0]], team[counts.argmax(), : counts.max()]
            teams.append(
                start if counts[0] == counts.max() else assign(most[None], start[None])[0][0]
            )
        return cls(*teams)


class Tracker:
    """Follows the players of `envs` games from map to map.

    A player keeps one slot throughout an episode: slots are assigned by their start places. So the
    features have the same order in both games.
    """

    def __init__(self, roster: Roster, envs: int) -> None:
        self.roster = roster
        self.starts = [np.repeat(team[None], envs, 0) for team in (roster.own, roster.opponents)]
        self.cells = [start.copy() for start in self.starts]
        # Newest first; ball, controlled player, own team, opponents.
        self.places = np.zeros((STACK, envs, 2 + roster.players, 2), np.float32)

    def see(self, maps: np.ndarray, first: np.ndarray) -> np.ndarray:
        """Returns the features of the next maps, float32 `(envs, roster.features)`.

        `maps` is uint8 `(envs, 72, 96, 4 k)`; `first` is `(envs,)` bool: an episode starts with
        this map. Features: x and y, metres, of the ball, the controlled player, own team,
        opponents; the way from the controlled player to the ball; a flag for each player who is
        there; then how far each of the first ones has come since 1, 2 and 3 maps ago.
        """
        *teams, balls, mine = marks(maps)
        there = []
        for side, cells in enumerate(teams):
            start = self.starts[side]
            before = np.where(first[:, None, None], start, self.cells[side])
            now, seen = assign(before, cells)
            jumped = ~first & (np.abs(now - before).mean((1, 2)) > JUMP_CELLS)
            if jumped.any():
                now[jumped], seen[jumped] = assign(start[jumped], cells[jumped])
            self.cells[side] = now
            there.append(seen)
        self.places[1:] = self.places[:-1].copy()
        newest = self.places[0]
        for slot, cells in ((BALL, balls), (ME, mine)):
            seen = np.isfinite(cells[:, 0, 0])
            newest[seen, slot] = metres(cells[seen, 0])
        newest[:, 2:] = metres(np.concatenate(self.cells, 1))
        if first.any():
            self._start(np.flatnonzero(first))
        ways = newest[None] - self.places[1:]
        envs = len(maps)
        parts = [
            newest.reshape(envs, -1),
            newest[:, BALL] - newest[:, ME],
            np.concatenate(there, 1).astype(np.float32),
            ways.transpose(1, 0, 2, 3).reshape(envs, -1),
        ]
        return np.concatenate(parts, 1)

    def _start(self, first: np.ndarray) -> None:
        """Fills the stack of episodes that start with their first map.

        On that map the real game marks its keeper as the controlled player and from the next one on
        the player at the ball: both games' first maps are read as if the player nearest to the ball
        was marked.
        """
        newest = self.places[0]
        own = newest[first, 2 : 2 + len(self.roster.own)]
        nearest = np.square(own - newest[first, None, BALL]).sum(-1).argmin(1)
        newest[first, ME] = own[np.arange(len(first)), nearest]
        self.places[1:, first] = newest[first]
