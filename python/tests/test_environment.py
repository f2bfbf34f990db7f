import math
import pickle
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import play, same
from environment_texts import SCRIPTED, SEVERAL
from gymnasium.utils.env_checker import check_env
from gymnasium.wrappers import (
    FlattenObservation,
    FrameStackObservation,
    RecordEpisodeStatistics,
    TimeLimit,
)

import setpiece
from setpiece import Action

PitchFile = Callable[..., Path]

CLOSE = "academy_empty_goal_close"

THREE = "academy_3_vs_1_with_keeper"

IDS = [f"setpiece/{name}-v0" for name in setpiece.list()]


@pytest.mark.parametrize("env_id", IDS)
def test_every_id_passes_the_checker(env_id: str) -> None:
    # The checker only supports one agent's rewards.
    check_env(gymnasium.make(env_id, left=1, right=0).unwrapped)


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
@pytest.mark.parametrize("name", [THREE, "11_vs_11_stochastic", "1_vs_1_easy"])
def test_every_observation_passes_the_checker(name: str, observation: str) -> None:
    check_env(
        setpiece.make(name, observation=observation, events=True, rewards="scoring,checkpoints")
    )


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
@pytest.mark.parametrize("name", [CLOSE, THREE, "11_vs_11_hard_stochastic"])
def test_observations_stay_in_their_space(name: str, observation: str) -> None:
    env = setpiece.make(name, observation=observation)
    for seed in range(3):
        for step in play(env, seed, steps=400):
            assert env.observation_space.contains(step[0])


def test_module_prefix_and_wrappers() -> None:
    env = gymnasium.make(
        f"setpiece:setpiece/{CLOSE}-v0", observation="smm", params={"difficulty": 0.2}
    )
    assert env.observation_space.shape == (72, 96, 4)
    unwrapped = env.unwrapped
    assert isinstance(unwrapped, setpiece.FootballEnv)
    assert unwrapped.scenario.params["difficulty"].default == 0.2
    assert pickle.loads(pickle.dumps(env.spec)).make().observation_space.shape == (72, 96, 4)
    stats = RecordEpisodeStatistics(FrameStackObservation(TimeLimit(setpiece.make(CLOSE), 5), 4))
    last = play(stats, 1, action=lambda: Action.IDLE)[-1]
    assert last[3]
    assert last[0].shape == (4, 115)
    assert last[4]["episode"]["l"] == 5
    flat = FlattenObservation(setpiece.make(CLOSE, observation="raw"))
    assert flat.reset(seed=1)[0] in flat.observation_space


def test_vector_of_environments() -> None:
    vector = gymnasium.make_vec(f"setpiece/{CLOSE}-v0", num_envs=2, vectorization_mode="sync")
    vector.reset(seed=1)
    for _ in range(80):
        vector.step(vector.action_space.sample())
    vector.close()


@pytest.mark.parametrize("name", [THREE, "11_vs_11_stochastic", "5_vs_5"])
@pytest.mark.parametrize("observation", ["simple115v2", "raw"])
def test_same_seed_same_episode(name: str, observation: str) -> None:
    first = play(setpiece.make(name, observation=observation, events=True), 11, steps=300)
    again = play(setpiece.make(name, observation=observation, events=True), 11, steps=300)
    other = play(setpiece.make(name, observation=observation, events=True), 12, steps=300)
    assert same(first, again)
    assert not same(first, other)


def index(info: dict[str, Any]) -> tuple[int, int]:
    return info["setpiece"]["seed"], info["setpiece"]["index"]


def test_index_counts_on_until_a_seed_comes() -> None:
    env = setpiece.make(CLOSE)
    shoot = lambda: Action.IDLE  # noqa: E731

    def episode(seed: int | None, **options: Any) -> tuple[int, int]:
        return index(play(env, seed, shoot, options=options)[-1][4])

    assert episode(5) == (5, 0)
    assert episode(None) == (5, 1)
    assert episode(None) == (5, 2)
    assert episode(None, episode=40) == (5, 40)
    assert episode(None) == (5, 41)
    assert episode(6) == (6, 0)
    assert episode(6, episode=9) == (6, 9)


def test_index_is_reproducible() -> None:
    env = setpiece.make("11_vs_11_stochastic")
    counted = [play(env, 5, steps=20), play(env, None, steps=20)]
    jumped = play(env, 5, steps=20, options={"episode": 1})
    assert same(counted[1], jumped)
    assert not same(counted[0], counted[1]), "the kick-off alternates"


def test_seed_of_make_is_that_of_the_first_reset() -> None:
    assert same(
        play(setpiece.make(THREE, seed=9), None, steps=30), play(setpiece.make(THREE), 9, steps=30)
    )
    unseeded = [play(setpiece.make("11_vs_11_stochastic"), None, steps=100) for _ in range(2)]
    assert not same(*unseeded)


def shoot() -> Callable[[], Action]:
    """An agent for the empty goal: runs, then shoots."""
    steps = iter(range(10_000))

    def act() -> Action:
        return Action.RIGHT if next(steps) < 4 else Action.SHOT

    return act


def a_goal(env: setpiece.FootballEnv) -> list[tuple[Any, Any, bool, bool, dict[str, Any]]]:
    """Plays until an episode ends with a goal."""
    for seed in range(20):
        trajectory = play(env, seed, shoot())
        if trajectory[-1][4]["score"] == [1, 0]:
            return trajectory
    pytest.fail("no goal in 20 episodes at an empty goal")


def test_goal_ends_the_episode_and_pays() -> None:
    env = setpiece.make(CLOSE, events=True)
    trajectory = a_goal(env)
    _, reward, terminated, truncated, info = trajectory[-1]
    assert (reward, terminated, truncated) == (1.0, True, False)
    assert info["outcome"] == "scored"
    assert info["reward_terms"]["scoring/goal"] == 1.0
    assert info["records"] == {}
    summary = info["setpiece"]
    assert summary.keys() == {
        "return",
        "length",
        "seed",
        "index",
        "digest",
        "level",
        "success",
        "faults",
        "observation_faults",
        "scenario",
    }
    assert (summary["success"], summary["faults"]) == (True, 0)
    assert summary["return"] == {"scoring/goal": 1.0, "scoring/conceded": 0.0}
    assert summary["length"] == len(trajectory) - 1
    goal = next(event for event in info["events"] if event["kind"] == "goal")
    assert goal["team"] == "left"
    # The place of the strike.
    assert 0.5 < goal["x"] < 1.0
    for step in trajectory[:-1]:
        assert step[4].keys() == {"score", "reward_terms", "action_mask", "events"}


def test_checkpoints_pay_at_most_one_besides_the_goal() -> None:
    env = setpiece.make(CLOSE, rewards="scoring,checkpoints")
    trajectory = a_goal(env)
    terms = trajectory[-1][4]["setpiece"]["return"]
    assert terms["scoring/goal"] == 1.0
    assert math.isclose(terms["checkpoints/carried"] + terms["checkpoints/goal"], 1.0, abs_tol=1e-9)
    assert math.isclose(sum(step[1] for step in trajectory), sum(terms.values()), abs_tol=1e-5)
    for step in trajectory[1:]:
        assert math.isclose(step[1], sum(step[4]["reward_terms"].values()), abs_tol=1e-6)


def test_idle_never_scores_and_is_cut_off_by_the_limit() -> None:
    trajectory = play(setpiece.make(CLOSE), 1, lambda: Action.IDLE)
    terminated, truncated = trajectory[-1][2:4]
    assert trajectory[-1][4]["score"] == [0, 0]
    assert terminated != truncated
    if truncated:
        assert len(trajectory) - 1 == 400


MINE = """import "std/academy/academy_empty_goal_close.pitch"

reward mine {
    give +5 on goal by us as "goal"
    give -5 on goal by them as "conceded"
}

scenario near_goal extends academy_empty_goal_close {
    remove reward scoring
    reward mine
}
"""


def test_an_edited_reward_pays_otherwise(pitch_file: PitchFile) -> None:
    env = setpiece.make(pitch_file(MINE))
    assert a_goal(env)[-1][1] == 5.0
    other = setpiece.make(pitch_file(MINE.replace("+5", "+7")))
    assert a_goal(other)[-1][1] == 7.0


def test_params_of_reset_hold_until_others_come() -> None:
    env = setpiece.make("11_vs_11_stochastic", params={"difficulty": 0.0})

    def episode(seed: int, options: dict[str, Any] | None = None) -> list[Any]:
        return play(env, seed, steps=300, options=options)

    easy = episode(1)
    hard = episode(1, {"params": {"difficulty": 1.0}})
    assert not same(easy, hard)
    assert same(hard, episode(1)), "they hold"
    assert same(easy, episode(1, {"params": {}})), "until others are given"


@pytest.mark.parametrize(
    "action",
    [5, np.int32(5), np.int64(5), np.uint8(5), Action.RIGHT, [5], (5,), np.array(5), np.array([5])],
)
def test_actions_of_every_integer_kind(action: Any) -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    assert same(env.step(action), play(setpiece.make(THREE), 1, lambda: 5, steps=1)[1])


def test_observations_are_copies_unless_disabled() -> None:
    env = setpiece.make(THREE)
    first = env.reset(seed=1)[0]
    kept = first.copy()
    assert not np.shares_memory(first, env.step(Action.RIGHT)[0])
    assert np.array_equal(first, kept)
    env = setpiece.make(THREE, copy=False)
    first = env.reset(seed=1)[0]
    for _ in range(10):
        assert env.step(Action.RIGHT)[0] is first
    assert not np.array_equal(first, kept)


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
def test_several_agents(observation: str) -> None:
    env = setpiece.make(setpiece.compile(SEVERAL), observation=observation)
    assert len(env.agents) == 4
    assert env.action_space == gymnasium.spaces.MultiDiscrete([19] * 4)
    for observed, reward, _, _, info in play(env, 1, lambda: [5, 0, 5, 5], steps=20)[1:]:
        assert env.observation_space.contains(observed)
        assert reward.shape == (4,)
        assert reward.dtype == np.float32
        assert info["action_mask"].shape == (4, 19)
        assert all(terms.shape == (4,) for terms in info["reward_terms"].values())
    for action in (5, [5, 5], [5, 5, 5, 19], [[5]] * 4, np.zeros((2, 2), int)):
        env.reset(seed=1)
        with pytest.raises(setpiece.ActionError):
            env.step(action)


def test_raw_is_what_the_array_shows() -> None:
    env, raw = setpiece.make(THREE), setpiece.make(THREE, observation="raw")
    for (flat, *_), (parts, *_) in zip(play(env, 4, steps=50), play(raw, 4, steps=50), strict=True):
        assert np.allclose(flat[:8], parts["left_team"].ravel(), atol=1e-6)
        assert np.all(flat[8:22] == -1)
        assert np.allclose(flat[44:48], parts["right_team"].ravel(), atol=1e-6)
        assert np.allclose(flat[88:91], parts["ball"], atol=1e-6)
        assert np.allclose(flat[91:94], parts["ball_direction"], atol=1e-6)
        assert np.argmax(flat[94:97]) == parts["ball_owned_team"] + 1
        assert np.argmax(flat[97:108]) == parts["active"]
        assert np.argmax(flat[108:115]) == parts["game_mode"]


def test_smm_shows_players_ball_and_the_active_one() -> None:
    observed, _ = setpiece.make(THREE, observation="smm").reset(seed=1)
    assert set(np.unique(observed)) == {0, 255}
    assert [int((observed[:, :, channel] == 255).sum()) for channel in range(4)] == [4, 2, 1, 1]


def test_action_mask_fits_the_space() -> None:
    env = setpiece.make(THREE)
    _, info = env.reset(seed=1)
    mask = info["action_mask"]
    assert mask.dtype == np.int8
    assert np.array_equal(mask, env.action_masks())
    assert mask[Action.IDLE] == 1
    for _ in range(20):
        assert mask[env.action_space.sample(mask=mask)] == 1


def test_drawing() -> None:
    env = setpiece.make(THREE, render_mode="ansi")
    env.reset(seed=1)
    drawing = env.render()
    assert isinstance(drawing, str)
    assert drawing.count("\n") > 10
    assert setpiece.make(THREE).render() is None


def test_step_releases_the_interpreter() -> None:
    """A counting thread continues while another steps.

    With the lock held, it would only get single bytecodes in.
    """
    env = setpiece.make("11_vs_11_stochastic")
    env.reset(seed=1)
    counted, stop = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.is_set():
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    begin, steps = time.perf_counter(), 0
    while time.perf_counter() - begin < 0.5:
        for _ in range(50):
            steps += 1
            if env.step(0)[2:4] != (False, False):
                env.reset()
    stop.set()
    thread.join()
    assert counted > steps


def test_script_pays(pitch_file: PitchFile, tmp_path: Path) -> None:
    (tmp_path / "mine.rhai").write_text("fn reward(ctx, now, prev, events) { 0.25 }\n")
    trajectory = play(setpiece.make(pitch_file(SCRIPTED)), 1, steps=5)
    assert [step[1] for step in trajectory[1:]] == [0.25] * (len(trajectory) - 1)


MEASURED = """
scenario measured extends academy {
    agents { left: [one, two] }
    ball at (0.5, 0)
    team left { one: CM at (0, 0)  two: CM at (0.2, 0.1) }
    observe vector { ball.x, me as "me", distance(me, ball) / 10m as "gap" }
    record touches = count of touch
    record top_speed = max of me.speed
    record begun = first of ball
    record heights = series of ball.height
    record path = series of ball
    end limit 20 steps
}
"""


def test_records_reach_the_last_info() -> None:
    env = setpiece.make(setpiece.compile(MEASURED))
    trajectory = play(env, 1, lambda: [5, 5])
    assert "records" not in trajectory[1][4]
    records = trajectory[-1][4]["records"]
    length = trajectory[-1][4]["setpiece"]["length"]
    assert list(records) == ["touches", "top_speed", "begun", "heights", "path"]
    assert isinstance(records["touches"], float)
    assert len(records["top_speed"]) == 2
    assert records["top_speed"][0] > 1.0
    assert records["begun"] == pytest.approx((0.5, 0.0), abs=0.05)
    assert records["heights"].shape == (length,)
    assert records["path"].shape == (length, 2)


def test_a_scenario_declares_its_own_observation() -> None:
    scenario = setpiece.compile(MEASURED)
    env = setpiece.make(scenario, observation="vector")
    observation, _ = env.reset(seed=1)
    assert env.observation_space.shape == (2, 4)
    assert env.observation_space.contains(observation)
    assert observation[:, 0] == pytest.approx([0.5, 0.5], abs=1e-6)
    assert observation[1, 1:3] == pytest.approx([0.2, 0.1], abs=1e-6)
    check_env(
        setpiece.make(setpiece.compile(MEASURED.replace("[one, two]", "1")), observation="vector")
    )
    with pytest.raises(setpiece.ParameterError, match="declares no observation"):
        setpiece.make(CLOSE, observation="vector")


def test_a_copy_goes_over_to_scenarios_that_lack_the_first_ones_parameters() -> None:
    env = setpiece.make("academy_corner", params={"difficulty": 0.9})
    bare = "scenario s extends academy { ball at (0, 0) team left { CM at (0.1, 0) } }"
    for copy in (env.unwrapped.clone(), pickle.loads(pickle.dumps(env))):
        assert copy.scenario.params["difficulty"].default == 0.9
        copy.reset(seed=1, options={"scenario": bare})
        for again in (copy.clone(), pickle.loads(pickle.dumps(copy))):
            assert again.scenario.name == "s"
            assert again.step(0)[4]["score"] == [0, 0]


def test_records_have_units_and_those_of_absent_players_none() -> None:
    text = """
    scenario s extends academy {
        ball at (0.5, 0)
        team left { CM at (0.48, 0) }
        team right { maybe 0% ghost: CB at (0.6, 0) }
        record gap = min of distance(ball, right.goal)
        record speed = max of ball.speed
        record touches = count of touch
        record place = last of ghost
        record near = min of distance(ghost, ball)
        end limit 3 steps
    }
    """
    scenario = setpiece.load(text)
    assert dict(scenario.records) == {
        "gap": "m",
        "speed": "m/s",
        "touches": "",
        "place": "",
        "near": "m",
    }
    env = setpiece.make(scenario)
    env.reset(seed=1)
    for _ in range(3):
        *_, info = env.step(setpiece.Action.IDLE)
    assert info["records"]["place"] is None
    assert info["records"]["near"] is None
    assert info["records"]["gap"] > 20
