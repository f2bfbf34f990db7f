import copy
import pickle
import random
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import Counter, play, same

import setpiece
from setpiece import Action

THREE = "academy_3_vs_1_with_keeper"
FULL = "11_vs_11_stochastic"

SCRIPTED = """import "std/academy/academy_3_vs_1_with_keeper.pitch"

scenario scripted extends academy_3_vs_1_with_keeper {
    reward script rhai \"\"\"
        fn reward(ctx, now, prev, events) {
            if this.seen == () { this.seen = []; }
            this.seen.push(now.ball.x + ctx.random());
            this.seen[0] + this.seen.len
        }
    \"\"\" as "mine"
    record path = series of ball
}
"""


def underway(env: setpiece.FootballEnv, steps: int = 8) -> setpiece.FootballEnv:
    env.reset(seed=3)
    for _ in range(steps):
        env.step(Action.RIGHT)
    return env


def go_on(env: setpiece.FootballEnv, steps: int = 300) -> list[Any]:
    generator = random.Random(1)
    trajectory: list[Any] = []
    for _ in range(steps):
        trajectory.append(env.step(generator.randrange(19)))
        if trajectory[-1][2] or trajectory[-1][3]:
            break
    return trajectory


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
@pytest.mark.parametrize("scenario", [THREE, FULL, setpiece.compile(SCRIPTED)])
def test_a_restored_episode_is_the_straight_run(scenario: Any, observation: str) -> None:
    env = underway(setpiece.make(scenario, observation=observation, events=True))
    snapshot = env.snapshot()
    assert isinstance(snapshot, bytes)
    straight = go_on(env)
    other = setpiece.make(scenario, observation=observation, events=True)
    observed, info = other.restore(snapshot)
    assert env.observation_space.contains(observed)
    assert info.keys() == {"score", "reward_terms", "action_mask", "events"}
    assert same(go_on(other), straight)
    env.restore(snapshot)
    assert same(go_on(env), straight), "also by the one that it was taken of"


def test_what_restore_returns_is_what_the_step_returned() -> None:
    env = underway(setpiece.make(THREE))
    observed, _, _, _, info = env.step(Action.SHOT)
    assert same(setpiece.make(THREE).restore(env.snapshot()), (observed, info))


def test_the_next_episodes_are_those_of_the_straight_run() -> None:
    env = setpiece.make(FULL)
    env.reset(seed=5, options={"params": {"difficulty": 0.1}})
    other = setpiece.make(FULL)
    other.restore(env.snapshot())
    assert same(play(env, None, steps=50), play(other, None, steps=50))


def test_an_ended_episode_stays_ended() -> None:
    env = setpiece.make(THREE)
    last = play(env, 1, lambda: Action.IDLE)[-1]
    other = setpiece.make(THREE)
    assert same(other.restore(env.snapshot())[1], last[4])
    with pytest.raises(gymnasium.error.ResetNeeded):
        other.step(0)
    fresh = setpiece.make(THREE)
    other.restore(fresh.snapshot())
    with pytest.raises(gymnasium.error.ResetNeeded):
        other.step(0)


@pytest.mark.parametrize(
    "copied",
    [setpiece.FootballEnv.clone, copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))],
)
@pytest.mark.parametrize("scenario", [THREE, setpiece.compile(SCRIPTED)])
def test_copies_go_on_by_themselves(scenario: Any, copied: Any) -> None:
    env = underway(setpiece.make(scenario, rewards="scoring", render_mode="ansi"))
    other = copied(env)
    assert other.render() == env.render()
    straight = go_on(env)
    assert same(go_on(other), straight)
    assert same(play(env, None, steps=20), play(other, None, steps=20))
    assert env.spec is not None
    assert other.spec.id == env.spec.id


def test_a_copy_before_the_first_episode() -> None:
    env = setpiece.make(THREE, seed=4)
    assert same(play(env.clone(), None, steps=20), play(env, None, steps=20))


def test_gymnasiums_own_environments_can_be_copied() -> None:
    env = gymnasium.make(f"setpiece/{THREE}-v0")
    env.reset(seed=1)
    env.step(5)
    other = copy.deepcopy(env)
    assert same(env.step(5), other.step(5))


def test_an_environment_of_a_vector_is_put_back() -> None:
    vector = gymnasium.vector.SyncVectorEnv([lambda: setpiece.make(THREE)] * 2)
    vector.reset(seed=1)
    first, second = (env.unwrapped for env in vector.envs)
    assert isinstance(first, setpiece.FootballEnv)
    assert isinstance(second, setpiece.FootballEnv)
    vector.step(np.array([Action.RIGHT, Action.LEFT]))
    second.restore(first.snapshot())
    observed = vector.step(np.array([Action.SHOT, Action.SHOT]))[0]
    assert np.array_equal(observed[0], observed[1])


def test_hindsight() -> None:
    env = underway(setpiece.make(FULL))
    for _ in range(200):
        observed = env.step(Action.RIGHT)[0]
    snapshot = env.snapshot()
    began, info = env.reset(seed=9, options={"snapshot": snapshot})
    assert np.array_equal(began, observed), "where the other stood"
    assert info["reward_terms"] == {"scoring/goal": 0.0, "scoring/conceded": 0.0}
    ways = [play(env, seed, steps=200, options={"snapshot": snapshot}) for seed in (9, 9, 10)]
    assert same(ways[0], ways[1])
    assert not same(ways[0], ways[2]), "noise is the seed's"
    drawn = env.reset(seed=9)[0]
    assert not np.array_equal(drawn, observed), "one episode only"


def test_hindsight_in_another_scenario() -> None:
    snapshot = underway(setpiece.make(FULL)).snapshot()
    hard = setpiece.make("11_vs_11_hard_stochastic")
    hard.reset(seed=1, options={"snapshot": snapshot})
    go_on(hard, 50)
    with pytest.raises(setpiece.SnapshotError, match="of scenario `11_vs_11_stochastic`") as caught:
        hard.restore(snapshot)
    assert caught.value.code == "SP0013"
    assert "reset(options=" in str(caught.value)
    with pytest.raises(
        setpiece.SnapshotError, match="the left players differ: the snapshot has 11"
    ):
        setpiece.make(THREE).reset(options={"snapshot": snapshot})


def test_bytes_that_are_no_snapshot() -> None:
    env = underway(setpiece.make(THREE))
    snapshot = env.snapshot()
    flipped = bytearray(snapshot)
    flipped[60] ^= 1
    for wrong in (b"", b"something else", snapshot[:50], bytes(flipped), snapshot + b"x"):
        with pytest.raises(setpiece.SnapshotError):
            env.restore(wrong)
    wrong_types: list[Any] = [None, "text", 3, [1, 2]]
    for wrong_type in wrong_types:
        with pytest.raises(setpiece.ParameterError, match="bytes"):
            env.restore(wrong_type)
    with pytest.raises(setpiece.ParameterError, match="bytes"):
        env.reset(options={"snapshot": "text"})
    env.restore(snapshot)
    assert env.snapshot() == snapshot


def test_behaviours_given_as_opponents_make_another_scenario() -> None:
    plain, lazy = (setpiece.make(THREE, left=1, opponents=ai) for ai in (None, {"right": "lazy"}))
    for env, other in ((plain, lazy), (lazy, plain)):
        env.reset(seed=1)
        other.reset(seed=1)
        with pytest.raises(setpiece.SnapshotError):
            other.restore(env.snapshot())
    again = setpiece.make(THREE, left=1, opponents={"right": "lazy"})
    again.restore(lazy.snapshot())
    assert same(again.step(0), lazy.step(0))


def test_copies_keep_the_actions_and_the_bots_choice() -> None:
    env = setpiece.make("academy_3_vs_1_with_keeper", action_set="v2", bot_action=True)
    env.reset(seed=1)
    for action in (5, 13, 19, 19, 11):
        env.step(action)
    state = env.snapshot()
    for other in (env.clone(), pickle.loads(pickle.dumps(env))):
        assert other.action_space.n == 20
        assert other.restore(state)[1]["bot_action"] == env.restore(state)[1]["bot_action"]
        assert other.played() == env.played()
        assert same(other.step(19), env.step(19))


def hashed(seen: Any) -> int:
    return int(np.abs(seen).sum() * 31) % 19


@pytest.mark.parametrize("stack", [1, 4])
@pytest.mark.parametrize(
    "copied", [setpiece.FootballEnv.clone, lambda env: pickle.loads(pickle.dumps(env))]
)
def test_a_copy_goes_on_with_what_opponents_have_seen(stack: int, copied: Any) -> None:
    env = setpiece.make("5_vs_5", left=1, right=1, opponents={"right": hashed}, stack=stack)
    env.reset(seed=1)
    for _ in range(20):
        env.step(5)
    twin = copied(env)
    for _ in range(20):
        assert np.array_equal(env.step(5)[0], twin.step(5)[0])


def test_a_clone_has_rewards_of_its_own() -> None:
    env = setpiece.make("5_vs_5", rewards=["none", Counter()])
    env.reset(seed=1)
    env.step(0)
    twin = env.clone()
    assert [twin.step(0)[1] for _ in range(3)] == [2.0, 3.0, 4.0]
    assert env.step(0)[1] == 2.0


def test_what_is_closed_stays_closed() -> None:
    env = setpiece.make("5_vs_5")
    env.reset(seed=1)
    snapshot = env.snapshot()
    env.close()
    for closed in (env, env.clone(), pickle.loads(pickle.dumps(env))):
        with pytest.raises(gymnasium.error.ClosedEnvironmentError):
            closed.restore(snapshot)
        with pytest.raises(gymnasium.error.ClosedEnvironmentError):
            closed.reset()
