"""Trains IMPALA of Ray RLlib: runners in separate processes play for one learner.

    python examples/train_rllib.py --scenario academy_empty_goal_close --steps 300000 --out runs/rllib

A runner plays its matches as one native batch (`setpiece.rllib.FootballEnvRunner`). The processes
may be on this machine or all over a cluster. It needs `setpiece[rllib]` and `tensorboard`, and
starts its own Ray; `--address` uses that of a cluster. The log in `--out` has the same curves as
that of `train_cleanrl.py`: score, return and every reward term.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np
import ray
import setpiece.rllib
import torch
from ray.rllib.algorithms.impala import IMPALAConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig
from torch.utils.tensorboard import SummaryWriter


def evaluate(module: Any, args: argparse.Namespace, episodes: int = 100) -> float:
    """Returns the mean score of the likeliest actions; every environment plays one episode."""
    envs = setpiece.make_vec(args.scenario, episodes, autoreset_mode="same_step", left=1)
    observation, _ = envs.reset(seed=1_000_000)
    score, playing = np.zeros(episodes), np.ones(episodes, bool)
    while playing.any():
        with torch.no_grad():
            rated = module.forward_inference({"obs": torch.from_numpy(observation)})[
                "action_dist_inputs"
            ]
        observation, _, terminated, truncated, infos = envs.step(rated.argmax(-1).numpy())
        over = (terminated | truncated) & playing
        if over.any():
            goals = infos["final_info"]["score"]
            score[over] = (goals[:, 0] - goals[:, 1])[over]
            playing &= ~over
    envs.close()
    return float(score.mean())


def main(argv: list[str] | None = None) -> float:
    """Reads the command line, trains, saves and evaluates."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenario", default="academy_empty_goal_close", help="a name or a file")
    parser.add_argument(
        "--rewards", help="rewards instead of the scenario's own: scoring,checkpoints"
    )
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--envs", type=int, default=64, help="of all runners together")
    parser.add_argument("--threads", type=int, default=2, help="how many runners play")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--lr", type=float, default=1e-3)
    parser.add_argument("--address", help="of a running Ray cluster")
    parser.add_argument("--out", type=Path, default=Path("runs/rllib"))
    args = parser.parse_args(argv)
    if args.address is None:
        ray.init(num_cpus=args.threads + 1, include_dashboard=False, log_to_driver=False)
    else:
        ray.init(args.address)
    setpiece.rllib.register()
    config = (
        IMPALAConfig()
        .environment(
            "setpiece", env_config={"scenario": args.scenario, "left": 1, "rewards": args.rewards}
        )
        .env_runners(
            env_runner_cls=setpiece.rllib.FootballEnvRunner,
            num_env_runners=args.threads,
            num_envs_per_env_runner=max(1, args.envs // args.threads),
            rollout_fragment_length=64,
        )
        .learners(num_learners=0)
        .rl_module(
            model_config=DefaultModelConfig(fcnet_hiddens=[128, 128], fcnet_activation="tanh")
        )
        .training(
            gamma=0.993,
            lr=args.lr,
            entropy_coeff=0.01,
            vf_loss_coeff=0.5,
            grad_clip=0.5,
            grad_clip_by="global_norm",
            train_batch_size_per_learner=64 * args.envs,
        )
        .reporting(min_time_s_per_iteration=1)
        .debugging(seed=args.seed, log_level="ERROR")
    )
    algorithm = config.build_algo()
    writer, step, began = SummaryWriter(str(args.out)), 0, time.monotonic()
    while step < args.steps:
        played = algorithm.train()["env_runners"]
        step = int(played.get("num_env_steps_sampled_lifetime", 0))
        curves = {"return": played.get("episode_return_mean", np.nan), **played.get("football", {})}
        for name, value in curves.items():
            if not np.isnan(value):  # no episode has ended since the last entry
                name = name.replace(":", "/") if ":" in name else f"episode/{name}"
                writer.add_scalar(name, float(value), step)
        writer.add_scalar("time/steps_per_second", step / (time.monotonic() - began), step)
    print(f"{step} steps in {time.monotonic() - began:.0f} s")
    writer.close()
    algorithm.save_to_path(str((args.out / "policy").resolve()))
    score = evaluate(algorithm.get_module(), args)
    print(f"mean score of 100 episodes: {score:.2f}")
    algorithm.stop()
    ray.shutdown()
    return score


if __name__ == "__main__":
    main()
