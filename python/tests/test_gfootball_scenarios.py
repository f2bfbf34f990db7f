"""Scenario scripts in GRF's form: played, translated, and imported by the command."""

import math
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from conftest import same
from gfootball_scripts import HEAD, ONE_TEAM, recorded, script_file, starts_as

import setpiece
from setpiece.gfootball import scenarios
from setpiece.gfootball._import import import_script, main
from setpiece.gfootball._translation import TranslationError, to_pitch
from setpiece.gfootball.env import create_environment
from setpiece.gfootball.env.scenario_config import FormationEntry, ScenarioConfig
from setpiece.gfootball.scenarios import PlayerRole

PLAIN = """
    config.game_duration = 60
    config.offsides = False
    config.end_episode_on_score = True
    builder.SetBallPosition(0.62, 0.0)
    builder.SetTeam(Team.e_Left)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
    builder.AddPlayer(0.6, 0.0, e_PlayerRole_CM)
    builder.SetTeam(Team.e_Right)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
    builder.AddPlayer(-0.75, 0.1, e_PlayerRole_CB)
"""

LOOPS = """
    config.game_duration = 40
    builder.SetBallPosition(0.1, 0.1)
    for team, lazy in ((Team.e_Left, False), (Team.e_Right, True)):
        builder.SetTeam(team)
        builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, lazy=lazy, controllable=False)
        for number, role in enumerate([e_PlayerRole_LB, e_PlayerRole_CB, e_PlayerRole_RB, e_PlayerRole_DM]):
            builder.AddPlayer(-0.1 * number - 0.05, 0.123456 - 0.1 * number, role, lazy)
"""

EVERYTHING = """
    config.game_duration = 25
    config.second_half = 12
    config.deterministic = True
    config.offsides = False
    config.use_magnet = False
    config.end_episode_on_score = True
    config.end_episode_on_out_of_play = True
    config.end_episode_on_possession_change = True
    config.left_team_difficulty = 0.25
    config.right_team_difficulty = 0.05
    config.control_all_players = True
    builder.SetBallPosition(-0.3, 0.2)
    builder.SetTeam(Team.e_Left)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
    builder.AddPlayer(-0.31, 0.2, e_PlayerRole_AM, controllable=True)
    builder.AddPlayer(0.0, 0.0, e_PlayerRole_LM, True, False)
    builder.SetTeam(Team.e_Right)
    builder.AddPlayer(1.0, 0.0, e_PlayerRole_GK, lazy=True)
    builder.AddPlayer(0.0, 0.0, e_PlayerRole_RM)
"""

BALL_TAKES_TURNS = """
    config.game_duration = 30
    if builder.EpisodeNumber() % 2 == 0:
        builder.SetBallPosition(-0.9, 0.3)
    else:
        builder.SetBallPosition(0.9, -0.3)
    builder.SetTeam(Team.e_Left)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, lazy=True)
    builder.AddPlayer(-0.85, 0.3, e_PlayerRole_RM, lazy=True)
    builder.SetTeam(Team.e_Right)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, lazy=True)
"""

PLACES_TAKE_TURNS = """
    even = builder.EpisodeNumber() % 2 == 0
    builder.SetBallPosition(0.2, 0.0)
    config.right_team_difficulty = 0.1 if even else 0.9
    builder.SetTeam(Team.e_Left)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
    builder.AddPlayer(0.1 if even else -0.1, 0.05, e_PlayerRole_CF)
    builder.SetTeam(Team.e_Right)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
    builder.AddPlayer(-0.2, 0.1 if even else 0.3, e_PlayerRole_CB)
"""

SIDES_TAKE_TURNS = """
    config.game_duration = 200
    config.second_half = 100
    teams = [Team.e_Left, Team.e_Right]
    if builder.EpisodeNumber() % 2:
        teams.reverse()
    layouts = ([(0.0, 0.02), (0.0, -0.02)], [(-0.04, 0.04), (-0.04, -0.04)])
    for team, ((ax, ay), (bx, by)) in zip(teams, layouts):
        builder.SetTeam(team)
        builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK, controllable=False)
        builder.AddPlayer(ax, ay, e_PlayerRole_RM)
        builder.AddPlayer(bx, by, e_PlayerRole_CF)
"""

COMPONENTS = """
    config.game_duration = 20
    config.ball_position[0] = 0.25
    config.ball_position[1] = -0.125
    builder.ScenarioConfig().left_team_difficulty = 0.5
    builder.AddPlayer(-1, 0, e_PlayerRole_GK)
    builder.AddPlayer(0.24, -0.12, PlayerRole.e_PlayerRole_CF)
    builder.SetTeam(Team.e_Right)
    builder.AddPlayer(-0.25, 0.125, e_PlayerRole_CB)
"""

SHAPES = {
    name.lower(): text
    for name, text in {
        **{
            "PLAIN": PLAIN,
            "LOOPS": LOOPS,
            "EVERYTHING": EVERYTHING,
            "BALL_TAKES_TURNS": BALL_TAKES_TURNS,
        },
        **{
            "PLACES_TAKE_TURNS": PLACES_TAKE_TURNS,
            "SIDES_TAKE_TURNS": SIDES_TAKE_TURNS,
            "ONE_TEAM": ONE_TEAM,
        },
        **{"COMPONENTS": COMPONENTS},
    }.items()
}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_script_plays_as_it_says(shape: str, tmp_path: Path) -> None:
    path = script_file(tmp_path, SHAPES[shape], shape)
    env = create_environment(path, representation="raw", rewards="scoring,checkpoints")
    for episode in (2, 3, 4):
        env.reset()
        said = recorded(path, episode)
        starts_as(env.unwrapped._core.whole, said)
        assert env.unwrapped._core.whole["steps_left"] == said.game_duration + 1
        for _ in range(said.game_duration + 1):
            done = env.step(0)[2]
            if done:
                break
        assert done


@pytest.mark.parametrize("shape", SHAPES)
def test_an_imported_script_starts_as_the_script(
    shape: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = script_file(tmp_path, SHAPES[shape], shape)
    out = tmp_path / f"{shape}.pitch"
    assert main(["grf", path, "-o", str(out)]) == 0
    assert setpiece._native.run_command(["fmt", "--check", str(out)]) == 0, capfd.readouterr()
    scenario = setpiece.load(out)
    assert scenario.name == shape
    assert not scenario.warnings
    env = setpiece.make(scenario, observation="raw")
    for episode in (2, 3):
        seen, _ = env.reset(seed=1, options={"episode": episode})
        said = recorded(path, episode)
        first = seen[0] if isinstance(seen, tuple) else seen
        starts_as(first, said)
        assert first["steps_left"] == said.game_duration


def test_the_text_says_what_the_script_sets(tmp_path: Path) -> None:
    text = import_script(script_file(tmp_path, EVERYTHING, "everything"))
    assert (
        text
        == """\
/// everything, as a script of Google Research Football has it.
scenario everything {
    rules { offside: off, kickoff_circle: off, assist: off, stochastic: off, half_time: 12 steps }
    agents { left: all }
    ball at (-0.3, 0.2)

    team left {
        difficulty: 0.25
        GK at (-1.011, 0) { overlap: allowed }
        AM at (-0.3134, 0.2033)
        LM at (0, 0) { ai: lazy, controllable: off, overlap: allowed }
    }

    team right {
        difficulty: 0.05
        GK at own (1.011, 0) { ai: lazy, overlap: allowed }
        RM at own (0, 0) { overlap: allowed }
    }

    reward scoring

    end success scored when goal by left
    end failure conceded when goal by right
    end out when out_of_play or ball_dead
    end possession when possession changes
    end limit 25 steps
}
"""
    )


def test_sides_that_take_turns_become_a_kick_off(tmp_path: Path) -> None:
    text = import_script(script_file(tmp_path, SIDES_TAKE_TURNS, "turns"))
    assert (
        "kickoff alternate(left, right) { kicking: turns_kicking, receiving: turns_receiving }"
        in text
    )
    assert "GK at (-1.011, 0) { controllable: off }" in text
    assert "half_time: 100 steps" in text


def test_places_that_take_turns_alternate(tmp_path: Path) -> None:
    text = import_script(script_file(tmp_path, PLACES_TAKE_TURNS))
    assert "difficulty: alternate(0.1, 0.9)" in text
    assert "CF at (alternate(0.1011, -0.1011), 0.0508)" in text
    assert "CB at own (-0.2022, alternate(0.1016, 0.3049))" in text


LIBRARY = """
    config.game_duration = 300
    config.right_team_difficulty = 0.6
    back = [(-0.422, -0.19576, "LB"), (-0.5, -0.06356, "CB"), (-0.5, 0.063559, "CB"), (-0.422, 0.19576, "RB")]
    middle = [(-0.184212, -0.10568, "CM"), (-0.267574, 0, "CM"), (-0.184212, 0.10568, "CM"), (-0.01, -0.2161, "LM")]
    rest = back + middle
    kicking = [(-1, 0, "GK"), (0, 0.02, "RM"), (0, -0.02, "CF"), *rest]
    receiving = [(-1, 0, "GK"), (-0.05, 0, "RM"), (-0.01, 0.216102, "CF"), *rest]
    teams = [Team.e_Left, Team.e_Right]
    for team, layout in zip(teams[:: 1 if builder.EpisodeNumber() % 2 == 0 else -1], (kicking, receiving)):
        builder.SetTeam(team)
        for x, y, role in layout:
            builder.AddPlayer(x, y, PlayerRole["e_PlayerRole_" + role])
"""


def test_a_script_of_a_full_match_plays_as_the_librarys(tmp_path: Path) -> None:
    options = {"game_engine_random_seed": 5}
    path = script_file(tmp_path, LIBRARY, "eleven")
    envs = [
        create_environment(name, representation="raw", other_config_options=options)
        for name in (path, "11_vs_11_stochastic")
    ]
    for _ in range(2):
        script, library = ({**env.reset()[0], "steps_left": 0} for env in envs)
        assert same(script, library)
        for step in range(300):
            script, library = ({**env.step(step * 7 % 19)[0][0], "steps_left": 0} for env in envs)
            assert same(script, library)


CANT_SAY = {
    "seed": (
        "    config.deterministic = True\n    config.game_engine_random_seed = 7\n" + ONE_TEAM,
        "no seed of its own",
    ),
    "rule": (
        "    config.offsides = builder.EpisodeNumber() % 2 == 0\n" + ONE_TEAM,
        "`offsides` is True in even",
    ),
    "players": (
        ONE_TEAM
        + "    if builder.EpisodeNumber() % 2:\n        builder.AddPlayer(0, 0, e_PlayerRole_CM)\n",
        "left team",
    ),
    "lazy": (
        ONE_TEAM
        + "    builder.AddPlayer(0, 0.1, e_PlayerRole_CM, lazy=builder.EpisodeNumber() % 2 == 0)\n",
        "left team",
    ),
    "thirds": (
        ONE_TEAM
        + "    builder.AddPlayer(0.1 * (builder.EpisodeNumber() % 3), 0, e_PlayerRole_CM)\n",
        "take turns",
    ),
    "random": (
        ONE_TEAM
        + "    import random\n    builder.AddPlayer(random.random(), 0, e_PlayerRole_CM)\n",
        "at random",
    ),
}


@pytest.mark.parametrize("case", CANT_SAY)
def test_what_a_text_cannot_say(
    case: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, words = CANT_SAY[case]
    path = script_file(tmp_path, text)
    with pytest.raises(TranslationError, match=words) as caught:
        import_script(path)
    assert caught.value.help
    assert main(["grf", path]) == 1
    assert words in capsys.readouterr().err
    # The drop-in runs the script again for every episode, so it can play all of these.
    env = create_environment(path)
    for _ in range(3):
        env.reset()
        env.step(0)


def test_to_pitch_of_a_recorded_scenario() -> None:
    said = ScenarioConfig(ball_position=[0.5, 0.0, 0.0])
    said.left_team.append(FormationEntry((-1e-7, math.pi / 10), PlayerRole.e_PlayerRole_CF))
    text = to_pitch(said, "small")
    assert "CF at (0, 0.3193)" in text
    assert setpiece.compile(text).name == "small"


def test_an_episode_longer_than_a_limit_has_none() -> None:
    said = ScenarioConfig(game_duration=1_000_000, ball_position=[0.5, 0.0, 0.0])
    assert "end limit 1000000 steps" in to_pitch(said, "long")
    said.game_duration += 1
    text = to_pitch(said, "longer")
    assert "game_duration of 1000001 steps" in text
    assert "end limit" not in text
    assert setpiece.compile(text).name == "longer"


def test_a_fixed_seed_makes_the_same_match(tmp_path: Path) -> None:
    def play(seed: int) -> list[Any]:
        text = (
            f"    config.deterministic = True\n    config.game_engine_random_seed = {seed}\n"
            + SIDES_TAKE_TURNS
        )
        env = create_environment(
            script_file(tmp_path, text, f"seed_{seed}"), representation="simple115v2"
        )
        return [env.reset(), *(env.step(12)[0] for _ in range(100))]

    assert same(play(7), play(7))
    assert same(play(42), play(42))
    assert not same(play(7), play(8))


def test_scenarios_by_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script_file(tmp_path, PLAIN, "by_folder")
    monkeypatch.setattr(scenarios, "__path__", [*scenarios.__path__, str(tmp_path)])
    assert create_environment("by_folder").reset().shape == (72, 96, 4)

    module = ModuleType("setpiece.gfootball.scenarios.by_name")
    module.build_scenario = lambda builder: builder.AddPlayer(-1, 0, 0)  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, module.__name__, module)
    assert create_environment("by_name").reset().shape == (72, 96, 4)

    package = tmp_path / "my_lab_scenarios"
    package.mkdir()
    (package / "__init__.py").write_text("")
    text = "from setpiece.gfootball.scenarios import *\n" + HEAD.split("\n", 1)[1] + PLAIN
    (package / "drill.py").write_text(text)
    monkeypatch.syspath_prepend(str(tmp_path))
    assert create_environment("my_lab_scenarios.drill").reset().shape == (72, 96, 4)


def test_a_pitch_file(tmp_path: Path) -> None:
    path = tmp_path / "wide.pitch"
    path.write_text("scenario wide extends academy_3_vs_1_with_keeper { end limit 9 steps }")
    env = create_environment(
        str(path), number_of_left_players_agent_controls=2, representation="simple115v2"
    )
    assert env.reset().shape == (2, 115)
    steps = 1
    while not env.step([0, 0])[2]:
        steps += 1
    assert steps <= 10


def test_a_state_of_the_other_kick_off(tmp_path: Path) -> None:
    env = create_environment(
        script_file(tmp_path, SIDES_TAKE_TURNS, "both"), representation="simple115v2"
    )
    env.reset()
    state = env.get_state()
    later = [env.step(5) for _ in range(5)]
    env.reset()
    env.set_state(state)
    assert same(later, [env.step(5) for _ in range(5)])


def test_the_command(tmp_path: Path) -> None:
    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        folder = str(Path(setpiece.__file__).parents[1])
        environment = {**os.environ, "PYTHONPATH": folder, "PYTHONIOENCODING": "utf-8"}
        command = [sys.executable, "-m", "setpiece", *arguments]
        return subprocess.run(
            command, capture_output=True, text=True, env=environment, cwd=tmp_path, check=False
        )

    text = "    print('hello')\n" + PLAIN
    (tmp_path / "drill.py").write_text(
        "from gfootball.scenarios import *\n" + HEAD.split("\n", 1)[1] + text
    )
    shown = run("import", "grf", "drill.py")
    assert shown.returncode == 0, shown.stderr
    assert "scenario drill {" in shown.stdout
    assert "hello" in shown.stderr
    assert "hello" not in shown.stdout
    assert run("import", "grf", "drill.py", "-o", "drill.pitch").returncode == 0
    assert (tmp_path / "drill.pitch").read_text() == shown.stdout
    assert run("run", "drill.pitch", "--episodes", "1").returncode == 0
    missing = run("import", "grf", "none.py")
    assert (missing.returncode, missing.stderr) == (1, "no file `none.py`\n")
    assert run("import", "grf", "drill.py", "-o", "no/where.pitch").returncode == 1
    assert run("import").returncode == 2
    assert run("import", "unity", "x.py").returncode == 2
    assert run("import", "--help").returncode == 0
