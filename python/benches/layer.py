"""What the Python layer costs a step, beside the engine: `python python/benches/layer.py`.

The baseline is one thread of a native batch of as many matches, which plays, observes and judges, but makes no Python
objects; what `make` and `make_vec` take beyond it is the layer's. The match is one man against nobody.
"""

import time
from collections.abc import Callable

import numpy as np

import setpiece
from setpiece._native import Batch, compile

EMPTY = """
scenario empty {
    ball at (0.5, 0.3)
    team left { GK at (-1, 0)  CM at (-0.5, 0) }
    team right { GK at own (-1, 0) { ai: lazy } }
    reward scoring
    end limit 1000000 steps
}
"""


def microseconds(call: Callable[[], object], calls: int) -> float:
    """The time of a call."""
    begun = time.perf_counter()
    for _ in range(calls):
        call()
    return (time.perf_counter() - begun) / calls * 1e6


def main() -> None:
    """Measures and prints."""
    scenario = compile(EMPTY)
    n = 256
    common = {"observation": "simple115v2", "action_set": "default", "rewards": None}
    seats = {"left": None, "right": None, "switching": None}
    batch = Batch(scenario, n, 1, next_step=True, stack=1, size=(96, 72), **common, **seats)
    arrays = batch.arrays()
    batch.reset(arrays, [True] * n, list(range(n)), [None] * n, False)
    actions = np.zeros(n, np.int64)
    env = setpiece.make(scenario)
    env.reset(seed=1)
    envs = setpiece.make_vec(scenario, n, threads=1, copy=False)
    envs.reset(seed=1)
    # In turn, so that whatever else the machine does falls on all of them alike; the least of each counts.
    rounds = [
        (
            microseconds(lambda: batch.step(arrays, actions), 100) / n,
            microseconds(lambda: env.step(0), 5_000),
            microseconds(lambda: envs.step(actions), 100) / n,
        )
        for _ in range(25)
    ]
    native, single, vector = (min(times) for times in zip(*rounds, strict=True))
    print(f"native batch of {n}        {native:6.3f} µs a step and match")
    print(f"make, one environment    {single:6.3f} µs a step: the layer {single - native:6.3f} µs")
    print(f"make_vec of {n}           {vector:6.3f} µs a step and match: the layer {vector - native:6.3f} µs")


if __name__ == "__main__":
    main()
