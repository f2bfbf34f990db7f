"""Options for learners: held keys after `simple115v2`, and scaled numbers."""

import pickle
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import same
from gymnasium.utils.env_checker import check_env

import setpiece
from setpiece import Action, Policy
from setpiece._spaces import OBSERVATIONS, UNSCALED, Block

THREE = "academy_3_vs_1_with_keeper"
STICKY = "simple115v2+sticky"
SCALABLE = [kind for kind in OBSERVATIONS if kind not in UNSCALED]
HELD = slice(115, 125)


def episode(env: Any, steps: int = 60) -> list[Any]:
    """Plays random actions and returns every observation and mask."""
    generator = np.random.default_rng(1)
    observation, info = env.reset(seed=2)
    seen = [(observation, info["action_mask"])]
    for _ in range(steps):
        observation, _, terminated, truncated, info = env.step(
            generator.integers(19, size=env.action_space.shape)
        )
        seen.append((observation, info["action_mask"]))
        if terminated or truncated:
            break
    return seen


@pytest.mark.parametrize("action_set", ["default", "v2", "full"])
def test_sticky_is_simple115v2_and_the_held_keys(action_set: str) -> None:
    env = setpiece.make(THREE, observation=STICKY, action_set=action_set)
    generator = np.random.default_rng(1)
    shown, _ = env.reset(seed=2)
    held = 0
    for _ in range(60):
        raw = env.look("raw")
        assert np.array_equal(shown[:115], env.look("simple115v2"))
        assert np.array_equal(shown[HELD], raw["sticky_actions"][:10])
        assert np.array_equal(shown[HELD], env.look("egocentric")[7:17])
        held += int(shown[HELD].sum())
        shown, _, terminated, truncated, _ = env.step(generator.integers(19))
        if terminated or truncated:
            break
    assert held > 10


def test_the_layout_names_the_held_keys() -> None:
    env = setpiece.make(THREE, observation=STICKY)
    assert env.observation_layout[:-1] == setpiece.make(THREE).observation_layout
    assert env.observation_layout[-1] == Block(115, 10, "held actions", "flags of `sticky_actions`")
    assert env.observation_space.shape == (125,)
    assert (env.observation_space.low[HELD] == 0).all()
    assert (env.observation_space.high[HELD] == 1).all()


def test_masks_tell_which_keys_are_held_and_simple115v2_does_not() -> None:
    """Two states with the same `simple115v2` have different masks.

    `simple115v2+sticky` distinguishes them.
    """
    env = setpiece.make(THREE, observation=STICKY)
    free, info = env.reset(seed=1)
    assert info["action_mask"][Action.RIGHT] == 1
    assert info["action_mask"][Action.RELEASE_DIRECTION] == 0
    held, *_, info = env.step(Action.RIGHT)
    assert info["action_mask"][Action.RIGHT] == 0
    assert info["action_mask"][Action.RELEASE_DIRECTION] == 1
    assert not free[HELD].any()
    assert np.flatnonzero(held[HELD]).tolist() == [4]
    differ = 0
    for shown, mask in episode(env):
        directions = [Action.LEFT, Action.TOP_LEFT, Action.TOP, Action.TOP_RIGHT]
        directions += [Action.RIGHT, Action.BOTTOM_RIGHT, Action.BOTTOM, Action.BOTTOM_LEFT]
        keys = [*directions, Action.SPRINT, Action.DRIBBLE]
        assert (mask[keys] == 1 - shown[HELD]).all()
        differ += int(shown[HELD].any())
    assert differ


@pytest.mark.parametrize("kind", SCALABLE)
@pytest.mark.parametrize("name", [THREE, "11_vs_11_stochastic", "academy_empty_goal_close"])
def test_scaled_observations_pass_the_checker_and_stay_in_their_space(kind: str, name: str) -> None:
    env = setpiece.make(name, observation=kind, scale=True)
    check_env(env)
    for shown, _ in episode(env):
        assert env.observation_space.contains(shown)


def test_scaled_simple115v2_is_in_metres_and_seconds() -> None:
    env = setpiece.make(THREE, scale=True)
    for seed in range(3):
        shown, _ = env.reset(seed=seed)
        over = False
        while not over:
            raw = env.look("raw")
            metres = np.array([54.4, 83.6])
            for start, side, n in ((0, "left_team", 4), (44, "right_team", 2)):
                places, ways = shown[start : start + 22], shown[start + 22 : start + 44]
                assert np.allclose(places[: 2 * n], (raw[side] * metres / 50).ravel(), atol=1e-5)
                assert np.allclose(
                    ways[: 2 * n], (raw[f"{side}_direction"] * metres * 10 / 10).ravel(), atol=1e-4
                )
                # Constants would be -83.6 in some columns.
                assert not places[2 * n :].any()
                assert not ways[2 * n :].any()
            assert np.allclose(
                shown[88:91], raw["ball"] * [54.4 / 50, 83.6 / 50, 1 / 10], atol=1e-5
            )
            assert np.allclose(shown[91:94], raw["ball_direction"] * [54.4, 83.6, 1], atol=1e-4)
            assert np.array_equal(shown[94:], env.look("simple115v2")[94:])
            shown, _, terminated, truncated, _ = env.step(Action.RIGHT)
            over = terminated or truncated


@pytest.mark.parametrize("kind", SCALABLE)
def test_most_scaled_numbers_are_of_the_size_of_one(kind: str) -> None:
    seen = np.array(
        [
            shown
            for shown, _ in episode(
                setpiece.make("11_vs_11_stochastic", observation=kind, scale=True)
            )
        ]
    )
    assert np.abs(seen).max() < 5
    assert np.quantile(np.abs(seen), 0.95) <= 1.3


@pytest.mark.parametrize("kind", SCALABLE)
def test_flags_and_the_meanings_stay(kind: str) -> None:
    plain, scaled = (
        setpiece.make(THREE, observation=kind),
        setpiece.make(THREE, observation=kind, scale=True),
    )
    assert scaled.observation_space.shape == plain.observation_space.shape
    pairs = zip(plain.observation_layout, scaled.observation_layout, strict=True)
    changed = 0
    for before, after in pairs:
        assert isinstance(after, Block)
        assert (before[:3]) == after[:3]
        where = slice(after.start, after.start + after.length)
        if before[3] == after.unit:
            assert np.array_equal(
                plain.observation_space.high[where], scaled.observation_space.high[where]
            )
        else:
            changed += 1
    assert changed >= 6


@pytest.mark.parametrize("kind", SCALABLE)
@pytest.mark.parametrize("stack", [1, 3])
def test_every_kind_of_environment_scales_alike(kind: str, stack: int) -> None:
    shown: dict[str, Any] = {
        "observation": kind,
        "scale": True,
        "stack": stack,
        "left": 2,
        "switching": "fixed",
    }
    single, vector = setpiece.make(THREE, **shown), setpiece.make_vec(THREE, 2, **shown)
    assert vector.single_observation_space == single.observation_space
    assert vector.observation_layout == single.observation_layout
    expected, rows = single.reset(seed=4)[0], vector.reset(seed=4)[0]
    for _ in range(5):
        assert same(rows[0], expected)
        expected = single.step([Action.RIGHT, Action.TOP])[0]
        rows = vector.step(np.array([[Action.RIGHT, Action.TOP]] * 2))[0]


@pytest.mark.parametrize("kind", SCALABLE)
def test_parallel_environments_scale_too(kind: str) -> None:
    shown: dict[str, Any] = {"observation": kind, "scale": True, "left": 2}
    single, parallel = (
        setpiece.make(THREE, switching="fixed", **shown),
        setpiece.parallel_env(THREE, **shown),
    )
    expected, parts = single.reset(seed=4)[0], parallel.reset(seed=4)[0]
    assert parallel.observation_layout == single.observation_layout
    assert same(np.stack([*parts.values()]), expected)
    for agent, part in parts.items():
        assert parallel.observation_space(agent).contains(part)


def test_scale_is_off_unless_asked_for() -> None:
    assert same(episode(setpiece.make(THREE)), episode(setpiece.make(THREE, scale=False)))
    assert not same(episode(setpiece.make(THREE)), episode(setpiece.make(THREE, scale=True)))


def test_copies_pickles_and_specs_keep_the_scale() -> None:
    env = setpiece.make(THREE, observation=STICKY, scale=True)
    env.reset(seed=1)
    expected = env.clone().step(Action.RIGHT)[0]
    assert same(pickle.loads(pickle.dumps(env)).step(Action.RIGHT)[0], expected)
    assert env.spec is not None
    assert env.spec.make().observation_space == env.observation_space
    made = gymnasium.make(f"setpiece:setpiece/{THREE}-v0", observation=STICKY, scale=True)
    assert made.observation_space == env.observation_space
    envs = setpiece.make_vec(THREE, 2, observation=STICKY, scale=True)
    assert envs.spec is not None
    assert envs.spec.make().observation_space == env.observation_space


def test_looking_can_scale() -> None:
    env = setpiece.make(THREE)
    env.reset(seed=1)
    expected = setpiece.make(THREE, observation="egocentric", scale=True).reset(seed=1)[0]
    assert same(env.look("egocentric", scale=True), expected)
    assert not same(env.look("egocentric"), expected)
    with pytest.raises(setpiece.ParameterError, match="can't be scaled"):
        env.look("raw", scale=True)


@pytest.mark.parametrize("kind", SCALABLE)
def test_an_opponent_sees_its_observation_scaled(kind: str) -> None:
    seen: list[Any] = []

    def watch(observation: Any) -> int:
        seen.append(observation.copy())
        return int(Action.RIGHT)

    policy = Policy(watch, kind, batched=False, scale=True)
    opposed = setpiece.make("1_vs_1_easy", left=1, right=1, opponents={"right": policy})
    caller = setpiece.make("1_vs_1_easy", left=1, right=1, observation=kind, scale=True)
    opposed.reset(seed=2)
    expected = [caller.reset(seed=2)[0][1]]
    for _ in range(10):
        opposed.step(Action.RIGHT)
        expected.append(caller.step([Action.RIGHT, Action.RIGHT])[0][1])
    assert same(seen, expected[:-1])


def test_a_policy_that_is_scaled_names_its_observation() -> None:
    for policy, match in (
        (Policy(lambda _: 0, scale=True), "scales nothing without an observation of its own"),
        (Policy(lambda _: 0, "smm", scale=True), "`smm` can't be scaled: its pixels are bytes"),
        (Policy(lambda _: 0, "egocentric", scale="yes"), "expected True or False as `scale`"),  # type: ignore[arg-type]
    ):
        with pytest.raises(setpiece.ParameterError, match=match):
            setpiece.make(THREE, right=1, opponents={"right": policy})


@pytest.mark.parametrize("kind", [*UNSCALED, "extracted"])
@pytest.mark.parametrize("make", [setpiece.make, setpiece.make_vec, setpiece.parallel_env])
def test_what_has_no_units_to_scale_is_refused(kind: str, make: Any) -> None:
    with pytest.raises(setpiece.ParameterError, match="can't be scaled: ") as caught:
        make(THREE, observation=kind, scale=True)
    assert caught.value.name == "scale"
    assert caught.value.help == "`simple115v2`, `simple115v2+sticky`, `egocentric` can"
    for wrong in (1, "yes", None):
        with pytest.raises(setpiece.ParameterError, match="expected True or False as `scale`"):
            make(THREE, scale=wrong)
