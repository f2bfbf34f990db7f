"""Trains PPO in plain PyTorch, in one file, in the style of CleanRL.

    python examples/train_cleanrl.py --scenario academy_empty_goal_close --steps 200000 --out runs/close

With `--observation pixels_gray --stack 4` the policy sees pictures, through three convolutions.
With `--levels learn_3_vs_1` it trains on the levels of a curriculum, or of a suite, and is still
evaluated on `--scenario`. `--evaluate-every` evaluates it while it trains, and `--until` ends the
training once it is good enough.

It needs `torch` and `tensorboard`. The log in `--out` has the mean score (goals of the left team
minus those of the right per episode), the mean return and the return of every reward term, over the
episodes that ended since the last entry, and `evaluation/score`.
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn
from torch.distributions import Categorical
from torch.utils.tensorboard import SummaryWriter

import setpiece

# The same for every scenario.
STEPS_OF_ENV = 64  # between two updates
EPOCHS = 4
MINIBATCHES = 4
GAMMA = 0.993
LAMBDA = 0.95
CLIP = 0.2
ENTROPY = 0.01
VALUE = 0.5
GRADIENT = 0.5
HIDDEN = 128


class Policy(nn.Module):
    """Two networks over the observation: one rates actions, the other predicts the return.

    Pictures first pass through convolutions, which both networks share.
    """

    def __init__(self, shape: tuple[int, ...], actions: int) -> None:
        super().__init__()
        self.eye = Eye(shape) if len(shape) == 3 else nn.Flatten()
        inputs = HIDDEN if len(shape) == 3 else int(np.prod(shape))
        self.actor = nn.Sequential(*_body(inputs), _layer(HIDDEN, actions, 0.01))
        self.critic = nn.Sequential(*_body(inputs), _layer(HIDDEN, 1, 1.0))

    def forward(
        self, observations: Tensor, masks: Tensor | None = None
    ) -> tuple[Categorical, Tensor]:
        """Returns the distributions of actions and the values; masked actions are never drawn."""
        seen = self.eye(observations)
        logits = self.actor(seen)
        if masks is not None:
            logits = logits.masked_fill(masks == 0, -1e9)
        return Categorical(logits=logits), self.critic(seen).squeeze(-1)


class Eye(nn.Module):
    """Turns pictures, uint8 `(batch, height, width, channels)`, into `HIDDEN` features."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        super().__init__()
        height, width, channels = shape
        self.layers = nn.Sequential(
            _scaled(nn.Conv2d(channels, 16, 8, stride=4)),
            nn.ReLU(),
            _scaled(nn.Conv2d(16, 32, 4, stride=2)),
            nn.ReLU(),
            _scaled(nn.Conv2d(32, 32, 3)),
            nn.ReLU(),
            nn.Flatten(),
        )
        features = self.layers(torch.zeros(1, channels, height, width)).shape[1]
        self.layers.append(_layer(features, HIDDEN)).append(nn.ReLU())

    def forward(self, pictures: Tensor) -> Tensor:
        """Returns the features."""
        features: Tensor = self.layers(pictures.permute(0, 3, 1, 2).float() / 255)
        return features


def _layer(inputs: int, outputs: int, gain: float = 2**0.5) -> nn.Module:
    return _scaled(nn.Linear(inputs, outputs), gain)


def _scaled(layer: nn.Linear | nn.Conv2d, gain: float = 2**0.5) -> nn.Module:
    nn.init.orthogonal_(layer.weight, gain)
    nn.init.zeros_(layer.bias)  # type: ignore[arg-type]
    return layer


def _body(inputs: int) -> list[nn.Module]:
    return [_layer(inputs, HIDDEN), nn.Tanh(), _layer(HIDDEN, HIDDEN), nn.Tanh()]


class Episodes:
    """The results of the episodes that ended since the last log entry."""

    def __init__(self) -> None:
        self.sums: dict[str, float] = defaultdict(float)
        self.ended = 0

    def take(self, final: dict[str, Any], over: np.ndarray) -> None:
        """Takes the infos of a step in which the episodes of `over` ended."""
        score, length = final["score"][over], final["setpiece"]["length"][over]
        self.ended += int(over.sum())
        self.sums["episode/score"] += float((score[:, 0] - score[:, 1]).sum())
        self.sums["episode/length"] += float(length.sum())
        for name, paid in final["setpiece"]["return"].items():
            self.sums[f"terms/{name}"] += float(paid[over].sum())
            self.sums["episode/return"] += float(paid[over].sum())

    def write(self, writer: SummaryWriter, step: int) -> None:
        """Writes the means and resets them."""
        for name, total in self.sums.items():
            writer.add_scalar(name, total / self.ended, step)
        self.__init__()  # type: ignore[misc]


def environments(
    args: argparse.Namespace, number: int, **others: Any
) -> setpiece.FootballVectorEnv:
    """Makes environments of the scenario and of what the policy sees."""
    return setpiece.make_vec(
        args.scenario,
        number,
        threads=args.threads,
        autoreset_mode="same_step",
        observation=args.observation,
        stack=args.stack,
        **others,
    )


def train(args: argparse.Namespace) -> Policy:
    """Trains a policy for `args.steps` steps of all environments together."""
    torch.manual_seed(args.seed)
    named = args.levels in setpiece.suites()
    levels = setpiece.suite(args.levels).levels if named else args.levels
    envs = environments(args, args.envs, rewards=args.rewards, seed=args.seed, levels=levels)
    space = envs.single_observation_space
    policy = Policy(space.shape, int(envs.single_action_space.n))
    optimizer = torch.optim.Adam(policy.parameters(), lr=args.lr, eps=1e-5)
    writer = SummaryWriter(args.out)
    rows = (STEPS_OF_ENV, args.envs)
    pictures = space.dtype == np.uint8
    observations = torch.zeros(
        *rows, *space.shape, dtype=torch.uint8 if pictures else torch.float32
    )
    masks = (
        torch.ones(*rows, int(envs.single_action_space.n), dtype=torch.int8) if args.masks else None
    )
    actions = torch.zeros(rows, dtype=torch.int64)
    log_probs, rewards, values, following = (torch.zeros(rows) for _ in range(4))
    ended = torch.zeros(rows)
    observation, infos = envs.reset()
    updates = max(1, args.steps // (STEPS_OF_ENV * args.envs))
    episodes, began = Episodes(), time.monotonic()
    evaluated, reached = 0, getattr(envs.level_source, "stage", None)
    for update in range(updates):
        optimizer.param_groups[0]["lr"] = args.lr * (1 - update / updates)
        for at in range(STEPS_OF_ENV):
            observations[at] = torch.from_numpy(observation)
            if masks is not None:
                masks[at] = torch.from_numpy(infos["action_mask"])
            with torch.no_grad():
                drawn, values[at] = policy(observations[at], None if masks is None else masks[at])
                actions[at] = drawn.sample()
                log_probs[at] = drawn.log_prob(actions[at])
            observation, reward, terminated, truncated, infos = envs.step(actions[at].numpy())
            rewards[at] = torch.from_numpy(reward)
            over = terminated | truncated
            ended[at] = torch.from_numpy(over)
            if over.any():
                episodes.take(infos["final_info"], over)
            # A time limit doesn't end the play: the rest is worth the critic's value of the last
            # observation. `observation` no longer is that one, because the next episode has begun.
            following[at] = 0
            for one in np.flatnonzero(truncated & ~terminated):
                with torch.no_grad():
                    last = torch.from_numpy(infos["final_obs"][one])
                    following[at, one] = policy(last[None])[1][0]
        with torch.no_grad():
            _, after = policy(torch.from_numpy(observation))
        advantages = torch.zeros(rows)
        advantage = torch.zeros(args.envs)
        for at in reversed(range(STEPS_OF_ENV)):
            going_on = 1 - ended[at]
            then = after if at == STEPS_OF_ENV - 1 else values[at + 1]
            delta = rewards[at] + GAMMA * (going_on * then + following[at]) - values[at]
            advantage = delta + GAMMA * LAMBDA * going_on * advantage
            advantages[at] = advantage
        returns = advantages + values
        batch = (observations, actions, log_probs, advantages, returns)
        flat = [part.flatten(0, 1) for part in batch]
        flat_masks = None if masks is None else masks.flatten(0, 1)
        for _ in range(EPOCHS):
            for rows_of in torch.randperm(STEPS_OF_ENV * args.envs).chunk(MINIBATCHES):
                seen, did, was, gained, foreseen = (part[rows_of] for part in flat)
                drawn, now = policy(seen, None if flat_masks is None else flat_masks[rows_of])
                ratio = (drawn.log_prob(did) - was).exp()
                gained = (gained - gained.mean()) / (gained.std() + 1e-8)
                loss = (
                    -torch.min(gained * ratio, gained * ratio.clamp(1 - CLIP, 1 + CLIP)).mean()
                    + VALUE * 0.5 * (now - foreseen).square().mean()
                    - ENTROPY * drawn.entropy().mean()
                )
                optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(policy.parameters(), GRADIENT)
                optimizer.step()
        step = (update + 1) * STEPS_OF_ENV * args.envs
        if episodes.ended:
            episodes.write(writer, step)
        writer.add_scalar("time/steps_per_second", step / (time.monotonic() - began), step)
        stage = getattr(envs.level_source, "stage", None)
        if stage != reached:
            reached = stage
            print(f"stage {stage} begins after {step} steps")
        if args.evaluate_every and step // args.evaluate_every > evaluated:
            evaluated = step // args.evaluate_every
            score = evaluate(policy, args, sampled=True)
            writer.add_scalar("evaluation/score", score, step)
            if args.until is not None and score >= args.until:
                print(f"mean score {score:.2f} after {step} steps")
                break
    print(f"{step} steps in {time.monotonic() - began:.0f} s")
    writer.close()
    envs.close()
    return policy


def evaluate(
    policy: Policy, args: argparse.Namespace, episodes: int = 100, *, sampled: bool = False
) -> float:
    """Returns the mean score of the policy's likeliest actions, in episodes not trained on.

    With `sampled` actions are drawn as in training.

    Environment k plays seed 1000000 + k, once. Taking the first episodes to end would favour short
    ones.
    """
    envs = environments(args, episodes)
    observation, infos = envs.reset(seed=1_000_000)
    score, playing = np.zeros(episodes), np.ones(episodes, bool)
    while playing.any():
        with torch.no_grad():
            masks = torch.from_numpy(infos["action_mask"]) if args.masks else None
            drawn, _ = policy(torch.from_numpy(observation), masks)
            actions = drawn.sample() if sampled else drawn.logits.argmax(-1)
        observation, _, terminated, truncated, infos = envs.step(actions.numpy())
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
        "--observation",
        default="simple115v2",
        help="of numbers, or `pixels`, `pixels_gray`, `smm`",
    )
    parser.add_argument("--stack", type=int, default=1, help="observations that are seen at once")
    parser.add_argument(
        "--rewards", help="rewards instead of the scenario's own: scoring,checkpoints"
    )
    parser.add_argument("--levels", help="a curriculum or a suite that chooses what is trained on")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument(
        "--evaluate-every",
        type=int,
        metavar="STEPS",
        help="also evaluate while training, with sampled actions",
    )
    parser.add_argument(
        "--until", type=float, metavar="SCORE", help="end once an evaluation has this mean score"
    )
    parser.add_argument("--envs", type=int, default=32)
    parser.add_argument("--threads", type=int, default=2, help="of the engine and of PyTorch")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--lr", type=float, default=1e-3, help="at the beginning; it falls to 0")
    parser.add_argument(
        "--masks", action="store_true", help="only draw actions that can change something"
    )
    parser.add_argument("--out", type=Path, default=Path("runs/cleanrl"))
    args = parser.parse_args(argv)
    if args.until is not None and not args.evaluate_every:
        parser.error("--until needs --evaluate-every")
    torch.set_num_threads(args.threads)
    policy = train(args)
    torch.save(policy.state_dict(), args.out / "policy.pt")
    score = evaluate(policy, args)
    print(f"mean score of 100 episodes: {score:.2f}")
    drawn = evaluate(policy, args, 500, sampled=True)
    print(f"mean score of 500 episodes with sampled actions: {drawn:.2f}")
    return score


if __name__ == "__main__":
    main()
