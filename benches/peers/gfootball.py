"""How fast Setpiece is beside EnvPool's build of Google Research Football, in one run: writes a page of figures.

`pip install envpool` and this project's wheel into one environment, then
`python benches/peers/gfootball.py -o docs/performance.md`.

Each plays the same scenario by the same rule on one thread: actions at random, bots for everyone else, resets
included, the super mini map (72 x 96 x 4 bytes, the only observation that EnvPool's build has) after every step. What
is counted is steps per second of CPU time. They take turns, each in a process of its own, so that whatever else the
machine does falls on all alike; the median of the rounds is told, and the ratio is the median of the rounds' ratios.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

SCENARIOS = ("11_vs_11_stochastic", "academy_3_vs_1_with_keeper", "academy_empty_goal_close")
ENVPOOL, NATIVE, NATIVE_FLOATS, VECTOR = "EnvPool's GRF", "setpiece", "setpiece, floats", "setpiece.make_vec"
PLAYERS = (ENVPOOL, NATIVE, NATIVE_FLOATS, VECTOR)


def per_cpu_second(step: Callable[[], object], steps: int, seconds: float) -> float:
    """Calls `step`, which plays so many steps, for a while; returns steps per second of the process's CPU time."""
    for _ in range(3):
        step()
    played, cpu, end = 0, time.process_time(), time.monotonic() + seconds
    while time.monotonic() < end:
        step()
        played += steps
    return played / (time.process_time() - cpu)


def envpool_steps(scenario: str, seconds: float) -> float:
    """Steps per CPU-second of EnvPool's build of GRF."""
    import envpool
    import numpy as np

    n = 4
    envs = envpool.make(f"gfootball/{scenario}-v1", env_type="gymnasium", num_envs=n, num_threads=1, seed=1)
    envs.reset()
    random = np.random.default_rng(0)
    return per_cpu_second(lambda: envs.step(random.integers(0, 19, n).astype(np.int32)), n, seconds)


def vector_steps(scenario: str, seconds: float) -> float:
    """Steps per CPU-second of `setpiece.make_vec`, 64 environments, arrays that are written in place."""
    import numpy as np
    import setpiece

    n = 64
    envs = setpiece.make_vec(scenario, n, threads=1, observation="smm", copy=False, seed=1)
    envs.reset()
    random = np.random.default_rng(0)
    return per_cpu_second(lambda: envs.step(random.integers(0, 19, n)), n, seconds)


def native_steps(scenario: str, seconds: float, observation: str) -> float:
    """Steps per CPU-second of `setpiece bench`."""
    command = [sys.executable, "-m", "setpiece", "bench", scenario, "--threads", "1", "--seconds", str(seconds)]
    told = subprocess.run(
        [*command, "--observation", observation, "--format", "jsonl"], check=True, capture_output=True
    )
    return float(json.loads(told.stdout)["steps_per_cpu_second"])


def measured(player: str, scenario: str, seconds: float) -> float:
    """Steps per CPU-second of one of them, in a process of its own."""
    if player in (NATIVE, NATIVE_FLOATS):
        return native_steps(scenario, seconds, "smm" if player == NATIVE else "simple115v2")
    command = [sys.executable, __file__, "--one", player, "--scenario", scenario, "--seconds", str(seconds)]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def processor() -> str:
    """What the processor calls itself."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    return next(
        (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.processor()
    )


def page(figures: dict[str, dict[str, list[float]]], seconds: float) -> str:
    """The page."""
    rounds = len(next(iter(figures.values()))[ENVPOOL])
    lines = [
        "# Performance",
        "",
        "Written by `benches/peers/gfootball.py`, which says how it measures: one thread, agents at random, bots for",
        "everyone else, resets included, the super mini map after every step but where it says floats.",
        "",
        f"{processor()}, {os.cpu_count()} cores; {platform.system()}, Python {platform.python_version()};",
        f"setpiece {version('setpiece')}, envpool {version('envpool')}; {rounds} rounds of {seconds:g} s each.",
        "",
        "| scenario | player | steps per CPU-second | against EnvPool's GRF |",
        "| --- | --- | --- | --- |",
    ]
    for scenario, by_player in figures.items():
        for player in PLAYERS:
            ratios = [mine / theirs for mine, theirs in zip(by_player[player], by_player[ENVPOOL], strict=True)]
            median = statistics.median(by_player[player])
            lines.append(f"| `{scenario}` | {player} | {median:,.0f} | {statistics.median(ratios):,.0f} |")
    return "\n".join([*lines, ""])


def main() -> None:
    """Measures in turn and writes the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, help="where the page goes; standard output without it")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=8.0, help="how long each is measured in a round")
    parser.add_argument("--one", choices=(ENVPOOL, VECTOR), help=argparse.SUPPRESS)
    parser.add_argument("--scenario", help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.one:
        print((envpool_steps if args.one == ENVPOOL else vector_steps)(args.scenario, args.seconds))
        return
    figures: dict[str, dict[str, list[float]]] = {
        scenario: {player: [] for player in PLAYERS} for scenario in SCENARIOS
    }
    for _ in range(args.rounds):
        for scenario, by_player in figures.items():
            for player in PLAYERS:
                by_player[player].append(measured(player, scenario, args.seconds))
                print(f"{scenario}, {player}: {by_player[player][-1]:,.0f}", file=sys.stderr)
    text = page(figures, args.seconds)
    if args.output:
        args.output.write_text(text, encoding="utf-8")
    else:
        print(text)


if __name__ == "__main__":
    main()
