"""Tasks of BenchMARL: MAPPO trains on them."""

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("benchmarl", reason="benchmarl isn't installed")

pytestmark = pytest.mark.filterwarnings("default")

import setpiece.benchmarl
from setpiece import ParameterError

THREE = "academy_3_vs_1_with_keeper"
EXAMPLES = Path(__file__).parents[3] / "examples"


def test_mappo_trains(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLES))
    made = import_module("train_benchmarl").experiment(
        THREE, tmp_path / "runs", iterations=2, frames=200, num_envs=2
    )
    before = [one.clone() for one in made.policy.parameters()]
    made.run()
    assert made.n_iters_performed == 2
    assert made.total_frames == 400
    assert np.isfinite(made.mean_return)
    after = list(made.policy.parameters())
    assert any(not one.equal(other) for one, other in zip(before, after, strict=True))
    logged = {path.stem for path in (tmp_path / "runs").rglob("*.csv")}
    assert any("reward" in name for name in logged)


@pytest.mark.parametrize(
    ("options", "keys", "continuous"),
    [
        ({}, True, True),
        ({"action_set": "v2"}, True, False),
        ({"action_set": "continuous"}, False, True),
    ],
)
def test_a_task_says_what_it_is(options: dict[str, Any], keys: bool, continuous: bool) -> None:
    task = setpiece.benchmarl.task(THREE, left="all", right="all", max_steps=50, **options)
    assert task.supports_discrete_actions() is keys
    assert task.supports_continuous_actions() is continuous
    env = task.get_env_fun(2, continuous, 3, "cpu")()
    assert {name: len(agents) for name, agents in task.group_map(env).items()} == {
        "left": 4,
        "right": 2,
    }
    assert task.max_steps(env) == 50
    for spec, key, size in (
        (task.observation_spec(env), "observation", 115),
        (task.action_mask_spec(env), "action_mask", None),
    ):
        assert set(spec.keys()) == {"left", "right"}
        assert list(spec["left"].keys()) == [key]
        assert spec["left", key].shape[0] == 4
        assert size is None or spec["left", key].shape[1] == size
    wide = task.action_spec(env)["right", "action"].shape
    assert wide == ((2, 4) if continuous else (2,))
    assert task.env_name() == "setpiece"


def test_success_is_logged() -> None:
    task = setpiece.benchmarl.task(THREE, left="all")
    env = task.get_env_fun(2, False, 3, "cpu")()
    rollout = env.rollout(401, break_when_any_done=False)
    shown = task.log_info(rollout)["collection/success"]
    done = rollout["next", "done"]
    assert done.any()
    assert shown == pytest.approx(float(rollout["next", "success"][done].float().mean()))
    assert task.log_info(rollout[:, :1]) == {}


def test_slips() -> None:
    with pytest.raises(ParameterError, match="whom they play"):
        setpiece.benchmarl.task(THREE)
    with pytest.raises(ParameterError, match="max_steps"):
        setpiece.benchmarl.task(THREE, left="all", max_steps=0)
