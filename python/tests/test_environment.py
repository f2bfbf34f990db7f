import math
import pickle
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import play, same
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


@pytest.mark.parametrize("seed", [-1, 2**64, 1.5, "one"])
def test_seed_out_of_range(seed: Any) -> None:
    with pytest.raises(setpiece.ParameterError, match="seed"):
        setpiece.make(CLOSE).reset(seed=seed)
    with pytest.raises(setpiece.ParameterError, match="seed"):
        setpiece.make(CLOSE, seed=seed)


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


@pytest.mark.parametrize("rewards", ["scorin", "scoring,nothing", ["scoring", "chekpoints"]])
def test_unknown_reward(rewards: str | list[str]) -> None:
    with pytest.raises(setpiece.RewardError, match="no reward"):
        setpiece.make(CLOSE, rewards=rewards)


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
    [
        19,
        -1,
        1.5,
        "shot",
        None,
        True,
        [1, 2],
        np.array([1, 2]),
        np.array([[1]]),
        np.float32(3),
        2**70,
        {5: 5},
        {5},
    ],
)
def test_wrong_actions_leave_the_episode_untouched(action: Any) -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    with pytest.raises(setpiece.ActionError) as caught:
        env.step(action)
    assert "0..18" in str(caught.value)
    after = env.step(Action.RIGHT)
    assert same(after, play(setpiece.make(THREE), 1, lambda: Action.RIGHT, steps=1)[1])


@pytest.mark.parametrize(
    "action",
    [5, np.int32(5), np.int64(5), np.uint8(5), Action.RIGHT, [5], (5,), np.array(5), np.array([5])],
)
def test_actions_of_every_integer_kind(action: Any) -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    assert same(env.step(action), play(setpiece.make(THREE), 1, lambda: 5, steps=1)[1])


def test_step_needs_an_episode() -> None:
    env = setpiece.make(CLOSE)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    play(env, 1, lambda: Action.IDLE)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)


def test_unknown_options_are_named() -> None:
    wrong: list[Any] = [
        {"param": {}},
        {"params": 3},
        {"params": {3: 4}},
        {"episode": -1},
        {"episode": "one"},
    ]
    for options in wrong:
        with pytest.raises(setpiece.ParameterError):
            setpiece.make(CLOSE).reset(options=options)
    with pytest.raises(setpiece.ParameterError, match="did you mean `simple115v2`"):
        setpiece.make(CLOSE, observation="simple15v2")
    with pytest.raises(setpiece.ParameterError, match="ansi"):
        setpiece.make(CLOSE, render_mode="humane")


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


def test_frozen_buffer_is_an_error_and_not_a_crash() -> None:
    env = setpiece.make(THREE, copy=False)
    first = env.reset(seed=1)[0]
    first.flags.writeable = False
    with pytest.raises(setpiece.SetpieceError, match="read-only"):
        env.step(0)
    first.flags.writeable = True
    env.step(0)


SEVERAL = """import "std/academy/academy_3_vs_1_with_keeper.pitch"

scenario several extends academy_3_vs_1_with_keeper {
    agents { left: 3 right: 1 }
}
"""


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


def test_one_environment_is_for_one_thread_at_a_time() -> None:
    env = setpiece.make("11_vs_11_stochastic")
    env.reset(seed=1)
    failures: list[BaseException] = []

    def steps() -> None:
        for _ in range(300):
            try:
                env.step(0)
            except (RuntimeError, gymnasium.error.ResetNeeded) as error:
                failures.append(error)

    threads = [threading.Thread(target=steps) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("Already" in str(error) or "thread" in str(error) for error in failures)
    env.reset(seed=2)


SCRIPTED = """import "std/academy/academy_empty_goal_close.pitch"

scenario scripted extends academy_empty_goal_close {
    remove reward scoring
    reward script "mine.rhai"
}
"""


def test_script_pays(pitch_file: PitchFile, tmp_path: Path) -> None:
    (tmp_path / "mine.rhai").write_text("fn reward(ctx, now, prev, events) { 0.25 }\n")
    trajectory = play(setpiece.make(pitch_file(SCRIPTED)), 1, steps=5)
    assert [step[1] for step in trajectory[1:]] == [0.25] * (len(trajectory) - 1)


def test_failing_script_says_where(pitch_file: PitchFile, tmp_path: Path) -> None:
    (tmp_path / "mine.rhai").write_text(
        "fn reward(ctx, now, prev, events) {\n    let x = 0;\n    1 / x\n}\n"
    )
    env = setpiece.make(pitch_file(SCRIPTED))
    env.reset(seed=77)
    with pytest.raises(setpiece.ScriptError) as caught:
        env.step(0)
    error = caught.value
    assert (error.script, error.line, error.hook, error.seed, error.step) == (
        "mine.rhai",
        3,
        "reward",
        77,
        1,
    )
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    env.reset(seed=78)


def test_requirements_that_are_never_met() -> None:
    text = "scenario s {\n param far = 0.5 in 0..1\n ball at (uniform(0, 0.1), 0)\n team left { CM at (0, 0) }\n"
    env = setpiece.make(
        setpiece.compile(text + ' require ball.x > far as "too far"\n end limit 10 steps\n}\n')
    )
    with pytest.raises(setpiece.DrawError, match="too far"):
        env.reset(seed=1)


def test_a_reset_that_fails_leaves_no_trace() -> None:
    env = setpiece.make(CLOSE, seed=3)
    before = env.reset(seed=1)
    for params in ({"difficulty": 2}, {"nobody": 1}):
        with pytest.raises(setpiece.ParameterError):
            env.reset(seed=9, options={"params": params})
    again = env.reset(seed=1)
    assert same(before, again)
    env.reset(seed=1, options={"episode": 2**64 - 1})
    env.reset()


def test_odd_arguments_are_named() -> None:
    with pytest.raises(setpiece.ParameterError, match="`rewards` as names"):
        setpiece.make(CLOSE, rewards=[3])  # type: ignore[list-item]
    env = setpiece.make(CLOSE)
    with pytest.raises(setpiece.ParameterError, match="`options` as a mapping"):
        env.reset(options=3)  # type: ignore[arg-type]
    with pytest.raises(setpiece.ParameterError, match="`seed`"):
        env.reset(seed=True)


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


@pytest.mark.parametrize("path", [5, None, b"run.pitchr", ["run.pitchr"]])
def test_what_is_no_path_is_named(path: Any) -> None:
    env = setpiece.make(CLOSE)
    env.reset(seed=1)
    for use in (setpiece.Replay, env.save_replay, setpiece.onnx_policy):
        with pytest.raises(setpiece.ParameterError, match="expected a path as `path`") as caught:
            use(path)
        assert caught.value.name == "path"


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


def test_two_threads_on_one_environment_are_reported() -> None:
    env = setpiece.make("11_vs_11_stochastic")
    env.reset(seed=1)
    raised: list[Exception] = []

    def play() -> None:
        for _ in range(2000):
            try:
                env.step(19 - 1)
            except Exception as error:
                raised.append(error)

    threads = [threading.Thread(target=play) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert raised
    assert {type(error) for error in raised} == {setpiece.InUseError}
    assert "one for each thread" in str(raised[0])
    # It still works.
    env.step(0)


def test_an_action_of_the_bots_is_asked_for_by_its_set() -> None:
    default, v2 = setpiece.make(THREE), setpiece.make(THREE, action_set="v2")
    assert default.action_space == gymnasium.spaces.Discrete(19)
    assert v2.action_space == gymnasium.spaces.Discrete(20)
    assert setpiece.make(setpiece.compile(SEVERAL), action_set="v2").action_space.shape == (4,)
    assert v2.reset(seed=1)[1]["action_mask"].shape == (20,)
    assert v2.action_masks()[Action.BUILTIN_AI] == 1
    assert same(
        play(default, 1, lambda: 5)[-1][4]["setpiece"], play(v2, 1, lambda: 5)[-1][4]["setpiece"]
    )
    with pytest.raises(setpiece.ParameterError, match="did you mean `default`") as caught:
        setpiece.make(THREE, action_set="defalt")
    assert caught.value.name == "action_set"
    default.reset(seed=1)
    with pytest.raises(setpiece.ActionError, match=r"0\.\.18") as refused:
        default.step(Action.BUILTIN_AI)
    assert 'action_set="v2"' in (refused.value.help or "")
    with pytest.raises(setpiece.ActionError, match=r"0\.\.19") as beyond:
        play(v2, 1, lambda: 20)
    assert 'action_set="full"' in (beyond.value.help or "")
    check_env(setpiece.make(THREE, action_set="v2", bot_action=True))


def test_the_bots_action_clears_what_is_held() -> None:
    env = setpiece.make("academy_empty_goal", action_set="v2", observation="raw")
    env.reset(seed=1)
    for action in (Action.RIGHT, Action.SPRINT):
        held = env.step(action)[0]["sticky_actions"]
    assert list(np.flatnonzero(held)) == [4, 8]
    assert not env.step(Action.BUILTIN_AI)[0]["sticky_actions"].any()


def test_who_follows_the_bots_choice_scores() -> None:
    env = setpiece.make("academy_empty_goal", bot_action=True)
    goals = 0
    for seed in range(10):
        _, info = env.reset(seed=seed)
        over = False
        while not over:
            assert isinstance(info["bot_action"], int)
            assert info["bot_action"] in env.action_space
            _, _, terminated, truncated, info = env.step(info["bot_action"])
            over = terminated or truncated
        goals += info["score"][0]
    assert goals >= 8


def test_asking_the_bot_changes_nothing() -> None:
    def digest(**options: Any) -> str:
        return play(setpiece.make("11_vs_11_stochastic", **options), 3, steps=4000)[-1][4][
            "setpiece"
        ]["digest"]

    assert digest() == digest(bot_action=True)


def test_the_bots_choice_of_several_agents() -> None:
    env = setpiece.make(setpiece.compile(SEVERAL), bot_action=True)
    for *_, info in play(env, 1, lambda: [5, 0, 5, 5], steps=20):
        assert info["bot_action"].dtype == np.int64
        assert info["bot_action"].shape == (4,)
        assert info["bot_action"] in env.action_space


def test_what_everyone_pressed() -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    assert env.played() == {}
    env.step(Action.SPRINT)
    played = env.played()
    assert len(played) == 6
    assert all(Action(action) != Action.BUILTIN_AI for action in played.values())
    assert Action.SPRINT in played.values()


NOBODY = """import "std/academy/academy_3_vs_1_with_keeper.pitch"

scenario nobody extends academy_3_vs_1_with_keeper {
    agents { left: 0 }
}
"""


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
def test_bots_among_themselves(observation: str) -> None:
    env = setpiece.make(
        setpiece.compile(NOBODY), observation=observation, events=True, bot_action=True
    )
    assert env.agents == ()
    trajectory = play(env, 1, lambda: [])
    for observed, reward, _, _, info in trajectory[1:]:
        assert env.observation_space.contains(observed)
        assert reward.shape == info["bot_action"].shape == (0,)
        assert info["action_mask"].shape == (0, 19)
    assert trajectory[-1][4]["outcome"]
    assert len(env.played()) == 6
    assert same(trajectory, play(env, 1, env.action_space.sample))
    env.reset(seed=1)
    with pytest.raises(setpiece.ActionError, match="nobody acts"):
        env.step(5)
    assert pickle.loads(pickle.dumps(env)).step([])[4]["score"] == [0, 0]


@pytest.mark.parametrize("kind", ["single", "vector", "parallel"])
def test_what_is_closed_says_so(kind: str) -> None:
    made: dict[str, Callable[[], Any]] = {
        "single": lambda: setpiece.make("academy_corner"),
        "vector": lambda: setpiece.make_vec("academy_corner", 2),
        "parallel": lambda: setpiece.parallel_env("academy_corner"),
    }
    env = made[kind]()
    env.reset(seed=1)
    env.close()
    env.close()
    with pytest.raises(gymnasium.error.ClosedEnvironmentError, match="closed"):
        env.reset()
    if kind != "parallel":
        with pytest.raises(gymnasium.error.ClosedEnvironmentError, match="closed"):
            env.step([0, 0] if kind == "vector" else 0)


@pytest.mark.parametrize(
    "maker", [setpiece.make, setpiece.parallel_env, partial(setpiece.make_vec, num_envs=2)]
)
def test_parameters_are_a_mapping(maker: Callable[..., Any]) -> None:
    with pytest.raises(setpiece.ParameterError, match="expected `params` as a mapping"):
        maker("academy_corner", params=[1])


def test_a_copy_goes_over_to_scenarios_that_lack_the_first_ones_parameters() -> None:
    env = setpiece.make("academy_corner", params={"difficulty": 0.9})
    bare = "scenario s extends academy { ball at (0, 0) team left { CM at (0.1, 0) } }"
    for copy in (env.unwrapped.clone(), pickle.loads(pickle.dumps(env))):
        assert copy.scenario.params["difficulty"].default == 0.9
        copy.reset(seed=1, options={"scenario": bare})
        for again in (copy.clone(), pickle.loads(pickle.dumps(copy))):
            assert again.scenario.name == "s"
            assert again.step(0)[4]["score"] == [0, 0]


def test_a_vector_refuses_what_only_single_environments_take() -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument 'events'"):
        gymnasium.make_vec(
            "setpiece/academy_corner-v0", 2, vectorization_mode="vector_entry_point", events=True
        )
    with pytest.raises(TypeError, match="unexpected keyword argument 'observations'"):
        setpiece.FootballEnv("academy_corner", observations="raw")  # type: ignore[call-arg]
