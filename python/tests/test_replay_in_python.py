"""A replay's file is read and played again from Python."""

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Trajectory, play, same

import setpiece

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"
FULL = "11_vs_11_stochastic"


def recorded(path: Path, scenario: Any, steps: int = 60, seed: int = 4, **kwargs: Any) -> Trajectory:
    """Plays at random, writes the replay, and returns what `reset` and each `step` gave."""
    env = setpiece.make(scenario, events=True, **kwargs)
    env.action_space.seed(seed)
    trajectory = play(env, seed, env.action_space.sample, steps)
    env.save_replay(path)
    return trajectory


@pytest.mark.parametrize(
    ("scenario", "kwargs"),
    [
        (CLOSE, {}),
        (THREE, {"left": 2, "right": "all"}),
        (THREE, {"left": ["left_CM_2"], "switching": "fixed", "rewards": "checkpoints"}),
        (FULL, {"left": 0, "right": 3, "action_set": "v2", "params": {"difficulty": 0.9}}),
        ("5_vs_5", {"left": 2, "action_set": "full"}),
        (FULL, {"left": 0}),
    ],
)
@pytest.mark.parametrize("observation", ["raw", "simple115v2", "smm"])
def test_every_moment_is_shown_as_it_was(
    tmp_path: Path, scenario: str, kwargs: dict[str, Any], observation: str
) -> None:
    trajectory = recorded(tmp_path / "x.pitchr", scenario, observation=observation, **kwargs)
    replay = setpiece.Replay(tmp_path / "x.pitchr")
    moments = list(replay.moments(observation))
    assert [moment.step for moment in moments] == list(range(len(trajectory)))
    n_agents = len(replay.agents)
    for moment, (seen, reward, *_, info) in zip(moments, trajectory, strict=True):
        seen = (seen,) if n_agents == 1 else seen
        assert list(moment.observations) == [agent.id for agent in replay.agents]
        assert all(same(mine, its) for mine, its in zip(moment.observations.values(), seen, strict=True))
        if moment.step:
            assert list(moment.rewards.values()) == np.atleast_1d(reward).tolist()
        assert moment.events == info["events"]
        assert moment.info["score"] == info["score"]
    last = trajectory[-1][4]
    assert (replay.outcome, replay.score) == (last.get("outcome"), last["score"])


def test_it_tells_what_was_played(tmp_path: Path) -> None:
    env = setpiece.make(THREE, left=2, record=tmp_path, params={})
    env.reset(seed=7, options={"episode": 3})
    pressed = [[setpiece.Action.RIGHT, setpiece.Action.SPRINT], [setpiece.Action.SHOT, setpiece.Action.IDLE]]
    info: dict[str, Any] = {}
    while "setpiece" not in info:
        info = env.step(pressed[0] if not info else pressed[1])[4]
    replay = setpiece.Replay(info["setpiece"]["replay"])
    assert (replay.scenario.name, replay.seed, replay.index) == (THREE, 7, 3)
    assert (replay.length, replay.digest) == (info["setpiece"]["length"], info["setpiece"]["digest"])
    assert (replay.outcome, replay.score) == (info["outcome"], info["score"])
    start, first, *rest = replay
    assert (start.step, start.actions, start.rewards, start.events) == (0, {}, {}, [])
    assert first.actions == dict(zip(env.agents, pressed[0], strict=True))
    assert all(list(moment.actions.values()) == pressed[1] for moment in rest)
    assert repr(replay) == f"Replay({THREE}, seed=7, index=3, length={replay.length})"


def test_parameters_of_every_type_come_back(tmp_path: Path) -> None:
    text = """
    scenario many extends academy_empty_goal_close {
        param wide: length = 3m
        param count: int = 2
        param late: bool = false
        param side: team = left
        param word: string = "near" in ["near", "far"]
    }
    """
    given = {"wide": 4.5, "count": 3, "late": True, "side": "right", "word": "far"}
    recorded(tmp_path / "x.pitchr", setpiece.compile(text), steps=3, params=given)
    replay = setpiece.Replay(tmp_path / "x.pitchr")
    assert {name: replay.scenario.params[name].default for name in given} == given
    assert len(list(replay)) == 4


def test_an_episode_begun_from_a_snapshot(tmp_path: Path) -> None:
    env = setpiece.make(THREE, observation="raw")
    play(env, 1, lambda: setpiece.Action.RIGHT, steps=5)
    seen, _ = env.reset(seed=2, options={"snapshot": env.snapshot()})
    after = env.step(setpiece.Action.SHOT)[0]
    env.save_replay(tmp_path / "x.pitchr")
    start, shot = setpiece.Replay(tmp_path / "x.pitchr")
    assert same([*start.observations.values(), *shot.observations.values()], [seen, after])


def test_opponents_are_agents_of_a_replay(tmp_path: Path) -> None:
    opponents = {"right": lambda _: setpiece.Action.LEFT}
    recorded(tmp_path / "x.pitchr", THREE, steps=4, right=1, opponents=opponents)
    replay = setpiece.Replay(tmp_path / "x.pitchr")
    assert [agent.team for agent in replay.agents] == [0, 1]
    assert all(moment.actions["right_0"] == setpiece.Action.LEFT for moment in list(replay)[1:])


def test_files_that_are_no_replays_are_named(tmp_path: Path) -> None:
    path = tmp_path / "x.pitchr"
    recorded(path, CLOSE, steps=5)
    good = path.read_bytes()
    version = good[:8] + struct.pack("<I", 99) + good[12:]
    flipped = good[:-1] + bytes([good[-1] ^ 1])
    for bad, why in [
        (b"", "doesn't begin as a replay"),
        (b"scenario x {}", "doesn't begin as a replay"),
        (good[:20], "cut off"),
        (good[:-1], "cut off"),
        (version, "version 99"),
        (flipped, "checksum"),
        (good + b"x", "checksum"),
    ]:
        path.write_bytes(bad)
        with pytest.raises(setpiece.ReplayError, match=why) as caught:
            setpiece.Replay(path)
        assert str(path) in str(caught.value)
        assert caught.value.code == "SP0014"
    for missing in (tmp_path / "none.pitchr", tmp_path):
        with pytest.raises(setpiece.FileError, match="can't be read") as unread:
            setpiece.Replay(missing)
        assert unread.value.path == str(missing)
