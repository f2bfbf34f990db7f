"""Switching to another scenario at `reset`, in a running environment."""

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import play, same

import setpiece
from setpiece import Action

PitchFile = Callable[..., Path]
THREE = "academy_3_vs_1_with_keeper"
CORNER = "academy_corner"
EMPTY = "academy_empty_goal"

DRILL = """
/// A behaviour that an opponent may be.
behavior chaser() { repeat { do move_to(ball) } }

scenario drill {
    param gap: length = 10m in 5m..20m
    param pay = 0.5 in 0..1
    ball at centre
    team left { CF at (-5m, 0m) }
    team right { CB at (gap, 0m) }
    reward stay { give pay as "step" }
    record closeness = mean of distance(ball, right.goal)
    end limit 25 steps
}
"""
PAIR = {
    "name": "pair",
    "ball": (0.5, 0),
    "left": [("CM", 0.45, 0), ("CF", 0.6, 0.1)],
    "right": [("GK", 1, 0)],
    "rewards": ["scoring", "checkpoints"],
    "limit": 30,
}
NEVER = (
    "scenario never { ball at centre team left { CF at (0, 0) } require 1 > 2 end limit 9 steps }"
)


def agree(env: Any, other: Any, seed: int, options: dict[str, Any], steps: int = 60) -> None:
    """Both play the same episode, the first after switching to another scenario, and the next one."""
    assert same(play(env, seed, options=options, steps=steps), play(other, seed, steps=steps))
    assert same(play(env, None, steps=steps), play(other, None, steps=steps))


@pytest.mark.parametrize("form", ["name", "path", "text", "compiled", "dict"])
@pytest.mark.parametrize("observation", ["simple115v2", "smm", "egocentric"])
def test_the_episode_is_that_of_a_new_environment(
    form: str, observation: str, pitch_file: PitchFile
) -> None:
    # The number of visible teammates stays the same.
    start = {"name": THREE, "dict": PAIR}.get(form, DRILL) if observation == "egocentric" else THREE
    source: Any = {
        "name": CORNER if observation != "egocentric" else THREE,
        "path": pitch_file(DRILL),
        "text": DRILL,
        "compiled": setpiece.compile(DRILL),
        "dict": PAIR,
    }[form]
    env = setpiece.make(start, observation=observation, events=True, bot_action=True)
    play(env, 3, steps=40)
    agree(
        env,
        setpiece.make(source, observation=observation, events=True, bot_action=True),
        5,
        {"scenario": source},
    )
    assert env.scenario.digest == setpiece.load(source).digest


def test_parameters_beside_a_scenario_are_its_own() -> None:
    params = {"gap": "6m", "pay": 0.25}
    env = setpiece.make(THREE, params={"difficulty": 0.9})
    env.reset(seed=1, options={"params": {"left_difficulty": 0.3}})
    agree(env, setpiece.make(DRILL, params=params), 2, {"scenario": DRILL, "params": params})
    assert env.scenario.params["pay"].default == 0.25
    env.reset(seed=1, options={"params": {"pay": 1.0}})
    assert env.step(Action.IDLE)[1] == 1.0
    env.reset(options={"scenario": DRILL})
    assert env.step(Action.IDLE)[1] == 0.5, "parameters of the scenario before are gone"


def test_a_scenario_may_begin_in_a_snapshot() -> None:
    other = DRILL.replace("scenario drill", "scenario later").replace("25 steps", "9 steps")
    source = setpiece.make(DRILL)
    play(source, 1, steps=12)
    snapshot = source.snapshot()
    env, new = setpiece.make(DRILL), setpiece.make(other)
    env.reset(seed=8)
    switched = play(env, 2, options={"scenario": other, "snapshot": snapshot})
    assert same(switched, play(new, 2, options={"snapshot": snapshot}))
    assert len(switched) == 10
    assert np.array_equal(switched[0][0], source.look("simple115v2"))


def test_several_agents_opponents_stacks_and_callbacks_go_over_too(pitch_file: PitchFile) -> None:
    def ahead(step: setpiece.Step) -> float:
        return float(step.now["ball"][0])

    path = pitch_file(DRILL)
    for options in (
        {"left": 1, "right": 1, "observation": "raw", "switching": "fixed"},
        {"left": 1, "right": 1, "opponents": {"right": lambda seen: int(seen[88] < 0) + 4}},
        {"right": 0, "opponents": {"right": "chaser"}},
        {"stack": 3, "rewards": ["none", ahead], "ends": lambda step: step.now["steps_left"] < 4},
    ):
        env = setpiece.make(path, **options)
        env.reset(seed=4)
        act = (
            (lambda: [Action.RIGHT, Action.LEFT]) if len(env.agents) == 2 else lambda: Action.RIGHT
        )
        env.step(act())
        other = DRILL.replace("scenario drill", "scenario other").replace("-5m", "-8m")
        new = setpiece.make(other, **options)
        assert same(play(env, 9, act, options={"scenario": other}), play(new, 9, act))
        assert env.scenario.name == new.scenario.name


def test_copies_go_over_as_well() -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    env.reset(options={"scenario": DRILL})
    for copy in (env.clone(), pickle.loads(pickle.dumps(env))):
        assert copy.scenario.digest == env.scenario.digest
        agree(copy, setpiece.make(CORNER), 5, {"scenario": CORNER})


@pytest.mark.parametrize(
    ("options", "source", "message"),
    [
        ({"left": "all"}, PAIR, r"the action space would change from 4 actions to 2 actions"),
        (
            {"left": 2, "observation": "raw"},
            PAIR,
            r"the observation space would change .* at `left_team`",
        ),
        (
            {"observation": "raw"},
            DRILL,
            r"from float64 \(4, 2\) to float64 \(1, 2\) at `left_team`",
        ),
        (
            {"observation": "egocentric"},
            DRILL,
            r"the observation space would change from float32 \(\d+,\) to",
        ),
        ({}, "academy_corne", "no scenario is called"),
        ({}, {"bal": (0, 0)}, "did you mean `ball`"),
        ({}, "scenario broken { ball nowhere }", "SP0101"),
        ({}, NEVER, "never"),
        ({}, 3, "expected a scenario's name"),
        ({"rewards": "checkpoints,stay"}, THREE, "stay"),
    ],
)
def test_a_scenario_that_does_not_fit_leaves_the_old_one(
    options: dict[str, Any], source: Any, message: str
) -> None:
    start = DRILL if "rewards" in options else "academy_3_vs_1_with_keeper"
    if options.get("left") == "all":
        start = {**PAIR, "left": [("CM", 0.1 * n, 0.1 * n) for n in range(4)], "rewards": []}
    env, twin = (setpiece.make(start, **options) for _ in range(2))
    idle = np.zeros(env.action_space.shape, np.int64)
    act = lambda: idle  # noqa: E731
    play(env, 4, act, steps=5)
    with pytest.raises(setpiece.SetpieceError, match=message) as refused:
        env.reset(options={"scenario": source})
    if isinstance(source, str | dict) and "space" in message:
        assert isinstance(refused.value, setpiece.ParameterError)
        assert refused.value.name == "scenario"
    play(twin, 4, act, steps=5)
    assert env.scenario.digest == twin.scenario.digest
    assert same(play(env, None, act, steps=5), play(twin, None, act, steps=5))


def test_an_episode_goes_on_where_a_scenario_does_not_fit() -> None:
    env, twin = setpiece.make(THREE, observation="raw"), setpiece.make(THREE, observation="raw")
    for one in (env, twin):
        one.reset(seed=1)
    with pytest.raises(setpiece.ParameterError, match="make another environment"):
        env.reset(options={"scenario": DRILL})
    assert same(env.step(Action.RIGHT), twin.step(Action.RIGHT))


def test_a_watched_environment_plays_its_file(pitch_file: PitchFile) -> None:
    env = setpiece.make(pitch_file(DRILL), watch=True)
    with pytest.raises(setpiece.ParameterError, match="switch to another"):
        env.reset(options={"scenario": THREE})
    assert len(play(env, 1)) == 26


def test_a_reset_option_that_is_not_there_is_named() -> None:
    with pytest.raises(setpiece.ParameterError, match="no reset option `scenaro`") as unknown:
        setpiece.make(THREE).reset(options={"scenaro": THREE})
    assert unknown.value.help == "did you mean `scenario`?"
    with pytest.raises(setpiece.ParameterError, match="no reset option `scenario`"):
        setpiece.make_vec(THREE).reset(options={"scenario": THREE})


def test_agents_of_a_parallel_environment_keep_their_names() -> None:
    pytest.importorskip("pettingzoo")
    env = setpiece.parallel_env(DRILL, right=1)
    other = DRILL.replace("-5m", "-8m")
    new = setpiece.parallel_env(other, right=1)
    env.reset(seed=1)
    actions = dict.fromkeys(env.possible_agents, Action.RIGHT)
    assert same(env.reset(seed=6, options={"scenario": other}), new.reset(seed=6))
    while new.agents:
        assert same(env.step(actions), new.step(actions))
    assert same(env.state(), new.state())
    for text, what in (
        (
            DRILL.replace("CF at", "anna: CF at"),
            "the agents would change from left_CF_1, right_CB_1 to anna",
        ),
        (DRILL.replace("CB at", "CM at (0.3, 0.3) CB at"), "would change"),
    ):
        with pytest.raises(setpiece.ParameterError, match=what):
            env.reset(options={"scenario": text})
    assert same(env.reset(seed=6), new.reset(seed=6))
