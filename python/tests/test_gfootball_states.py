"""`create_environment`: seeds, and states that are taken and restored."""

import pickle
from typing import Any

import gymnasium
import pytest
from conftest import same
from gfootball_env import FULL, SEEDED, make

from setpiece import (
    CompileError,
    SnapshotError,
)
from setpiece.gfootball.env import create_environment


def test_seeds() -> None:
    import random

    def play(env: Any) -> list[Any]:
        return [env.reset(), *(env.step(5)[0] for _ in range(40))]

    def one(**options: Any) -> Any:
        return create_environment(FULL, representation="simple115v2", other_config_options=options)

    assert same(play(one(**SEEDED)), play(one(**SEEDED)))
    random.seed(3)
    first = play(one())
    random.seed(3)
    assert same(first, play(one()))
    assert not same(first, play(one()))
    envs = [one(), one()]
    assert [env.seed(5) for env in envs] == [[5], [5]]
    assert same(play(envs[0]), play(envs[1]))
    env = one(**SEEDED)
    runs = [play(env) for _ in range(3)]
    assert same(runs[0], runs[2]), (
        "a fixed seed makes every episode with the same kick-off the same"
    )
    assert not same(runs[0], runs[1])


@pytest.mark.parametrize("representation", ["simple115v2", "raw", "extracted"])
def test_a_state_goes_on_as_before(representation: str) -> None:
    stacked = representation != "raw"
    env = make(representation=representation, stacked=stacked, rewards="scoring,checkpoints")
    env.reset()
    for _ in range(5):
        env.step(5)
    state = env.get_state()
    later = [env.step(action) for action in (5, 11, 0)]
    assert env.set_state(state)
    assert env.get_state() == state
    assert same(later, [env.step(action) for action in (5, 11, 0)])
    other = make(representation=representation, stacked=stacked, rewards="scoring,checkpoints")
    other.set_state(state)
    assert same(later, [other.step(action) for action in (5, 11, 0)])


def test_a_state_holds_after_done() -> None:
    env = make("1_vs_1_easy")
    env.reset()
    state = env.get_state()
    while not env.step(0)[2]:
        pass
    over = env.get_state()
    env.set_state(state)
    env.step(0)
    env.set_state(over)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)


def test_a_state_of_something_else_is_refused() -> None:
    env = make()
    env.reset()
    before = env.get_state()
    for state in (b"", b"nonsense", before[:-9], make(FULL).get_state(), make(left=2).get_state()):
        with pytest.raises(SnapshotError):
            env.set_state(state)
        assert env.get_state() == before


PARTS = (
    "agents",
    "source",
    "played",
    "snapshot",
    "waiting",
    "step_count",
    "cumulative_reward",
    "done",
)


@pytest.mark.parametrize("damage", ["gone", "x", [7]])
@pytest.mark.parametrize("part", PARTS)
def test_a_damaged_state_is_refused(part: str, damage: Any) -> None:
    env = make()
    env.reset()
    before = env.get_state()
    state = pickle.loads(before)
    if damage == "gone":
        del state["core"][part]
    else:
        state["core"][part] = damage
    with pytest.raises(SnapshotError):
        env.set_state(pickle.dumps(state))
    assert env.get_state() == before


def test_a_source_that_can_not_be_read_is_not_taken_for_damage() -> None:
    env = make()
    env.reset()
    before = env.get_state()
    state = pickle.loads(before)
    name, _, folder = state["core"]["source"]
    state["core"]["source"] = name, "scenario {", folder
    with pytest.raises(CompileError):
        env.set_state(pickle.dumps(state))
    assert env.get_state() == before
