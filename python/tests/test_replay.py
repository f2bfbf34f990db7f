"""Episodes are recorded, and replayed with the command."""

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier
from typing import Any

import numpy as np
import pytest
from conftest import play

import setpiece
from setpiece._native import run_command

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"
FULL = "11_vs_11_stochastic"


def replayed(path: str | Path, capfd: pytest.CaptureFixture[str], *options: str) -> str:
    assert run_command(["replay", str(path), *options]) == 0
    return capfd.readouterr().out


def test_a_recorded_episode_is_played_again(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    env = setpiece.make(THREE, record=tmp_path / "runs")
    for name in (f"{THREE}_7_0.pitchr", f"{THREE}_7_0_2.pitchr", f"{THREE}_7_0_3.pitchr"):
        end = play(env, 7)[-1][4]["setpiece"]
        assert end["replay"] == str(tmp_path / "runs" / name), "nothing that was recorded is lost"
        printed = replayed(end["replay"], capfd)
        assert f"digest {end['digest']}, as it was" in printed
        assert f"after {end['length']} steps" in printed


def test_each_step_is_a_line_of_json(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    env = setpiece.make(CLOSE, record=tmp_path, observation="raw")
    trajectory = play(env, 3, lambda: setpiece.Action.SHOT)
    lines = replayed(
        trajectory[-1][4]["setpiece"]["replay"], capfd, "--format", "jsonl"
    ).splitlines()
    moments: list[dict[str, Any]] = [json.loads(line) for line in lines]
    assert [moment["step"] for moment in moments] == list(range(len(trajectory)))
    for moment, (seen, *_rest) in zip(moments, trajectory, strict=True):
        assert moment["ball"] == pytest.approx(seen["ball"], abs=1e-4)
    assert moments[1]["actions"] == {"left_0": "shot"} or moments[1]["actions"] == {
        env.agents[0]: "shot"
    }
    assert moments[-1]["outcome"] == trajectory[-1][4]["outcome"]


def test_actions_of_numbers_and_opponents_are_recorded(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    env = setpiece.make(THREE, action_set="continuous", record=tmp_path)
    rng = np.random.default_rng(1)
    end = play(env, 5, lambda: rng.uniform(-1, 1, 4))[-1][4]["setpiece"]
    assert end["digest"] in replayed(end["replay"], capfd)
    rival = setpiece.make(
        THREE, right=1, opponents={"right": lambda _: int(rng.integers(20))}, record=tmp_path
    )
    end = play(rival, 6)[-1][4]["setpiece"]
    assert end["digest"] in replayed(end["replay"], capfd)


def test_threads_that_record_the_same_draw_into_one_folder_lose_none(tmp_path: Path) -> None:
    together = Barrier(4)

    def episodes() -> list[str]:
        env = setpiece.make(CLOSE, record=tmp_path, ends=lambda _: True)
        together.wait()
        return [play(env, 1)[-1][4]["setpiece"]["replay"] for _ in range(25)]

    with ThreadPoolExecutor(4) as threads:
        runs = [threads.submit(episodes) for _ in range(4)]
    paths = [path for run in runs for path in run.result()]
    assert len(set(paths)) == 100
    assert all(setpiece.Replay(path).length == 1 for path in paths)


def test_which_episodes_are_recorded(tmp_path: Path) -> None:
    every = setpiece.make(CLOSE, record=tmp_path / "third", record_when=3)
    goals = setpiece.make(CLOSE, record=tmp_path / "goals", record_when="goal")
    third, scored = [], []
    for at in range(8):
        third.append(play(every, 1 if at == 0 else None)[-1][4]["setpiece"]["replay"] is not None)
        info = play(goals, 1 if at == 0 else None)[-1][4]
        scored.append((info["setpiece"]["replay"] is not None, any(info["score"])))
    assert third == [True, False, False, True, False, False, True, False]
    assert all(written == goal for written, goal in scored)
    assert len(list((tmp_path / "third").iterdir())) == 3


def test_an_episode_under_way_is_saved(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    env = setpiece.make(THREE)
    with pytest.raises(setpiece.ReplayError, match="no episode has begun"):
        env.save_replay(tmp_path / "none.pitchr")
    env.reset(seed=1)
    for _ in range(5):
        env.step(setpiece.Action.RIGHT)
    with pytest.raises(setpiece.ActionError):
        env.step(99)
    env.save_replay(tmp_path / "five.pitchr")
    assert "not ended after 5 steps" in replayed(tmp_path / "five.pitchr", capfd)
    env.restore(env.snapshot())
    with pytest.raises(setpiece.ReplayError, match="continues from a restored snapshot"):
        env.save_replay(tmp_path / "none.pitchr")


def test_what_can_not_be_recorded_is_named(tmp_path: Path) -> None:
    for when in ("sometimes", 0, -1, True, 2.5):
        with pytest.raises(setpiece.ParameterError, match="`record_when` is"):
            setpiece.make(THREE, record=tmp_path, record_when=when)  # type: ignore[arg-type]
    (tmp_path / "file").write_text("in the way")
    env = setpiece.make(CLOSE)
    env.reset(seed=1)
    with pytest.raises(setpiece.FileError, match="can't be written"):
        env.save_replay(tmp_path / "file" / "x.pitchr")


def test_an_episode_gone_on_from_a_snapshot_is_not_recorded(tmp_path: Path) -> None:
    env = setpiece.make(CLOSE, record=tmp_path)
    env.reset(seed=1)
    env.step(setpiece.Action.RIGHT)
    env.restore(env.snapshot())
    while "setpiece" not in (info := env.step(setpiece.Action.SHOT)[4]):
        pass
    assert info["setpiece"]["replay"] is None
    assert list(tmp_path.iterdir()) == []


def ended(env: Any, seed: int | None) -> dict[str, Any]:
    """Plays an episode of agents that shoot; returns everyone's last info."""
    env.reset(seed=seed)
    while env.agents:
        infos = env.step(dict.fromkeys(env.agents, setpiece.Action.SHOT))[4]
    last: dict[str, Any] = infos
    return last


def test_a_parallel_environment_records_as_a_single_one(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    env = setpiece.parallel_env(THREE, left=3, record=tmp_path)
    for seed, index in ((7, 0), (None, 1)):
        infos = ended(env, seed)
        path = tmp_path / f"{THREE}_7_{index}.pitchr"
        assert {info["setpiece"]["replay"] for info in infos.values()} == {str(path)}
        assert infos["left_CM_1"]["setpiece"]["digest"] in replayed(path, capfd)
    every = setpiece.parallel_env(CLOSE, record=tmp_path / "third", record_when=3)
    [agent] = every.possible_agents
    paths = [ended(every, 1 if at == 0 else None)[agent]["setpiece"]["replay"] for at in range(4)]
    assert [path is not None for path in paths] == [True, False, False, True]
    with pytest.raises(setpiece.ParameterError, match="`record_when` is 'never'"):
        setpiece.parallel_env(CLOSE, record=tmp_path, record_when="never")  # type: ignore[arg-type]
    with pytest.raises(setpiece.ParameterError, match="needs a folder"):
        setpiece.parallel_env(CLOSE, record_when="goal")


def test_an_episode_that_max_cycles_end_is_recorded(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    env = setpiece.parallel_env(FULL, left=2, max_cycles=4, record=tmp_path)
    infos = ended(env, 3)
    assert "max_cycles after 4 steps" in replayed(
        infos[env.possible_agents[0]]["setpiece"]["replay"], capfd
    )
    env.save_replay(tmp_path / "again.pitchr")
    assert (tmp_path / "again.pitchr").read_bytes() == (
        tmp_path / f"{FULL}_3_0.pitchr"
    ).read_bytes()


def test_an_environment_that_records_does_so_where_max_cycles_end_it(tmp_path: Path) -> None:
    pytest.importorskip("pettingzoo")
    from setpiece._parallel import ParallelFootballEnv

    env = ParallelFootballEnv(
        setpiece.make(FULL, left=2, switching="fixed", record=tmp_path), max_cycles=2
    )
    env.reset(seed=1)
    for _ in range(2):
        infos = env.step(dict.fromkeys(env.agents, 0))[-1]
    for info in infos.values():
        assert setpiece.Replay(info["setpiece"]["replay"]).length == 2


def test_a_vector_says_that_it_records_nothing(tmp_path: Path) -> None:
    with pytest.raises(setpiece.UnavailableError, match="a vector can't record replays") as caught:
        setpiece.make_vec(CLOSE, 2, record=tmp_path)
    assert caught.value.name == "record"


def test_a_folder_that_can_not_be_made_is_reported_at_once(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(setpiece.FileError, match="can't be written"):
        setpiece.make(CLOSE, record=tmp_path / "file")
    with pytest.raises(setpiece.ParameterError, match="expected a path as `record`"):
        setpiece.make(CLOSE, record=3)  # type: ignore[arg-type]
