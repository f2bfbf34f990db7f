"""What playing one group of matches while the policy looks at the other gains.

    python benches/groups.py

It measures steps of all matches per second of the clock: a vector that waits for the policy, and
`setpiece.make_groups`. Both have one thread for the matches. The policies are networks on one
thread of the processor, which need a free core, and one that only waits, like a thread whose policy
is on another device. `overlap` is the share of the shorter of both times (of the matches, of the
policy) that the groups hide.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import torch
from torch import nn

import setpiece

SCENARIO = "academy_3_vs_1_with_keeper"


def policy_of(width: int) -> Callable[[Any], Any]:
    """A network with two hidden layers that picks actions."""
    network = nn.Sequential(
        nn.Linear(115, width), nn.Tanh(), nn.Linear(width, width), nn.Tanh(), nn.Linear(width, 19)
    )

    @torch.inference_mode()
    def policy(observations: Any) -> Any:
        return network(torch.as_tensor(observations)).argmax(-1).numpy()

    return policy


def wait_of(ms: float, n: int) -> Callable[[Any], Any]:
    """A policy that waits so long for `n` rows, and in proportion for fewer, as for a device."""

    def policy(observations: Any) -> Any:
        time.sleep(ms / 1000 * len(observations) / n)
        return np.zeros(len(observations), np.int64)

    return policy


def vector_s(scenario: str, n: int, policy: Callable[[Any], Any], steps: int) -> float:
    """Seconds of `steps` steps of a vector, one after the other."""
    envs = setpiece.make_vec(scenario, n, threads=1)
    observations, _ = envs.reset(seed=1)
    began = time.perf_counter()
    for _ in range(steps):
        observations = envs.step(policy(observations))[0]
    took = time.perf_counter() - began
    envs.close()
    return took


def groups_s(scenario: str, n: int, policy: Callable[[Any], Any], steps: int) -> float:
    """Seconds of `steps` steps of two groups that alternate."""
    with setpiece.make_groups(scenario, n, groups=2, threads=1) as envs:
        envs.async_reset(seed=1)
        for _ in range(2):
            envs.send(policy(envs.recv()[0]))
        began = time.perf_counter()
        for _ in range(2 * steps):
            envs.send(policy(envs.recv()[0]))
        return time.perf_counter() - began


def policy_s(n: int, policy: Callable[[Any], Any], steps: int) -> float:
    """Seconds that the policy alone takes for `steps` batches."""
    observations = torch.randn(n, 115)
    began = time.perf_counter()
    for _ in range(steps):
        policy(observations)
    return time.perf_counter() - began


def main() -> None:
    """Reads the command line and prints a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenario", default=SCENARIO)
    parser.add_argument("--num-envs", type=int, default=64)
    parser.add_argument("--steps", type=int, default=150)
    parser.add_argument("--repeats", type=int, default=5)
    given = parser.parse_args()
    torch.set_num_threads(1)
    n, steps = given.num_envs, given.steps
    print("policy         ms  vector steps/s  groups steps/s   gain  overlap")
    policies = [(f"width {width}", policy_of(width)) for width in (64, 512, 1024, 2048)]
    policies += [(f"wait {ms} ms", wait_of(ms, n)) for ms in (2, 6, 20)]
    for name, policy in policies:
        # Alternating, because other load on the machine comes and goes.
        runs = [
            (
                policy_s(n, policy, steps),
                vector_s(given.scenario, n, policy, steps),
                groups_s(given.scenario, n, policy, steps),
            )
            for _ in range(given.repeats)
        ]
        thinks, alone, grouped = (statistics.median(column) for column in zip(*runs, strict=True))
        hidden = (alone - grouped) / max(1e-9, min(thinks, alone - thinks))
        print(
            f"{name:10}  {1000 * thinks / steps:5.2f}  {n * steps / alone:14.0f}  "
            f"{n * steps / grouped:14.0f}  {alone / grouped:5.2f}  {hidden:6.0%}"
        )


if __name__ == "__main__":
    main()
