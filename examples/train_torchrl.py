"""Trains PPO with TorchRL's collector, loss and advantage.

pip install setpiece[torchrl]
python train_torchrl.py academy_empty_goal_close --frames 200000
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import torch
from tensordict.nn import TensorDictModule
from torch import nn
from torchrl.collectors import Collector
from torchrl.modules import MaskedCategorical, MLP, ProbabilisticActor, ValueOperator
from torchrl.objectives import ClipPPOLoss
from torchrl.objectives.value import GAE

import setpiece.torchrl

EPOCHS = 4
MINIBATCH = 256


def train(
    scenario: str, *, num_envs: int = 16, steps: int = 64, frames: int = 200_000, seed: int = 1
) -> Iterator[dict[str, float]]:
    """Trains and yields the figures of every update.

    - `steps`: steps of each match between two updates.
    - `frames`: steps of all matches together.
    """
    torch.manual_seed(seed)
    env = setpiece.torchrl.make(scenario, num_envs, rewards="scoring,checkpoints", scale=True)
    env.set_seed(seed)
    n_actions = env.action_spec.n
    body = MLP(out_features=n_actions, num_cells=[128, 128], activation_class=nn.Tanh)
    actor = ProbabilisticActor(
        TensorDictModule(body, in_keys=["observation"], out_keys=["logits"]),
        in_keys={"logits": "logits", "mask": "action_mask"},
        distribution_class=MaskedCategorical,
        return_log_prob=True,
    )
    critic = ValueOperator(
        MLP(out_features=1, num_cells=[128, 128], activation_class=nn.Tanh), in_keys=["observation"]
    )
    start = env.reset()
    critic(actor(start))
    advantage = GAE(gamma=0.993, lmbda=0.95, value_network=critic, average_gae=True)
    loss = ClipPPOLoss(actor, critic, clip_epsilon=0.2, entropy_coeff=0.01)
    optimizer = torch.optim.Adam(loss.parameters(), lr=3e-4)
    collector = Collector(env, actor, frames_per_batch=num_envs * steps, total_frames=frames)
    for rollout in collector:
        last = rollout["next"]
        done = last["done"]
        figures = {
            "episodes": float(done.sum()),
            "reward": float(last["reward"].sum() / num_envs),
            "success": float(last["success"][done].float().mean()) if done.any() else float("nan"),
        }
        for _ in range(EPOCHS):
            with torch.no_grad():
                advantage(rollout)
            flat = rollout.reshape(-1)
            for rows in torch.randperm(len(flat)).split(MINIBATCH):
                terms = loss(flat[rows])
                total = sum(terms[key] for key in terms.keys() if key.startswith("loss_"))  # noqa: SIM118
                optimizer.zero_grad()
                total.backward()
                nn.utils.clip_grad_norm_(loss.parameters(), 0.5)
                optimizer.step()
        yield {**figures, "loss": float(total.detach())}
    collector.shutdown()


def main() -> None:
    """Reads the command line and prints every tenth update."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenario", nargs="?", default="academy_empty_goal_close")
    parser.add_argument("--num-envs", type=int, default=16)
    parser.add_argument("--frames", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    updates = train(
        arguments.scenario,
        num_envs=arguments.num_envs,
        frames=arguments.frames,
        seed=arguments.seed,
    )
    for update, figures in enumerate(updates):
        if update % 10 == 0:
            print(update, {name: round(value, 3) for name, value in figures.items()}, flush=True)


if __name__ == "__main__":
    main()
