"""The cost of the Python layer per step, on top of the engine: `python python/benches/layer.py`.

The baseline is one thread of a native batch of 256 matches, which plays, observes and judges, but
makes no Python objects. What `make` takes beyond it is the layer's cost; for `make_vec` it is
measured within each step. The match is one player against nobody.
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


class Timed:
    """A batch that measures how long its steps take."""

    def __init__(self, batch: Batch) -> None:
        self.batch, self.microseconds = batch, 0.0

    def __getattr__(self, name: str) -> object:
        return getattr(self.batch, name)

    def step(self, *arguments: object) -> object:
        """Steps the batch."""
        begun = time.perf_counter()
        stepped = self.batch.step(*arguments)  # type: ignore[arg-type]
        self.microseconds += (time.perf_counter() - begun) * 1e6
        return stepped


def main() -> None:
    """Measures and prints."""
    scenario = compile(EMPTY)
    n, steps = 256, 100
    env = setpiece.make(scenario)
    env.reset(seed=1)
    envs = setpiece.make_vec(scenario, n, threads=1, copy=False)
    batch = Timed(envs._batch)
    envs._batch = batch  # type: ignore[assignment]
    envs.reset(seed=1)
    actions = np.zeros(n, np.int64)

    def vector() -> tuple[float, float]:
        batch.microseconds = 0.0
        whole = microseconds(lambda: envs.step(actions), steps) / n
        return batch.microseconds / steps / n, whole

    # In turn, so that other load on the machine affects all of them equally; the minimum counts.
    rounds = [(*vector(), microseconds(lambda: env.step(0), 5_000)) for _ in range(25)]
    native, _, single = (min(times) for times in zip(*rounds, strict=True))
    layer = min(whole - inside for inside, whole, _ in rounds)
    print(f"native batch of {n}      {native:6.3f} µs a step and match")
    print(f"make, one environment  {single:6.3f} µs a step: the layer {single - native:6.3f} µs")
    print(
        f"make_vec of {n}         {native + layer:6.3f} µs a step and match: the layer {layer:6.3f} µs"
    )


if __name__ == "__main__":
    main()
