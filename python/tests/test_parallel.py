import pickle
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import gymnasium
import numpy as np
import pettingzoo
import pytest
from conftest import same
from pettingzoo.test import parallel_api_test, parallel_seed_test, render_test, seed_test
from pettingzoo.test.max_cycles_test import max_cycles_test
from pettingzoo.test.state_test import state_test
from pettingzoo.utils import parallel_to_aec

import setpiece
from setpiece import Action, ActionError, FootballEnv, parallel_env

THREE = "academy_3_vs_1_with_keeper"
FULL = "11_vs_11_stochastic"
PitchFile = Callable[..., Path]

DUEL = """
scenario duel extends academy {
    agents { left: [anna, bea] right: [carla] }
    ball at (0, 0)
    team left {
        anna: CF at (-0.1, 0)
        bea: CM at (-0.3, 0.2)
        CB at (-0.6, 0)
    }
    team right { carla: CB at (0.3, 0) }
    reward carla_pays { give -1 on goal by them as "conceded" }
}
"""

# A foul soon means a red card here: the player is already booked and slides repeatedly.
RECKLESS = """
scenario reckless extends academy {
    agents { left: [hothead, mate] right: [victim] }
    ball at victim + (-1m, 0m) { owner: victim }
    team left {
        GK at (-1, 0)
        hothead: CB at (0.082, 0) { yellow_cards: 1 }
        mate: CM at (-0.5, 0.3)
    }
    team right {
        GK at (1, 0)
        victim: CF at (0.06, 0)
    }
    remove end possession
    remove end out
    end limit 300 steps
}
"""


def act(env: Any, action: int = Action.IDLE, **others: int) -> Any:
    """Steps with one action for everybody, but for those named."""
    return env.step({agent: others.get(agent, action) for agent in env.agents})


def random_episode(env: Any, seed: int) -> list[Any]:
    for at, agent in enumerate(env.possible_agents):
        env.action_space(agent).seed(at)
    steps: list[Any] = [env.reset(seed=seed)]
    while env.agents:
        steps.append(env.step({agent: env.action_space(agent).sample() for agent in env.agents}))
    return steps


SIDES: list[dict[str, Any]] = [
    {"scenario": THREE},
    {"scenario": THREE, "left": "all", "right": "all"},
    {"scenario": THREE, "left": 0, "right": 1},
    {"scenario": FULL, "left": 3, "right": 2},
]


@pytest.mark.filterwarnings("ignore:no reset option `options`")
@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
@pytest.mark.parametrize("kwargs", SIDES)
def test_passes_the_tests_of_pettingzoo(kwargs: dict[str, Any], observation: str) -> None:
    make = lambda **more: parallel_env(**kwargs, observation=observation, events=True, **more)  # noqa: E731
    parallel_api_test(make(), num_cycles=150)
    parallel_seed_test(lambda: make(max_cycles=60))
    seed_test(lambda: parallel_to_aec(make(max_cycles=20)))


SHOWN: list[tuple[dict[str, Any], tuple[int, ...]]] = [
    ({"stack": 2}, (230,)),
    ({"observation": "smm", "size": (40, 30)}, (30, 40, 4)),
    ({"observation": "smm", "size": (40, 30), "stack": 4}, (30, 40, 16)),
]


@pytest.mark.filterwarnings("ignore:no reset option `options`")
@pytest.mark.parametrize(("kwargs", "shape"), SHOWN)
def test_everyone_sees_a_stack_and_a_map_of_another_size(
    kwargs: dict[str, Any], shape: tuple[int, ...]
) -> None:
    make = lambda: parallel_env(THREE, left=2, right="all", **kwargs)  # noqa: E731
    parallel_api_test(make(), num_cycles=50)
    env, joint = make(), setpiece.make(THREE, left=2, right="all", switching="fixed", **kwargs)
    assert {space.shape for space in env.observation_spaces.values()} == {shape}
    assert env.observation_layout == joint.observation_layout
    observations, _ = env.reset(seed=1)
    expected, _ = joint.reset(seed=1)
    for _ in range(4):
        assert np.array_equal(np.stack([*observations.values()]), expected)
        observations, expected = act(env, Action.RIGHT)[0], joint.step([Action.RIGHT] * 4)[0]
    for wrong in ({"stack": 0}, {"size": (0, 72)}, {"stack": 2, "observation": "raw"}):
        with pytest.raises(
            setpiece.ParameterError,
            match=next(iter(wrong)) if "observation" not in wrong else "raw",
        ):
            parallel_env(THREE, **wrong)


@pytest.mark.parametrize("kwargs", SIDES)
def test_passes_the_other_tests_of_pettingzoo(kwargs: dict[str, Any]) -> None:
    make = lambda **more: parallel_env(**kwargs, **more)  # noqa: E731
    max_cycles_test(
        SimpleNamespace(parallel_env=make, env=lambda **more: parallel_to_aec(make(**more)))
    )
    state_test(parallel_to_aec(make()), make())


def test_passes_the_render_test_of_pettingzoo() -> None:
    modes = FootballEnv.metadata["render_modes"]

    def make(render_mode: str) -> Any:
        # The test first requests "human" from every environment.
        return parallel_to_aec(
            parallel_env(THREE, left=2, render_mode=render_mode if render_mode in modes else "ansi")
        )

    render_test(make)


def test_any_number_of_agents_on_each_side(pitch_file: PitchFile) -> None:
    assert len(parallel_env(FULL, left="all", right="all").possible_agents) == 22
    assert parallel_env(FULL, left=0, right=3).possible_agents == [
        "right_RM_1",
        "right_CF_1",
        "right_LB_1",
    ]
    assert parallel_env(THREE).possible_agents == ["left_CM_1"]
    duel = pitch_file(DUEL)
    assert parallel_env(duel).possible_agents == ["anna", "bea", "carla"]
    assert parallel_env(duel, left=["bea"], right=0).possible_agents == ["bea"]
    assert parallel_env(setpiece.load(duel)).possible_agents == ["anna", "bea", "carla"]


def test_every_agent_keeps_its_player() -> None:
    env = parallel_env(FULL, left=3, observation="raw")
    observations, _ = env.reset(seed=2)
    first = {agent: observation["active"] for agent, observation in observations.items()}
    assert len(set(first.values())) == 3
    for _ in range(100):
        observations, *_ = act(env, Action.RIGHT)
        assert {
            agent: observation["active"] for agent, observation in observations.items()
        } == first


def test_both_sides_attack_to_the_right() -> None:
    env = parallel_env(THREE, left=1, right="all", observation="raw")
    observations, _ = env.reset(seed=1)
    left, right = observations["left_CM_1"], observations["right_GK_1"]
    np.testing.assert_array_equal(left["left_team"], -right["right_team"])
    before = right["left_team"][0][0]
    for _ in range(8):
        observations, *_ = act(env, Action.RIGHT)
    assert observations["right_GK_1"]["left_team"][0][0] > before


def test_agents_are_given_their_part() -> None:
    """An agent gets its row of the same match with all agents in one array."""
    env = parallel_env(
        THREE, left="all", right=1, events=True, bot_action=True, rewards="scoring,checkpoints"
    )
    other = env.env.clone()
    observations, infos = env.reset(seed=4)
    joint, joint_info = other.reset(seed=4)
    while env.agents:
        for at, agent in enumerate(env.possible_agents):
            assert same(observations[agent], joint[at])
            assert env.observation_space(agent).contains(observations[agent])
            assert same(infos[agent]["action_mask"], joint_info["action_mask"][at])
            assert infos[agent]["bot_action"] == joint_info["bot_action"][at]
            assert infos[agent]["score"] == joint_info["score"]
            assert infos[agent]["events"] == joint_info["events"]
            terms = {name: paid[at].item() for name, paid in joint_info["reward_terms"].items()}
            assert same(infos[agent]["reward_terms"], terms)
        actions = {agent: infos[agent]["bot_action"] for agent in env.agents}
        observations, rewards, _, _, infos = env.step(actions)
        joint, paid, _, _, joint_info = other.step(list(actions.values()))
        assert rewards == {agent: float(paid[at]) for at, agent in enumerate(env.possible_agents)}
        assert all(type(reward) is float for reward in rewards.values())
    for at, agent in enumerate(env.possible_agents):
        assert infos[agent]["setpiece"]["digest"] == joint_info["setpiece"]["digest"]
        returned = {
            name: paid[at].item() for name, paid in joint_info["setpiece"]["return"].items()
        }
        assert same(infos[agent]["setpiece"]["return"], returned)
        assert infos[agent]["outcome"] == joint_info["outcome"]


def test_an_ending_terminates_and_the_limit_truncates_everyone() -> None:
    env = parallel_env("academy_empty_goal_close", left="all")
    env.reset(seed=1)
    for _ in range(4):
        act(env, Action.RIGHT)
    while env.agents:
        _, _, terminations, truncations, _ = act(env, Action.SHOT)
    assert all(terminations.values())
    assert not any(truncations.values())
    env = parallel_env(FULL, left=2, max_cycles=5)
    env.reset(seed=1)
    for cycle in range(1, 6):
        _, _, terminations, truncations, infos = act(env)
        assert set(truncations.values()) == {cycle == 5}
        assert set(terminations.values()) == {False}
    assert env.agents == []
    info = infos["left_RM_1"]
    assert info["outcome"] == "max_cycles"
    assert (info["setpiece"]["length"], info["setpiece"]["success"]) == (5, False)
    assert info["setpiece"]["digest"] == env.env._native.digest
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step({})
    env.reset()
    assert env.agents == env.possible_agents


def test_continuous_actions_are_those_of_an_environment() -> None:
    env = parallel_env("5_vs_5", left=2, action_set="continuous")
    single = setpiece.make("5_vs_5", left=2, switching="fixed", action_set="continuous")
    seen, _ = env.reset(seed=1)
    expected, _ = single.reset(seed=1)
    rng = np.random.default_rng(1)
    for _ in range(20):
        acts = rng.uniform([-1, -1, -1, 0], 1, (2, 4)).astype(np.float32)
        seen = env.step(dict(zip(env.agents, acts, strict=True)))[0]
        expected = single.step(acts)[0]
        assert np.array_equal(np.stack([*seen.values()]), expected)
    first, second = env.agents
    for wrong in (3, [0.0] * 3, "run", np.zeros(4, bool), [[0.0], [0.0, 0.0]]):
        with pytest.raises(ActionError, match=f"four numbers for `{second}`"):
            env.step({first: acts[0], second: wrong})
    with pytest.raises(ActionError):
        env.step({first: acts[0], second: np.full(4, np.nan)})
    assert env.observation_layout == single.observation_layout


def test_an_agent_whose_player_is_sent_off_is_terminated(pitch_file: PitchFile) -> None:
    env = parallel_env(pitch_file(RECKLESS), events=True)
    for seed in range(60):
        env.reset(seed=seed)
        while "hothead" in env.agents and len(env.agents) == 3:
            agents = list(env.agents)
            observations, rewards, terminations, truncations, infos = act(
                env, hothead=Action.SLIDING
            )
        if env.agents == ["mate", "victim"]:
            break
    else:
        pytest.fail("nobody was sent off in 60 episodes")
    assert "red_card" in [event["kind"] for event in infos["mate"]["events"]]
    assert terminations == {"hothead": True, "mate": False, "victim": False}
    assert truncations == dict.fromkeys(agents, False)
    assert set(observations) == set(rewards) == set(infos) == set(agents), (
        "the last step is everyone's"
    )
    with pytest.raises(setpiece.ActionError, match="`hothead`, which no longer plays"):
        env.step({"hothead": 0, "mate": 0, "victim": 0})
    snapshot = env.snapshot()
    observations, *_ = act(env)
    assert list(observations) == ["mate", "victim"]
    while env.agents:
        assert env.agents == ["mate", "victim"], "a player sent off never comes back"
        act(env)
    env.reset(seed=1)
    assert env.agents == ["hothead", "mate", "victim"]
    env.reset(options={"snapshot": snapshot})
    assert env.agents == ["mate", "victim"], "an episode may begin without the player"


def test_state_is_the_same_for_whoever_plays() -> None:
    states = []
    for left, right in ((1, 0), (0, 1), ("all", "all")):
        env = parallel_env(THREE, left=left, right=right)
        env.reset(seed=5)
        states.append(env.state())
        assert env.state_space.contains(states[-1])
        assert states[-1].dtype == np.float32
    assert same(states[0], states[1])
    assert same(states[0], states[2])


def test_state_has_the_documented_layout() -> None:
    env = parallel_env(THREE, left=1, right=1, observation="raw")
    observations, _ = env.reset(seed=5)
    for _ in range(30):
        raw = observations["left_CM_1"]
        players, rest = np.split(env.state(), [6 * 8])
        players = players.reshape(6, 8)
        np.testing.assert_allclose(players[:4, :2], raw["left_team"], atol=1e-6)
        np.testing.assert_allclose(players[4:, :2], raw["right_team"], atol=1e-6)
        np.testing.assert_allclose(players[4:, 2:4], raw["right_team_direction"], atol=1e-6)
        np.testing.assert_allclose(players[:4, 4], raw["left_team_tired_factor"], atol=1e-6)
        assert players[:, 6].all()
        assert players[:, 7].sum() == (raw["ball_owned_team"] != -1)
        np.testing.assert_allclose(
            rest[:9], [*raw["ball"], *raw["ball_direction"], *raw["ball_rotation"]], atol=1e-6
        )
        assert rest[9:16].argmax() == raw["game_mode"]
        assert rest[16:18].tolist() == raw["score"].tolist()
        assert rest[18] == pytest.approx(raw["steps_left"] / 1000)
        observations, *_ = act(env, Action.RIGHT)
        if not env.agents:
            break


def test_looking_changes_nothing() -> None:
    def episode(looking: bool) -> Any:
        env = parallel_env(THREE, left="all")
        env.reset(seed=3, options={"params": {"difficulty": 0.9}})
        while env.agents:
            if looking:
                env.state()
            infos = act(env, Action.RIGHT)[4]
        return infos["left_CM_1"]["setpiece"]

    assert same(episode(True), episode(False))


def test_seeds_and_options_are_those_of_the_single_environment() -> None:
    first = random_episode(parallel_env(THREE, left=3, right="all"), 11)
    assert same(first, random_episode(parallel_env(THREE, left=3, right="all"), 11))
    assert not same(first, random_episode(parallel_env(THREE, left=3, right="all"), 12))
    env = parallel_env("academy_empty_goal_close", seed=7)
    env.reset(options={"params": {"difficulty": 0.1}, "episode": 4})
    while env.agents:
        infos = act(env)[4]
    assert (infos["left_CB_1"]["setpiece"]["seed"], infos["left_CB_1"]["setpiece"]["index"]) == (
        7,
        4,
    )
    with pytest.warns(UserWarning, match="no reset option `parms`"):
        env.reset(options={"parms": {}})


def test_actions_that_are_none_leave_the_episode_untouched() -> None:
    env = parallel_env(THREE, left=2)
    env.reset(seed=1)
    good: dict[str, Any] = {"left_CM_1": 0, "left_CM_2": 5}
    for actions, message in [
        ({"left_CM_1": 0}, "no action for `left_CM_2`"),
        ({**good, "left_CM_3": 0}, "`left_CM_3`, which is not an agent"),
        ({**good, "left_CM_2": 19}, r"0\.\.18 for `left_CM_2`, found `19`"),
        ({**good, "left_CM_2": -1}, "found `-1`"),
        ({**good, "left_CM_2": 1.0}, "found `1.0`"),
        ({**good, "left_CM_2": None}, "found `None`"),
        ({**good, "left_CM_2": [1]}, "expected an integer"),
        ([0, 5], "expected a mapping"),
    ]:
        with pytest.raises(setpiece.ActionError, match=message):
            env.step(actions)
    other = parallel_env(THREE, left=2)
    other.reset(seed=1)
    assert same(env.step(good), other.step({"left_CM_1": np.int64(0), "left_CM_2": Action.RIGHT}))
    v2 = parallel_env(THREE, left=2, action_set="v2")
    v2.reset(seed=1)
    act(v2, Action.BUILTIN_AI)


def test_what_is_closed_says_so_and_not_to_reset() -> None:
    env = parallel_env(THREE, left=2)
    env.reset(seed=1)
    env.close()
    for use in (
        env.reset,
        lambda: env.step({"left_CM_1": 0, "left_CM_2": 0}),
        lambda: env.step({}),
    ):
        with pytest.raises(gymnasium.error.ClosedEnvironmentError):
            use()


def test_seats_that_are_not_there() -> None:
    for kwargs, message in [
        ({"left": 9}, "9 agents on the left side, which has 4 controllable players"),
        ({"right": "al"}, 'it can be a number of agents, "all" or a list of players'),
        ({"left": ["left_CM_9"]}, "did you mean `left_CM_1`"),
        ({"left": -1}, "`left` is `-1`"),
        ({"left": True}, "`left` is `True`"),
        ({"left": ["nobody"]}, "no agent can play `nobody` of the left side"),
        ({"left": ["left_CM_1", "left_CM_1"]}, "`left_CM_1` is requested twice"),
        ({"left": 0, "right": 0}, "leaves the caller no agent"),
        ({"max_cycles": 0}, "`max_cycles` is 0"),
        ({"observation": "simple15v2"}, "did you mean `simple115v2`"),
    ]:
        with pytest.raises(setpiece.ParameterError, match=message):
            parallel_env(THREE, **kwargs)
    assert parallel_env(setpiece.load(THREE), left=2).possible_agents == ["left_CM_1", "left_CM_2"]
    assert len(parallel_env(setpiece.load(FULL)).possible_agents) == 1
    with pytest.raises(setpiece.ParameterError, match="did you mean `left_CM_1`"):
        parallel_env(THREE).observation_space("left_CM1")


def test_registers_with_pettingzoo() -> None:
    setpiece.register_pettingzoo()
    setpiece.register_pettingzoo()
    for name in setpiece.list():
        env = pettingzoo.make("parallel", f"setpiece/{name}-v0", right=1)
        assert env.metadata["name"] == f"setpiece/{name}-v0"
        env.reset(seed=1)
        act(env)
    assert pettingzoo.make("parallel", f"setpiece/{THREE}-v0", left=3, max_cycles=4).max_cycles == 4
    small = pettingzoo.make(
        "parallel", f"setpiece/{THREE}-v0", observation="smm", stack=2, size=(40, 30)
    )
    assert small.observation_space("left_CM_1").shape == (30, 40, 8)


def test_without_pettingzoo_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pettingzoo", None)
    with pytest.raises(
        setpiece.MissingPackageError, match=r"pip install 'setpiece\[pettingzoo\]'"
    ) as caught:
        parallel_env(THREE)
    assert caught.value.name == "pettingzoo"
    assert isinstance(caught.value, ImportError)


def test_goes_on_from_a_snapshot() -> None:
    env = parallel_env(THREE, left=2, right=1)
    env.reset(seed=8)
    act(env, Action.RIGHT)
    snapshot, other = env.snapshot(), parallel_env(THREE, left=2, right=1)
    observations, _ = other.restore(snapshot)
    assert list(observations) == other.agents == env.agents
    while env.agents:
        assert same(act(env, Action.SHOT), act(other, Action.SHOT))
    observations, infos = other.restore(env.snapshot())
    assert other.agents == []
    assert infos["left_CM_1"]["outcome"]


def test_can_be_pickled_in_the_middle_of_an_episode() -> None:
    env = parallel_env(THREE, left=2, right=1)
    env.reset(seed=8)
    act(env, Action.RIGHT)
    other = pickle.loads(pickle.dumps(env))
    assert other.agents == env.agents
    while env.agents:
        assert same(act(env, Action.SHOT), act(other, Action.SHOT))
