"""Threads and processes that share an environment get clear errors, and never hang."""

import os
import sys
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import setpiece


def in_a_fork(work: Callable[[], object], seconds: int = 60) -> int:
    """Runs a function in a fork of this process; returns its exit code, or fails if it hangs."""
    import time
    import warnings

    with warnings.catch_warnings():
        # Python warns about forks with threads, which are tested here.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        code = 1
        try:
            work()
            code = 0
        finally:
            os._exit(code)
    for _ in range(seconds * 20):
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.05)
    os.kill(child, 9)
    os.waitpid(child, 0)
    pytest.fail("the fork hangs")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks")
def test_a_vector_inherited_by_a_fork_plays_on() -> None:
    envs = setpiece.make_vec("academy_3_vs_1_with_keeper", 6, threads=3, seed=1)
    envs.reset()
    envs.step(np.zeros(6, int))
    expected = setpiece.make_vec("academy_3_vs_1_with_keeper", 6, threads=3, seed=1)
    expected.reset()
    expected.step(np.zeros(6, int))
    following = expected.step(np.full(6, 5))[0]

    def work() -> None:
        for _ in range(2):
            observations = envs.step(np.full(6, 5))[0]
            assert _ or np.array_equal(observations, following)
        envs.reset(seed=3)
        setpiece.make_vec("academy_corner", 4, threads=2).reset(seed=1)

    assert in_a_fork(work) == 0
    assert np.array_equal(envs.step(np.full(6, 5))[0], following), "the parent plays on"


@pytest.mark.parametrize(
    "asked",
    [
        lambda env: env.look("raw"),
        lambda env: env.played(),
        lambda env: env.render(),
        lambda env: env.action_masks(),
        lambda env: env.slots,
        lambda env: env.observation_layout,
        lambda env: env.snapshot(),
        lambda env: env.step(0),
        lambda env: env.reset(seed=1),
    ],
)
def test_a_second_thread_is_reported_in_the_packages_words(asked: Callable[[Any], Any]) -> None:
    env = setpiece.make("11_vs_11_stochastic", render_mode="ansi")
    env.reset(seed=1)
    wrong: list[BaseException] = []
    done = threading.Event()

    def other() -> None:
        while not done.is_set():
            try:
                asked(env)
            except setpiece.InUseError:
                pass
            except BaseException as error:
                wrong.append(error)
                return

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    thread = threading.Thread(target=other)
    thread.start()
    try:
        for _ in range(300):
            try:
                *_, terminated, truncated, _info = env.step(0)
                if terminated or truncated:
                    env.reset()
            except setpiece.InUseError:
                pass
    finally:
        done.set()
        thread.join()
        sys.setswitchinterval(interval)
    assert not [error for error in wrong if type(error) is RuntimeError], wrong


def test_seeds_of_a_vector_may_be_numbers_of_numpy() -> None:
    envs = setpiece.make_vec("academy_corner", 2)
    expected = envs.reset(seed=5)[0]
    for seed in (np.array(5), np.int64(5), np.array([5, 6]), [5, 6]):
        assert np.array_equal(envs.reset(seed=seed)[0], expected)
    for wrong in (np.array(5.5), np.array([[5, 6]]), "5", [5, "6"], np.array([5])):
        with pytest.raises(setpiece.ParameterError):
            envs.reset(seed=wrong)
