"""A replay's file is read and played again from Python."""

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Trajectory, play, same

import setpiece

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"
FULL = "11_vs_11_stochastic"


def recorded(
    path: Path, scenario: Any, steps: int = 60, seed: int = 4, **kwargs: Any
) -> Trajectory:
    """Plays at random and saves the replay; returns the results of `reset` and each `step`."""
    env = setpiece.make(scenario, events=True, **kwargs)
    env.action_space.seed(seed)
    trajectory = play(env, seed, env.action_space.sample, steps)
    env.save_replay(path)
    return trajectory


def sealed(body: bytes) -> bytes:
    """A replay with a valid header: magic number, version, checksum and length."""
    deflater = zlib.compressobj(wbits=-zlib.MAX_WBITS)
    deflated = deflater.compress(body) + deflater.flush()
    return b"\x8bpitchr\n" + struct.pack("<IIQ", 2, zlib.crc32(deflated), len(deflated)) + deflated


@pytest.mark.parametrize(
    ("scenario", "kwargs"),
    [
        (CLOSE, {}),
        (THREE, {"left": 2, "right": "all"}),
        (THREE, {"left": ["left_CM_2"], "switching": "fixed", "rewards": "checkpoints"}),
        (FULL, {"left": 0, "right": 3, "action_set": "v2", "params": {"difficulty": 0.9}}),
        ("5_vs_5", {"left": 2, "action_set": "full"}),
        (FULL, {"left": 0}),
        (FULL, {"action_set": "continuous"}),
        (FULL, {"left": 3, "right": 1, "action_set": "continuous"}),
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
        assert all(
            same(mine, its) for mine, its in zip(moment.observations.values(), seen, strict=True)
        )
        if moment.step:
            assert list(moment.rewards.values()) == np.atleast_1d(reward).tolist()
        assert moment.events == info["events"]
        assert moment.info["score"] == info["score"]
    last = trajectory[-1][4]
    assert (replay.outcome, replay.score) == (last.get("outcome"), last["score"])


def test_it_tells_what_was_played(tmp_path: Path) -> None:
    env = setpiece.make(THREE, left=2, record=tmp_path, params={})
    env.reset(seed=7, options={"episode": 3})
    pressed = [
        [setpiece.Action.RIGHT, setpiece.Action.SPRINT],
        [setpiece.Action.SHOT, setpiece.Action.IDLE],
    ]
    info: dict[str, Any] = {}
    while "setpiece" not in info:
        info = env.step(pressed[0] if not info else pressed[1])[4]
    replay = setpiece.Replay(info["setpiece"]["replay"])
    assert (replay.scenario.name, replay.seed, replay.index) == (THREE, 7, 3)
    assert (replay.length, replay.digest) == (
        info["setpiece"]["length"],
        info["setpiece"]["digest"],
    )
    assert (replay.outcome, replay.score) == (info["outcome"], info["score"])
    start, first, *rest = replay
    assert (start.step, start.actions, start.rewards, start.events) == (0, {}, {}, [])
    assert first.actions == dict(zip(env.agents, pressed[0], strict=True))
    assert all(list(moment.actions.values()) == pressed[1] for moment in rest)
    assert repr(replay) == f"Replay({THREE}, seed=7, index=3, length={replay.length})"


def test_continuous_actions_come_back_as_they_were_played(tmp_path: Path) -> None:
    # Many steps: rounding lets about one direction in three hundred be cut twice.
    recorded(tmp_path / "x.pitchr", FULL, steps=3000, action_set="continuous")
    replay = setpiece.Replay(tmp_path / "x.pitchr")
    assert replay.action_set == "continuous"
    actions = [next(iter(moment.actions.values())) for moment in list(replay)[1:]]
    env = setpiece.make(FULL, action_set="continuous")
    env.reset(seed=4)
    for action in actions:
        env.step(action)
    env.save_replay(tmp_path / "again.pitchr")
    assert (tmp_path / "again.pitchr").read_bytes() == (tmp_path / "x.pitchr").read_bytes()


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
    body = zlib.decompress(good[24:], -zlib.MAX_WBITS)
    head, acts = body.split(b"dacts\x85")
    version = good[:8] + struct.pack("<I", 99) + good[12:]
    flipped = good[:-1] + bytes([good[-1] ^ 1])
    for bad, why in [
        (b"", "not a replay"),
        (b"scenario x {}", "not a replay"),
        (good[:20], "truncated"),
        (good[:-1], "truncated"),
        (version, "version 99"),
        (flipped, "checksum"),
        (good + b"x", "checksum"),
        (sealed(b""), "the replay is damaged"),
        (sealed(b"\x9b" + b"\xff" * 8), "the replay is damaged"),
        (sealed(b"\x81" * 100_000), "the replay is damaged"),
        (sealed(body[:-9]), "the replay is damaged"),
        (
            sealed(body.replace(b"flength\x05", b"flength\x06")),
            "one action for each agent and step",
        ),
        (sealed(body.replace(b"flength\x05", b"flength\x25")), "the replay is damaged"),
        (sealed(head + b"dacts\x85\x18\x40" + acts[1:]), "no action has the number 64"),
        (sealed(body.replace(b"\x18\x8b\x18p", b"\x18\x8b\x18q")), "the replay is damaged"),
        (sealed(body.replace(b"gphysics\xf6", b"gphysics\x65loose")), "the replay is damaged"),
    ]:
        path.write_bytes(bad)
        with pytest.raises(setpiece.ReplayError, match=why) as caught:
            setpiece.Replay(path)
        assert str(path) in str(caught.value), why
        assert caught.value.code == "SP0014"
    for missing in (tmp_path / "none.pitchr", tmp_path):
        with pytest.raises(setpiece.FileError, match=r"no file|directory") as unread:
            setpiece.Replay(missing)
        assert unread.value.path == str(missing)


def test_an_episode_that_diverges_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "x.pitchr"
    recorded(path, CLOSE, steps=5)
    body = zlib.decompress(path.read_bytes()[24:], -zlib.MAX_WBITS)
    head, acts = body.split(b"dacts\x85")
    path.write_bytes(
        sealed(head + b"dacts\x85" + bytes(5 if act != 5 else 1 for act in acts[:5]) + acts[5:])
    )
    replay = setpiece.Replay(path)
    with pytest.raises(
        setpiece.ReplayError, match="step 5: this build diverges from the recording"
    ):
        list(replay)
    assert head.count(b"flength\x05") == 1
    path.write_bytes(sealed(head.replace(b"flength\x05", b"flength\x00") + b"dacts\x80" + acts[5:]))
    with pytest.raises(
        setpiece.ReplayError, match="step 0: this build diverges from the recording"
    ):
        list(setpiece.Replay(path))
