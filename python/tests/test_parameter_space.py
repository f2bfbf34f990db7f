"""The parameters of a scenario as a space."""

import numpy as np
import pytest
from gymnasium import spaces

import setpiece

DRILL = """
scenario drill {
    param gap = 2m in 1m..20m
    param n: int = 1 in 0..3
    param k = 4 in [1, 4, 9]
    param wing: string = "top" in ["top", "bottom"]
    param wet = off
    param free = 3
    ball at (0.01 * n + 0.001 * k, if wing == "top" and wet then 0.1 else 0.01 * free)
    team left { CF at (50m - gap, 0m) }
    end limit 5 steps
}
"""


def test_samples_are_parameters() -> None:
    scenario = setpiece.compile(DRILL)
    space = scenario.parameter_space
    assert isinstance(space, spaces.Dict)
    assert set(space) == {"gap", "n", "k", "wing", "wet"}
    assert (float(space["gap"].low), float(space["gap"].high)) == (1.0, 20.0)
    space.seed(1)
    samples = [space.sample() for _ in range(200)]
    for sample in samples:
        assert space.contains(sample)
        scenario.with_params(**sample)
    for name, values in [("n", {0, 1, 2, 3}), ("k", {1, 4, 9}), ("wing", {"top", "bottom"})]:
        assert {sample[name] for sample in samples} == values
    assert not space.contains({**samples[0], "gap": 21.0})
    assert not space.contains({**samples[0], "n": 1.5})
    assert "Choice" in repr(space)


def test_a_vector_is_a_sample_and_back() -> None:
    space = setpiece.compile(DRILL).parameter_space
    for share in np.linspace(0, 1, 21):
        params = space.from_vector(np.full(5, share))
        again = space.from_vector(space.to_vector(params))
        assert again.pop("gap") == pytest.approx(params.pop("gap"))
        assert again == params
    assert space.to_vector({"gap": "20m"})[[*space].index("gap")] == 1.0
    for wrong in (np.zeros(4), np.full(5, np.nan)):
        with pytest.raises(setpiece.ParameterError, match="5 finite numbers"):
            space.from_vector(wrong)
    with pytest.raises(setpiece.ParameterError):
        space.to_vector({"gap": 50})


def test_a_mutated_level_is_near_and_can_be_played() -> None:
    scenario = setpiece.compile(DRILL)
    space = scenario.parameter_space
    rng = np.random.default_rng(1)
    level = "drill{gap=10m,n=3}#7:2"
    env = setpiece.make(scenario)
    near = [space.mutate(level, rng, 0.05) for _ in range(100)]
    for one in near:
        assert (one["seed"], one["episode"], one["params"]["free"]) == (7, 2, 3)
        env.reset(options={"level": one})
    gaps = [one["params"]["gap"] for one in near]
    assert 0.5 < np.std(gaps) < 1.5
    assert {one["params"]["wing"] for one in near} == {"top", "bottom"}
    assert space.mutate(level, rng, 0.0)["params"]["gap"] == pytest.approx(10.0)
    with pytest.raises(setpiece.LevelError):
        space.mutate("other#1", rng)
