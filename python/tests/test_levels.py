"""Sources of levels: curricula, lists, functions and samplers choose what a vector plays."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import same
from gymnasium.vector import AutoresetMode

import setpiece
from setpiece.samplers import Prioritized, Randomized

COURSE = """
reward steady { give 0.01 as "alive" }

scenario near {
    ball at (0.9, 0)
    team left { CF at (0.85, 0) }
    reward scoring
    end success when elapsed >= 0.5s
}
scenario far extends near {
    param gap = 2m in 1m..21m
    param n: int = 1 in [1, 4, 9]
    record gap_m = gap / 1m
    ball at (50m - gap, 0m)
    reward steady
}
curriculum course {
    stage first = near until success_rate(last: 6) > 70%
    stage second = far(gap: d, n: 4) adapt d from 1m to 21m keeping success_rate(last: 4) in 40%..60%
    mix current: 75%, earlier: 25%
}
"""


def idle(envs: Any) -> Any:
    return np.zeros(envs.action_space.shape, np.int64)


def endings(envs: Any, steps: int) -> list[tuple[int, int, dict[str, Any]]]:
    """Plays some steps; step, environment and the last `infos["setpiece"]` of each episode."""
    found = []
    for step in range(steps):
        _, _, terminated, truncated, infos = envs.step(idle(envs))
        last = infos.get("final_info", infos)
        for at in np.flatnonzero(terminated | truncated).tolist():
            one = {
                key: value[at]
                for key, value in last["setpiece"].items()
                if isinstance(value, np.ndarray)
            }
            found.append((step, at, one))
    return found


def played(envs: Any, steps: int) -> list[str]:
    return [one["level"] for _, _, one in endings(envs, steps)]


def test_a_curriculum_of_the_language_chooses_what_is_played() -> None:
    envs = setpiece.make_vec(COURSE, 4, levels="course", seed=7)
    assert isinstance(envs.level_source, setpiece.Curriculum)
    assert envs.level_source.stages == ("first", "second")
    with pytest.raises(gymnasium.error.ResetNeeded):
        _ = envs.levels
    envs.reset()
    assert envs.levels == [f"near#7{':' if at else ''}{at or ''}" for at in range(4)]
    assert envs.level_source.stage == "first"
    found = endings(envs, 300)
    assert envs.level_source.stage == "second"
    assert envs.level_source.value == 21.0
    # Each number once, in the order of the environments.
    numbers = [int(one["index"]) for _, _, one in found]
    assert sorted(numbers) == [*range(len(numbers))]
    far = setpiece.compile(COURSE)
    assert far.name == "far"
    digests = {
        one["level"][: one["level"].index("#")].split("{")[0]: one["scenario"]
        for _, _, one in found
    }
    assert digests["far"] == far.digest
    assert digests["near"] != far.digest
    assert any(one["level"].startswith("far{gap=21m,n=4}#7:") for _, _, one in found)


def test_the_terms_of_all_scenarios_are_listed_together() -> None:
    envs = setpiece.make_vec(COURSE, 2, levels="course", seed=1)
    _, infos = envs.reset()
    assert "steady/alive" in infos["reward_terms"]
    for _ in range(60):
        levels = envs.levels
        _, rewards, terminated, _, infos = envs.step(idle(envs))
        alive = infos["reward_terms"]["steady/alive"]
        total = sum(infos["reward_terms"].values())
        assert np.allclose(rewards, total)
        for at in range(2):
            if levels[at] == envs.levels[at]:
                assert alive[at] == (0.01 if levels[at].startswith("far") else 0.0)
        for at in np.flatnonzero(terminated).tolist():
            paid = infos["setpiece"]["return"]["steady/alive"][at]
            assert (paid > 0) == levels[at].startswith("far")


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_levels_do_not_depend_on_the_threads(mode: AutoresetMode) -> None:
    runs = []
    for threads in (1, 2, 5):
        envs = setpiece.make_vec(
            COURSE, 9, levels="course", seed=3, threads=threads, autoreset_mode=mode
        )
        envs.reset()
        runs.append(endings(envs, 60))
    assert len(runs[0]) > 50
    assert same(runs[0], runs[1])
    assert same(runs[0], runs[2])


def test_every_level_can_be_played_again() -> None:
    envs = setpiece.make_vec(COURSE, 3, levels="course", seed=3)
    envs.reset()
    found = endings(envs, 40)
    for _, _, one in [found[0], found[-1]]:
        name = one["level"].split("{")[0].split("#")[0]
        env = setpiece.make(COURSE if name == "far" else COURSE.split("scenario far")[0])
        env.reset(options={"level": one["level"]})
        while True:
            *_, terminated, truncated, info = env.step(0)
            if terminated or truncated:
                break
        assert info["setpiece"]["digest"] == one["digest"]


def test_a_restored_curriculum_continues_as_the_original() -> None:
    course = setpiece.curriculum(COURSE, seed=5)
    envs = setpiece.make_vec(COURSE, 4, levels=course)
    envs.reset()
    endings(envs, 30)
    state = json.loads(json.dumps(course.state_dict()))
    envs.reset()
    first = played(envs, 40)
    again = setpiece.curriculum(COURSE, "course")
    again.load_state_dict(state)
    assert again.seed == 5
    other = setpiece.make_vec(COURSE, 4, levels=again)
    other.reset()
    assert played(other, 40) == first
    with pytest.raises(setpiece.ParameterError, match="it plays `near`, `far`, and this"):
        setpiece.curriculum("learn_3_vs_1").load_state_dict(state)
    renamed = setpiece.curriculum(COURSE.replace("stage first", "stage begin"), "course")
    with pytest.raises(setpiece.ParameterError, match="the stages are `first`, `second`"):
        renamed.load_state_dict(state)
    for wrong in ({}, {"stages": 3}, 7):
        with pytest.raises(setpiece.ParameterError):
            again.load_state_dict(wrong)  # type: ignore[arg-type]
    assert repr(again).startswith("Curriculum(")


def test_a_seed_of_reset_seeds_the_source() -> None:
    envs = setpiece.make_vec(COURSE, 3, levels="course")
    envs.reset(seed=11)
    first = played(envs, 8)
    assert all("#11" in level for level in first)
    envs.reset(seed=11)
    assert played(envs, 8)[0] == first[0]
    # Without a seed levels are counted on.
    envs.reset()
    assert all("#11:" in level for level in envs.levels)
    # Two vectors without any seed differ.
    seeds = set()
    for _ in range(2):
        other = setpiece.make_vec(COURSE, 1, levels="course")
        other.reset()
        seeds.add(other.levels[0])
    assert len(seeds) == 2


def test_a_list_begins_again_after_its_end() -> None:
    levels = ["far{gap=5m}#1", {"scenario": "far", "seed": 2, "params": {"gap": 3}}, "far#3"]
    envs = setpiece.make_vec(COURSE, 2, levels=levels, params={"n": 9})
    envs.reset()
    assert envs.levels == ["far{gap=5m,n=9}#1", "far{gap=3m,n=9}#2"]
    assert played(envs, 12) == [
        *("far{gap=5m,n=9}#1", "far{gap=3m,n=9}#2", "far{gap=2m,n=9}#3", "far{gap=5m,n=9}#1")
    ]
    library = setpiece.make_vec(
        "academy_corner", 2, levels=["academy_corner#1", "academy_empty_goal#2"]
    )
    library.reset()
    assert [level.split("{")[0] for level in library.levels] == [
        "academy_corner",
        "academy_empty_goal#2",
    ] or library.levels[1].startswith("academy_empty_goal")


def test_a_list_holds_whatever_a_user_would_write(pitch_file: Callable[[str], Path]) -> None:
    level = setpiece.Level("far", 3, params={"gap": 5})
    # One level alone.
    array = np.array(["far{gap=5m}#3"], object)
    for one in (
        level,
        array,
        "far{gap=5m}#3",
        {"scenario": "far", "seed": 3, "params": {"gap": 5}},
    ):
        envs = setpiece.make_vec(COURSE, 2, levels=one)
        envs.reset()
        assert envs.levels == ["far{gap=5m,n=1}#3"] * 2
    # What has no seed is another episode every time, under the seed of the vector.
    for source in (COURSE, pitch_file(COURSE)):
        levels = ["near", {"params": {"gap": 4}}, level, "far{gap=6m}", setpiece.load(COURSE)]
        envs = setpiece.make_vec(source, 5, levels=levels, seed=8)
        envs.reset()
        assert envs.levels == [
            *("near#8", "far{gap=4m,n=1}#8:1", "far{gap=5m,n=1}#3", "far{gap=6m,n=1}#8:3"),
            "far{gap=2m,n=1}#8:4",
        ]
        assert played(envs, 12)[0] == "near#8"
        envs.reset(seed=9)
        assert envs.levels[:2] == ["near#9", "far{gap=4m,n=1}#9:1"]
    # Names of the library.
    names = ["academy_empty_goal", "academy_run_to_score"]
    library = setpiece.make_vec("academy_empty_goal", 2, levels=names, seed=1)
    library.reset()
    assert [level.split("{")[0].split("#")[0] for level in library.levels] == names


def test_a_suite_is_played_by_its_name_or_as_it_is(pitch_file: Callable[[str], Path]) -> None:
    text = COURSE + "suite two { near for 2 episodes  far(gap: 3m) for 1 episode seed 5 }"
    suite = setpiece.suite(text)
    alone = pitch_file(text.replace(COURSE[COURSE.index("curriculum") :], ""))
    for source, levels in ((text, "two"), (text, suite), (text, suite.levels), (alone, alone)):
        envs = setpiece.make_vec(source, 4, levels=levels)
        envs.reset()
        assert envs.levels == ["near#0", "near#0:1", "far{gap=3m,n=1}#5", "near#0"]
    with pytest.raises(setpiece.ParameterError, match="no suite is called `acadmy`") as caught:
        setpiece.make_vec("academy_corner", 2, levels="acadmy")
    assert caught.value.help == "did you mean `academy`?"
    envs = setpiece.make_vec("academy_corner", 2, levels="academy")
    envs.reset()
    assert envs.levels[0].startswith("academy_empty_goal_close")


def test_a_function_gets_the_result_and_returns_the_next_level() -> None:
    results: list[Any] = []

    def choose(result: setpiece.LevelResult | None) -> Any:
        results.append(result)
        if len(results) == 3:
            return f"academy_empty_goal#{len(results)}"
        return {"scenario": "far", "seed": len(results), "params": {"gap": f"{len(results)}m"}}

    envs = setpiece.make_vec(COURSE, 2, levels=choose)
    envs.reset(seed=4)
    assert results == [None, None]
    assert envs.levels == ["far{gap=1m,n=1}#1", "far{gap=2m,n=1}#2"]
    assert envs.level_source is None
    endings(envs, 7)
    result = results[2]
    assert (result.level, result.success, result.length) == ("far{gap=1m,n=1}#1", True, 5)
    assert result.records == {"gap_m": 1.0}
    assert result.returns == [pytest.approx(0.05)]
    assert envs.levels[0].startswith("academy_empty_goal")


def test_a_function_that_fails_says_so() -> None:
    def choose(_result: object) -> str:
        raise KeyError("no level")

    with pytest.raises(setpiece.CallbackError, match="choose"):
        setpiece.make_vec(COURSE, 2, levels=choose).reset()
    for given, error, words in [
        ("far", setpiece.ParameterError, "NAME"),
        ("fart#1", setpiece.UnknownScenarioError, "fart"),
        ("5_vs_5#1", setpiece.LevelError, "doesn't fit the vector"),
        ("far{gap=90m}#1", setpiece.ParameterError, "gap"),
    ]:
        envs = setpiece.make_vec(
            COURSE, 2, levels=lambda _, given=given: given, observation="egocentric"
        )
        with pytest.raises(error, match=words):
            envs.reset()


@pytest.mark.parametrize(
    ("second", "words"),
    [
        ("observe vector { me.speed  me.speed }", r"shape \[2\].*\[1\]"),
        ("observe vector { ball.x }", "other numbers"),
        ("agents { left: 2 }", "2 agents on the left"),
    ],
)
def test_scenarios_with_other_spaces_are_refused(second: str, words: str) -> None:
    text = f"""
    scenario one {{
        ball at (0, 0)  team left {{ CM at (-0.1, 0)  CF at (-0.1, 0.1) }}
        observe vector {{ me.speed }}
        end limit 1s
    }}
    scenario two extends one {{ {second} }}
    curriculum course {{
        stage a = one until episodes >= 3
        stage b = two
    }}
    """
    observation = "vector" if "observe" in second else "simple115v2"
    with pytest.raises(setpiece.LevelError, match=words) as caught:
        setpiece.make_vec(
            text.replace("curriculum", "scenario last extends one {}\ncurriculum"),
            2,
            levels="course",
            observation=observation,
        )
    assert caught.value.code == "SP0021"
    assert "stage `b` of `course`" in str(caught.value)


def test_stages_may_have_other_players() -> None:
    text = """
    scenario rondo {
        param n: int = 1 in 1..3
        ball at (0, 0)
        team left { CM at (-0.1, 0)  CF at (-0.1, 0.1) when n > 1  LM at (0.1, 0.1) when n > 2 }
        end success when elapsed >= 0.3s
    }
    curriculum grows {
        stage one = rondo until episodes >= 2
        stage three = rondo(n: 3) until episodes >= 2
        stage adapts = rondo(n: k) adapt k from 1 to 3 keeping success_rate(last: 1) in 0%..50%
    }
    """
    envs = setpiece.make_vec(text, 2, levels="grows", seed=1)
    envs.reset()
    names = {level.split("#")[0] for level in played(envs, 200)}
    assert names == {"rondo{n=1}", "rondo{n=2}", "rondo{n=3}"}
    egocentric = setpiece.make_vec(text, 2, levels="grows", seed=1, observation="egocentric")
    egocentric.reset()
    with pytest.raises(setpiece.LevelError, match="shape"):
        endings(egocentric, 50)


def test_what_the_levels_choose_is_refused_elsewhere() -> None:
    envs = setpiece.make_vec(COURSE, 2, levels="course", seed=1)
    envs.reset()
    for options in ({"params": {"gap": 3}}, {"episode": 4}):
        with pytest.raises(setpiece.ParameterError, match="chooses"):
            envs.reset(options=options)
    with pytest.raises(setpiece.ParameterError, match="one seed"):
        envs.reset(seed=[1, 2])
    with pytest.raises(setpiece.ParameterError, match="chooses the parameters"):
        setpiece.make_vec(COURSE, 2, levels="course", params={"gap": 3})
    with pytest.raises(setpiece.ParameterError, match="`lean_3_vs_1`") as caught:
        setpiece.make_vec(COURSE, 2, levels="lean_3_vs_1")
    assert caught.value.code == "SP0020"
    assert "learn_3_vs_1" in str(caught.value)
    with pytest.raises(setpiece.ParameterError, match="expected one curriculum, found 0"):
        setpiece.curriculum(COURSE.split("curriculum")[0])
    for wrong in (3, []):
        with pytest.raises(setpiece.ParameterError):
            setpiece.make_vec(COURSE, 2, levels=wrong)  # type: ignore[arg-type]


def test_a_digest_is_of_the_text_whatever_a_vector_binds() -> None:
    envs = setpiece.make_vec(COURSE, 2, params={"gap": "5m"})
    envs.reset()
    scenario = setpiece.load(COURSE)
    envs.reset(options={"level": {"scenario": "far", "seed": 3, "digest": scenario.digest}})


def test_a_first_level_leaves_the_source_its_seed() -> None:
    envs = setpiece.make_vec(COURSE, 2, levels="course", seed=7)
    envs.reset(options={"level": "far#3"})
    assert envs.level_source is not None
    assert envs.level_source.seed == 7


def test_what_levels_would_ignore_is_refused() -> None:
    with pytest.raises(setpiece.ParameterError, match="chooses the parameters"):
        setpiece.make_vec(COURSE, 2, levels=["far#1"], params=[{"gap": 3}, {"gap": 4}])
    text = "behavior press_on { repeat { do press for 1s } }" + COURSE
    with pytest.raises(setpiece.ParameterError, match="brings its own"):
        setpiece.make_vec(text, 2, levels="course", opponents={"right": "press_on"})


def test_an_explicit_level_comes_between() -> None:
    envs = setpiece.make_vec(
        COURSE, 2, levels="course", seed=1, autoreset_mode=AutoresetMode.DISABLED
    )
    envs.reset()
    only = np.array([True, False])
    envs.reset(options={"level": "far{gap=9m}#8", "reset_mask": only})
    assert envs.levels == ["far{gap=9m,n=1}#8", "near#1:1"]
    endings(envs, 5)
    envs.reset(options={"reset_mask": only})
    assert envs.levels == ["near#1:2", "near#1:1"]


def test_a_path_names_the_curriculum_of_a_file(pitch_file: Callable[[str], Path]) -> None:
    path = pitch_file(COURSE)
    for levels in (path, str(path), "course"):
        envs = setpiece.make_vec(path, 2, levels=levels, seed=1)
        envs.reset()
        assert envs.levels[0] == "near#1"
    two = pitch_file(COURSE + COURSE.split("}\n")[-2].replace("course", "other") + "}\n")
    with pytest.raises(setpiece.ParameterError, match="found 2"):
        setpiece.curriculum(two)
    assert setpiece.curriculum(two, "other").stage == "first"


def test_a_vector_with_levels_can_be_made_again_from_its_spec() -> None:
    envs = setpiece.make_vec(COURSE, 2, levels="course", seed=1)
    assert envs.spec is not None
    again = gymnasium.make_vec(envs.spec, num_envs=3)
    again.reset()
    assert again.unwrapped.levels[2] == "near#1:2"
    envs.spec.make().reset()


def test_parameters_of_each_environment() -> None:
    each = [{"gap": "3m"}, {"gap": 4}, {}]
    envs = setpiece.make_vec(COURSE, 3, params=each, seed=1)
    envs.reset()
    expected = ["far{gap=3m,n=1}#1", "far{gap=4m,n=1}#2", "far{gap=2m,n=1}#3"]
    assert envs.levels == expected
    envs.reset(seed=5, options={"params": [{"n": 4}, {"n": 9}, {}]})
    assert envs.levels == ["far{gap=2m,n=4}#5", "far{gap=2m,n=9}#6", "far{gap=2m,n=1}#7"]
    for wrong in (each[:2], [1, 2, 3], [{"gap": "90m"}] * 3):
        with pytest.raises(setpiece.ParameterError):
            setpiece.make_vec(COURSE, 3, params=wrong)  # type: ignore[arg-type]
    assert envs.spec is not None
    envs.spec.make().reset()


def test_a_learner_with_opponents_and_a_mirror_sees_the_levels() -> None:
    envs = setpiece.make_vec(
        "academy_3_vs_1_with_keeper",
        2,
        left=2,
        right=1,
        opponents={"right": lambda _seen: 5},
        levels="learn_3_vs_1",
        seed=1,
    )
    replays: list[bytes] = []
    envs.mirrors.append(lambda replay: replays.append(replay()))
    observations, _ = envs.reset()
    assert observations.shape == (2, 2, 115) or observations.shape[0] == 2


def test_domain_randomisation_draws_the_named_parameters() -> None:
    levels = Randomized(COURSE, ["gap"], seed=3)
    envs = setpiece.make_vec(COURSE, 4, levels=levels)
    envs.reset()
    found = played(envs, 60)
    gaps = {level.split("gap=")[1].split("m")[0] for level in found}
    assert len(gaps) > 20
    assert all("n=1}" in level for level in found)
    assert len({level.split("n=")[1][0] for level in played_of(Randomized(COURSE, seed=3))}) == 3
    for wrong, words in [(["gab"], "gap"), ("gap", "list"), ([], "no parameter")]:
        with pytest.raises(setpiece.ParameterError, match=words):
            Randomized(COURSE, wrong)


def played_of(source: Any) -> list[str]:
    envs = setpiece.make_vec(COURSE, 4, levels=source)
    envs.reset()
    return played(envs, 60)


def test_given_scores_decide_what_is_played_again() -> None:
    levels = Prioritized(COURSE, ["gap"], score="given", capacity=4, seed=3)
    envs = setpiece.make_vec(COURSE, 4, levels=levels)
    envs.reset()
    found = played(envs, 60)
    assert levels.kept == 0
    assert len({*found}) == len(found)
    levels.update(found[:6], [0.0, 5.0, 1.0, 2.0, 3.0, 4.0])
    assert levels.kept == 4
    later = played(envs, 200)
    counts = {level: later.count(level) for level in found[:6]}
    assert counts[found[1]] > counts[found[3]]
    assert counts[found[0]] == counts[found[2]] == 0
    state = levels.state_dict()
    other = Prioritized(COURSE, ["gap"], score="given", capacity=4)
    other.load_state_dict(state)
    assert other.state_dict() == state
    with pytest.raises(setpiece.ParameterError, match="nan"):
        levels.update(found[:1], [float("nan")])
    with pytest.raises(setpiece.LevelError):
        levels.update(["near#3"], [1.0])


def test_learnability_and_edits_need_nothing_from_the_learner() -> None:
    levels = Prioritized(COURSE, ["gap"], capacity=8, edit=0.5, replay=0.8, seed=3)
    found = played_of(levels)
    assert levels.kept == 8
    keys = [level.split("#")[1] for level in found]
    edited = [level for level in found if keys.count(level.split("#")[1]) > 1]
    assert len({*edited}) > len({level.split("#")[1] for level in edited})
    for wrong in [
        {"capacity": 0},
        {"capacity": 1.5},
        {"replay": 2},
        {"temperature": 0},
        {"score": "regret"},
    ]:
        with pytest.raises(setpiece.ParameterError):
            Prioritized(COURSE, **wrong)  # type: ignore[arg-type]


def test_a_vector_of_stable_baselines_plays_a_curriculum() -> None:
    sb3 = pytest.importorskip("setpiece.sb3", exc_type=ImportError)
    vec = sb3.make_vec(COURSE, 2, levels="course", seed=5)
    vec.reset()
    assert vec.envs.levels == ["near#5", "near#5:1"]
    with pytest.raises(setpiece.ParameterError, match="batch"):
        sb3.make_vec(COURSE, 2, levels="course", events=True)
