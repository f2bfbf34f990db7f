"""The environment for TorchRL, and the example that trains on it."""

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece

torch = pytest.importorskip("torch", reason="torch isn't installed")
pytest.importorskip("torchrl", reason="torchrl isn't installed")

pytestmark = pytest.mark.filterwarnings("default")

from torchrl.envs import check_env_specs

import setpiece.torchrl
from setpiece import ParameterError

THREE = "academy_3_vs_1_with_keeper"
EXAMPLES = Path(__file__).parents[3] / "examples"
ENDING = """import "std/academy/academy_empty_goal_close.pitch"
scenario short extends academy_empty_goal_close {
    param steps: int = 5 in 1..20
    end limit 6 steps
    end success early when elapsed > steps * 0.1s - 0.05s
}
"""


@pytest.mark.parametrize(
    ("options", "groups"),
    [
        ({}, {}),
        ({"groups": True}, {"left": ["left_0"]}),
        ({"left": 2, "scale": True, "action_set": "full"}, {"left": ["left_0", "left_1"]}),
        ({"left": "all", "right": "all"}, {"left": 4, "right": 2}),
        ({"right": "all", "left": 0}, {"right": 2}),
        ({"observation": "smm", "size": (24, 18), "stack": 2}, {}),
        ({"left": "all", "action_set": "continuous"}, {"left": 4}),
    ],
)
def test_specs_are_right(options: dict[str, Any], groups: dict[str, Any]) -> None:
    env = setpiece.torchrl.make(THREE, 3, **options)
    check_env_specs(env, seed=2)
    found = {
        name: agents if groups[name] == agents else len(agents)
        for name, agents in env.group_map.items()
    }
    assert found == groups
    # The scenario's limit ends episodes after 400 steps at the latest.
    rollout = env.rollout(401, break_when_any_done=False)
    assert rollout.shape == (3, 401)
    assert rollout["next", "done"].any()
    env.close()


def test_matches_are_those_of_a_vector() -> None:
    env = setpiece.torchrl.make(THREE, 4, left="all", right="all", rewards="scoring,checkpoints")
    vector = setpiece.make_vec(
        THREE, 4, left="all", right="all", rewards="scoring,checkpoints", autoreset_mode="disabled"
    )
    env.set_seed(7, static_seed=True)
    observed, _ = vector.reset(seed=7)
    state = env.reset()
    rng = np.random.default_rng(1)
    ends = 0
    for _ in range(120):
        actions = rng.integers(0, 19, (4, 6))
        for group, columns in (("left", slice(0, 4)), ("right", slice(4, 6))):
            assert np.array_equal(state[group, "observation"].numpy(), observed[:, columns])
            state[group, "action"] = torch.as_tensor(actions[:, columns])
        played, state = env.step_and_maybe_reset(state)
        last = played["next"]
        observed, rewards, terminated, truncated, infos = vector.step(actions)
        for group, columns in (("left", slice(0, 4)), ("right", slice(4, 6))):
            assert np.array_equal(last[group, "observation"].numpy(), observed[:, columns])
            assert np.array_equal(last[group, "reward"][..., 0].numpy(), rewards[:, columns])
            mask = infos["action_mask"][:, columns].astype(bool)
            assert np.array_equal(last[group, "action_mask"].numpy(), mask)
        assert np.array_equal(last["terminated"][:, 0].numpy(), terminated)
        assert np.array_equal(last["truncated"][:, 0].numpy(), truncated)
        over = terminated | truncated
        assert np.array_equal(last["done"][:, 0].numpy(), over)
        if over.any():
            ends += 1
            won = infos["setpiece"]["success"] & over
            assert np.array_equal(last["success"][:, 0].numpy(), won)
            observed, _ = vector.reset(options={"reset_mask": over})
    assert ends > 2


def test_a_partial_reset_leaves_the_others_alone() -> None:
    env = setpiece.torchrl.make(THREE, 3)
    env.set_seed(1)
    state = env.rollout(20, break_when_any_done=False)[:, -1]["next"].clone()
    before = state["observation"].clone()
    mask = torch.tensor([[False], [True], [False]])
    fresh = env.reset(state.set("_reset", mask))
    same = (fresh["observation"] == before).all(-1)
    assert same.tolist() == [True, False, True]
    assert not fresh["done"].any()


def test_endings_and_limits_are_told_apart() -> None:
    env = setpiece.torchrl.make(ENDING, 2, params=[{"steps": 3}, {"steps": 20}])
    state = env.reset()
    seen = []
    for _ in range(6):
        state["action"] = torch.zeros(2, dtype=torch.int64)
        played, state = env.step_and_maybe_reset(state)
        last = played["next"]
        seen.append([last["terminated"].flatten().tolist(), last["truncated"].flatten().tolist()])
    assert seen[1] == [[False, False], [False, False]]
    assert seen[2] == [[True, False], [False, False]]
    assert seen[5] == [[True, False], [False, True]]


def test_a_seed_repeats_a_rollout() -> None:
    def rollout(seed: int) -> Any:
        env = setpiece.torchrl.make(THREE, 2, threads=1)
        env.set_seed(seed)
        torch.manual_seed(0)
        return env.rollout(80, break_when_any_done=False)

    one, same, other = rollout(4), rollout(4), rollout(5)
    assert (one == same).all()
    assert not torch.equal(one["observation"], other["observation"])


def test_slips() -> None:
    with pytest.raises(ParameterError, match="copy"):
        setpiece.torchrl.make(THREE, copy=False)
    with pytest.raises(ParameterError, match="4 agents"):
        setpiece.torchrl.make(THREE, left="all", groups=False)
    with pytest.raises(ParameterError, match="groups"):
        setpiece.torchrl.make(THREE, groups="left")  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match="resets"):
        setpiece.torchrl.FootballTensorEnv(setpiece.make_vec(THREE, 2))


def test_the_example_trains(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLES))
    train = import_module("train_torchrl").train
    updates = list(train("academy_empty_goal_close", num_envs=4, frames=4 * 64 * 3))
    assert len(updates) == 3
    assert all(np.isfinite(update["loss"]) for update in updates)
    assert len({update["loss"] for update in updates}) == 3
    assert any(update["reward"] > 0 for update in updates)
