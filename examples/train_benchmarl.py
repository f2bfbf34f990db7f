"""Trains MAPPO of BenchMARL: every player of a team is an agent.

pip install setpiece[benchmarl]
python train_benchmarl.py academy_3_vs_1_with_keeper --iterations 50
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarl.algorithms import MappoConfig
from benchmarl.experiment import Experiment, ExperimentConfig
from benchmarl.models.mlp import MlpConfig

import setpiece.benchmarl


def experiment(
    scenario: str, folder: Path, *, iterations: int = 50, frames: int = 6000, num_envs: int = 10
) -> Experiment:
    """Makes an experiment; `run` trains.

    - `folder`: where the logs are written.
    - `frames`: steps of all matches together, per iteration.
    """
    folder.mkdir(parents=True, exist_ok=True)
    config = ExperimentConfig.get_from_yaml()
    config.max_n_iters, config.max_n_frames = iterations, None
    config.on_policy_collected_frames_per_batch = frames
    config.on_policy_n_envs_per_worker = num_envs
    config.on_policy_minibatch_size = max(1, frames // 8)
    config.on_policy_n_minibatch_iters = 4
    config.evaluation_interval = frames * max(1, iterations // 5)
    config.evaluation_episodes = num_envs
    config.prefer_continuous_actions = False
    config.loggers = ["csv"]
    config.save_folder = str(folder)
    return Experiment(
        task=setpiece.benchmarl.task(scenario, left="all", rewards="scoring,checkpoints"),
        algorithm_config=MappoConfig.get_from_yaml(),
        model_config=MlpConfig.get_from_yaml(),
        critic_model_config=MlpConfig.get_from_yaml(),
        seed=0,
        config=config,
    )


def main() -> None:
    """Reads the command line and trains."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenario", nargs="?", default="academy_3_vs_1_with_keeper")
    parser.add_argument("--iterations", type=int, default=50)
    parser.add_argument("--out", type=Path, default=Path("runs/benchmarl"))
    given = parser.parse_args()
    experiment(given.scenario, given.out, iterations=given.iterations).run()


if __name__ == "__main__":
    main()
