"""Long use doesn't need more memory."""

import sys
from pathlib import Path

import numpy as np
import pytest

import setpiece

STATM = Path("/proc/self/statm")


def resident_mib() -> float:
    return int(STATM.read_text().split()[1]) * 4096 / 2**20


@pytest.mark.skipif(sys.platform != "linux", reason="reads Linux's count of pages")
def test_resets_and_environments_leave_nothing_behind() -> None:
    env = setpiece.make("academy_3_vs_1_with_keeper")

    def use(resets: int, made: int) -> None:
        for _ in range(resets):
            env.reset()
        for _ in range(made):
            single = setpiece.make("11_vs_11_stochastic", seed=1)
            single.reset()
            single.step(0)
            single.close()
            envs = setpiece.make_vec("academy_corner", 8, threads=2)
            envs.reset(seed=1)
            envs.step(np.zeros(8, int))
            envs.close()

    use(5_000, 10)
    before = resident_mib()
    use(100_000, 50)
    assert resident_mib() < before + 8.0
