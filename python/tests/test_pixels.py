"""Pictures: observations in pixels, and frames for people."""

from __future__ import annotations

import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import setpiece
from setpiece import Action, gfootball

THREE = "academy_3_vs_1_with_keeper"


def played(env: setpiece.FootballEnv, steps: int = 20, seed: int = 3) -> np.ndarray:
    observation, _ = env.reset(seed=seed)
    for step in range(steps):
        observation, _, terminated, truncated, _ = env.step(
            [Action.RIGHT, Action.SPRINT, Action.SHOT][step % 3]
        )
        if terminated or truncated:
            break
    return observation


@pytest.mark.parametrize(
    ("kwargs", "shape"),
    [
        ({"observation": "pixels"}, (72, 96, 3)),
        ({"observation": "pixels_gray"}, (72, 96, 1)),
        ({"observation": "pixels", "stack": 4}, (72, 96, 12)),
        ({"observation": "pixels_gray", "stack": 4, "size": (84, 80)}, (80, 84, 4)),
        ({"observation": "pixels", "left": 3, "size": (40, 30)}, (3, 30, 40, 3)),
        ({"observation": "pixels", "size": (1280, 720)}, (720, 1280, 3)),
    ],
)
def test_pixels_have_the_shape_that_was_asked_for(
    kwargs: dict[str, Any], shape: tuple[int, ...]
) -> None:
    env = setpiece.make(THREE, **kwargs)
    observation, _ = env.reset(seed=1)
    assert observation.shape == shape
    assert observation.dtype == np.uint8
    assert env.observation_space.contains(observation)


@pytest.mark.parametrize("observation", ["pixels", "pixels_gray"])
def test_gymnasium_accepts_pixels_and_frames(observation: str) -> None:
    env = setpiece.make(
        THREE, observation=observation, render_mode="rgb_array", render_size=(64, 48)
    )
    check_env(env, skip_render_check=False)


def test_the_same_state_gives_the_same_bytes_on_any_thread() -> None:
    env = setpiece.make(THREE, observation="pixels")
    expected = played(env)

    def again(_: int) -> np.ndarray:
        return played(setpiece.make(THREE, observation="pixels"))

    with ThreadPoolExecutor(4) as pool:
        for other in pool.map(again, range(8)):
            assert np.array_equal(other, expected)
    copy = env.clone()
    assert np.array_equal(copy.look("pixels"), env.look("pixels"))


def test_a_picture_without_news_depends_on_the_state_alone() -> None:
    env = setpiece.make("11_vs_11_stochastic")
    env.reset(seed=1)
    generator, size = np.random.default_rng(0), (480, 270)
    while np.array_equal(env.picture(size), env.picture(size, news=False)):
        env.step(int(generator.integers(0, 19)))
    copy = env.clone()
    assert np.array_equal(copy.picture(size, news=False), env.picture(size, news=False))
    copy.restore(env.snapshot())
    assert np.array_equal(copy.picture(size, news=False), env.picture(size, news=False))
    assert np.array_equal(copy.look("pixels"), env.look("pixels"))


def test_several_matches_are_drawn_at_once() -> None:
    def frames(seed: int) -> list[np.ndarray]:
        env = setpiece.make(THREE, render_mode="rgb_array", render_size=(320, 180))
        env.reset(seed=seed)
        drawn = []
        for _ in range(5):
            env.step(Action.RIGHT)
            drawn.append(env.picture())
        return drawn

    alone = [frames(seed) for seed in range(4)]
    with ThreadPoolExecutor(4) as pool:
        together = [*pool.map(frames, range(4))]
    assert np.array_equal(alone, together)


def test_a_vector_in_pixels_is_fast() -> None:
    n, steps = 32, 50
    envs = setpiece.make_vec(THREE, n, observation="pixels", threads=1, copy=False)
    envs.reset(seed=1)
    actions = np.random.default_rng(0).integers(0, 19, (steps, n))

    def steps_per_second() -> float:
        begun = time.process_time()
        for each in actions:
            envs.step(each)
        return n * steps / (time.process_time() - begun)

    assert max(steps_per_second() for _ in range(4)) >= 5_000


def test_gray_is_the_gray_of_the_colours() -> None:
    env = setpiece.make(THREE, observation="pixels")
    env.reset(seed=1)
    colour, gray = env.look("pixels"), env.look("pixels_gray")
    assert np.abs(colour @ [0.299, 0.587, 0.114] - gray[..., 0]).max() <= 2


@pytest.mark.parametrize("line", ["CB at (30m, 4m)", "CB at (31m, 4m)", "CB at (30m, 5m)"])
def test_a_player_who_moves_a_metre_changes_the_picture(line: str) -> None:
    text = (
        "scenario s {{ ball at (25m, 0m) team left {{ CF at (24m, 0m) }} team right {{ {} }}"
        " end limit 9 steps }}"
    )

    def seen(player: str) -> np.ndarray:
        env = setpiece.make(text.format(player), observation="pixels")
        return env.reset(seed=1)[0]

    moved = np.any(seen(line) != seen("CB at (29m, 4m)"), axis=-1).sum()
    assert moved >= 4


def test_everyone_sees_themselves_in_the_same_kit_attacking_to_the_right() -> None:
    text = (
        "scenario s {{ agents {{ left: 1, right: 1 }} ball at ({0}10m, {0}5m) team {1} {{"
        " GK at ({2}50m, 0m) CF at ({0}8m, {0}3m) }} team {3} {{"
        " GK at ({0}50m, 0m) CF at ({0}12m, {0}7m) }} end limit 9 steps }}"
    ).format
    texts = text("", "left", "-", "right"), text("-", "right", "", "left")
    one, other = (setpiece.make(each, observation="pixels").reset(seed=1)[0] for each in texts)
    # The agents of a side keep their slots: left's view of one match is right's of the other.
    differs = np.any(one[0] != other[1], axis=-1).mean()
    assert differs < 0.02
    assert np.any(one[0] != one[1])


def test_a_vector_sees_what_single_environments_see() -> None:
    envs = setpiece.make_vec(THREE, 3, observation="pixels_gray", stack=2, threads=2)
    singles = [setpiece.make(THREE, observation="pixels_gray", stack=2) for _ in range(3)]
    seen, _ = envs.reset(seed=5)
    for at, single in enumerate(singles):
        assert np.array_equal(single.reset(seed=5 + at)[0], seen[at])
    for _ in range(10):
        seen = envs.step(np.full(3, Action.RIGHT))[0]
        for at, single in enumerate(singles):
            assert np.array_equal(single.step(Action.RIGHT)[0], seen[at])


def test_frames_are_of_the_size_and_camera_that_were_asked_for() -> None:
    env = setpiece.make(THREE, render_mode="rgb_array")
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.render()
    env.reset(seed=1)
    frame = env.render()
    assert isinstance(frame, np.ndarray)
    assert frame.shape == (720, 1280, 3)
    small = env.picture((320, 180))
    above = env.picture((320, 180), "above")
    assert small.shape == above.shape == (180, 320, 3)
    assert np.any(small != above)
    env.step(Action.RIGHT)
    assert np.any(env.picture((320, 180)) != small)


@pytest.mark.parametrize(
    ("kwargs", "name", "words"),
    [
        ({"render_mode": "rgb"}, "render_mode", "there are `ansi`, `rgb_array`, `human`"),
        ({"render_size": (0, 9)}, "render_size", "each in 1..4096"),
        ({"camera": "abov"}, "camera", "no camera `abov`"),
        ({"observation": "pixels", "size": (96, 5000)}, "size", "each in 1..4096"),
        ({"observation": "pixels", "scale": True}, "scale", "they are bytes"),
        ({"observation": "pixel"}, "observation", "no observation `pixel`"),
    ],
)
def test_a_wrong_option_is_named(kwargs: dict[str, Any], name: str, words: str) -> None:
    with pytest.raises(setpiece.ParameterError, match=words) as caught:
        setpiece.make(THREE, **kwargs)
    assert caught.value.name == name


def test_a_vector_draws_each_of_its_matches() -> None:
    envs = setpiece.make_vec(THREE, 3, render_mode="rgb_array", render_size=(64, 48))
    envs.reset(seed=1)
    frames = envs.render()
    assert isinstance(frames, tuple)
    assert [frame.shape for frame in frames] == [(48, 64, 3)] * 3


def test_a_window_needs_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pygame", None)
    with pytest.raises(setpiece.MissingPackageError) as caught:
        setpiece.make(THREE, render_mode="human")
    assert "setpiece[human]" in str(caught.value.help)


def test_pettingzoo_draws_too() -> None:
    env = setpiece.parallel_env(
        THREE, left=2, observation="pixels", render_mode="rgb_array", render_size=(64, 48)
    )
    observations, _ = env.reset(seed=1)
    assert {one.shape for one in observations.values()} == {(72, 96, 3)}
    assert env.render().shape == (48, 64, 3)


def test_the_drop_in_has_grf_s_pixels() -> None:
    make = gfootball.env.create_environment
    gray = make(THREE, representation="pixels_gray", stacked=True)
    assert gray.reset().shape == gray.observation_space.shape == (72, 96, 4)
    large = make(THREE, representation="pixels", channel_dimensions=(1280, 720))
    assert large.reset().shape == (720, 1280, 3)
    several = make(THREE, representation="pixels", number_of_left_players_agent_controls=3)
    assert several.reset().shape == (3, 72, 96, 3)
    observation, _, done, _ = several.step([0, 0, 0])
    assert observation.shape == (3, 72, 96, 3)
    assert not done


def test_the_drop_in_draws_once_it_is_asked_to() -> None:
    env = gfootball.env.create_environment(
        THREE, representation="raw", other_config_options={"render_resolution_x": 320}
    )
    assert "frame" not in env.reset()[0]
    frame = env.render(mode="rgb_array")
    assert frame.shape == (180, 320, 3)
    observation = env.step(0)[0][0]
    assert observation["frame"].shape == (180, 320, 3)
    state = env.get_state()
    before = env.step(5)[0][0]["frame"]
    env.set_state(state)
    assert np.array_equal(env.step(5)[0][0]["frame"], before)
    env.disable_render()
    assert "frame" not in env.step(0)[0][0]


def test_the_drop_in_sees_the_same_after_set_state() -> None:
    env = gfootball.env.create_environment(
        "11_vs_11_stochastic",
        representation="pixels",
        channel_dimensions=(480, 270),
        other_config_options={"game_engine_random_seed": 1},
    )
    env.reset()
    generator = np.random.default_rng(0)
    match = env.unwrapped
    while np.array_equal(match.picture((480, 270)), match.picture((480, 270), news=True)):
        env.step(int(generator.integers(0, 19)))
    state = env.get_state()
    expected = env.step(0)[0]
    env.set_state(state)
    assert np.array_equal(env.step(0)[0], expected)
