import random
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Lock
from typing import Any

import gymnasium
import numpy as np
import pytest

from setpiece import Step

Trajectory = list[tuple[Any, Any, bool, bool, dict[str, Any]]]


@pytest.fixture
def pitch_file(tmp_path: Path) -> Callable[[str], Path]:
    """Writes a text to a `.pitch` file and returns its path."""

    def write(text: str, name: str = "mine.pitch") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def nothing_installed() -> Iterator[None]:
    """Removes what `gfootball.install()` puts into `sys.modules`, before and after."""

    def take_away() -> None:
        for name in [name for name in sys.modules if name.split(".")[0] == "gfootball"]:
            del sys.modules[name]

    take_away()
    yield
    take_away()


def play(
    env: gymnasium.Env[Any, Any],
    seed: int | None,
    action: Callable[[], Any] | None = None,
    steps: int = 10_000,
    options: dict[str, Any] | None = None,
) -> Trajectory:
    """Plays an episode, at random unless actions are given.

    Returns the results of `reset` and of each `step`.
    """
    generator = random.Random(0)
    act = action or (lambda: generator.randrange(19))
    observation, info = env.reset(seed=seed, options=options)
    trajectory: Trajectory = [(observation, 0.0, False, False, info)]
    for _ in range(steps):
        trajectory.append(env.step(act()))
        if trajectory[-1][2] or trajectory[-1][3]:
            break
    return trajectory


def same(a: Any, b: Any) -> bool:
    """Whether two values from an environment are the same, bit for bit."""
    if isinstance(a, dict):
        return (
            isinstance(b, dict) and a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
        )
    if isinstance(a, (list, tuple)):
        return type(a) is type(b) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.dtype == b.dtype and np.array_equal(a, b)
    return type(a) is type(b) and a == b


class Counter:
    """A reward with memory: the number of the step in its episode."""

    def __init__(self) -> None:
        self.steps = 0

    def reset(self) -> None:
        self.steps = 0

    def __call__(self, _step: Step) -> float:
        self.steps += 1
        return float(self.steps)


class Tracker:
    """A reward and an ending with a shared memory: the episode ends after three paid steps."""

    def __init__(self) -> None:
        self.steps = 0

    def paid(self, _step: Step) -> float:
        self.steps += 1
        return 0.0

    def tired(self, _step: Step) -> bool:
        return self.steps == 3


class Locked:
    """A reward that holds something that can't be copied."""

    def __init__(self) -> None:
        self.lock = Lock()

    def __call__(self, _step: Step) -> float:
        return 0.0
