"""Scenarios as dicts."""

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import play, same

import setpiece
from setpiece import Action
from setpiece._native import run_command

DUO: setpiece.ScenarioDict = {
    "name": "duo",
    "extends": "academy",
    "rules": {"offside": False, "half_time": 50},
    "world": {"friction": "uniform(0.5, 1.5)", "wind": ("4m/s", "-1m/s")},
    "pitch": {"goal": "6m"},
    "agents": {"left": ["anna", "bea"], "others": "hold"},
    "ball": ("uniform(0.5, 0.6)", 0, {"velocity": "(2m/s, 0m/s)"}),
    "difficulty": {"right": 0.3},
    "left": [
        ("GK", -1, 0),
        ("CM", 0.48, 0, {"name": "anna", "stats": {"speed": 0.9}}),
        "bea: CF in right.box",
    ],
    "right": [("GK", 1, np.float32(0.25), {"ai": "lazy"})],
    "rewards": ["scoring", 'near { give 0.01 when ball in right.box as "box" }'],
    "ends": ["success arrived when distance(ball, right.goal) < 5m"],
    "limit": 60,
}
TEXT = """\
scenario duo extends academy {
    rules { offside: off, half_time: 50 }
    world { friction: uniform(0.5, 1.5), wind: (4m/s, -1m/s) }
    pitch { goal: 6m }
    agents { left: [anna, bea], others: hold }
    ball at (uniform(0.5, 0.6), 0) { velocity: (2m/s, 0m/s) }

    team left {
        GK at (-1, 0)
        anna: CM at (0.48, 0) { stats: { speed: 0.9 } }
        bea: CF in right.box
    }

    team right {
        difficulty: 0.3
        GK at (1, 0.25) { ai: lazy }
    }

    reward scoring
    reward near { give 0.01 when ball in right.box as "box" }

    end success arrived when distance(ball, right.goal) < 5m
    end limit 60 steps
}
"""


def test_the_text_is_what_one_would_write(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert setpiece.pitch_text(DUO) == TEXT
    path = tmp_path / "duo.pitch"
    path.write_text(TEXT, encoding="utf-8")
    assert run_command(["fmt", "--check", str(path)]) == 0, capfd.readouterr()


def test_it_is_played_as_its_text() -> None:
    env, other = setpiece.make(DUO), setpiece.make(TEXT)
    assert env.agents == ("anna", "bea")
    assert env.scenario.digest == other.scenario.digest
    act = lambda: [Action.RIGHT, Action.SPRINT]  # noqa: E731
    assert same(play(env, 3, act), play(other, 3, act))


def test_wherever_there_is_a_scenario_there_may_be_a_dict() -> None:
    digest = setpiece.compile(TEXT).digest
    assert setpiece.load(DUO).digest == setpiece.load(TEXT).digest == digest
    assert setpiece.make_vec(DUO, 2).scenario.digest == digest
    assert setpiece.play(DUO, "bot", "bot", seed=1).length <= 60
    again = setpiece.make(DUO).spec
    assert again is not None
    made = pickle.loads(pickle.dumps(again)).make().unwrapped
    assert isinstance(made, setpiece.FootballEnv)
    assert made.scenario.digest == digest
    with pytest.raises(setpiece.ParameterError, match="no file to watch"):
        setpiece.make(DUO, watch=True)


def test_behaviours_play_a_side_of_a_dict_or_a_text() -> None:
    env = setpiece.make(
        {**DUO, "right": [("GK", 1, 0), ("CB", 0.7, 0.1)]}, opponents={"right": "hold"}
    )
    env.reset(seed=1)
    before = env.look("raw")[0]["right_team"].copy()
    for _ in range(5):
        env.step([Action.IDLE, Action.IDLE])
    assert np.array_equal(env.look("raw")[0]["right_team"], before)
    assert setpiece.make(TEXT, opponents={"right": "hold"}).agents == ("anna", "bea")


def test_the_smallest_one_plays() -> None:
    env = setpiece.make({"ball": (0, 0), "left": [("CF", 0, 0.1)], "limit": 3})
    assert env.scenario.name == "from_dict"
    assert len(play(env, 1)) == 4


@pytest.mark.parametrize(
    ("changes", "name", "message"),
    [
        ({"bal": (0, 0)}, "bal", "did you mean `ball`?"),
        ({"difficulty": {"rigt": 1}}, "rigt", "did you mean `right`?"),
        ({"difficulty": 0.5}, "difficulty", "expected a dict"),
        ({"name": "two on one"}, "name", "expected a word, found `'two on one'`"),
        ({"extends": 3}, "extends", "expected the language's words"),
        ({"ball": 0.5}, "ball", "expected (x, y), (x, y, options) or words"),
        ({"ball": (0, 0, 1)}, "ball", "expected options as a dict"),
        ({"ball": (0, None)}, "ball", "expected a finite number"),
        ({"left": "CM"}, "left", "expected a list"),
        ({"left": [("CM", 0)]}, "left[0]", "expected (role, x, y), (role, x, y, options) or words"),
        ({"right": [("GK", 1, 0), (3, 0, 0)]}, "right[1]", "expected a word, found `3`"),
        ({"left": [("CM", 0, float("nan"))]}, "left[0]", "expected a finite number"),
        ({"left": [("CM", 0, 0, {"name": 3})]}, "left[0]", "expected a word"),
        ({"agents": 2}, "agents", "expected a dict"),
        ({"rules": ["offside"]}, "rules", "expected options as a dict"),
        ({"rewards": "scoring"}, "rewards", "expected a list"),
        ({"rewards": [max]}, "rewards", "expected the language's words"),
        ({"ends": [""]}, "ends", "expected the language's words"),
        ({"limit": 1.5}, "limit", "expected steps as an integer"),
        ({"limit": True}, "limit", "expected steps as an integer"),
    ],
)
def test_what_is_not_of_this_form_is_named(
    changes: dict[str, Any], name: str, message: str
) -> None:
    wrong: Any = {**DUO, **changes}
    with pytest.raises(setpiece.ParameterError) as refused:
        setpiece.make(wrong)
    assert refused.value.name == name
    assert message in str(refused.value)


@pytest.mark.parametrize(
    ("changes", "code", "message"),
    [
        ({"left": [("XX", 0, 0)]}, "SP0203", "unknown role `XX`"),
        ({"rules": {"ofside": True}}, "SP0205", "did you mean `offside`?"),
        ({"world": {"gravty": 9}}, "SP0205", "did you mean `gravity`?"),
        ({"rewards": ["scorin"]}, "SP0201", "scoring"),
        ({"ball": "nowhere"}, "SP0101", "expected a place"),
    ],
)
def test_what_has_no_meaning_the_compiler_says(
    changes: dict[str, Any], code: str, message: str
) -> None:
    wrong: Any = {**DUO, **changes}
    with pytest.raises(setpiece.CompileError) as refused:
        setpiece.make(wrong)
    assert code in [diagnostic.code for diagnostic in refused.value.diagnostics]
    assert message in str(refused.value)
    assert refused.value.diagnostics[0].labels[0].file == "duo"
