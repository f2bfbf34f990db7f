"""Scenario scripts in GRF's form that fail, or set something wrong."""

from pathlib import Path

import pytest
from gfootball_scripts import HEAD, recorded, script_file

import setpiece
from setpiece import CompileError, FileError, ParameterError, SetpieceError
from setpiece.gfootball import scenarios
from setpiece.gfootball._import import import_script, main
from setpiece.gfootball.env import create_environment


@pytest.mark.parametrize(
    "call", ["AddPlayer(math.nan, 0, 1)", "AddPlayer(0, 'x', 1)", "SetBallPosition(0, math.inf)"]
)
def test_places_are_numbers(call: str, tmp_path: Path) -> None:
    path = script_file(tmp_path, f"    import math\n    builder.{call}\n", "odd")
    with pytest.raises(SetpieceError, match=call.partition("(")[0]):
        create_environment(path)


def test_bad_scripts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(FileError):
        create_environment(str(tmp_path / "none.py"))
    empty = tmp_path / "empty.py"
    empty.write_text("")
    with pytest.raises(SetpieceError, match="build_scenario"):
        create_environment(str(empty))
    with pytest.raises(ParameterError, match="did you mean `offsides`"):
        create_environment(script_file(tmp_path, "    config.offside = False\n", "typo"))
    with pytest.raises(ParameterError, match=r"Team\.e_Left"):
        create_environment(script_file(tmp_path, "    builder.SetTeam(3)\n", "team"))
    with pytest.raises(ParameterError, match="e_PlayerRole_CM"):
        create_environment(
            script_file(tmp_path, "    builder.AddPlayer('a', 0, e_PlayerRole_GK)\n", "player")
        )
    with pytest.raises(CompileError):
        create_environment(script_file(tmp_path, "    builder.SetBallPosition(3, 3)\n", "outside"))
    assert main(["grf", script_file(tmp_path, "    nonsense\n", "broken")]) == 1
    assert "NameError" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("script", "why"),
    [
        ("def build_scenario(builder):\n    raise ValueError('hm')\n", "ValueError: hm"),
        ("def build_scenario(builder)\n", "SyntaxError"),
        ("import sys\nsys.exit(3)\n", "SystemExit: 3"),
    ],
)
def test_a_script_that_fails_is_named(tmp_path: Path, script: str, why: str) -> None:
    path = tmp_path / "broken.py"
    path.write_text(script)
    with pytest.raises(setpiece.GrfScriptError, match=why) as caught:
        create_environment(str(path)).reset()
    assert "broken.py` failed" in str(caught.value)
    assert main(["grf", str(path)]) == 1


@pytest.mark.parametrize(
    ("name", "script", "line", "why"),
    [
        ("unclosed", "from . import *\ndef build_scenario(builder\n", 2, "SyntaxError"),
        ("raising", "from . import *\nraise ValueError('hm')\n", 2, "ValueError: hm"),
        ("lacking", "import no_such_package_at_all\n", 1, "ModuleNotFoundError: No module named"),
        ("leaving", "import sys\n\nsys.exit(3)\n", 3, "SystemExit: 3"),
        (
            "deep",
            HEAD + "    deeper(config)\n\ndef deeper(config):\n    1 / 0\n",
            8,
            "ZeroDivisionError",
        ),
    ],
)
def test_a_script_that_fails_says_where(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, script: str, line: int, why: str
) -> None:
    path = tmp_path / f"{name}.py"
    path.write_text(script)
    monkeypatch.setattr(scenarios, "__path__", [*scenarios.__path__, str(tmp_path)])
    for level in (name, str(path)):
        with pytest.raises(
            setpiece.GrfScriptError, match=f"failed at line {line}: {why}"
        ) as caught:
            create_environment(level)
        assert Path(caught.value.path) == path
        assert caught.value.__cause__ is not None


BAD_VALUES = {
    "game_duration = 'x'": "`game_duration` is 'x'; it is an integer",
    "game_duration = 40.5": "`game_duration` is 40.5; it is an integer",
    "second_half = None": "`second_half` is None; it is an integer",
    "left_team_difficulty = None": "`left_team_difficulty` is None; it is a number",
    "right_team_difficulty = float('nan')": "`right_team_difficulty` is nan; it is a number",
    "right_team_difficulty = '0.5'": "`right_team_difficulty` is '0.5'; it is a number",
    "offsides = 'no'": "`offsides` is 'no'; it is True or False",
    "ball_position = 3": "`ball_position` is 3; it is three numbers",
    "left_team = [3]": "`left_team` is [3]; it is a list of players",
    "game_engine_random_seed = 'x'": "`game_engine_random_seed` is 'x'; it is an integer",
}


@pytest.mark.parametrize("statement", BAD_VALUES)
def test_a_setting_of_another_kind_is_named_with_its_line(
    statement: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = script_file(tmp_path, f"    config.{statement}\n")
    why = f"`{path}` at line 5: {BAD_VALUES[statement]}"
    with pytest.raises(ParameterError) as caught:
        create_environment(path)
    assert str(caught.value) == why
    assert caught.value.name == statement.split(" ")[0]
    assert main(["grf", path]) == 1
    assert capsys.readouterr() == ("", why + "\n")


@pytest.mark.parametrize(
    ("statement", "why"),
    [
        ("ball_position[0] = 'x'", "it is three numbers"),
        ("ball_position.clear()", "it is three numbers"),
        ("right_team.append(None)", "it is a list of players"),
    ],
)
def test_a_list_filled_with_something_else_is_named(
    statement: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = script_file(tmp_path, f"    config.{statement}\n")
    assert main(["grf", path]) == 1
    printed = capsys.readouterr().err
    assert printed.startswith(f"`{path}`: `{statement[:8]}")
    assert why in printed


@pytest.mark.parametrize("name", ["position", "role"])
def test_a_players_place_and_role_are_said_once(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    added = "    builder.AddPlayer(-1, 0, e_PlayerRole_GK)\n    config.left_team[0].lazy = True\n"
    path = script_file(tmp_path, added + f"    config.left_team[0].{name} = None\n")
    assert main(["grf", path]) == 1
    assert capsys.readouterr().err.startswith(
        f"`{path}` at line 7: a player's `{name}` can only be read\n"
    )
    assert "GK at (-1.011, 0) { ai: lazy" in import_script(script_file(tmp_path, added, "lazy_one"))


def test_settings_may_be_numbers_of_numpy(tmp_path: Path) -> None:
    text = """
    import numpy
    config.game_duration = numpy.int64(60)
    config.offsides = numpy.bool_(False)
    config.end_episode_on_score = 1
    config.left_team_difficulty = numpy.float32(0.5)
    config.ball_position = numpy.array([0.62, 0.0, 0.0])
"""
    said = recorded(script_file(tmp_path, text), 2)
    assert (said.game_duration, said.offsides, said.end_episode_on_score) == (60, False, True)
    assert said.ball_position == [0.62, 0.0, 0.0]
    assert "difficulty: 0.5" in import_script(script_file(tmp_path, text))
