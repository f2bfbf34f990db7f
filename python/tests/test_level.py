"""Levels: an episode begins again from the text that its last `info` has."""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.vector import AutoresetMode

import setpiece

DRILL = """
scenario drill {
    param gap = 2m in 1m..20m
    let y = uniform(-0.2, 0.2)
    ball at (0.5, y)
    team left { CF at (50m - gap, 0m) }
    end over when elapsed > 0.5s
}
"""


def last_info(env: Any) -> dict[str, Any]:
    while True:
        *_, terminated, truncated, info = env.step(setpiece.Action.IDLE)
        if terminated or truncated:
            return info["setpiece"]


def test_a_level_begins_its_episode_again() -> None:
    env = setpiece.make(DRILL, params={"gap": "5m"})
    env.reset(seed=12)
    last_info(env)
    env.reset()
    first = last_info(env)
    assert first["level"] == "drill{gap=5m}#12:1"
    # Another environment has another default.
    other = setpiece.make(DRILL)
    other.reset(seed=1)
    for level in (
        first["level"],
        {"scenario": "drill", "params": {"gap": "5m"}, "seed": 12, "episode": 1},
        {"scenario": "drill", "params": {"gap": 5}, "seed": np.uint64(12), "episode": 1},
    ):
        other.reset(options={"level": level})
        again = last_info(other)
        assert (again["digest"], again["level"]) == (first["digest"], first["level"])
    other.reset()
    assert last_info(other)["level"] == "drill{gap=5m}#12:2"


def test_a_level_goes_with_its_scenario() -> None:
    env = setpiece.make("academy_corner")
    env.reset(options={"scenario": DRILL, "level": "drill{gap=7m}#3"})
    assert last_info(env)["level"] == "drill{gap=7m}#3"


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"level": "dril#3"}, setpiece.LevelError, "is of `dril`"),
        ({"level": "drill"}, setpiece.ParameterError, "NAME{param=value}#SEED:EPISODE"),
        ({"level": "drill#-3"}, setpiece.ParameterError, "the seed `-3`"),
        ({"level": "drill{gab=5m}#3"}, setpiece.ParameterError, "gap"),
        ({"level": "drill{gap=5m,gap=6m}#3"}, setpiece.ParameterError, "`gap` twice"),
        ({"level": "drill{gap=50m}#3"}, setpiece.ParameterError, "gap"),
        ({"level": {"scenario": "drill", "seed": -1}}, setpiece.ParameterError, "outside"),
        ({"level": {"scenario": "drill", "sed": 1}}, setpiece.ParameterError, "`seed`"),
        ({"level": {"scenario": "drill"}}, setpiece.ParameterError, "no `seed`"),
        ({"level": 3}, setpiece.ParameterError, "found `3`"),
        ({"level": "drill#3", "params": {}}, setpiece.ParameterError, "exclude"),
        ({"level": "drill#3", "episode": 2}, setpiece.ParameterError, "exclude"),
        (
            {"level": {"scenario": "drill", "seed": 1, "digest": "0" * 16}},
            setpiece.LevelError,
            "another version",
        ),
    ],
)
def test_a_bad_level_is_refused(options: Any, error: Any, words: str) -> None:
    for env in (setpiece.make(DRILL), setpiece.make_vec(DRILL, 2)):
        env.reset(seed=1)
        with pytest.raises(error) as caught:
            env.reset(options=options)
        assert words in str(caught.value)
        env.step(env.action_space.sample())
    with pytest.raises(setpiece.ParameterError, match="exclude"):
        setpiece.make(DRILL).reset(seed=1, options={"level": "drill#3"})


def test_a_vector_takes_a_level_for_each_environment() -> None:
    levels = ["drill{gap=5m}#12:1", "drill{gap=2m}#3", "drill{gap=9m}#12:1"]
    digests = []
    for level in levels:
        env = setpiece.make(DRILL)
        env.reset(options={"level": level})
        digests.append(last_info(env)["digest"])
    envs = setpiece.make_vec(DRILL, 3, autoreset_mode=AutoresetMode.DISABLED)

    def ended() -> dict[str, Any]:
        while True:
            _, _, terminated, truncated, infos = envs.step(np.zeros(3, np.int64))
            if (terminated | truncated).any():
                return infos["setpiece"]

    envs.reset(options={"level": levels})
    infos = ended()
    assert infos["level"].tolist() == levels
    assert infos["digest"].tolist() == digests
    envs.reset(options={"level": levels[0]})
    # Parameters of the next episode don't change the level of this one.
    only = np.array([True, False, False])
    envs.reset(options={"params": {"gap": "3m"}, "reset_mask": only, "episode": 4})
    assert ended()["level"].tolist()[1:] == [levels[0]] * 2
    with pytest.raises(setpiece.ParameterError, match="expected 3 levels, found 1"):
        envs.reset(options={"level": levels[:1]})
    # A refused list binds nothing.
    envs.reset(seed=1, options={"params": {"gap": "4m"}})
    with pytest.raises(setpiece.ParameterError):
        envs.reset(options={"level": [levels[0], levels[1], "drill{gap=50m}#3"]})
    envs.reset(seed=1)
    assert ended()["level"].tolist() == [f"drill{{gap=4m}}#{at}" for at in (1, 2, 3)]


def test_a_vector_takes_back_the_levels_of_its_infos() -> None:
    envs = setpiece.make_vec(DRILL, 2, autoreset_mode=AutoresetMode.DISABLED)
    envs.reset(seed=[5, 6])
    levels = np.array([None, "drill{gap=4m}#9"], object)
    envs.reset(options={"level": levels, "reset_mask": np.array([False, True])})
    while True:
        _, _, terminated, _, infos = envs.step(np.zeros(2, np.int64))
        if terminated.any():
            break
    assert infos["setpiece"]["level"].tolist() == ["drill{gap=2m}#5", "drill{gap=4m}#9"]
    with pytest.raises(setpiece.ParameterError, match="environment 0 begins"):
        envs.reset(options={"level": levels})


def test_a_digest_is_of_the_text_whatever_is_bound() -> None:
    digest = setpiece.compile(DRILL).digest
    level = {"scenario": "drill", "seed": 1, "digest": digest}
    setpiece.make(DRILL, params={"gap": "5m"}).reset(options={"level": level})


def test_the_values_of_a_level_may_have_any_sign() -> None:
    text = """
    scenario odd {
        param mode = "a,k=3" in ["a", "b", "a,k=3"]
        param k: int = 1 in 0..9
        ball at (if mode == "a" then 0.1 else 0.2, 0.01 * k)
        team left { CF at (0, 0) }
        end over when elapsed > 0.5s
    }
    """
    env = setpiece.make(text)
    env.reset(seed=1)
    first = last_info(env)
    assert first["level"] == 'odd{k=1,mode="a,k=3"}#1'
    env.reset(options={"level": first["level"]})
    assert last_info(env)["digest"] == first["digest"]


def test_a_level_of_another_scenario_may_say_who_plays() -> None:
    grown = DRILL.replace(
        "scenario drill {", "scenario grown {\n    param n: int = 0 in 0..1"
    ).replace("0m) }", "0m)  CM at (0, 0) when n == 1 }")
    env = setpiece.make(grown, params={"n": 1})
    env.reset(options={"scenario": grown, "level": "grown{n=1}#1"})
    assert last_info(env)["level"] == "grown{gap=2m,n=1}#1"


def test_a_level_is_a_value() -> None:
    level = setpiece.Level("drill", seed=12, episode=1, params={"gap": 5})
    assert str(level) == "drill{gap=5}#12:1"
    same = {level, setpiece.Level.of(str(level).replace("gap=5", "gap=5")), level}
    assert len({setpiece.Level("a", 1), setpiece.Level("a", 1), setpiece.Level("a", 2)}) == 2
    assert len(same) == 2  # A text says texts: the scenario says what they mean.
    assert setpiece.Level.of({"scenario": "drill", "seed": 3}) == setpiece.Level("drill", 3)
    assert setpiece.Level.of(level) == level
    assert str(setpiece.Level("drill", params={"on": True, "word": "a,b"})) == (
        'drill{on=on,word="a,b"}'
    )
    assert pickle.loads(pickle.dumps(level)) == level
    env = setpiece.make(DRILL)
    env.reset(options={"level": level})
    assert last_info(env)["level"] == "drill{gap=5m}#12:1"


def test_a_level_stands_for_a_scenario() -> None:
    text = "academy_corner{difficulty=0.8}#12:3"
    level = setpiece.Level.of(text)
    fields = {"scenario": "academy_corner", "params": {"difficulty": 0.8}, "seed": 12, "episode": 3}
    for given in (text, level, fields):
        scenario = setpiece.load(given)
        assert (scenario.name, scenario.params["difficulty"].default) == ("academy_corner", 0.8)
        env = setpiece.make(given)
        for one in (env, copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
            for _ in range(2):
                one.reset()
                assert one.level == "academy_corner{difficulty=0.8,left_difficulty=1}#12:3"
        env.reset(seed=5)
        env.reset(options={"episode": 7})
        assert env.level.endswith("#5:7")
        env.reset()
        assert env.level.endswith("#12:3")
        envs = setpiece.make_vec(given, 2)
        envs.reset()
        assert envs.levels == ["academy_corner{difficulty=0.8,left_difficulty=1}#12:3"] * 2
    # Without a seed it is the scenario with its parameters.
    env = setpiece.make(setpiece.Level("academy_corner", params={"difficulty": 0.8}), seed=4)
    env.reset()
    env.reset()
    assert env.level.endswith("{difficulty=0.8,left_difficulty=1}#4:1")
    with pytest.raises(setpiece.LevelError, match="another version"):
        setpiece.make(setpiece.Level("academy_corner", 1, digest="0" * 16))


def test_a_level_may_name_a_file(pitch_file: Callable[[str], Path]) -> None:
    path = pitch_file(DRILL)
    level = setpiece.Level(str(path), 3, params={"gap": "5m"})
    env = setpiece.make(level)
    env.reset()
    assert env.level == "drill{gap=5m}#3"
    envs = setpiece.make_vec(level, 2)
    envs.reset()
    assert envs.levels == ["drill{gap=5m}#3"] * 2


def test_one_of_several_scenarios_is_loaded_by_its_name(pitch_file: Callable[[str], Path]) -> None:
    text = DRILL + DRILL.replace("drill", "second")
    for source in (text, pitch_file(text)):
        assert setpiece.load(source).name == "second"
        assert setpiece.load(source, "drill").name == "drill"
        env = setpiece.make(setpiece.load(source, "drill"), params={"gap": 4})
        env.reset(seed=1)
        assert env.level == "drill{gap=4m}#1"
    assert setpiece.load("academy_corner", "academy_corner").name == "academy_corner"
    assert setpiece.compile(text, scenario="drill").name == "drill"
