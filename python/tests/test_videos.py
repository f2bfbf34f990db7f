"""Videos, recordings of several qualities, and the drop-in's scripts and hands."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import setpiece
from setpiece import Action, gfootball
from setpiece.gfootball import dump_to_video, play_game, replay
from setpiece.gfootball.env._hands import Hands
from setpiece.gfootball.env.config import Config
from setpiece.gfootball.env.observation_processor import read_dump

CLOSE = "academy_empty_goal_close"


def scored(**kwargs: Any) -> tuple[setpiece.FootballEnv, dict[str, Any]]:
    env = setpiece.make(CLOSE, **kwargs)
    env.reset(seed=1)
    while True:
        _, _, terminated, truncated, info = env.step(Action.SHOT)
        if terminated or truncated:
            return env, info


def is_mp4(path: str | Path) -> bool:
    return Path(path).read_bytes()[4:8] == b"ftyp"


def test_a_replay_is_written_as_a_video(tmp_path: Path) -> None:
    env, _ = scored()
    env.save_replay(tmp_path / "a.pitchr")
    recorded = setpiece.Replay(tmp_path / "a.pitchr")
    recorded.video(tmp_path / "a.mp4", size=(160, 90))
    recorded.video(tmp_path / "b.mp4", size=(160, 90))
    recorded.video(tmp_path / "a.gif", size=(96, 54), camera="above", speed=2)
    assert is_mp4(tmp_path / "a.mp4")
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "b.mp4").read_bytes()
    assert (tmp_path / "a.gif").read_bytes().startswith(b"GIF89a")
    for kwargs, name in [
        ({"size": (161, 90)}, "size"),
        ({"speed": 0}, "speed"),
        ({"speed": "fast"}, "speed"),
        ({"quality": "best"}, "quality"),
        ({"camera": "side"}, "camera"),
    ]:
        with pytest.raises(setpiece.ParameterError) as caught:
            recorded.video(tmp_path / "c.mp4", **kwargs)
        assert caught.value.name == name
    with pytest.raises(setpiece.ParameterError, match="can't be written as"):
        recorded.video(tmp_path / "c.avi")
    assert not (tmp_path / "c.mp4").exists()


def test_episodes_are_recorded_with_their_video(tmp_path: Path) -> None:
    _, info = scored(record=tmp_path, record_when="goal", record_quality="low")
    summary = info["setpiece"]
    assert is_mp4(summary["video"])
    assert Path(summary["video"]).with_suffix(".pitchr") == Path(summary["replay"])
    with pytest.raises(setpiece.ParameterError, match="needs a folder"):
        setpiece.make(CLOSE, record_quality="low")
    with pytest.raises(setpiece.ParameterError, match="no quality"):
        setpiece.make(CLOSE, record=tmp_path, record_quality="best")


def dumped(tmp_path: Path, **kwargs: Any) -> list[dict[str, str]]:
    env = gfootball.env.create_environment(
        CLOSE,
        representation="raw",
        write_goal_dumps=True,
        write_full_episode_dumps=True,
        logdir=str(tmp_path),
        **kwargs,
    )
    env.reset()
    dumps: list[dict[str, str]] = []
    done = False
    while not done:
        _, _, done, info = env.step(12)
        dumps += info.get("dumps", [])
    return dumps


def test_a_video_lies_beside_each_dump(tmp_path: Path) -> None:
    small = {"render_resolution_x": 160, "video_quality_level": 1}
    dumps = dumped(tmp_path, write_video=True, other_config_options=small)
    assert {dump["name"] for dump in dumps} == {"score", "episode_done"}
    for dump in dumps:
        assert is_mp4(dump["video"])
        assert Path(dump["video"]).with_suffix(".dump") == Path(dump["dump"])
    assert all("video" not in dump for dump in dumped(tmp_path))


def test_a_dump_becomes_a_video_later(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    whole = next(dump for dump in dumped(tmp_path) if dump["name"] == "episode_done")
    assert dump_to_video.main([f"--trace_file={whole['dump']}", f"--directory={tmp_path}"]) == 0
    assert is_mp4(capsys.readouterr().out.strip())
    assert dump_to_video.main([f"--trace_file={tmp_path / 'none.dump'}"]) == 1
    assert "none.dump" in capsys.readouterr().err
    assert replay.main([f"--trace_file={whole['dump']}", "--render=false"]) == 0


def test_a_game_is_played_by_its_players(tmp_path: Path) -> None:
    arguments = ["--level", CLOSE, "--players", "builtin_ai:left_players=1", "--norender"]
    assert play_game.main([*arguments, "--real_time=false", "--episodes=1"]) == 0
    assert play_game.main(["--players", "agent:left_players=1"]) == 1
    assert play_game.main(["--players", "bot", "--render=perhaps"]) == 2
    assert not list(tmp_path.iterdir())


class Scripted(Hands):
    """Holds what it is given."""

    keys: tuple[tuple[int, int], tuple[str, ...]] = ((0, 0), ())

    def held(self) -> tuple[tuple[int, int], tuple[str, ...]]:
        return self.keys

    def press(self, *keys: str, way: tuple[int, int] = (0, 0)) -> str:
        self.keys = way, keys
        return str(self.take_action([]).name)


def test_hands_send_one_action_a_step() -> None:
    hands = Scripted({"left_players": 1, "right_players": 0}, Config({}))
    assert hands.press() == "idle"
    # A direction comes before a key, and both arrive.
    assert hands.press("sprint", way=(1, -1)) == "top_right"
    assert hands.press("sprint", way=(1, -1)) == "sprint"
    assert hands.press("sprint", way=(1, -1)) == "idle"
    # A kick lasts as long as its key; what it means without the ball isn't in this action set.
    assert hands.press("sprint", "shot", "team_pressure", way=(1, -1)) == "shot"
    assert hands.press("sprint", "shot", "team_pressure", way=(1, -1)) == "shot"
    assert hands.press("shot", way=(1, -1)) == "release_sprint"
    assert hands.press("shot", way=(1, -1)) == "shot"
    assert hands.press() == "release_direction"
    assert hands.press() == "idle"


def test_dumps_hold_no_moments(tmp_path: Path) -> None:
    small = {"render_resolution_x": 160}
    for dump in dumped(tmp_path, write_video=True, other_config_options=small):
        assert b"Moment" not in Path(dump["dump"]).read_bytes()
        for record in read_dump(dump["dump"]):
            assert set(record) == {"debug", "observation", "reward", "cumulative_reward"}
