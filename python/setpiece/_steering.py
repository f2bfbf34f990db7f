"""Continuous actions written down in a replay, as the numbers that `step` takes."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._native import KINDS
from setpiece._vocabulary import Action

STRETCHES = 65536
"""How many lengths are tried to find one that is cut down to the way that was run."""

Floats = NDArray[np.float32]


def numbers_of(action: Action, steer: Sequence[float]) -> Floats:
    """Returns x, y, kind and power, float32 `(4,)`, that the engine reads as this key and this way and power.

    Raises `ValueError` where no four numbers are read so.
    """
    x, y, power = steer
    # The middle of the part of -1..1 that means this key.
    kind = (2 * KINDS.index(action.name.lower()) + 1) / len(KINDS) - 1
    return np.array([*_uncut(np.array([x, y], np.float32)), kind, power], np.float32)


def _uncut(way: Floats) -> Floats:
    """Returns a way that the engine cuts down to this one, to the bit.

    Mostly it is the same. But the engine cuts what is longer than 1, and rounding may leave that a hair longer, so that
    it would be cut again: then a longer one of the same direction is looked for that comes to it at once.
    """
    if (_cut(way[None]) == way).all():
        return way
    tried = np.linspace(1, 1 / np.abs(way).max(), STRETCHES, dtype=np.float32)[:, None] * way
    for steps in sorted(product((0, 1, -1), repeat=2), key=np.count_nonzero):
        # The neighbours among the floats too.
        beside = np.clip(np.nextafter(tried, tried + np.array(steps, np.float32)), -1, 1)
        found: NDArray[Any] = np.flatnonzero((_cut(beside) == way).all(axis=1))
        if found.size:
            uncut: Floats = beside[found[0]]
            return uncut
    raise ValueError(f"no way is cut down to {way}")


def _cut(ways: Floats) -> Floats:
    """The engine's own arithmetic: ways longer than 1 are made as long as that."""
    squares = ways[:, 0] * ways[:, 0] + ways[:, 1] * ways[:, 1]
    lengths = np.where(squares > 1, np.sqrt(squares), np.float32(1))
    return np.divide(ways, lengths[:, None], dtype=np.float32)
