"""Groups of matches: `send` and `recv`."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from environment_texts import SCRIPTED

import setpiece
from setpiece import ActionError, ParameterError, ScriptError, UnavailableError

THREE = "academy_3_vs_1_with_keeper"


def groups_of(*arguments: Any, **options: Any) -> setpiece.FootballGroups:
    return setpiece.make_groups(*arguments, **options)


@pytest.mark.parametrize("mode", ["next_step", "same_step"])
@pytest.mark.parametrize("agents", [None, "all"])
def test_an_environment_plays_what_it_plays_in_a_vector(mode: str, agents: str | None) -> None:
    options: dict[str, Any] = {
        "autoreset_mode": mode,
        "left": agents,
        "rewards": "scoring,checkpoints",
    }
    vector = setpiece.make_vec(THREE, 6, **options)
    observed, _ = vector.reset(seed=11)
    rng = np.random.default_rng(2)
    ended = 0
    with groups_of(THREE, 6, groups=3, **options) as envs:
        assert (envs.num_envs, envs.batch_size) == (6, 2)
        assert envs.action_space.shape == (2, *vector.action_space.shape[1:])  # type: ignore[index]
        envs.async_reset(seed=11)
        rewards, over, infos = np.zeros(vector.action_space.shape), np.zeros(6, bool), {}  # type: ignore[arg-type, var-annotated]
        for step in range(300):
            actions = rng.integers(0, 19, vector.action_space.shape)
            for group in range(3):
                seen, paid, terminated, truncated, with_them = envs.recv()
                ids = with_them["env_id"]
                assert ids.tolist() == [2 * group, 2 * group + 1]
                assert np.array_equal(seen, observed[ids])
                assert np.array_equal(paid, rewards[ids])
                assert np.array_equal(terminated | truncated, over[ids])
                if step:
                    assert np.array_equal(with_them["action_mask"], infos["action_mask"][ids])
                    for at in np.flatnonzero(terminated | truncated):
                        last = with_them.get("final_info", with_them)["setpiece"]
                        wanted = infos.get("final_info", infos)["setpiece"]
                        assert last["digest"][at] == wanted["digest"][ids[at]]
                        ended += 1
                envs.send(actions[ids])
            observed, rewards, terminated, truncated, infos = vector.step(actions)
            over = terminated | truncated
    assert ended > 5


def test_the_caller_goes_on_while_a_group_is_played() -> None:
    with groups_of("11_vs_11_easy_stochastic", 64, groups=2, threads=1) as envs:
        envs.async_reset(seed=1)
        envs.recv()
        envs.recv()
        count = 0
        # A step of 32 matches takes some milliseconds, in which this thread counts.
        envs.send(np.zeros(32, np.int64))
        ((_, future),) = envs._played
        while not future.done():
            count += 1
        assert count > 100


def test_actions_may_be_given_by_env_id() -> None:
    with groups_of(THREE, 4, groups=2) as envs, groups_of(THREE, 4, groups=2) as others:
        for one in (envs, others):
            one.async_reset(seed=3)
        first, second = (envs.recv()[-1]["env_id"] for _ in range(2))
        envs.send([5, 5], env_id=second)
        envs.send([1, 1], env_id=first)
        assert envs.recv()[-1]["env_id"].tolist() == [2, 3]
        shown = envs.recv()[0]
        others.recv()
        others.send([1, 1])
        others.recv()
        assert np.array_equal(others.recv()[0], shown)
        others.send([5, 5])
        with pytest.raises(ParameterError, match="env_id"):
            envs.send([0, 0], env_id=[0, 2])


def test_a_reset_drops_what_is_being_played() -> None:
    with groups_of(THREE, 4, seed=9) as envs:
        envs.async_reset()
        start = envs.recv()[0]
        envs.send([3, 3])
        envs.async_reset(seed=9)
        assert np.array_equal(envs.recv()[0], start)
        envs.recv()
        with pytest.raises(gymnasium.error.ResetNeeded):
            envs.recv()


def test_a_failing_script_names_its_environment(tmp_path: Path) -> None:
    (tmp_path / "mine.rhai").write_text(
        'fn reward(ctx, now, prev, events) { if ctx.step >= 2 { throw "enough"; } 0.0 }'
    )
    path = tmp_path / "scripted.pitch"
    path.write_text(SCRIPTED)
    with groups_of(path, 4, groups=2) as envs:
        envs.async_reset(seed=1)
        failed = []
        for _ in range(8):
            try:
                envs.recv()
            except ScriptError as error:
                failed.append(error.environment)
            envs.send([0, 0])
        assert failed[:2] == [0, 2]


def test_parameters_and_seeds_of_each() -> None:
    params = [{"difficulty": at / 10} for at in range(4)]
    with groups_of("academy_corner", 4, params=params) as envs:
        envs.async_reset(seed=[5, 6, 5, 6])
        for _ in range(2):
            envs.recv()
        vector = setpiece.make_vec("academy_corner", 4, params=params)
        vector.reset(seed=[5, 6, 5, 6])
        assert envs._vectors[1].levels == vector.levels[2:]
        with pytest.raises(ParameterError, match="4 dicts"):
            groups_of("academy_corner", 4, params=params[:2])


def test_slips() -> None:
    with pytest.raises(ParameterError, match="5 environments"):
        groups_of(THREE, 5, groups=2)
    for options in (
        {"opponents": {"right": lambda *_: 0}},
        {"autoreset_mode": "disabled"},
        {"render_mode": "ansi"},
    ):
        with pytest.raises(UnavailableError):
            groups_of(THREE, 4, **options)
    envs = groups_of(THREE, 4)
    with pytest.raises(gymnasium.error.ResetNeeded, match="async_reset"):
        envs.recv()
    with pytest.raises(gymnasium.error.ResetNeeded, match="async_reset"):
        envs.send([0, 0])
    envs.async_reset(seed=0)
    envs.recv()
    with pytest.raises(ActionError, match=r"\(2,\)"):
        envs.send([0, 0, 0])
    envs.recv()
    envs.send([0, 99])
    with pytest.raises(ActionError, match="99"):
        envs.recv()
    envs.send([0, 0])
    envs.close()
    envs.close()
    with pytest.raises(gymnasium.error.ClosedEnvironmentError):
        envs.async_reset()
