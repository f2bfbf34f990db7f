"""A `reset` with bad arguments keeps the running episode; one that fails later ends it."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import pytest
from conftest import same

import setpiece

NEVER = """
scenario never extends academy {
    param far = 0 in 0..1
    ball at (uniform(0, 0.1), 0)
    team left { GK at (-1, 0) CM at (0, 0) }
    team right { GK at (1, 0) }
    require ball.x >= far as "too far"
}
"""
OTHER = """
scenario other extends academy {
    ball at (0, 0)
    team left { CM at (0, 0) }
    reward paid { give 1 on goal as "joy" }
}
"""


def paid(_step: setpiece.Step) -> float:
    return 0.0


paid.__name__ = "paid/joy"


REFUSED: dict[str, dict[str, Any]] = {
    "seed": {"seed": -1},
    "option": {"options": {"parms": {}}},
    "options": {"options": 3},
    "index": {"options": {"episode": "one"}},
    "no parameter": {"options": {"params": {"fra": 1}}},
    "out of range": {"options": {"params": {"far": 5}}},
    "no bytes": {"options": {"snapshot": 5}},
    "no snapshot": {"options": {"snapshot": b"abc"}},
    "no snapshot, and parameters": {"options": {"snapshot": b"abc", "params": {"far": 0.01}}},
    "no scenario": {"options": {"scenario": "nowhere"}},
    "broken": {"options": {"scenario": "scenario broken {"}},
    "a snapshot of others": {"options": {"snapshot": setpiece.make("5_vs_5").snapshot()}},
    "a snapshot for another": {"options": {"scenario": NEVER, "snapshot": b"abc"}},
    "a reward of the same name": {"options": {"scenario": OTHER}},
}


KINDS = [setpiece.make, partial(setpiece.parallel_env, left="all")]
# PettingZoo's environments warn about unknown options, and continue.
CASES = [(kind, what) for what in REFUSED for kind in (KINDS if what != "option" else KINDS[:1])]


@pytest.mark.parametrize(("kind", "what"), CASES)
def test_a_reset_that_is_refused_leaves_the_running_episode(
    kind: Any, what: str, tmp_path: Path
) -> None:
    def begun() -> Any:
        env = kind(NEVER, rewards=[paid], seed=3)
        env.reset(seed=1)
        move(env)
        return env

    def move(env: Any) -> Any:
        return env.step(dict.fromkeys(env.agents, 5) if kind is not setpiece.make else 5)

    env, other = begun(), begun()
    before = env.snapshot()
    with pytest.raises(setpiece.SetpieceError):
        env.reset(**REFUSED[what])
    assert env.snapshot() == before
    assert same([move(env) for _ in range(5)], [move(other) for _ in range(5)])
    env.save_replay(tmp_path / "refused.pitchr")
    other.save_replay(tmp_path / "other.pitchr")
    assert (tmp_path / "refused.pitchr").read_bytes() == (tmp_path / "other.pitchr").read_bytes()
    assert same(env.reset(), other.reset()), "the next episode is the next one"


@pytest.mark.parametrize("kind", KINDS)
def test_a_reset_that_fails_later_ends_the_running_episode(kind: Any) -> None:
    failing = False

    class Moody:
        def reset(self) -> None:
            if failing:
                raise ValueError("not today")

        def __call__(self, _step: setpiece.Step) -> float:
            return 0.0

    env = kind(NEVER, rewards=[Moody()])
    for options, error in (
        ({"params": {"far": 1}}, setpiece.DrawError),
        (None, setpiece.CallbackError),
    ):
        env.reset(seed=1, options={"params": {}})
        failing = error is setpiece.CallbackError
        with pytest.raises(error):
            env.reset(options=options)
        with pytest.raises(gymnasium.error.ResetNeeded):
            env.step({} if kind is not setpiece.make else 0)


def test_a_refused_reset_of_a_watched_file_takes_over_what_has_changed(
    pitch_file: Callable[..., Path],
) -> None:
    path = pitch_file(NEVER)
    env = setpiece.make(path, watch=True)
    env.reset(seed=1)
    refused = {"params": {"near": 1}}
    with pytest.raises(setpiece.ParameterError):
        env.reset(options=refused)
    env.step(0)
    path.write_text(NEVER.replace("far", "near"))
    deadline = time.monotonic() + 20
    while env.last_reload is None and time.monotonic() < deadline:
        with pytest.raises(setpiece.SetpieceError):
            env.reset(options={"params": {"nowhere": 1}})
        time.sleep(0.02)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    with pytest.raises(setpiece.DrawError):
        env.reset(options=refused)
