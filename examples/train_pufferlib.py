"""Trains PPO over PufferLib's `recv` and `send`, with its default policy.

While the policy looks at one group of matches, the other one is played.

    python train_pufferlib.py academy_empty_goal_close --steps 200000
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import numpy as np
import torch
from pufferlib.models import Default
from pufferlib.pytorch import sample_logits

import setpiece.pufferlib

HORIZON = 64
EPOCHS = 4
MINIBATCHES = 4
GAMMA, LAMBDA, CLIP, ENTROPY = 0.993, 0.95, 0.2, 0.01


def train(
    scenario: str, *, num_envs: int = 32, steps: int = 200_000, seed: int = 1
) -> Iterator[dict[str, float]]:
    """Trains and yields the figures of every update."""
    torch.manual_seed(seed)
    env = setpiece.pufferlib.make(scenario, num_envs, rewards="scoring,checkpoints", scale=True)
    policy = Default(env)
    optimizer = torch.optim.Adam(policy.parameters(), lr=1e-3)
    shape = (HORIZON, env.num_agents)
    seen = torch.zeros(*shape, *env.single_observation_space.shape)
    acts, logps, values, rewards, dones = (torch.zeros(shape) for _ in range(5))
    env.async_reset(seed)
    groups = env.num_agents // env.agents_per_batch
    for _ in range(max(1, steps // (HORIZON * env.num_agents))):
        # The reward and the end that come with an observation belong to the action before it.
        # One step more is played for the value of the state after the last.
        ended, after = [], torch.zeros(env.num_agents)
        for step in range(HORIZON + 1):
            for _ in range(groups):
                observed, paid, terminals, truncations, infos, agents, _ = env.recv()
                ended += infos
                if step > 0:
                    rewards[step - 1, agents] = torch.as_tensor(paid)
                    dones[step - 1, agents] = torch.as_tensor(terminals | truncations).float()
                observed = torch.as_tensor(observed)
                with torch.no_grad():
                    logits, value = policy(observed)
                    action, logp, _ = sample_logits(logits)
                env.send(action.numpy())
                if step < HORIZON:
                    seen[step, agents], values[step, agents] = observed, value.flatten()
                    acts[step, agents], logps[step, agents] = action.float(), logp
                else:
                    after[agents] = value.flatten()
        advantages = torch.zeros(shape)
        last = torch.zeros(env.num_agents)
        for step in reversed(range(HORIZON)):
            alive = 1 - dones[step]
            delta = rewards[step] + GAMMA * after * alive - values[step]
            last = advantages[step] = delta + GAMMA * LAMBDA * alive * last
            after = values[step]
        wanted = advantages + values
        for _ in range(EPOCHS):
            for rows in torch.randperm(HORIZON * env.num_agents).chunk(MINIBATCHES):
                logits, value = policy(seen.flatten(0, 1)[rows])
                _, logp, entropy = sample_logits(logits, acts.flatten()[rows].long())
                gain = advantages.flatten()[rows]
                gain = (gain - gain.mean()) / (gain.std() + 1e-8)
                ratio = (logp - logps.flatten()[rows]).exp()
                clipped = ratio.clamp(1 - CLIP, 1 + CLIP)
                loss = -torch.min(gain * ratio, gain * clipped).mean() - ENTROPY * entropy.mean()
                loss = loss + 0.5 * (value.flatten() - wanted.flatten()[rows]).square().mean()
                optimizer.zero_grad()
                loss.backward()
                torch.nn.utils.clip_grad_norm_(policy.parameters(), 0.5)
                optimizer.step()
        success = [info["success"] for info in ended]
        yield {
            "episodes": len(ended),
            "reward": float(rewards.sum() / env.num_agents),
            "success": float(np.mean(success)) if success else float("nan"),
            "loss": float(loss.detach()),
        }
    env.close()


def main() -> None:
    """Reads the command line and prints every tenth update."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenario", nargs="?", default="academy_empty_goal_close")
    parser.add_argument("--num-envs", type=int, default=32)
    parser.add_argument("--steps", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    updates = train(given.scenario, num_envs=given.num_envs, steps=given.steps, seed=given.seed)
    for update, figures in enumerate(updates):
        if update % 10 == 0:
            print(update, {name: round(value, 3) for name, value in figures.items()}, flush=True)


if __name__ == "__main__":
    main()
