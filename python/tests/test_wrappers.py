"""Gymnasium's wrappers for statistics and videos, around single and vector environments."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers import RecordEpisodeStatistics, RecordVideo
from gymnasium.wrappers import vector as wrappers

import setpiece

THREE = "academy_3_vs_1_with_keeper"
SMALL: dict[str, Any] = {"render_mode": "rgb_array", "render_size": (160, 96)}
KEEPS_FIRST_STEP = tuple(map(int, gymnasium.__version__.split(".")[:2])) >= (1, 4)
"""Before, Gymnasium's statistics lost the first step of an episode that began in the same step."""


def episodes(env: Any, count: int) -> list[dict[str, Any]]:
    """Plays some episodes at random; returns their last infos."""
    generator = np.random.default_rng(1)
    lasts = []
    for at in range(count):
        env.reset(seed=at)
        over = False
        while not over:
            action = generator.integers(19, size=env.action_space.shape)
            *_, terminated, truncated, info = env.step(action)
            over = terminated or truncated
        lasts.append(info)
    return lasts


def until(envs: Any, ended: int) -> list[dict[str, Any]]:
    """Steps a vector at random until so many of its episodes have ended; returns all infos."""
    generator = np.random.default_rng(1)
    envs.reset(seed=3)
    shown: list[dict[str, Any]] = []
    over = 0
    while over < ended:
        actions = generator.integers(19, size=envs.action_space.shape)
        *_, terminations, truncations, infos = envs.step(actions)
        over += int((terminations | truncations).sum())
        shown.append(infos)
    return shown


@pytest.mark.parametrize("agents", [1, 3])
def test_statistics_of_an_environment_are_those_of_its_summary(agents: int) -> None:
    made = setpiece.make(THREE, left=agents, rewards="scoring,checkpoints", switching="fixed")
    infos = episodes(RecordEpisodeStatistics(made), 6)
    returns = []
    for info in infos:
        summary = info["setpiece"]
        assert info["episode"]["l"] == summary["length"]
        total = np.sum([*summary["return"].values()], axis=0)
        assert np.allclose(info["episode"]["r"], total, atol=1e-5)
        returns.append(np.max(total))
    assert max(returns) > 0


@pytest.mark.parametrize("mode", ["NEXT_STEP", "SAME_STEP"])
def test_statistics_of_a_vector_are_those_of_its_summaries(mode: str) -> None:
    if mode == "SAME_STEP" and not KEEPS_FIRST_STEP:
        pytest.skip("this Gymnasium loses the first step")
    envs = wrappers.RecordEpisodeStatistics(
        setpiece.make_vec(THREE, 5, rewards="scoring,checkpoints", autoreset_mode=mode)
    )
    ends, paid = 0, 0.0
    for infos in until(envs, 20):
        if "episode" not in infos:
            continue
        over = infos["_episode"]
        last = infos["final_info"] if mode == "SAME_STEP" else infos
        summary = last["setpiece"]
        total = np.sum([*summary["return"].values()], axis=0)
        assert (infos["episode"]["l"] == summary["length"])[over].all()
        assert np.allclose(infos["episode"]["r"][over], total[over], atol=1e-5)
        ends += int(over.sum())
        paid += float(total[over].sum())
    assert ends == envs.episode_count >= 20
    assert paid > 0


def frames(path: Path) -> tuple[int, tuple[int, int]]:
    """How many pictures a video has, and their size."""
    from moviepy import VideoFileClip

    with VideoFileClip(str(path)) as clip:
        return round(clip.duration * clip.fps), tuple(clip.size)


def test_a_video_of_every_second_episode(tmp_path: Path) -> None:
    pytest.importorskip("moviepy")
    env = RecordVideo(
        setpiece.make(THREE, **SMALL),
        str(tmp_path / "videos"),
        episode_trigger=lambda episode: episode % 2 == 0,
    )
    infos = episodes(RecordEpisodeStatistics(env), 4)
    env.close()
    videos = sorted(tmp_path.glob("videos/*.mp4"))
    assert [video.stem for video in videos] == ["rl-video-episode-0", "rl-video-episode-2"]
    for video, info in zip(videos, infos[::2], strict=True):
        # The start, and a picture after each step; MoviePy may lose the last one.
        count, size = frames(video)
        assert info["episode"]["l"] <= count <= info["episode"]["l"] + 1
        assert size == (160, 96)


@pytest.mark.parametrize(("first", "size"), [(False, (320, 192)), (True, (160, 96))])
def test_a_video_of_a_vector_at_intervals(
    tmp_path: Path, first: bool, size: tuple[int, int]
) -> None:
    """All matches beside each other, or the first alone, for some steps of every 40."""
    pytest.importorskip("moviepy")
    if not hasattr(wrappers, "RecordVideo"):
        pytest.skip("this Gymnasium records no vector")
    envs = wrappers.RecordVideo(
        setpiece.make_vec(THREE, 4, threads=1, **SMALL),
        str(tmp_path / "videos"),
        record_first_only=first,
        video_aspect_ratio=(16, 9),
        step_trigger=lambda step: step % 40 == 0,
        video_length=10,
    )
    envs.reset(seed=1)
    for _ in range(60):
        envs.step(np.full(4, setpiece.Action.RIGHT))
    envs.close()
    videos = sorted(tmp_path.glob("videos/*.mp4"))
    assert [video.stem for video in videos] == ["rl-video-step-0", "rl-video-step-40"]
    assert frames(videos[1])[1] == size
    assert 10 <= frames(videos[1])[0] <= 11


def test_a_video_of_a_vector_s_episode_has_all_of_its_steps(tmp_path: Path) -> None:
    pytest.importorskip("moviepy")
    if not hasattr(wrappers, "RecordVideo"):
        pytest.skip("this Gymnasium records no vector")
    envs = wrappers.RecordVideo(
        setpiece.make_vec(THREE, 2, threads=1, **SMALL),
        str(tmp_path / "videos"),
        record_first_only=True,
        episode_trigger=lambda episode: episode == 1,
    )
    lengths = []
    envs.reset(seed=1)
    while len(lengths) < 2:
        infos = envs.step(np.full(2, setpiece.Action.SHOT))[4]
        if infos.get("_setpiece", [False])[0]:
            lengths.append(int(infos["setpiece"]["length"][0]))
    # The picture of an end is that of the step before the next episode begins.
    envs.step(np.full(2, setpiece.Action.SHOT))
    envs.close()
    (video,) = tmp_path.glob("videos/*.mp4")
    assert lengths[1] <= frames(video)[0] <= lengths[1] + 1
    assert lengths[0] != lengths[1]
