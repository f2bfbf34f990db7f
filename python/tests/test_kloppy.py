"""Tracking and event data of replays, read by kloppy and held to the format's own validator."""

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece
from setpiece import Replay
from setpiece._replay_command import main

kloppy = pytest.importorskip("kloppy", reason="kloppy isn't installed")
cdf = pytest.importorskip("cdf", reason="common-data-format-validator isn't installed")

from kloppy.domain import EventType, PassResult, ShotResult  # noqa: E402

from setpiece.kloppy import load_event, load_tracking  # noqa: E402

X_SCALE_M, Y_SCALE_M = 54.4, 83.6
FILES = {
    "cdf": ["meta.json", "tracking.jsonl", "event.jsonl", "pitch.json"],
    "csv": ["meta.json", "tracking.csv", "events.csv", "pitch.json"],
}


def recorded(scenario: str, path: Path, seed: int, steps: int = 400) -> Replay:
    """Records an episode that the built-in bot plays."""
    env = setpiece.make(scenario, bot_action=True)
    _, info = env.reset(seed=seed)
    for _ in range(steps):
        _, _, terminated, truncated, info = env.step(info["bot_action"])
        if terminated or truncated:
            break
    env.save_replay(path)
    return Replay(path)


@pytest.fixture(scope="module")
def replay(tmp_path_factory: pytest.TempPathFactory) -> Replay:
    path = tmp_path_factory.mktemp("replay") / "match.pitchr"
    return recorded("11_vs_11_easy_stochastic", path, seed=3)


@pytest.mark.parametrize("form", ["cdf", "csv"])
def test_kloppy_reads_the_frames_that_agents_observe(
    replay: Replay, tmp_path: Path, form: str
) -> None:
    paths = replay.export(tmp_path / "made" / form, form)
    assert [path.name for path in paths] == FILES[form]
    tracking = load_tracking(tmp_path / "made" / form)
    assert tracking.frame_rate == 10
    assert len(tracking) == replay.length + 1
    moments = list(replay)
    for moment, frame in zip(moments, tracking.frames, strict=True):
        raw = moment.observations["left_0"]
        scale = np.array([X_SCALE_M, -Y_SCALE_M])
        assert frame.frame_id == moment.step
        assert frame.timestamp.total_seconds() == pytest.approx(moment.step / 10)
        ball = [frame.ball_coordinates.x, frame.ball_coordinates.y]
        assert ball == pytest.approx(raw["ball"][:2] * scale, abs=1e-4)
        for team, key in (("left", "left_team"), ("right", "right_team")):
            shown = [
                [data.coordinates.x, data.coordinates.y]
                for player, data in frame.players_data.items()
                if player.team.team_id == team
            ]
            assert np.array(shown) == pytest.approx(raw[key] * scale, abs=1e-4)
    assert {frame.ball_state.value for frame in tracking.frames} == {"alive", "dead"}
    assert {str(frame.ball_owning_team) for frame in tracking.frames} >= {"left", "None"}


def test_both_forms_say_the_same(replay: Replay, tmp_path: Path) -> None:
    for form in FILES:
        replay.export(tmp_path / form, form)
    one, other = (load_tracking(tmp_path / form) for form in FILES)
    speeds = []
    for frame, same in zip(one.frames, other.frames, strict=True):
        assert frame.ball_coordinates == same.ball_coordinates
        assert frame.players_coordinates == same.players_coordinates
        for player, data in frame.players_data.items():
            assert data.speed == pytest.approx(same.players_data[player].speed, abs=1e-5)
            speeds.append(data.speed)
    assert 5 < max(speeds) < 12
    events, same_events = (load_event(tmp_path / form).to_df() for form in FILES)
    assert len(events) > 50
    assert events.equals(same_events)


def test_every_line_is_valid_common_data_format(replay: Replay, tmp_path: Path) -> None:
    replay.export(tmp_path, "cdf")
    strict: dict[str, Any] = {"mode": "extreme"}
    cdf.MetaSchemaValidator().validate_schema(tmp_path / "meta.json", **strict)
    cdf.TrackingSchemaValidator().validate_schema(tmp_path / "tracking.jsonl", limit=None, **strict)
    cdf.EventSchemaValidator().validate_schema(tmp_path / "event.jsonl", limit=None, **strict)
    broken = (tmp_path / "event.jsonl").read_text().replace('"is_successful"', '"is_fine"')
    (tmp_path / "event.jsonl").write_text(broken)
    with pytest.raises(Exception, match="is_successful"):
        cdf.EventSchemaValidator().validate_schema(tmp_path / "event.jsonl", limit=None, **strict)


def test_passes_and_shots_are_what_the_engine_reports(replay: Replay, tmp_path: Path) -> None:
    replay.export(tmp_path)
    noted = [event for moment in replay for event in moment.events]
    events = load_event(tmp_path)
    for kind, result, qualifier in (
        (EventType.PASS, PassResult.COMPLETE, "completed"),
        (EventType.SHOT, ShotResult.BLOCKED, "blocked"),
    ):
        word = kind.value.lower()
        ours = [event for event in events if event.event_type == kind]
        struck = [
            it for it in noted if it["kind"] == word and it["qualifier"] in (None, "attempted")
        ]
        assert len(ours) == len(struck)
        ended = [event for event in ours if event.result == result]
        assert len(ended) == len(
            [it for it in noted if (it["kind"], it["qualifier"]) == (word, qualifier)]
        )
    passes = [event for event in events if event.result == PassResult.COMPLETE]
    assert len(passes) > 3
    for event in passes:
        assert event.receiver_player.team == event.team
        assert event.receive_timestamp > event.timestamp
    times = [event.time for event in events]
    assert times == sorted(times)


def test_goals_are_successful_shots(tmp_path: Path) -> None:
    replay = recorded("academy_empty_goal_close", tmp_path / "goal.pitchr", seed=1)
    assert replay.score == [1, 0]
    replay.export(tmp_path / "goal")
    events = load_event(tmp_path / "goal")
    assert (events.metadata.score.home, events.metadata.score.away) == (1, 0)
    (shot,) = [event for event in events if event.event_type == EventType.SHOT]
    assert shot.result == ShotResult.GOAL
    assert shot.result_coordinates.x == pytest.approx(55, abs=0.5)
    assert abs(shot.result_coordinates.y) < 3.7


def test_the_command_writes_the_same_files(
    replay: Replay, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    replay.export(tmp_path / "one", "csv")
    arguments = [str(replay.path), "--format", "csv", "-o", str(tmp_path / "other")]
    assert main(arguments) == 0
    assert [Path(line).name for line in capfd.readouterr().out.split()] == FILES["csv"]
    for name in FILES["csv"]:
        one, other = (tmp_path / folder / name for folder in ("one", "other"))
        assert one.read_bytes() == other.read_bytes()


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["--format", "cdf"], 2, "--output"),
        (["--format", "jsonl", "-o", "x"], 2, "-o"),
        (["--format", "csv", "-o", "{file}/x"], 1, "{file}"),
    ],
)
def test_slips_of_the_command(
    replay: Replay,
    capfd: pytest.CaptureFixture[str],
    arguments: list[str],
    code: int,
    says: str,
) -> None:
    file = str(replay.path)
    given = [argument.replace("{file}", file) for argument in arguments]
    assert main([file, *given]) == code
    assert says.replace("{file}", file) in capfd.readouterr().err


def test_slips_in_python(replay: Replay, tmp_path: Path) -> None:
    with pytest.raises(setpiece.ParameterError, match="cdf"):
        replay.export(tmp_path, "xml")
    with pytest.raises(FileNotFoundError, match=r"tracking\.csv"):
        load_tracking(tmp_path)


def test_the_tables_hold_numbers(replay: Replay, tmp_path: Path) -> None:
    replay.export(tmp_path, "csv")
    with (tmp_path / "tracking.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    assert len(rows) == (replay.length + 1) * 23
    assert {row["id"] for row in rows[:23]} >= {"ball", "left_GK_1", "right_CF_1"}
    meta = json.loads((tmp_path / "meta.json").read_text())
    assert meta["venue"] == {"id": "setpiece", "pitch_length": 110.0, "pitch_width": 72.0}
    for row in rows:
        assert abs(float(row["x"])) < 65
        assert abs(float(row["y"])) < 42.5


def test_a_small_pitch_has_its_own_goals_and_boxes(tmp_path: Path) -> None:
    text = """
    scenario small extends academy {
        pitch { length: 60m, width: 40m, goal: 5m, box: 9m }
        ball at (0.2, 0)
        team left { CF at (0.1, 0) }
        end limit 2s
    }
    """
    made = recorded(text, tmp_path / "small.pitchr", seed=1)
    made.export(tmp_path, "cdf")
    cdf.MetaSchemaValidator().validate_schema(tmp_path / "meta.json", mode="extreme")
    pitch = load_tracking(tmp_path).metadata.pitch_dimensions
    assert (pitch.pitch_length, pitch.pitch_width) == (60, 40)
    assert (pitch.goal_width, pitch.penalty_area_length) == (5, 9)
    assert pitch.penalty_area_width == pytest.approx(40.32 * 40 / 72, abs=0.5)
    assert pitch.circle_radius == pitch.penalty_arc_radius < 9.15
