"""Bad input and misuse of an environment: each is named, and nothing is lost."""

import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import play, same
from environment_texts import SCRIPTED

import setpiece
from setpiece import Action

PitchFile = Callable[..., Path]

CLOSE = "academy_empty_goal_close"

THREE = "academy_3_vs_1_with_keeper"


@pytest.mark.parametrize("seed", [-1, 2**64, 1.5, "one"])
def test_seed_out_of_range(seed: Any) -> None:
    with pytest.raises(setpiece.ParameterError, match="seed"):
        setpiece.make(CLOSE).reset(seed=seed)
    with pytest.raises(setpiece.ParameterError, match="seed"):
        setpiece.make(CLOSE, seed=seed)


@pytest.mark.parametrize("rewards", ["scorin", "scoring,nothing", ["scoring", "chekpoints"]])
def test_unknown_reward(rewards: str | list[str]) -> None:
    with pytest.raises(setpiece.RewardError, match="no reward"):
        setpiece.make(CLOSE, rewards=rewards)


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


def test_frozen_buffer_is_an_error_and_not_a_crash() -> None:
    env = setpiece.make(THREE, copy=False)
    first = env.reset(seed=1)[0]
    first.flags.writeable = False
    with pytest.raises(setpiece.SetpieceError, match="read-only"):
        env.step(0)
    first.flags.writeable = True
    env.step(0)


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


@pytest.mark.parametrize("path", [5, None, b"run.pitchr", ["run.pitchr"]])
def test_what_is_no_path_is_named(path: Any) -> None:
    env = setpiece.make(CLOSE)
    env.reset(seed=1)
    for use in (setpiece.Replay, env.save_replay, setpiece.onnx_policy):
        with pytest.raises(setpiece.ParameterError, match="expected a path as `path`") as caught:
            use(path)
        assert caught.value.name == "path"


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


def test_a_vector_refuses_what_only_single_environments_take() -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument 'events'"):
        gymnasium.make_vec(
            "setpiece/academy_corner-v0", 2, vectorization_mode="vector_entry_point", events=True
        )
    with pytest.raises(TypeError, match="unexpected keyword argument 'observations'"):
        setpiece.FootballEnv("academy_corner", observations="raw")  # type: ignore[call-arg]
