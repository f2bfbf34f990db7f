"""Trains PPO of Stable-Baselines3, or MaskablePPO of sb3-contrib.

    python examples/train_sb3.py --scenario academy_empty_goal_close --steps 200000 --out runs/sb3

It needs `setpiece[sb3]` and `tensorboard`, with `--masks` also `sb3-contrib`. The log in `--out`
has the same curves as that of `train_cleanrl.py`: score, return and every reward term, besides
those of Stable-Baselines3.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import setpiece.sb3
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import configure
from stable_baselines3.common.vec_env import VecMonitor


class Terms(BaseCallback):
    """Logs the mean score, return and reward terms of the episodes that ended in a rollout."""

    def __init__(self) -> None:
        super().__init__()
        self.ended: dict[str, list[float]] = defaultdict(list)

    def _on_step(self) -> bool:
        for info in self.locals["infos"]:
            # Only the infos of an episode's last step have a summary.
            if "setpiece" in info:
                paid = info["setpiece"]["return"]
                self.ended["episode/score"].append(info["score"][0] - info["score"][1])
                self.ended["episode/length"].append(info["setpiece"]["length"])
                self.ended["episode/return"].append(sum(paid.values()))
                for name, value in paid.items():
                    self.ended[f"terms/{name}"].append(value)
        return True

    def _on_rollout_end(self) -> None:
        for name, values in self.ended.items():
            self.logger.record(name, float(np.mean(values)))
        self.ended.clear()


def seen(args: argparse.Namespace) -> dict[str, Any]:
    """Returns what the agents see: pictures in stacks of four, so that motion shows."""
    pictures = args.observation.startswith("pixels")
    return {"observation": args.observation, "stack": 4 if pictures else 1}


def evaluate(model: Any, args: argparse.Namespace, episodes: int = 100) -> float:
    """Returns the mean score of the likeliest actions; every environment plays one episode."""
    envs = setpiece.sb3.make_vec(
        args.scenario, episodes, seed=1_000_000, threads=args.threads, **seen(args)
    )
    observation: Any = envs.reset()
    score, playing = np.zeros(episodes), np.ones(episodes, bool)
    while playing.any():
        masks = {"action_masks": envs.action_masks()} if args.masks else {}
        actions, _ = model.predict(observation, deterministic=True, **masks)
        observation, _, dones, infos = envs.step(actions)
        for at in np.flatnonzero(dones & playing):
            score[at] = infos[at]["score"][0] - infos[at]["score"][1]
            playing[at] = False
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
    parser.add_argument(
        "--observation",
        default="simple115v2",
        help="simple115v2, or pixels_gray for a convolutional network",
    )
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--envs", type=int, default=32)
    parser.add_argument("--threads", type=int, default=2, help="of the engine and of PyTorch")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--lr", type=float, default=1e-3, help="at the beginning; it falls to 0")
    parser.add_argument(
        "--masks", action="store_true", help="only draw actions that can change something"
    )
    parser.add_argument("--out", type=Path, default=Path("runs/sb3"))
    args = parser.parse_args(argv)
    torch.set_num_threads(args.threads)
    algorithm: Any = PPO
    if args.masks:
        from sb3_contrib import MaskablePPO

        algorithm = MaskablePPO
    envs = VecMonitor(
        setpiece.sb3.make_vec(
            args.scenario,
            args.envs,
            seed=args.seed,
            threads=args.threads,
            rewards=args.rewards,
            **seen(args),
        )
    )
    pictures = args.observation.startswith("pixels")
    model = algorithm(
        "CnnPolicy" if pictures else "MlpPolicy",
        envs,
        n_steps=64,
        batch_size=16 * args.envs,
        n_epochs=4,
        gamma=0.993,
        ent_coef=0.01,
        learning_rate=lambda left: args.lr * left,
        policy_kwargs={} if pictures else {"net_arch": [128, 128]},
        seed=args.seed,
        device="cpu",
    )
    model.set_logger(configure(str(args.out), ["tensorboard"]))
    model.learn(args.steps, callback=Terms())
    model.save(args.out / "policy.zip")
    score = evaluate(model, args)
    print(f"mean score of 100 episodes: {score:.2f}")
    return score


if __name__ == "__main__":
    main()
