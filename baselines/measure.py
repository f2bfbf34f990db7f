"""What is measured of a run: time, scores with their intervals, and curves."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

EVALUATION_SEED = 1_000_000
"""The seed of the first episode of an evaluation; the others have the following ones."""


class Clock:
    """Seconds of the CPU by what they were spent on, and seconds on the wall."""

    def __init__(self, spent: dict[str, float] | None = None) -> None:
        self.spent: dict[str, float] = defaultdict(float, spent or {})

    @contextmanager
    def on(self, what: str) -> Iterator[None]:
        """Counts what happens inside."""
        cpu, wall = time.process_time(), time.perf_counter()
        yield
        self.spent[what] += time.process_time() - cpu
        self.spent["wall"] += time.perf_counter() - wall

    @property
    def cpu(self) -> float:
        """All seconds of the CPU."""
        return sum(seconds for what, seconds in self.spent.items() if what != "wall")


def estimate(scores: np.ndarray) -> dict[str, float]:
    """Returns the mean of scores with its 95 % interval.

    Of goals that are all 0 or 1 it is Wilson's, otherwise that of the normal distribution.
    """
    mean, n, z = float(scores.mean()), len(scores), 1.959964
    if set(np.unique(scores)) <= {0, 1}:
        half = z * (mean * (1 - mean) / n + z * z / (4 * n * n)) ** 0.5
        low, high = ((mean + z * z / (2 * n) + by) / (1 + z * z / n) for by in (-half, half))
    else:
        half = z * float(scores.std()) / n**0.5
        low, high = mean - half, mean + half
    return {"mean": mean, "low": round(min(low, mean), 4), "high": round(max(high, mean), 4)}


def tensorboard(out: Path | None) -> Any:
    """Returns a writer of TensorBoard's log, or None without a folder or without TensorBoard."""
    if out is None:
        return None
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        return None
    return SummaryWriter(out)
