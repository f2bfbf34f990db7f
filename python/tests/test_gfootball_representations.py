"""`create_environment`: what each representation shows."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import same
from gfootball_env import CLOSE, THREE, inside, make

import setpiece
from setpiece.gfootball.env.config import Config
from setpiece.gfootball.env.observation_preprocessing import generate_smm
from setpiece.gfootball.env.observation_rotation import flip_observation
from setpiece.gfootball.env.wrappers import Simple115StateWrapper

SHAPES = [
    ("extracted", False, (72, 96, 4), np.uint8),
    ("extracted", True, (72, 96, 16), np.uint8),
    ("simple115", False, (115,), np.float32),
    ("simple115", True, (460,), np.float32),
    ("simple115v2", False, (115,), np.float32),
    ("simple115v2", True, (460,), np.float32),
]


@pytest.mark.parametrize(("left", "right"), [(1, 0), (0, 1), (3, 0), (0, 2), (2, 2)])
@pytest.mark.parametrize(("representation", "stacked", "shape", "dtype"), SHAPES)
def test_shapes(
    representation: str, stacked: bool, shape: tuple[int, ...], dtype: Any, left: int, right: int
) -> None:
    env = make(left=left, right=right, representation=representation, stacked=stacked)
    agents = left + right
    expected = shape if agents == 1 else (agents, *shape)
    first = env.reset()
    observation, reward, done, info = env.step(env.action_space.sample())
    for seen in (first, observation):
        assert seen.shape == expected
        assert seen.dtype == dtype
        assert env.observation_space.contains(seen)
    assert env.observation_space.shape == expected
    if dtype == np.float32:
        assert np.all(np.isinf(env.observation_space.low))
    assert np.shape(reward) == (() if agents == 1 else (agents,))
    assert reward.dtype == np.float32
    assert done is False
    assert info == {"score_reward": 0.0}
    space = (
        gymnasium.spaces.Discrete(19)
        if agents == 1
        else gymnasium.spaces.MultiDiscrete([19] * agents)
    )
    assert env.action_space == space


@pytest.mark.parametrize(("left", "right"), [(1, 0), (0, 1), (2, 2)])
def test_raw_is_a_list_of_dicts(left: int, right: int) -> None:
    env = make(left=left, right=right, representation="raw")
    observation = env.reset()
    assert isinstance(observation, list)
    assert len(observation) == left + right
    assert env.observation_space.contains(observation)
    seen = observation[0]
    assert seen["left_team"].shape == ((4, 2) if left else (2, 2))
    assert type(seen["active"]) is int
    assert type(seen["steps_left"]) is int
    assert seen["steps_left"] == 401
    assert seen["score"] == [0, 0]
    assert seen["sticky_actions"].dtype == np.uint8
    assert seen["sticky_actions"].shape == (10,)


def test_without_an_agent_the_whole_match_is_shown() -> None:
    env = make(left=0, right=0)
    observation = env.reset()
    assert observation["left_agent_controlled_player"] == []
    assert env.observation_space.contains(observation)
    observation, reward, done, _ = env.step([])
    assert (reward, done) == (0.0, False)
    assert observation["steps_left"] == 400
    assert "active" not in observation


def test_channel_dimensions_are_width_and_height() -> None:
    env = make(channel_dimensions=(48, 36))
    assert env.reset().shape == (36, 48, 4)


def test_minimap_marks_everybody() -> None:
    env = make(CLOSE)
    frame = env.reset()
    assert set(np.unique(frame)) == {0, 255}
    # The ball at (0.77, 0): column 1.77 / 2 of 96, row half-way of 72.
    assert np.argwhere(frame[:, :, 2]).tolist() == [[36, 84]]
    assert np.count_nonzero(frame[:, :, 0]) == 2
    assert np.count_nonzero(frame[:, :, 3]) == 1


def test_simple115_of_few_players() -> None:
    raw, fixed, older = (make(representation=name) for name in ("raw", "simple115v2", "simple115"))
    seen, block, loose = raw.reset()[0], fixed.reset(), older.reset()
    assert np.allclose(block[:8], seen["left_team"].ravel())
    assert np.all(block[8:22] == -1)
    assert np.allclose(block[44:48], seen["right_team"].ravel())
    assert np.allclose(loose[8:16], seen["left_team_direction"].ravel())
    assert np.allclose(loose[16:20], seen["right_team"].ravel())
    assert np.all(loose[24:88] == -1)
    assert np.allclose(block[88:], loose[88:])
    assert block[94:97].sum() == 1
    assert block[97 + seen["active"]] == 1
    assert block[108 + seen["game_mode"]] == 1


def test_simple115v2_is_the_native_observation() -> None:
    env = make(representation="simple115v2", left=1)
    scenario = setpiece.compile(f"scenario same extends {THREE} {{ end limit 401 steps }}")
    native = setpiece.make(scenario, observation="simple115v2", action_set="v2")
    first, _ = native.reset(seed=7, options={"episode": 0})
    assert np.array_equal(env.reset(), first)
    for action in (5, 5, 13, 11, 0, 12, 3):
        assert np.array_equal(env.step(action)[0], native.step(action)[0])


def listed(seen: dict[str, Any]) -> dict[str, Any]:
    """An observation as it comes out of JSON."""
    return {
        key: value.tolist() if isinstance(value, np.ndarray) else value
        for key, value in seen.items()
    }


def test_lists_are_shown_as_arrays_are() -> None:
    raw = make(representation="raw", left=2, right=1).reset()
    for seen in raw:
        seen["left_team_active"][1] = False
    lists = [listed(seen) for seen in raw]
    assert np.array_equal(generate_smm(lists), generate_smm(raw))
    for fixed in (False, True):
        for kept in (False, True):
            numbers = Simple115StateWrapper.convert_observation(lists, fixed, kept)
            assert np.array_equal(
                numbers, Simple115StateWrapper.convert_observation(raw, fixed, kept)
            )
    config = Config({"level": THREE})
    for seen, plain in zip(raw, lists, strict=True):
        turned, expected = flip_observation(plain, config), flip_observation(seen, config)
        assert same(listed(turned), listed(expected))


def test_an_agent_of_kaggles_kind_makes_a_minimap() -> None:
    def agent(observation: Any) -> list[int]:
        assert generate_smm(observation["players_raw"]).shape == (1, 72, 96, 4)
        return [5]

    assert not setpiece.play("academy_empty_goal_close", agent, "bot", seed=1).errors


def test_observations_that_do_not_tell_all() -> None:
    raw = make(representation="raw").reset()
    untold = [
        {key: value for key, value in seen.items() if not key.endswith("_active")} for seen in raw
    ]
    assert np.array_equal(generate_smm(untold), generate_smm(raw))
    convert = Simple115StateWrapper.convert_observation
    assert np.array_equal(convert(untold, fixed_positions=True), convert(raw, fixed_positions=True))
    env = make(representation="raw")
    seen = env.reset()
    whole = [inside(env)._core.whole]
    assert np.array_equal(generate_smm(whole)[..., :3], generate_smm(seen)[..., :3])
    assert not generate_smm(whole)[..., 3].any(), "nobody is the active one of a whole match"
    assert np.array_equal(
        convert(whole, fixed_positions=True)[:, :97], convert(seen, fixed_positions=True)[:, :97]
    )
    assert not convert(whole, fixed_positions=True)[:, 97:108].any()
    assert not generate_smm([{"ball": [0.0, 0.0, 0.1]}])[..., :2].any()


@pytest.mark.parametrize(
    "config", [None, {"action_set": "default"}, {}, 7, "smm", Config({"level": THREE})]
)
def test_a_minimap_needs_no_config(config: Any) -> None:
    raw = make(representation="raw").reset()
    assert np.array_equal(generate_smm(raw, config), generate_smm(raw))


def test_settings_of_a_dump_wish_bugs_back_too() -> None:
    raw = make(representation="raw").reset()
    raw[0]["left_team_active"][2] = False
    for bugs, marked in [
        (True, 4),
        (["sent_off"], 4),
        ("sent_off", 4),
        (False, 3),
        (["kick_off_mode"], 3),
    ]:
        settings = Config({"level": THREE, "grf_bugs": bugs}).get_dictionary()
        assert np.count_nonzero(generate_smm(raw, settings)[0, :, :, 0]) == marked


def test_minimap_is_the_native_one() -> None:
    scenario = setpiece.compile(f"scenario same extends {THREE} {{ end limit 401 steps }}")
    native = setpiece.make(scenario, observation="smm", action_set="v2")
    env = make()
    assert np.array_equal(env.reset(), native.reset(seed=7, options={"episode": 0})[0])
    for action in (5, 5, 13, 11, 0, 12, 3):
        assert np.array_equal(env.step(action)[0], native.step(action)[0])
