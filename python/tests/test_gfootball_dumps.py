"""Players by their definitions, dumps, and matches replayed from them."""

import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from conftest import same

from setpiece import ActionError, FileError, FormatError, ParameterError, UnavailableError
from setpiece.gfootball.dump_to_txt import main as dump_to_txt
from setpiece.gfootball.env import create_environment
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env.config import Config, count_players, parse_player_definition
from setpiece.gfootball.env.football_env import FootballEnv
from setpiece.gfootball.env.observation_processor import read_dump
from setpiece.gfootball.env.player_base import PlayerBase
from setpiece.gfootball.env.players.bot import Player as Bot
from setpiece.gfootball.env.script_helpers import ScriptHelpers

CLOSE = "academy_empty_goal_close"
FULL = "11_vs_11_stochastic"


@pytest.mark.parametrize(
    ("definition", "name", "left", "right"),
    [
        ("agent", "agent", 1, 0),
        ("lazy:right_players=2", "lazy", 0, 2),
        ("agent:left_players=0", "agent", 0, 0),
        ("agent:left_players=3,right_players=4", "agent", 3, 4),
        ("replay:path=C:/a.dump,left_players=1", "replay", 1, 0),
    ],
)
def test_definitions(definition: str, name: str, left: int, right: int) -> None:
    found, settings = parse_player_definition(definition)
    assert (found, settings["left_players"], settings["right_players"]) == (name, left, right)
    assert count_players(definition) == left + right


def test_slots_are_dealt_out_in_order() -> None:
    config = Config(
        {"level": FULL, "players": ["lazy:left_players=2", "agent:left_players=1,right_players=1"]}
    )
    env = FootballEnv(config)
    observation = env.reset()
    assert len(observation) == 2
    env.step([actions.action_top, actions.action_top])
    held = env._core.whole["left_agent_sticky_actions"]
    assert [np.flatnonzero(each).tolist() for each in held] == [[], [], [2]]
    assert np.flatnonzero(env._core.whole["right_agent_sticky_actions"][0]).tolist() == [6]


def test_players_of_other_config_options_replace_all() -> None:
    options = {"players": ["agent:left_players=2,right_players=1", "lazy:left_players=1"]}
    env = create_environment(FULL, representation="simple115v2", other_config_options=options)
    assert env.reset().shape == (3, 115)
    assert env.step([0, 0, 0])[1].shape == (3,)
    options = {"players": ["lazy:left_players=1"]}
    env = create_environment(FULL, other_config_options=options)
    assert "left_team" in env.reset()
    env.step([])


@pytest.mark.parametrize("name", ["lazy", "builtin_ai"])
def test_extra_players_take_slots_of_their_own(name: str) -> None:
    env = create_environment(CLOSE, extra_players=[f"{name}:right_players=1"], representation="raw")
    assert len(env.reset()) == 1
    for _ in range(12):
        observation, reward, _, _ = env.step(0)
    assert np.shape(reward) == ()
    # In `academy_empty_goal_close` the right keeper is far from their goal. The bot runs home, and
    # a lazy one stays, apart from being pushed away by the other keeper, who starts in the same
    # place.
    moved = abs(float(observation[0]["right_team"][0][0]) + 1.011) > 0.03
    assert moved == (name == "builtin_ai")


def test_a_player_of_ones_own(monkeypatch: pytest.MonkeyPatch) -> None:
    class Player(PlayerBase):
        def __init__(self, player_config: dict[str, Any], env_config: Any) -> None:
            super().__init__(player_config)
            self.level = env_config["level"]
            self.wish = player_config["wish"]

        def take_action(self, observations: list[dict[str, Any]]) -> Any:
            return [int(self.wish)] * len(observations)

    module = ModuleType("setpiece.gfootball.env.players.wishful")
    module.Player = Player  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, module.__name__, module)
    env = create_environment(FULL, extra_players=["wishful:right_players=1,wish=5"])
    env.reset()
    env.step(0)
    # Its `right` leads to the left of the pitch.
    assert np.flatnonzero(env.unwrapped._core.whole["right_agent_sticky_actions"][0]).tolist() == [
        0
    ]


def test_the_bot_needs_the_full_set() -> None:
    with pytest.raises(ParameterError, match="full"):
        create_environment(FULL, extra_players=["bot:right_players=1"])
    options = {"action_set": "full"}
    env = create_environment(
        FULL, extra_players=["bot:right_players=1"], other_config_options=options
    )
    env.reset()
    for _ in range(50):
        env.step(0)


def bot_sees(**changes: Any) -> dict[str, Any]:
    return {
        **{
            "active": 0,
            "game_mode": 0,
            "ball_owned_team": 0,
            "left_team": np.array([[0.0, 0.0], [0.1, 0.2]]),
        },
        **{"left_team_active": np.array([True, True]), "right_team": np.array([[0.9, 0.3]])},
        **changes,
    }


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, ["right", "right"]),
        ({"game_mode": 3}, ["long_pass"]),
        ({"left_team": np.array([[0.8, 0.05], [0.1, 0.2]])}, ["shot"]),
        ({"left_team": np.array([[0.6, -0.25], [0.1, 0.2]])}, ["bottom_right"]),
        ({"ball_owned_team": 1}, ["pressure", "sprint"]),
        ({"right_team": np.array([[0.05, 0.0]])}, ["bottom_right", "short_pass"]),
        (
            {
                "right_team": np.array([[0.05, 0.01]]),
                "left_team": np.array([[0.0, 0.0], [0.9, 0.2]]),
            },
            ["top", "top"],
        ),
        ({"active": -1}, ["idle"]),
    ],
)
def test_what_the_bot_does(changes: dict[str, Any], expected: list[str]) -> None:
    bot = Bot({"left_players": 1, "right_players": 0}, {"action_set": "full"})
    assert [bot.take_action([bot_sees(**changes)])[0].name for _ in expected] == expected


def play(env: Any, episodes: int = 1) -> list[dict[str, str]]:
    """Runs and shoots; returns the dumps listed in infos."""
    dumps = []
    for _ in range(episodes):
        env.reset()
        done, step = False, 0
        while not done:
            _, _, done, info = env.step(5 if step < 4 else 12)
            dumps += info.get("dumps", [])
            step += 1
    return dumps


def test_a_whole_episode(tmp_path: Path) -> None:
    env = create_environment(
        CLOSE, write_full_episode_dumps=True, logdir=str(tmp_path), representation="raw"
    )
    [dump] = play(env)
    assert dump["name"] == "episode_done"
    path = Path(dump["dump"])
    assert path.parent == tmp_path
    assert path.name.startswith("episode_done_")
    assert path.suffix == ".dump"
    records = read_dump(str(path))
    assert [record["debug"]["frame_cnt"] for record in records] == list(range(len(records)))
    first = records[0]
    assert first["debug"]["config"]["level"] == CLOSE
    assert all("config" not in record["debug"] for record in records[1:])
    assert first["debug"]["action"] == [actions.action_right]
    assert first["observation"]["left_agent_controlled_player"] == [1]
    assert same(records[-1]["observation"]["ball"], env.unwrapped.observation()[0]["ball"])
    assert records[-1]["cumulative_reward"] == sum(record["reward"] for record in records)


def test_the_run_up_of_a_goal(tmp_path: Path) -> None:
    for seed in range(20):
        options = {"game_engine_random_seed": seed}
        env = create_environment(
            CLOSE, write_goal_dumps=True, logdir=str(tmp_path), other_config_options=options
        )
        dumps = play(env)
        if dumps:
            break
    assert [dump["name"] for dump in dumps] == ["score"]
    assert read_dump(dumps[0]["dump"])[-1]["reward"] == 1


def test_every_kth_episode_is_dumped(tmp_path: Path) -> None:
    env = create_environment(
        CLOSE, write_full_episode_dumps=True, logdir=str(tmp_path), dump_frequency=3
    )
    assert len(play(env, 7)) == 3


def test_a_dump_on_demand(tmp_path: Path) -> None:
    env = create_environment("1_vs_1_easy", logdir=str(tmp_path))
    env.reset()
    assert env.unwrapped.write_dump("mine") is None, "nothing was played"
    for _ in range(150):
        env.step(0)
    path = env.unwrapped.write_dump("mine")
    assert len(read_dump(path)) == 100
    assert env.unwrapped.write_dump("mine") is None, "once in an episode"


def test_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    env = create_environment(CLOSE, logdir=str(tmp_path / "file"))
    env.reset()
    env.step(0)
    with pytest.raises(FileError):
        env.unwrapped.write_dump("mine")
    env.step(0)


@pytest.mark.parametrize("right", [0, 1])
def test_a_dump_plays_again(tmp_path: Path, right: int) -> None:
    env = create_environment(
        "academy_3_vs_1_with_keeper",
        write_full_episode_dumps=True,
        logdir=str(tmp_path),
        number_of_left_players_agent_controls=2,
        number_of_right_players_agent_controls=right,
    )
    env.reset()
    env.action_space.seed(1)
    done = False
    while not done:
        _, _, done, info = env.step(env.action_space.sample())
    path = info["dumps"][0]["dump"]
    helpers = ScriptHelpers()
    again = tmp_path / "again"
    infos = helpers.replay(
        path, directory=str(again), render=False, config_update={"dump_full_episodes": True}
    )
    before, after = helpers.load_dump(path), helpers.load_dump(infos[-1]["dumps"][0]["dump"])
    assert len(before) == len(after)
    for old, new in zip(before, after, strict=True):
        assert same(old["observation"], new["observation"])
        assert old["debug"]["action"] == new["debug"]["action"]


def test_a_dump_as_text(tmp_path: Path) -> None:
    env = create_environment(CLOSE, write_full_episode_dumps=True, logdir=str(tmp_path))
    [dump] = play(env)
    text = tmp_path / "dump.txt"
    ScriptHelpers().dump_to_txt(dump["dump"], str(text))
    assert "'frame_cnt': 0" in text.read_text()
    ScriptHelpers().dump_to_txt(dump["dump"], str(text), include_debug=False)
    assert "frame_cnt" not in text.read_text()
    assert "steps_left" in text.read_text()


def test_the_command_writes_a_dump_as_text(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    env = create_environment(CLOSE, write_full_episode_dumps=True, logdir=str(tmp_path))
    [dump] = play(env)
    text = tmp_path / "dump.txt"
    files = [f"--trace_file={dump['dump']}", f"--output={text}"]
    for flags in ([], ["--include_debug"], ["--include_debug=true"]):
        assert dump_to_txt([*files, *flags]) == 0
        assert "frame_cnt" in text.read_text()
    for flags in (["--noinclude_debug"], ["--include_debug=False"]):
        assert dump_to_txt([*files, *flags]) == 0
        assert "frame_cnt" not in text.read_text()
    assert capsys.readouterr() == ("", "")
    assert dump_to_txt(["--trace_file", str(tmp_path / "none.dump"), "--output", str(text)]) == 1
    assert "none.dump` can't be read" in capsys.readouterr().err
    assert dump_to_txt(files[:1]) == dump_to_txt([*files, "--include_debug=x"]) == 2


def test_replaying_beyond_the_end(tmp_path: Path) -> None:
    env = create_environment(FULL, logdir=str(tmp_path))
    env.reset()
    for _ in range(3):
        env.step(5)
    path = env.unwrapped.write_dump("short")
    again = create_environment(
        FULL, number_of_left_players_agent_controls=0, extra_players=[f"replay:path={path}"]
    )
    again.reset()
    for _ in range(3):
        again.step([])
    with pytest.raises(ActionError, match="ends after 3 steps"):
        again.step([])
    again.reset()
    again.step([])


def test_bad_dumps(tmp_path: Path) -> None:
    bad = tmp_path / "bad.dump"
    bad.write_bytes(b"nonsense")
    helpers = ScriptHelpers()
    with pytest.raises(FormatError):
        helpers.load_dump(str(bad))
    bad.write_bytes(b"")
    with pytest.raises(FormatError):
        helpers.load_dump(str(bad))
    with pytest.raises(FileError):
        helpers.load_dump(str(tmp_path / "none.dump"))
    with pytest.raises(UnavailableError):
        helpers.replay("x", 20, render=False)
