"""A replay is converted to a GRF dump that the drop-in's scripts read."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import play, same

import setpiece
from setpiece._replay_command import main
from setpiece.gfootball import replay_to_dump
from setpiece.gfootball.env import create_environment
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env.script_helpers import ScriptHelpers

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"
HELPERS = ScriptHelpers()


def recorded(path: Path, scenario: Any, steps: int = 60, index: int = 0, **kwargs: Any) -> Path:
    """Plays at random and writes the replay."""
    env = setpiece.make(scenario, **kwargs)
    env.action_space.seed(1)
    play(env, 5, env.action_space.sample, steps, {"episode": index})
    env.save_replay(path)
    return path


def ended(path: Path, scenario: str, index: int = 0, **kwargs: Any) -> int:
    """Plays at random until an episode ends before its limit; saves it and returns its seed."""
    env = setpiece.make(scenario, **kwargs)
    for seed in range(50):
        env.action_space.seed(seed)
        if play(env, seed, env.action_space.sample, 300, {"episode": index})[-1][2]:
            env.save_replay(path)
            return seed
    pytest.fail("no episode ended by itself")


def dumped(replay: Path) -> tuple[Path, list[dict[str, Any]]]:
    """Converts a replay with the command; returns the dump and its records."""
    dump = replay.with_suffix(".dump")
    assert main([str(replay), "--format", "grf", "-o", str(dump)]) == 0
    return dump, HELPERS.load_dump(str(dump))


def test_a_dump_holds_every_step(tmp_path: Path) -> None:
    env = setpiece.make(CLOSE, observation="raw")
    presses = iter([setpiece.Action.RIGHT] * 4)
    trajectory = play(env, 3, lambda: next(presses, setpiece.Action.SHOT))
    env.save_replay(tmp_path / "x.pitchr")
    assert any(trajectory[-1][4]["score"]), "this one is a goal"
    _, records = dumped(tmp_path / "x.pitchr")
    assert len(records) == len(trajectory) - 1
    assert [record["debug"]["frame_cnt"] for record in records] == list(range(len(records)))
    assert [record["debug"]["action"] for record in records[:5]] == [[actions.action_right]] * 4 + [
        [actions.action_shot]
    ]
    for record, (seen, *_) in zip(records, trajectory[1:], strict=True):
        assert same(record["observation"]["ball"], seen["ball"])
        assert same(record["observation"]["left_agent_sticky_actions"], [seen["sticky_actions"]])
        assert record["observation"]["left_agent_controlled_player"] == [seen["active"]]
    assert [record["reward"] for record in records] == [0.0] * (len(records) - 1) + [1.0]
    assert records[-1]["cumulative_reward"] == 1.0
    config = records[0]["debug"]["config"]
    assert (config["level"], config["game_engine_random_seed"], config["action_set"]) == (
        CLOSE,
        3,
        "default",
    )
    assert all("config" not in record["debug"] for record in records[1:])


def test_it_is_the_dump_that_the_drop_in_writes(tmp_path: Path) -> None:
    path = tmp_path / "x.pitchr"
    seed = ended(path, THREE, left=2, right=1)
    _, records = dumped(path)
    env = create_environment(
        THREE,
        write_full_episode_dumps=True,
        logdir=str(tmp_path),
        number_of_left_players_agent_controls=2,
        number_of_right_players_agent_controls=1,
        other_config_options={"game_engine_random_seed": seed},
    )
    env.reset()
    for moment in list(setpiece.Replay(path))[1:]:
        _, _, done, info = env.step(list(moment.actions.values()))
    assert done
    own = HELPERS.load_dump(info["dumps"][0]["dump"])
    assert len(own) == len(records)
    for mine, its in zip(records, own, strict=True):
        assert mine.keys() == its.keys()
        assert mine["debug"].keys() == its["debug"].keys()
        assert mine["debug"]["action"] == its["debug"]["action"]
        assert (mine["reward"], mine["cumulative_reward"]) == (
            its["reward"],
            its["cumulative_reward"],
        )
        # The drop-in plays one step more than a scenario says, like GRF.
        its["observation"]["steps_left"] -= 1
        assert same(mine["observation"], its["observation"])
    assert records[0]["debug"]["config"].keys() == own[0]["debug"]["config"].keys()


@pytest.mark.parametrize(
    "seats", [{}, {"left": 3}, {"left": 0, "right": 1}, {"left": 1, "right": 1}]
)
@pytest.mark.parametrize("index", [0, 1])
def test_the_drop_in_plays_the_match_again(
    tmp_path: Path, seats: dict[str, Any], index: int
) -> None:
    ended(tmp_path / "x.pitchr", THREE, index, **seats)
    dump, before = dumped(tmp_path / "x.pitchr")
    infos = HELPERS.replay(
        str(dump),
        directory=str(tmp_path / "again"),
        render=False,
        config_update={"dump_full_episodes": True},
    )
    after = HELPERS.load_dump(infos[-1]["dumps"][0]["dump"])
    assert len(before) == len(after)
    for old, new in zip(before, after, strict=True):
        for key in ("ball", "left_team", "right_team", "score", "game_mode"):
            assert same(old["observation"][key], new["observation"][key])


@pytest.mark.parametrize("action_set", ["v2", "full"])
def test_larger_sets_of_actions(tmp_path: Path, action_set: str) -> None:
    path = recorded(tmp_path / "x.pitchr", "5_vs_5", action_set=action_set)
    _, records = dumped(path)
    assert records[0]["debug"]["config"]["action_set"] == action_set
    [held] = records[-1]["observation"]["left_agent_sticky_actions"]
    assert held.shape == ((13,) if action_set == "full" else (10,))
    pressed = [record["debug"]["action"][0].name for record in records]
    moments = list(setpiece.Replay(path))[1:]
    assert pressed == [next(iter(moment.actions.values())).name.lower() for moment in moments]


def test_a_match_that_the_drop_in_does_not_know_can_be_read(tmp_path: Path) -> None:
    text = "scenario mine extends academy_empty_goal_close { ball at (0.5, 0.1) }"
    for path in (
        recorded(tmp_path / "own.pitchr", setpiece.compile(text)),
        recorded(tmp_path / "late.pitchr", CLOSE, index=2),
        recorded(tmp_path / "fixed.pitchr", "5_vs_5", left=2, switching="fixed"),
        recorded(tmp_path / "hard.pitchr", "11_vs_11_stochastic", params={"difficulty": 0.11}),
    ):
        dump, records = dumped(path)
        assert np.isfinite(records[-1]["observation"]["ball"]).all()
        with pytest.raises(setpiece.UnknownScenarioError, match=path.name):
            HELPERS.replay(str(dump), render=False)


def test_a_replay_is_converted_by_any_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "deep").mkdir()
    recorded(tmp_path / "late.pitchr", CLOSE, index=2)
    monkeypatch.chdir(tmp_path / "deep")
    dump, records = dumped(Path("..", "late.pitchr"))
    assert records[0]["debug"]["config"]["level"] == str(Path("..", "late.pitchr"))
    with pytest.raises(setpiece.UnknownScenarioError, match=r"late\.pitchr"):
        HELPERS.replay(str(dump), render=False)


def test_a_dump_as_text(tmp_path: Path) -> None:
    dump, records = dumped(recorded(tmp_path / "x.pitchr", CLOSE, steps=3))
    HELPERS.dump_to_txt(str(dump), str(tmp_path / "x.txt"))
    assert (tmp_path / "x.txt").read_text().count("'frame_cnt'") == len(records)
    assert HELPERS.build_players(str(dump)) == [f"replay:path={dump},left_players=1"]


def test_a_set_piece_that_waits_too_long_for_the_drop_in(tmp_path: Path) -> None:
    env = setpiece.make("11_vs_11_stochastic", left="all", observation="raw")
    seen, _ = env.reset(seed=0)
    modes: list[int] = []
    for _ in range(2900):
        # The taker of a set piece doesn't take it.
        press = setpiece.Action.IDLE if seen[0]["game_mode"] else setpiece.Action.RIGHT
        seen = env.step([press] * 11)[0]
        modes.append(int(seen[0]["game_mode"]))
        if len(modes) > 20 and 0 not in modes[-20:]:
            break
    else:
        pytest.fail("no set piece waited")
    env.save_replay(tmp_path / "x.pitchr")
    _, records = dumped(tmp_path / "x.pitchr")
    # As in GRF, a pending kick-off has no mode of its own.
    assert [int(record["observation"]["game_mode"]) for record in records] == [
        mode if mode != 1 else 0 for mode in modes
    ]
    assert records[0]["debug"]["config"]["level"] == str(tmp_path / "x.pitchr")


def test_the_command_of_the_package_converts(tmp_path: Path) -> None:
    path, dump = recorded(tmp_path / "x.pitchr", CLOSE, steps=3), tmp_path / "deep" / "x.dump"
    words = [
        sys.executable,
        "-m",
        "setpiece",
        "replay",
        str(path),
        "--format=grf",
        "--output",
        str(dump),
    ]
    result = subprocess.run(words, capture_output=True, text=True, check=False, timeout=300)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    assert len(HELPERS.load_dump(str(dump))) == 3


def test_other_formats_are_reported_as_before(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = str(recorded(tmp_path / "x.pitchr", CLOSE, steps=3))
    assert main([path]) == main(["--color", "never", path, "--format", "text"]) == 0
    printed = capfd.readouterr().out
    assert printed[: len(printed) // 2] == printed[len(printed) // 2 :] != ""
    assert main([path, "--format=jsonl"]) == 0
    assert len(capfd.readouterr().out.splitlines()) == 4
    assert main(["--help"]) == 0
    assert "grf: a dump" in capfd.readouterr().out


def test_what_can_not_be_converted_is_reported(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path, dump = str(recorded(tmp_path / "x.pitchr", CLOSE, steps=3)), str(tmp_path / "x.dump")
    for wrong in (
        [path, "--format", "grf"],
        [path, "--format", "grff"],
        [path, "-o", dump],
        ["--format", "grf"],
    ):
        assert main(wrong) == 2, wrong
    nobody = recorded(tmp_path / "nobody.pitchr", "11_vs_11_stochastic", steps=2, left=0)
    numbers = recorded(tmp_path / "numbers.pitchr", CLOSE, steps=2, action_set="continuous")
    cut = tmp_path / "cut.pitchr"
    cut.write_bytes(Path(path).read_bytes()[:-1])
    capfd.readouterr()
    for source, out, why in [
        (cut, dump, "cut.pitchr`: the replay is truncated"),
        (tmp_path / "none.pitchr", dump, "none.pitchr`"),
        (nobody, dump, "nobody was an agent"),
        (numbers, dump, "actions were continuous"),
        (path, f"{path}/x.dump", "can't be written"),
    ]:
        assert main([str(source), "--format", "grf", "-o", out]) == 1
        printed = capfd.readouterr()
        assert printed.out == ""
        assert why in printed.err
        assert not Path(dump).exists()


def test_a_replay_is_given_by_its_path_too(tmp_path: Path) -> None:
    path = recorded(tmp_path / "x.pitchr", CLOSE, steps=3)
    dumps = []
    for number, replay in enumerate([setpiece.Replay(path), path, str(path)]):
        dump = tmp_path / f"{number}.dump"
        replay_to_dump(replay, dump)
        dumps.append(dump.read_bytes())
    assert dumps[0] == dumps[1] == dumps[2]
    with pytest.raises(setpiece.FileError):
        replay_to_dump(tmp_path / "none.pitchr", tmp_path / "x.dump")
    with pytest.raises(setpiece.ParameterError, match="a `Replay` or the path of one"):
        replay_to_dump(5, tmp_path / "x.dump")  # type: ignore[arg-type]
