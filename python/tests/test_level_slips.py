"""Slips with levels, samplers and their states: each is refused."""

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece
from setpiece.samplers import Prioritized, Randomized

TEXT = """
scenario near {
    param gap = 2m in 1m..20m
    ball at (50m, 0m)
    team left { CF at (50m - gap, 0m) }
    reward scoring
    reward steady { give 0.01 as "alive" }
    end success when elapsed >= 0.5s
}
scenario other { ball at (0, 0) team left { CF at (0, 0) } end limit 5 steps }
curriculum course {
    stage first = near until success_rate(last: 6) > 70%
    stage second = near
}
curriculum paid {
    stage first = near until mean(term "steady/alive", last: 4) > 0.01
    stage second = near
}
"""


def refused(match: str) -> Any:
    return pytest.raises(setpiece.ParameterError, match=match)


@pytest.mark.parametrize("scale", [float("nan"), float("inf"), -1.0, "0.1"])
def test_a_scale_is_a_finite_number_from_0_up(scale: Any) -> None:
    space = setpiece.load("academy_corner").parameter_space
    with refused("`scale` is") as caught:
        space.mutate("academy_corner#1", np.random.default_rng(0), scale=scale)
    assert caught.value.name == "scale"


def test_every_level_has_a_score_or_none_is_given() -> None:
    levels = Prioritized("academy_corner", score="given")
    with refused("a score for each of 2 levels, found 1"):
        levels.update(["academy_corner#1", "academy_corner#2"], [1.0])
    with refused("the score of `academy_corner#2` is nan"):
        levels.update(["academy_corner#1", "academy_corner#2"], [1.0, float("nan")])
    assert levels.kept == 0
    levels.update(["academy_corner#1", "academy_corner#2"], [1.0, 2.0])
    assert levels.kept == 2


def test_a_class_is_no_source() -> None:
    with refused("`levels` is the class `Randomized`") as caught:
        setpiece.make_vec("academy_corner", 2, levels=Randomized)  # type: ignore[arg-type]
    assert caught.value.help == "make one: `Randomized(…)`"


def test_a_state_goes_only_to_the_kind_and_scenario_that_it_is_of() -> None:
    corner = Randomized("academy_corner", seed=1)
    assert corner.state_dict()["kind"] == "domain randomisation"
    with refused("`academy_corner`, and this `academy_empty_goal`"):
        Randomized("academy_empty_goal").load_state_dict(corner.state_dict())
    with refused("it is one of a domain randomisation, and this is a prioritized"):
        Prioritized("academy_corner").load_state_dict(corner.state_dict())
    envs = setpiece.make_vec("academy_corner", 2, levels=["academy_corner#1"])
    assert envs.level_source is not None
    with refused("this is a list"):
        envs.level_source.load_state_dict(corner.state_dict())
    other = Randomized("academy_corner")
    other.load_state_dict(corner.state_dict())
    assert other.state_dict() == corner.state_dict()
    assert other.seed == 1


@pytest.mark.parametrize("sample", [2.0, -0.5, 0.5])
def test_a_rate_has_samples_of_0_or_1(sample: float) -> None:
    course = setpiece.curriculum(TEXT, "course", seed=1)
    state = course.state_dict()
    state["memory"]["phase"]["windows"][0] = {"taken": 1, "samples": [sample]}
    with refused("no state of stage 0"):
        course.load_state_dict(state)
    state["memory"]["phase"]["windows"][0]["samples"] = [1.0]
    course.load_state_dict(state)


def test_the_greatest_counts_of_a_state_stay() -> None:
    most = 2**64 - 1
    course = setpiece.curriculum(TEXT, "course", seed=1)
    text = json.dumps(course.state_dict())
    text = re.sub(r'"(tag|episodes|steps|next|taken)": \d+', rf'"\1": {most}', text)
    course.load_state_dict(json.loads(text))
    envs = setpiece.make_vec(TEXT, 4, levels=course)
    envs.reset()
    for _ in range(60):
        envs.step(np.zeros(4, np.int64))
    # All episodes succeed.
    assert course.stage == "second"
    levels = Prioritized("academy_empty_goal_close", seed=1)
    text = json.dumps(levels.state_dict()).replace('"tag": 0', f'"tag": {most}')
    levels.load_state_dict(json.loads(text))
    envs = setpiece.make_vec("academy_empty_goal_close", 4, levels=levels)
    envs.reset()
    for _ in range(80):
        envs.step(np.full(4, setpiece.Action.RIGHT))
    assert levels.kept > 0


def test_a_stage_that_measures_what_is_not_paid_is_refused() -> None:
    with pytest.raises(
        setpiece.LevelError, match="stage `first` of `paid` can't be measured"
    ) as caught:
        setpiece.make_vec(TEXT, 2, levels="paid", rewards="scoring")
    assert "`steady/alive`" in str(caught.value)
    assert caught.value.code == "SP0021"
    envs = setpiece.make_vec(TEXT, 2, levels="paid")
    envs.reset()
    for _ in range(30):
        envs.step(np.zeros(2, np.int64))
    assert envs.level_source.stage == "second"  # type: ignore[union-attr]


def test_without_syllabus_the_error_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    import setpiece.syllabus

    monkeypatch.setitem(sys.modules, "syllabus", None)
    monkeypatch.setitem(sys.modules, "syllabus.task_space", None)
    with pytest.raises(setpiece.MissingPackageError, match="syllabus") as caught:
        setpiece.syllabus.task_space("academy_corner")
    assert caught.value.help == "pip install 'setpiece[syllabus]'"


def test_a_loaded_scenario_brings_no_curriculum() -> None:
    with pytest.raises(setpiece.ParameterError, match="no curriculum is called `paid`") as caught:
        setpiece.make_vec(setpiece.load(TEXT), 2, levels="paid")
    assert "give the file or the text" in str(caught.value.help)


def test_a_name_of_no_plan_says_what_it_is() -> None:
    with pytest.raises(setpiece.ParameterError, match="no curriculum") as caught:
        setpiece.make_vec("academy_corner", 2, levels="academy_empty_goal")
    assert caught.value.help == "a scenario stands in a list: `levels=['academy_empty_goal']`"


@pytest.mark.parametrize(
    ("levels", "words", "helped"),
    [
        ([{"gap": 3}], "no key of a level is called `gap`", "{'params': {'gap': 3}}"),
        (["far{gap=3#1"], "is no level", None),
        (["farr"], "`farr`", None),
        ([3], "expected a level", None),
        ([{"scenario": "far", "episode": 3}], "needs its `seed`", None),
    ],
)
def test_a_slip_in_a_list_is_named(levels: Any, words: str, helped: str | None) -> None:
    with pytest.raises(setpiece.SetpieceError, match=words) as caught:
        setpiece.make_vec(TEXT, 2, levels=levels)
    assert helped is None or helped in str(caught.value.help)


def test_an_episode_has_a_seed() -> None:
    env = setpiece.make("academy_corner")
    with pytest.raises(setpiece.ParameterError, match="no `seed`") as caught:
        env.reset(options={"level": setpiece.Level("academy_corner", params={"difficulty": 0.5})})
    assert "`academy_corner{difficulty=0.5}#7`" in str(caught.value.help)


def test_a_level_decides_seed_and_parameters() -> None:
    for arguments in ({"seed": 3}, {"params": {"difficulty": 0.5}}):
        for made in (setpiece.make, lambda level, **given: setpiece.make_vec(level, 2, **given)):
            with pytest.raises(setpiece.ParameterError, match="exclude each other"):
                made("academy_corner#1", **arguments)
    with pytest.raises(setpiece.ParameterError, match="exclude each other"):
        setpiece.make_vec("academy_corner#1", 2, levels=["academy_corner#2"])


def test_a_scenario_of_a_file_is_chosen_by_its_name(pitch_file: Callable[[str], Path]) -> None:
    path = pitch_file(TEXT)
    for source in (path, str(path), TEXT):
        with pytest.raises(setpiece.CompileError, match="it has `near`, `other`") as caught:
            setpiece.load(source, "nobody")
        assert caught.value.code == "SP0214"
    with pytest.raises(setpiece.SetpieceError, match="`nobody`"):
        setpiece.load("academy_corner", "nobody")
    loaded = setpiece.load(TEXT)
    assert setpiece.load(loaded, loaded.name) is loaded
    with pytest.raises(setpiece.UnknownScenarioError, match="the loaded scenario is"):
        setpiece.load(loaded, "nobody")
    with pytest.raises(setpiece.ParameterError, match="expected a scenario's name"):
        setpiece.load(TEXT, 3)  # type: ignore[arg-type]
