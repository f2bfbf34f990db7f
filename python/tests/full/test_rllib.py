from typing import Any

import numpy as np
import pytest

import setpiece
from setpiece import Action, parallel_env

ray = pytest.importorskip("ray")

from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.env.multi_agent_env_runner import MultiAgentEnvRunner
from ray.rllib.utils.pre_checks.env import check_multiagent_environments

import setpiece.rllib
from setpiece.rllib import RllibFootballEnv

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"

pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture(scope="module", autouse=True)
def cluster() -> Any:
    ray.init(num_cpus=1, include_dashboard=False, log_to_driver=False, configure_logging=False)
    setpiece.rllib.register()
    yield
    ray.shutdown()


@pytest.mark.parametrize(
    "shown",
    [
        {},
        {"stack": 4},
        {"observation": "simple115v2+sticky", "scale": True},
        {"observation": "smm"},
        {"observation": "smm", "stack": 4, "size": (40, 30)},
    ],
)
def test_passes_the_checks_of_rllib(shown: dict[str, Any]) -> None:
    check_multiagent_environments(
        RllibFootballEnv({"scenario": THREE, "left": "all", "right": "all", **shown})
    )


def test_is_the_parallel_environment() -> None:
    config = {"scenario": CLOSE, "left": "all", "seed": 3}
    env, parallel = RllibFootballEnv(config), parallel_env(**config)
    assert env.possible_agents == parallel.possible_agents
    assert env.get_observation_space("left_CB_1") == parallel.observation_space("left_CB_1")
    observations, infos = env.reset(seed=1)
    expected, _ = parallel.reset(seed=1)
    assert env.agents == parallel.agents == list(observations) == list(infos)
    while env.agents:
        actions = dict.fromkeys(env.agents, int(Action.RIGHT))
        observations, rewards, terminateds, truncateds, _ = env.step(actions)
        expected, paid, *_ = parallel.step(actions)
        assert rewards == paid
        for agent, observation in observations.items():
            np.testing.assert_array_equal(observation, expected[agent])
        assert (terminateds["__all__"] or truncateds["__all__"]) == (not env.agents)


def test_the_limit_truncates_all() -> None:
    env = RllibFootballEnv({"scenario": THREE, "left": 2, "max_cycles": 2})
    env.reset(seed=1)
    env.step(dict.fromkeys(env.agents, 0))
    _, _, terminateds, truncateds, _ = env.step(dict.fromkeys(env.agents, 0))
    assert truncateds == {"left_CM_1": True, "left_CM_2": True, "__all__": True}
    assert not any(terminateds.values())


def test_a_config_without_a_scenario() -> None:
    with pytest.raises(setpiece.ParameterError, match="names no scenario"):
        RllibFootballEnv({})


def ppo(env_config: dict[str, Any], policies: set[str], mapping: Any) -> PPOConfig:
    return (
        PPOConfig()
        .environment("setpiece", env_config=env_config)
        .env_runners(num_env_runners=0)
        .learners(num_learners=0)
        .multi_agent(policies=policies, policy_mapping_fn=mapping)
        .training(train_batch_size_per_learner=800, minibatch_size=200, num_epochs=2)
        .debugging(seed=0)
    )


def test_random_agents_of_both_sides_roll_out() -> None:
    config = ppo({"scenario": THREE, "left": "all", "right": "all"}, {"p0"}, lambda *_, **__: "p0")
    runner = MultiAgentEnvRunner(config=config)
    episodes = runner.sample(num_episodes=2, random_actions=True)
    assert len(episodes) == 2
    assert all(len(episode.agent_ids) == 6 for episode in episodes)
    runner.stop()


def test_ppo_trains_on_the_empty_goal() -> None:
    algorithm = ppo(
        {"scenario": CLOSE, "left": 1, "rewards": "scoring,checkpoints"},
        {"p0"},
        lambda *_, **__: "p0",
    ).build_algo()
    results = [algorithm.train() for _ in range(2)]
    assert results[-1]["env_runners"]["num_episodes_lifetime"] > 0
    assert np.isfinite(results[-1]["env_runners"]["episode_return_mean"])
    algorithm.stop()


def test_ppo_trains_two_sides_against_each_other() -> None:
    algorithm = ppo(
        {"scenario": THREE, "left": 2, "right": 1},
        {"left", "right"},
        lambda agent, *_, **__: agent.split("_")[0],
    ).build_algo()
    learned = algorithm.train()["learners"]
    assert {"left", "right"} <= set(learned)
    algorithm.stop()
