"""Many matches at once: a vector plays the same as many single environments."""

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import same
from gymnasium.vector import AutoresetMode

import setpiece

THREE = "academy_3_vs_1_with_keeper"
CLOSE = "academy_empty_goal_close"
KINDS = ["simple115v2", "simple115v2+sticky", "simple115", "egocentric", "smm"]


def actions(rng: np.random.Generator, envs: setpiece.FootballVectorEnv) -> Any:
    shape = envs.action_space.shape
    return rng.integers(19, size=shape)


def hashed(observations: Any) -> Any:
    """A policy with every action, which depends on everything that it sees."""
    return (np.abs(observations).reshape(len(observations), -1).sum(axis=1) * 31).astype(int) % 20


def of_dicts(views: Any) -> list[int]:
    return [(int(view["steps_left"]) + int(view["active"])) % 20 for view in views]


@pytest.mark.parametrize("observation", KINDS)
@pytest.mark.parametrize("stack", [1, 4])
def test_a_vector_plays_what_single_environments_play(observation: str, stack: int) -> None:
    check_parity({"observation": observation, "stack": stack, "left": 2, "switching": "fixed"})


@pytest.mark.parametrize(
    "opponents",
    [
        {"left_CM_2": "bot"},
        {"left_CM_1": setpiece.Policy(hashed), "left_CM_3": "bot"},
        {
            "left_CM_1": setpiece.Policy(hashed, observation="egocentric"),
            "right": setpiece.Policy(of_dicts, "raw"),
        },
        {
            "left_CM_3": lambda seen: int(seen.sum() * 31) % 19,
            "right": setpiece.Policy(hashed, "smm"),
        },
        {"left_CM_2": setpiece.Policy(hashed, observation="simple115v2")},
        {
            "left_CM_2": setpiece.Policy(hashed, "egocentric", scale=True),
            "left_CM_3": setpiece.Policy(hashed, "egocentric"),
        },
        {"right": "lazy"},
    ],
)
@pytest.mark.parametrize("stack", [1, 2])
def test_opponents_play_in_a_vector_as_in_single_environments(
    opponents: dict[str, Any], stack: int
) -> None:
    right = None if opponents.get("right") in (None, "lazy") else 1
    check_parity(
        {"left": 3, "right": right, "switching": "fixed", "opponents": opponents, "stack": stack}
    )


def test_an_opponent_that_fails_leaves_a_vector_as_it_is() -> None:
    asked: list[int] = []

    def fails_once(seen: Any) -> Any:
        asked.append(len(seen))
        return [0] * (3 if len(asked) == 1 else 8)

    opponents = {"right": setpiece.Policy(fails_once)}
    envs = setpiece.make_vec(
        "5_vs_5", 4, left=1, right=2, opponents=opponents, observation="egocentric"
    )
    before, _ = envs.reset(seed=1)
    assert envs.agents == ("left_0",)
    with pytest.raises(
        setpiece.OpponentError, match=r"expected 8 actions, integers in 0\.\.19"
    ) as caught:
        envs.step(np.zeros(4, int))
    assert caught.value.side == "right"
    for wrong in (
        np.zeros(3, int),
        np.zeros(4),
        np.full(4, 19),
        [0, 0, 0, -1],
        [[0], [0, 0], 0, 0],
    ):
        with pytest.raises(setpiece.ActionError):
            envs.step(wrong)
    assert same(before, envs._shown())
    envs.step([0, 0, 0, 18])
    assert asked == [8, 8]
    with pytest.raises(setpiece.ParameterError, match="leave the caller no agent"):
        setpiece.make_vec(THREE, 2, opponents={"left": "bot"})


def test_an_opponent_can_not_play_the_vector_that_asks_it() -> None:
    def meddles(observations: Any) -> list[int]:
        calls.pop()()
        return [0] * len(observations)

    envs = setpiece.make_vec(THREE, 2, right=1, opponents={"right": setpiece.Policy(meddles)})
    calls: list[Callable[[], object]] = [int, lambda: envs.reset(seed=2), lambda: envs.step([0, 0])]
    envs.reset(seed=1)
    for _ in range(2):
        with pytest.raises(
            setpiece.OpponentError, match="InUseError: this environment is in the middle of a step"
        ):
            envs.step([0, 0])
    envs.step([0, 0])


def test_an_opponents_own_words_are_not_taken_for_a_second_thread() -> None:
    def fails(_observations: Any) -> Any:
        raise ValueError("a borrowed model")

    envs = setpiece.make_vec(THREE, 2, right=1, opponents={"right": setpiece.Policy(fails)})
    envs.reset(seed=1)
    with pytest.raises(setpiece.OpponentError, match="a borrowed model"):
        envs.step([0, 0])


def test_records_are_reported_by_environment() -> None:
    text = """
        scenario measured {
            ball at (0.1, 0)
            team left { CF at (0, 0) CF at (0, 0.2) }
            team right { CF at (0.5, 0.3) }
            agents { left: all }
            record way = ball.x
            record mine = me.x
            record unknown = 1 / count of goal
            record places = series of ball
            end limit 5 steps
        }"""
    for opponents in (None, {"left_CF_2": "bot"}):
        envs = setpiece.make_vec(text, 2, opponents=opponents)
        envs.reset(seed=1)
        for _ in range(5):
            infos = envs.step(np.zeros(envs.action_space.shape, int))[-1]
        assert infos["_records"].all()
        assert infos["records"]["way"].dtype == np.float64
        assert infos["records"]["mine"].dtype == (object if opponents is None else np.float64)
        for at in range(2):
            env = setpiece.make(text, opponents=opponents)
            env.reset(seed=1 + at)
            for _ in range(5):
                info = env.step(np.zeros(env.action_space.shape, int))[-1]
            own = info["records"]
            assert own["unknown"] is None
            assert np.isnan(infos["records"]["unknown"][at])
            assert infos["records"]["way"][at] == own["way"]
            assert same(infos["records"]["mine"].tolist()[at], own["mine"])
            assert same(infos["records"]["places"][at], own["places"])


def check_parity(kwargs: dict[str, Any]) -> None:
    envs = setpiece.make_vec(THREE, 5, threads=2, **kwargs)
    singles = [setpiece.make(THREE, **kwargs) for _ in range(5)]
    rng = np.random.default_rng(1)
    observations, infos = envs.reset(seed=3)
    seen = [env.reset(seed=3 + at) for at, env in enumerate(singles)]
    over = [False] * 5
    for _ in range(120):
        for at in range(5):
            assert np.array_equal(observations[at], seen[at][0])
            assert np.array_equal(infos["action_mask"][at], seen[at][-1]["action_mask"])
            assert infos["score"][at].tolist() == seen[at][-1]["score"]
        acts = actions(rng, envs)
        observations, rewards, terminated, truncated, infos = envs.step(acts)
        for at, env in enumerate(singles):
            if over[at]:
                seen[at] = env.reset()
                over[at] = False
                assert not rewards[at].any()
                assert not terminated[at]
                continue
            result = env.step(acts[at])
            assert np.array_equal(rewards[at].astype(np.float32), result[1])
            assert (terminated[at], truncated[at]) == result[2:4]
            for name, paid in result[4]["reward_terms"].items():
                assert np.array_equal(infos["reward_terms"][name][at], paid)
            seen[at] = result
            over[at] = result[2] or result[3]
            if over[at]:
                summary, own = infos["setpiece"], result[4]["setpiece"]
                assert infos["_outcome"][at]
                assert infos["outcome"][at] == result[4]["outcome"]
                for key in ("length", "seed", "index", "digest", "success", "faults"):
                    assert summary[key][at] == own[key], key
                for name, paid in own["return"].items():
                    assert np.array_equal(summary["return"][name][at], paid)


@pytest.mark.parametrize("threads", [1, 2, 3, 64])
def test_threads_change_nothing(threads: int) -> None:
    envs = setpiece.make_vec(THREE, 7, threads=threads)
    rng = np.random.default_rng(2)
    envs.reset(seed=1)
    total = np.zeros(115)
    for _ in range(60):
        total += envs.step(actions(rng, envs))[0].sum(axis=0)
    other = setpiece.make_vec(THREE, 7, threads=1)
    rng = np.random.default_rng(2)
    other.reset(seed=1)
    expected = np.zeros(115)
    for _ in range(60):
        expected += other.step(actions(rng, other))[0].sum(axis=0)
    assert np.array_equal(total, expected)


def test_the_same_step_begins_the_next_episode() -> None:
    envs = setpiece.make_vec(CLOSE, 3, autoreset_mode="same_step")
    assert envs.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
    single = setpiece.make(CLOSE)
    envs.reset(seed=5)
    single.reset(seed=5)
    ended = 0
    for _ in range(200):
        observations, rewards, terminated, truncated, infos = envs.step(
            np.full(3, setpiece.Action.SHOT)
        )
        result = single.step(setpiece.Action.SHOT)
        assert (rewards[0], terminated[0], truncated[0]) == result[1:4]
        if result[2] or result[3]:
            ended += 1
            assert infos["_final_obs"][0]
            assert np.array_equal(infos["final_obs"][0], result[0])
            final = infos["final_info"]
            assert final["outcome"][0] == result[4]["outcome"]
            assert final["setpiece"]["digest"][0] == result[4]["setpiece"]["digest"]
            first, info = single.reset()
            assert np.array_equal(observations[0], first)
            assert np.array_equal(infos["action_mask"][0], info["action_mask"])
        else:
            assert np.array_equal(observations[0], result[0])
            assert "final_obs" not in infos or not infos["_final_obs"][0]
    assert ended > 3


def test_a_disabled_autoreset_waits_to_be_asked() -> None:
    envs = setpiece.make_vec(CLOSE, 3, autoreset_mode=AutoresetMode.DISABLED)
    envs.reset(seed=5)
    over = np.zeros(3, bool)
    while not over.any():
        observations, _, terminated, truncated, _ = envs.step(np.full(3, setpiece.Action.SHOT))
        over = terminated | truncated
    with pytest.raises(gymnasium.error.ResetNeeded, match="reset_mask"):
        envs.step(np.zeros(3, int))
    fresh, _ = envs.reset(options={"reset_mask": over})
    assert np.array_equal(fresh[~over], observations[~over])
    assert not np.array_equal(fresh[over], observations[over])
    envs.step(np.zeros(3, int))
    for mask in (np.ones(2, bool), [True] * 3, np.zeros(3, bool), np.ones(3, int)):
        with pytest.raises(setpiece.ParameterError, match="reset_mask"):
            envs.reset(options={"reset_mask": mask})


def test_gymnasium_makes_it() -> None:
    envs = gymnasium.make_vec(
        f"setpiece/{THREE}-v0", 4, vectorization_mode="vector_entry_point", stack=2
    )
    assert envs.observation_space.shape == (4, 230)
    recorded = gymnasium.wrappers.vector.RecordEpisodeStatistics(envs)
    recorded.reset(seed=1)
    ends = 0
    for _ in range(150):
        infos = recorded.step(recorded.action_space.sample())[4]
        ends += "episode" in infos
    assert ends > 0
    assert gymnasium.make_vec(envs.spec).observation_space.shape[1] == 230
    recorded.close()


def test_its_spec_makes_another_vector_and_a_single_environment() -> None:
    kwargs: dict[str, Any] = {"left": 2, "stack": 2, "seed": 7, "opponents": {"left_1": "bot"}}
    envs = setpiece.make_vec(THREE, 3, threads=2, autoreset_mode="SAME_STEP", **kwargs)
    assert envs.spec is not None
    more = gymnasium.make_vec(envs.spec, num_envs=2)
    assert (more.num_envs, more.metadata["autoreset_mode"]) == (2, AutoresetMode.SAME_STEP)
    assert same(more.reset()[0], envs.reset()[0][:2])
    several = gymnasium.make_vec(envs.spec, num_envs=2, vectorization_mode="sync")
    assert several.single_observation_space == envs.single_observation_space
    env = envs.spec.make()
    assert isinstance(env.unwrapped, setpiece.FootballEnv)
    first, _ = env.reset()
    assert same(first, setpiece.make(THREE, **kwargs).reset()[0])
    assert env.spec is not None
    assert same(env.spec.make().reset()[0], first)
    assert gymnasium.make_vec(env.spec, num_envs=2).num_envs == 2


def test_spaces_hold_what_is_shown() -> None:
    for observation in [*KINDS]:
        envs = setpiece.make_vec(
            THREE, 3, observation=observation, left="all", right="all", size=(48, 36)
        )
        seen, _ = envs.reset(seed=1)
        assert envs.observation_space.contains(seen)
        assert envs.single_observation_space.contains(seen[0])
        for _ in range(20):
            seen = envs.step(envs.action_space.sample())[0]
            assert envs.observation_space.contains(seen)


def test_continuous_actions_of_a_vector() -> None:
    envs = setpiece.make_vec(THREE, 3, action_set="continuous")
    single = setpiece.make(THREE, action_set="continuous")
    assert same(envs.reset(seed=1)[0][0], single.reset(seed=1)[0])
    rng = np.random.default_rng(0)
    compared = 0
    while compared < 15:
        acts = rng.uniform(envs.action_space.low, envs.action_space.high).astype(np.float32)
        seen, _, terminated, truncated, _ = single.step(acts[0])
        assert np.array_equal(envs.step(acts)[0][0], seen)
        compared += 1
        if terminated or truncated:
            break
    assert compared > 5


def test_one_array_where_no_copies_are_asked_for() -> None:
    envs = setpiece.make_vec(THREE, 3, copy=False)
    seen, _ = envs.reset(seed=1)
    assert all(envs.step(np.zeros(3, int))[0] is seen for _ in range(3))
    copies = setpiece.make_vec(THREE, 3)
    before, _ = copies.reset(seed=1)
    kept = before.copy()
    copies.step(np.full(3, 5))
    assert np.array_equal(before, kept)


def test_what_is_wrong_is_named_and_nothing_is_played() -> None:
    envs = setpiece.make_vec(THREE, 3)
    with pytest.raises(gymnasium.error.ResetNeeded):
        envs.step(np.zeros(3, int))
    envs.reset(seed=1)
    other = setpiece.make_vec(THREE, 3)
    other.reset(seed=1)
    for wrong in (
        [0, 0],
        [0, 0, 19],
        np.zeros(3),
        [0, -1, 0],
        "abc",
        None,
        [[0, 0, 0], [0, 0, 0]],
        [[0], [0, 0], 0],
    ):
        with pytest.raises(setpiece.ActionError):
            envs.step(wrong)
    assert np.array_equal(envs.step([1, 2, 3])[0], other.step(np.array([1, 2, 3]))[0])
    for kwargs, match in [
        ({"num_envs": 0}, "`num_envs` is 0"),
        ({"num_envs": 2.5}, "`num_envs` is 2.5"),
        ({"threads": 0}, "`threads` is 0"),
        ({"autoreset_mode": "later"}, "no autoreset mode `later`"),
        ({"observation": "raw"}, "dicts"),
        ({"observation": "vector"}, "declares no observation"),
        ({"stack": 0}, "`stack` is 0"),
        ({"copy": "no"}, "expected True or False as `copy`"),
        ({"size": (0, 3)}, "`size` is"),
        ({"left": 77}, "77 agents on the left side"),
    ]:
        with pytest.raises(setpiece.ParameterError, match=match):
            setpiece.make_vec(THREE, **kwargs)
    for seed in (-1, "one", [1, 2], 2**64):
        with pytest.raises(setpiece.ParameterError):
            envs.reset(seed=seed)


def test_parameters_of_a_vector() -> None:
    envs = setpiece.make_vec("11_vs_11_stochastic", 2, params={"difficulty": 0.1})
    envs.reset(seed=1, options={"params": {"difficulty": 0.9}})
    with pytest.raises(setpiece.ParameterError, match="did you mean `difficulty`"):
        envs.reset(options={"params": {"dificulty": 0.9}})
