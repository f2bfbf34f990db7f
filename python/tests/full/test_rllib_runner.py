"""The `EnvRunner` that steps a native batch: its episodes are those of single environments."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece

ray = pytest.importorskip("ray")
torch = pytest.importorskip("torch")

from ray.rllib.algorithms.impala import IMPALAConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig

import setpiece.rllib
from setpiece.rllib import FootballEnvRunner

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"

pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture(scope="module", autouse=True)
def cluster() -> Any:
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, configure_logging=False)
    setpiece.rllib.register()
    yield
    ray.shutdown()


def config(env_config: dict[str, Any], envs: int = 8, steps: int = 40, runners: int = 0) -> Any:
    """IMPALA over the runner, in this process unless there are `runners`."""
    return (
        IMPALAConfig()
        .environment("setpiece", env_config=env_config)
        .env_runners(
            env_runner_cls=FootballEnvRunner,
            num_env_runners=runners,
            num_envs_per_env_runner=envs,
            rollout_fragment_length=steps,
        )
        .learners(num_learners=0)
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[64, 64], fcnet_activation="tanh"))
        .training(
            lr=7e-4, entropy_coeff=0.01, train_batch_size_per_learner=envs * steps, grad_clip=0.5
        )
        .debugging(seed=3, log_level="ERROR")
    )


def whole(samples: list[list[Any]]) -> dict[str, list[Any]]:
    """The parts of every episode that has ended, in order, by its id."""
    parts: dict[str, list[Any]] = {}
    for one in (one for sample in samples for one in sample):
        parts.setdefault(one.id_, []).append(one)
    return {name: all_ for name, all_ in parts.items() if all_[-1].is_done}


@pytest.mark.parametrize(
    "env_config",
    [
        {"rewards": "scoring,checkpoints"},
        {"left": 3, "rewards": "scoring,checkpoints"},
        {"observation": "smm", "stack": 2, "size": (42, 42)},
    ],
    ids=["one player", "three players", "maps"],
)
def test_episodes_are_those_of_single_environments(env_config: dict[str, Any]) -> None:
    runner = FootballEnvRunner(config=config({"scenario": THREE, **env_config}, envs=4))
    players = len(setpiece.make(THREE, left=env_config.get("left")).agents)
    # RLlib's own modules take no bytes.
    maps = "observation" in env_config
    samples = [runner.sample(random_actions=maps) for _ in range(4)]
    assert all(sum(len(one) for one in sample) == 4 * players * 40 for sample in samples)
    ended = whole(samples)
    assert len(ended) >= 4 * players
    assert any(len(parts) > 1 for parts in ended.values())
    # Episodes in the order of their beginning, row by row: the n-th of a match has the index n.
    begun: dict[int, int] = {}
    rows = {}
    for sample in samples:
        for row, one in zip(rows_of(sample, 4 * players), sample, strict=True):
            if one.id_ not in rows:
                rows[one.id_] = (row, begun.get(row, 0))
                begun[row] = begun.get(row, 0) + 1
    by_match: dict[tuple[int, int], list[list[Any]]] = {}
    for name, parts in ended.items():
        row, index = rows[name]
        by_match.setdefault((row // players, index), []).append(parts)
    env = setpiece.make(THREE, **env_config)
    for (match, index), all_parts in by_match.items():
        assert len(all_parts) == players
        acts = np.stack([np.concatenate([p.actions.data for p in parts]) for parts in all_parts])
        shown, _ = env.reset(seed=3 + match, options={"episode": index})
        frames, paid = [shown], []
        for act in acts.T:
            shown, reward, terminated, truncated, _ = env.step(act if players > 1 else act[0])
            frames.append(shown)
            paid.append(np.atleast_1d(reward))
        assert terminated or truncated
        for player, parts in enumerate(all_parts):
            mine = [one if players == 1 else one[player] for one in frames]
            at = 0
            for part in parts:
                assert part.t_started == at
                assert np.array_equal(part.observations.data, mine[at : at + len(part) + 1])
                wanted = [one[player] for one in paid[at : at + len(part)]]
                assert np.allclose(part.rewards.data, wanted)
                at += len(part)
            assert at == len(paid)
            assert (parts[-1].is_terminated, parts[-1].is_truncated) == (terminated, truncated)


def rows_of(sample: list[Any], rows: int) -> list[int]:
    """The row of each episode of a sample: a row's episodes follow each other, and fill it."""
    count = sum(len(one) for one in sample) // rows
    found, played = [], 0
    for one in sample:
        found.append(played // count)
        played += len(one)
    return found


def test_runners_play_different_matches() -> None:
    chosen = config({"scenario": THREE}, envs=4, steps=1)
    levels = []
    for index in (1, 2, 3):
        runner = FootballEnvRunner(config=chosen, worker_index=index)
        runner.sample()
        levels += runner.env.envs.levels
    assert len({*levels}) == len(levels) == 12


def test_whole_episodes_go_on_with_other_starts() -> None:
    runner = FootballEnvRunner(config=config({"scenario": THREE}, envs=2))
    levels = []
    for _ in range(3):
        runner.sample(num_episodes=2)
        levels += runner.env.envs.levels
    assert len({*levels}) == len(levels) == 6


def test_it_says_how_likely_an_action_was() -> None:
    runner = FootballEnvRunner(config=config({"scenario": THREE}))
    for one in runner.sample():
        seen = torch.from_numpy(one.observations.data[:-1])
        with torch.no_grad():
            logits = runner.module.forward_exploration({"obs": seen})["action_dist_inputs"]
        odds = logits.log_softmax(-1).numpy()[np.arange(len(one)), one.actions.data]
        said = {name: buffer.data for name, buffer in one.extra_model_outputs.items()}
        assert np.allclose(said["action_logp"], odds, atol=1e-5)
        assert np.allclose(said["action_dist_inputs"], logits, atol=1e-5)


def test_whole_episodes_and_likeliest_actions() -> None:
    runner = FootballEnvRunner(config=config({"scenario": THREE}))
    episodes = runner.sample(num_episodes=10, explore=False)
    assert len(episodes) == 10
    assert all(one.is_done and one.t_started == 0 for one in episodes)
    assert any(len(one) > 64 for one in runner.sample(num_episodes=10, random_actions=True))
    for one in episodes:
        assert len(one.observations.data) == len(one) + 1
        with torch.no_grad():
            logits = runner.module.forward_inference(
                {"obs": torch.from_numpy(one.observations.data[:-1])}
            )["action_dist_inputs"]
        assert np.array_equal(logits.argmax(-1).numpy(), one.actions.data)


def test_metrics_are_those_of_the_episodes() -> None:
    runner = FootballEnvRunner(
        config=config({"scenario": THREE, "left": 2, "rewards": "scoring,checkpoints"}, steps=100)
    )
    ended = whole([runner.sample() for _ in range(3)])
    measured = runner.get_metrics()
    returns = [sum(part.get_return() for part in parts) for parts in ended.values()]
    lengths = [sum(len(part) for part in parts) for parts in ended.values()]
    assert 10 < len(ended) <= 100
    assert measured["episode_return_mean"].peek() == pytest.approx(np.mean(returns))
    assert measured["episode_len_mean"].peek() == pytest.approx(np.mean(lengths))
    curves = {name: value.peek() for name, value in measured["football"].items()}
    assert curves["length"] == pytest.approx(np.mean(lengths))
    paid = sum(value for name, value in curves.items() if name.startswith("terms:"))
    assert paid == pytest.approx(np.mean(returns), abs=1e-5)


def test_impala_learns_the_empty_goal_and_continues(tmp_path: Path) -> None:
    chosen = config(
        {"scenario": CLOSE, "rewards": "scoring,checkpoints"}, envs=64, steps=50, runners=1
    )
    algorithm = chosen.build_algo()
    # A module that has learnt nothing scores about 0.15.
    score, steps = 0.0, 0
    while steps < 600_000 and score < 0.6:
        played = algorithm.train()["env_runners"]
        # The first results may come before any episode.
        steps = played.get("num_env_steps_sampled_lifetime", 0)
        score = float(played.get("football", {}).get("score", 0))
    assert score >= 0.6, steps
    algorithm.save_to_path(tmp_path / "saved")
    algorithm.stop()
    again = type(algorithm).from_checkpoint(str(tmp_path / "saved"))
    scores: list[float] = []
    while not scores:
        # Not a number while no episode has ended.
        played = float(again.train()["env_runners"].get("football", {}).get("score", np.nan))
        scores = [] if np.isnan(played) else [played]
    assert scores[0] > 0.4
    again.stop()


def test_what_it_cannot_play_is_said() -> None:
    with pytest.raises(setpiece.ParameterError, match="names no scenario"):
        FootballEnvRunner(config=config({}))
    with pytest.raises(setpiece.UnknownScenarioError, match="academy_cornr"):
        FootballEnvRunner(config=config({"scenario": "academy_cornr"}))
    remembering = config({"scenario": CLOSE}).rl_module(
        model_config=DefaultModelConfig(use_lstm=True)
    )
    with pytest.raises(setpiece.UnavailableError, match="no module with a state"):
        FootballEnvRunner(config=remembering)
    connected = config({"scenario": CLOSE}).env_runners(env_to_module_connector=lambda *_: [])
    with pytest.raises(setpiece.UnavailableError, match="env_to_module_connector"):
        FootballEnvRunner(config=connected)
