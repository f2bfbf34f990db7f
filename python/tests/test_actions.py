"""Sets of actions and layouts of observations."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import same
from gymnasium.utils.env_checker import check_env

import setpiece
from setpiece import Action

THREE = "academy_3_vs_1_with_keeper"
FULL = "11_vs_11_stochastic"


def test_the_full_set_has_grfs_numbers() -> None:
    assert [action.name.lower() for action in Action] == [
        name for name, _ in setpiece._native.ACTIONS
    ]
    env = setpiece.make(FULL, action_set="full", observation="raw")
    assert env.action_space == gymnasium.spaces.Discrete(33)
    _, info = env.reset(seed=1)
    assert info["action_mask"].shape == (33,)
    held = env.step(Action.KEEPER_RUSH)[0]["sticky_actions"]
    assert held.shape == (13,)
    assert list(np.flatnonzero(held)) == [10]
    for action in (Action.PRESSURE, Action.TEAM_PRESSURE):
        held = env.step(action)[0]["sticky_actions"]
    assert list(np.flatnonzero(held)) == [10, 11, 12]
    for action in (
        Action.RELEASE_KEEPER_RUSH,
        Action.RELEASE_PRESSURE,
        Action.RELEASE_TEAM_PRESSURE,
    ):
        held = env.step(action)[0]["sticky_actions"]
    assert not held.any()
    check_env(env)


def test_keys_that_let_themselves_go_have_nothing_to_release() -> None:
    env = setpiece.make(FULL, action_set="full")
    env.reset(seed=1)
    rng = np.random.default_rng(0)
    for _ in range(200):
        mask = env.step(int(rng.integers(33)))[4]["action_mask"]
        assert not mask[[24, 25, 26, 27, 29, 32]].any()


@pytest.mark.parametrize("action_set", ["default", "v2", "full", "continuous"])
@pytest.mark.parametrize("left", [1, "all"])
def test_every_set_passes_the_checker(action_set: str, left: Any) -> None:
    env = setpiece.make(THREE, action_set=action_set, left=left)
    if left == 1:
        check_env(env)
    env.reset(seed=1)
    for _ in range(10):
        if env.step(env.action_space.sample())[2]:
            env.reset()


def test_numbers_run_at_any_angle() -> None:
    env = setpiece.make("academy_empty_goal", action_set="continuous", observation="raw")
    env.reset(seed=1)
    assert env.action_space == gymnasium.spaces.Box(
        np.float32([-1, -1, -1, 0]), np.float32([1, 1, 1, 1])
    )
    for _ in range(15):
        seen = env.step([0.6, 0.8, -1.0, 0.0])[0]
    dx, dy = seen["left_team_direction"][1] * (54.4, 83.6)
    assert np.arctan2(dy, dx) == pytest.approx(np.arctan2(0.8, 0.6), abs=0.3)
    assert env.action_masks().shape == (6,)


def test_numbers_that_are_none_are_refused() -> None:
    env = setpiece.make(THREE, action_set="continuous")
    env.reset(seed=1)
    for wrong in ([0.0] * 3, [np.nan, 0, 0, 0], "abcd", None, [[0.0] * 4] * 2, 3, [np.inf] * 4):
        with pytest.raises(setpiece.ActionError, match=r"\(4,\)"):
            env.step(wrong)
    env.step(np.zeros(4))
    two = setpiece.make(THREE, action_set="continuous", left=2)
    two.reset(seed=1)
    with pytest.raises(setpiece.ActionError, match=r"\(2, 4\)"):
        two.step(np.zeros(4))
    two.step(np.zeros((2, 4)))
    with pytest.raises(setpiece.ParameterError, match="with opponents"):
        setpiece.make(THREE, action_set="continuous", right=1, opponents={"right": "bot"})


@pytest.mark.parametrize(
    "observation", ["simple115v2", "simple115v2+sticky", "simple115", "egocentric", "smm", "raw"]
)
@pytest.mark.parametrize("stack", [1, 3])
def test_the_layout_covers_the_observation(observation: str, stack: int) -> None:
    if observation == "raw":
        env = setpiece.make(FULL, observation="raw")
        seen, _ = env.reset(seed=1)
        for key in env.observation_layout:
            value = np.asarray(seen[key.name])
            assert value.shape == key.shape
            assert key.meaning
        assert {key.name for key in env.observation_layout} == set(seen)
        return
    env = setpiece.make(FULL, observation=observation, stack=stack)
    seen, _ = env.reset(seed=1)
    at = 0
    for block in env.observation_layout:
        assert block.start == at
        assert block.meaning
        at += block.length
    assert at == seen.shape[-1]
    assert env.observation_space.contains(seen)
    check_env(env)


def test_what_is_egocentric_is_seen_from_the_player() -> None:
    env = setpiece.make(THREE, observation="egocentric")
    raw = env.reset(seed=1)[0], env.look("raw")
    blocks = {
        block.meaning: slice(block.start, block.start + block.length)
        for block in env.observation_layout
    }
    me = raw[1]["left_team"][raw[1]["active"]] * (54.4, 83.6)
    ball = raw[1]["ball"][:2] * (54.4, 83.6)
    assert raw[0][blocks["from me to the ball"]] == pytest.approx((ball - me) / 54.4, abs=1e-4)
    mates = sorted(np.hypot(*(place * (54.4, 83.6) - me)) for place in raw[1]["left_team"])[1:]
    seen = [raw[0][where] for meaning, where in blocks.items() if meaning.startswith("mate ")]
    assert [mate[5] * 128 for mate in seen] == pytest.approx(mates, abs=1e-3)


def test_any_size_of_map_and_grfs_name_of_it() -> None:
    env = setpiece.make(THREE, observation="extracted", size=(48, 30))
    assert env.observation == "smm"
    assert env.reset(seed=1)[0].shape == (30, 48, 4)
    assert setpiece.make(THREE, observation="smm", stack=4).reset(seed=1)[0].shape == (72, 96, 16)


def test_a_stack_shows_the_oldest_first_and_begins_with_the_first() -> None:
    stacked, plain = setpiece.make(THREE, stack=4), setpiece.make(THREE)
    wide, one = stacked.reset(seed=1)[0], plain.reset(seed=1)[0]
    assert np.array_equal(wide, np.tile(one, 4))
    shown = [one] * 4
    for _ in range(6):
        wide, one = stacked.step(Action.RIGHT)[0], plain.step(Action.RIGHT)[0]
        shown = [*shown[1:], one]
        assert np.array_equal(wide, np.concatenate(shown))
    other = stacked.clone()
    assert same(other.step(Action.SHOT), stacked.step(Action.SHOT)), (
        "a clone has what the stack holds"
    )
    with pytest.raises(setpiece.ParameterError, match="can't be stacked"):
        setpiece.make(THREE, observation="raw", stack=2)


def test_agents_asked_for_take_the_place_of_the_scenarios() -> None:
    assert setpiece.make(FULL, left=3).agents == ("left_0", "left_1", "left_2")
    assert setpiece.make(FULL, left=1, right=1, switching="fixed").agents == (
        "left_RM_1",
        "right_RM_1",
    )
    assert len(setpiece.make(FULL, left="all", right="all").agents) == 22
    assert setpiece.make(FULL, left=["left_GK_1", "left_CF_1"]).agents == ("left_GK_1", "left_CF_1")
    env = setpiece.make(THREE, left=2, right=1)
    assert env.reset(seed=1)[0].shape == (3, 115)
    assert same(env.clone().step([1, 2, 3]), env.step([1, 2, 3]))
    with pytest.raises(setpiece.ParameterError, match="`switching` is `never`"):
        setpiece.make(THREE, switching="never")  # type: ignore[arg-type]
