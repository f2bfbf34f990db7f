"""PufferLib's native environment, its vectors over it, and the loop of `recv` and `send`."""

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece

pytestmark = pytest.mark.filterwarnings("default")

try:
    # It links its resources into the working directory when it is imported.
    import pufferlib.vector
except ImportError:
    pytest.skip("pufferlib isn't installed", allow_module_level=True)

import setpiece.pufferlib

THREE = "academy_3_vs_1_with_keeper"
EXAMPLES = Path(__file__).parents[3] / "examples"


def rollout(env: Any, seed: int, steps: int) -> list[Any]:
    """Steps that PufferLib's own `reset` and `step` play."""
    rng = np.random.default_rng(seed)
    observed, _ = env.reset(seed=seed)
    played = [observed.copy()]
    for _ in range(steps):
        observed, *rest, _ = env.step(rng.integers(0, 19, env.action_space.shape))
        played += [observed.copy(), *(one.copy() for one in rest)]
    return played


@pytest.mark.parametrize("agents", [None, "all"])
def test_the_native_environment_plays_what_a_vector_plays(agents: str | None) -> None:
    options: dict[str, Any] = {"left": agents, "rewards": "scoring,checkpoints"}
    native = pufferlib.vector.make(
        setpiece.pufferlib.FootballPuffer, env_args=[THREE, 3], env_kwargs=options
    )
    vector = setpiece.make_vec(THREE, 3, autoreset_mode="same_step", **options)
    n = len(vector.agents)
    assert native.num_agents == 3 * n
    assert native.single_observation_space.shape == (115,)
    observed, _ = vector.reset(seed=5)
    assert np.array_equal(native.reset(seed=5)[0], observed.reshape(3 * n, 115))
    rng = np.random.default_rng(0)
    told = []
    for _ in range(120):
        actions = rng.integers(0, 19, 3 * n)
        seen, paid, terminals, truncations, infos = native.step(actions)
        observed, rewards, terminated, truncated, _ = vector.step(
            actions.reshape(vector.action_space.shape)
        )
        assert np.array_equal(seen, observed.reshape(3 * n, 115))
        assert np.array_equal(paid, np.asarray(rewards, np.float32).ravel())
        assert np.array_equal(terminals, np.repeat(terminated, n))
        assert np.array_equal(truncations, np.repeat(truncated, n))
        assert len(infos) == int((terminated | truncated).sum())
        told += infos
    assert told
    assert set(told[0]) == {"episode_return", "episode_length", "success"}
    assert all(1 <= info["episode_length"] <= 400 for info in told)
    native.close()


def test_serial_vectors_hold_several() -> None:
    serial = pufferlib.vector.make(
        setpiece.pufferlib.FootballPuffer,
        env_args=[THREE, 2],
        backend=pufferlib.vector.Serial,
        num_envs=2,
    )
    seen = rollout(serial, 3, 20)
    assert seen[0].shape == (4, 115)
    # The second environment's matches have the seeds 4 and 5.
    native = setpiece.pufferlib.FootballPuffer(THREE, 2)
    assert np.array_equal(native.reset(seed=4)[0], seen[0][2:])
    serial.close()


def test_groups_play_what_the_native_environment_plays() -> None:
    native = setpiece.pufferlib.FootballPuffer(THREE, 4, left="all")
    native.reset(seed=2)
    groups = setpiece.pufferlib.make(THREE, 4, left="all")
    assert (groups.num_agents, groups.agents_per_batch) == (16, 8)
    assert groups.driver_env.single_action_space.n == 19
    groups.async_reset(2)
    rng = np.random.default_rng(1)
    rows = [native.observations, native.rewards, native.terminals, native.truncations]
    for _ in range(100):
        actions = rng.integers(0, 19, 16)
        ended = 0
        for _ in range(2):
            *seen, infos, agents, masks = groups.recv()
            for one, other in zip(seen, rows, strict=True):
                assert np.array_equal(one, other[agents])
            assert masks.all()
            ended += len(infos)
            groups.send(actions[agents])
        assert ended * 4 == int((native.terminals | native.truncations).sum())
        native.step(actions)
    groups.close()


def test_the_example_trains(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLES))
    train = import_module("train_pufferlib").train
    updates = list(train("academy_empty_goal_close", num_envs=8, steps=3 * 64 * 8))
    assert len(updates) == 3
    assert all(np.isfinite(update["loss"]) for update in updates)
    assert any(update["reward"] > 0 for update in updates)


def test_slips() -> None:
    with pytest.raises(pufferlib.APIUsageError, match="same_step"):
        setpiece.pufferlib.FootballPufferGroups(setpiece.make_groups(THREE, 2))
    with pytest.raises(setpiece.ParameterError, match="groups"):
        setpiece.pufferlib.make(THREE, 3, groups=2)
