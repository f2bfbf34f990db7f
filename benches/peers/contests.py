"""The contests with the peers."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Contest:
    """Players that do the same work: the first is the peer that the others are compared with.

    `players` maps a name to its measurement: a function of a case and a number of seconds that
    returns units per second of CPU time.
    """

    title: str
    unit: str
    text: str
    packages: tuple[str, ...]
    cases: tuple[str, ...]
    players: dict[str, Callable[[str, float], float]] = field(default_factory=dict)


def per_cpu_second(act: Callable[[], object], units: int, seconds: float) -> float:
    """Calls `act`, which does `units` of work, for a while; returns units per CPU second."""
    for _ in range(3):
        act()
    done, cpu, end = 0, time.process_time(), time.monotonic() + seconds
    while time.monotonic() < end:
        act()
        done += units
    return done / (time.process_time() - cpu)


def native_steps(scenario: str, seconds: float, observation: str) -> float:
    """Steps per CPU-second of `setpiece bench`."""
    (line,) = bench(scenario, seconds, "--threads", "1", "--observation", observation)
    return float(line["steps_per_cpu_second"])


def bench(scenario: str, seconds: float, *options: str) -> list[dict[str, Any]]:
    """The lines of `setpiece bench SCENARIO` with some options."""
    command = [
        sys.executable,
        "-m",
        "setpiece",
        "bench",
        scenario,
        "--seconds",
        str(seconds),
        *options,
    ]
    output = subprocess.run(
        [*command, "--format", "jsonl"], check=True, capture_output=True, text=True
    )
    return [json.loads(line) for line in output.stdout.splitlines()]
