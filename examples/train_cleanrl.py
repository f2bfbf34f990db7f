"""Trains PPO in plain PyTorch, in one file, in the style of CleanRL.

    python examples/train_cleanrl.py --scenario academy_empty_goal_close --steps 200000 --out runs/close

With `--observation pixels_gray --stack 4` the policy sees pictures, through three convolutions.
With `--levels learn_3_vs_1` it trains on the levels of a curriculum, or of a suite, and is still
evaluated on `--scenario`. `--evaluate-every` evaluates it while it trains, and `--until` ends the
training once it is good enough. `--repeat 4` decides in every fourth step only, which finds actions
that have to be held for a while; steps are still those of the environments.

The policy is saved in `--out` as `policy.pt`, and as `policy.onnx` for `setpiece.Suite.evaluate`,
for `opponents` and for `find_failures.py`. It takes observations as the environments give them.

It needs `torch`, `tensorboard` and `onnx`. The log in `--out` has the mean score (goals of the left team
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
import onnx
import torch
from torch import Tensor, nn
from torch.distributions import Categorical
from torch.utils.tensorboard import SummaryWriter

import setpiece

# The same for every scenario.
MINIBATCHES = 4
LAMBDA = 0.95
CLIP = 0.2
ENTROPY = 0.01
VALUE = 0.5
GRADIENT = 0.5
HIDDEN = 128


class Policy(nn.Module):
    """Two networks over the observation: one rates actions, the other predicts the return.

    Pictures first pass through convolutions, which both networks share. Numbers are standardised.
    """

    def __init__(self, shape: tuple[int, ...], actions: int) -> None:
        super().__init__()
        inputs = HIDDEN if len(shape) == 3 else int(np.prod(shape))
        self.eye = Eye(shape) if len(shape) == 3 else Standard(inputs)
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
        return Categorical(logits=logits, validate_args=False), self.critic(seen).squeeze(-1)

    def save(self, folder: Path, observations: np.ndarray, repeat: int) -> None:
        """Writes `policy.pt`, and `policy.onnx`: from observations to the logits of the actions.

        The metadata of `policy.onnx` says how many steps a decision lasts.
        """
        torch.save(self.state_dict(), folder / "policy.pt")
        torch.onnx.export(
            nn.Sequential(self.eye, self.actor),
            (torch.from_numpy(observations),),
            folder / "policy.onnx",
            input_names=["observation"],
            output_names=["logits"],
            dynamic_axes={"observation": {0: "batch"}, "logits": {0: "batch"}},
            dynamo=False,
        )
        model = onnx.load(folder / "policy.onnx")
        onnx.helper.set_model_props(model, {"repeat": str(repeat)})
        onnx.save(model, folder / "policy.onnx")


class Standard(nn.Module):
    """Standardises numbers by the mean and the variance of all that it has taken so far."""

    mean: Tensor
    variance: Tensor

    def __init__(self, inputs: int) -> None:
        super().__init__()
        self.register_buffer("mean", torch.zeros(inputs))
        self.register_buffer("variance", torch.ones(inputs))
        self.taken = 0

    def forward(self, observations: Tensor) -> Tensor:
        """Returns the standardised numbers, none further from 0 than 10."""
        away = observations.flatten(1) - self.mean
        return (away / (self.variance + 1e-8).sqrt()).clamp(-10, 10)

    def take(self, observations: Tensor) -> None:
        """Takes a batch of observations into the mean and the variance."""
        variance, mean = torch.var_mean(observations.flatten(1), 0, correction=0)
        self.taken += len(observations)
        share, away = len(observations) / self.taken, mean - self.mean
        self.mean += share * away
        self.variance += share * (variance - self.variance + (1 - share) * away.square())


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


def press(
    envs: setpiece.FootballVectorEnv, actions: Tensor, times: int, episodes: Episodes
) -> tuple[np.ndarray, Tensor, Tensor, dict[int, np.ndarray], dict[str, Any]]:
    """Plays actions for some steps; where an episode ends meanwhile, the next one begins idle.

    Returns the observation, the rewards, whether episodes ended, the last observations of those
    that a time limit ended, and the infos.
    """
    pressed, paid = actions.numpy(), np.zeros(len(actions), np.float32)
    ended, last = np.zeros(len(actions), bool), {}
    for _ in range(times):
        observation, reward, terminated, truncated, infos = envs.step(np.where(ended, 0, pressed))
        paid += np.where(ended, 0, reward)
        over = terminated | truncated
        if over.any():
            episodes.take(infos["final_info"], over)
        for one in np.flatnonzero(truncated & ~terminated & ~ended):
            last[int(one)] = infos["final_obs"][one]
        ended |= over
    return observation, torch.from_numpy(paid), torch.from_numpy(ended), last, infos


def train(args: argparse.Namespace) -> Policy:
    """Trains a policy for `args.steps` steps of all environments together, and saves it."""
    torch.manual_seed(args.seed)
    named = args.levels in setpiece.suites()
    levels = setpiece.suite(args.levels).levels if named else args.levels
    envs = environments(args, args.envs, rewards=args.rewards, seed=args.seed, levels=levels)
    space = envs.single_observation_space
    policy = Policy(space.shape, int(envs.single_action_space.n))
    optimizer = torch.optim.Adam(policy.parameters(), lr=args.lr, eps=1e-5)
    writer = SummaryWriter(args.out)
    rows = (args.decisions, args.envs)
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
    steps_of_update = args.decisions * args.envs * args.repeat
    updates = max(1, args.steps // steps_of_update)
    episodes, began = Episodes(), time.monotonic()
    evaluated, reached = 0, getattr(envs.level_source, "stage", None)
    for update in range(updates):
        optimizer.param_groups[0]["lr"] = args.lr * (1 - update / updates)
        for at in range(args.decisions):
            observations[at] = torch.from_numpy(observation)
            if masks is not None:
                masks[at] = torch.from_numpy(infos["action_mask"])
            with torch.no_grad():
                drawn, values[at] = policy(observations[at], None if masks is None else masks[at])
                actions[at] = drawn.sample()
                log_probs[at] = drawn.log_prob(actions[at])
            observation, rewards[at], ended[at], last, infos = press(
                envs, actions[at], args.repeat, episodes
            )
            # A time limit doesn't end the play: the rest is worth the critic's value of the last
            # observation. `observation` no longer is that one, because the next episode has begun.
            following[at] = 0
            for one, seen_last in last.items():
                with torch.no_grad():
                    following[at, one] = policy(torch.from_numpy(seen_last)[None])[1][0]
        with torch.no_grad():
            _, after = policy(torch.from_numpy(observation))
        advantages = torch.zeros(rows)
        advantage = torch.zeros(args.envs)
        for at in reversed(range(args.decisions)):
            going_on = 1 - ended[at]
            then = after if at == args.decisions - 1 else values[at + 1]
            delta = rewards[at] + args.gamma * (going_on * then + following[at]) - values[at]
            advantage = delta + args.gamma * LAMBDA * going_on * advantage
            advantages[at] = advantage
        returns = advantages + values
        batch = (observations, actions, log_probs, advantages, returns)
        flat = [part.flatten(0, 1) for part in batch]
        flat_masks = None if masks is None else masks.flatten(0, 1)
        for _ in range(args.epochs):
            for rows_of in torch.randperm(args.decisions * args.envs).chunk(MINIBATCHES):
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
        if isinstance(policy.eye, Standard):
            policy.eye.take(flat[0])
        step = (update + 1) * steps_of_update
        if episodes.ended:
            episodes.write(writer, step)
        writer.add_scalar("time/steps_per_second", step / (time.monotonic() - began), step)
        stage = getattr(envs.level_source, "stage", None)
        if stage != reached:
            reached = stage
            print(f"stage {stage} begins after {step} steps")
        if args.evaluate_every and step // args.evaluate_every > evaluated:
            evaluated = step // args.evaluate_every
            score = evaluate(policy, args, 40, 5, sampled=True)
            writer.add_scalar("evaluation/score", score, step)
            if args.until is not None and score >= args.until:
                print(f"mean score {score:.2f} after {step} steps")
                break
    print(f"{step} steps in {time.monotonic() - began:.0f} s")
    policy.save(args.out, observation, args.repeat)
    writer.close()
    envs.close()
    return policy


def evaluate(
    policy: Policy, args: argparse.Namespace, number: int, each: int = 1, *, sampled: bool = False
) -> float:
    """Returns the mean score of the policy's likeliest actions, in episodes not trained on.

    With `sampled` actions are drawn as in training.

    Environment k of the `number` plays the first `each` episodes of seed 1000000 + k. Taking the
    first episodes to end would favour short ones.
    """
    envs = environments(args, number)
    observation, infos = envs.reset(seed=1_000_000)
    score, played = 0.0, np.zeros(number, int)
    while (played < each).any():
        with torch.no_grad():
            masks = torch.from_numpy(infos["action_mask"]) if args.masks else None
            drawn, _ = policy(torch.from_numpy(observation), masks)
            actions = drawn.sample() if sampled else drawn.logits.argmax(-1)
        ended = np.zeros(number, bool)
        for _ in range(args.repeat):
            observation, _, terminated, truncated, infos = envs.step(
                np.where(ended, 0, actions.numpy())
            )
            over = terminated | truncated
            counted = over & (played < each)
            if counted.any():
                goals = infos["final_info"]["score"][counted]
                score += float((goals[:, 0] - goals[:, 1]).sum())
            played += counted
            ended |= over
    envs.close()
    return score / (number * each)


def main(argv: list[str] | None = None) -> float:
    """Reads the command line, trains and evaluates."""
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
    parser.add_argument("--envs", type=int, default=128)
    parser.add_argument("--threads", type=int, default=2, help="of the engine and of PyTorch")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--lr", type=float, default=7e-4, help="at the beginning; it falls to 0")
    parser.add_argument("--epochs", type=int, default=3, help="of an update")
    parser.add_argument(
        "--gamma", type=float, default=0.997, help="what a reward after the next action is worth"
    )
    parser.add_argument(
        "--decisions", type=int, default=64, help="of an environment between two updates"
    )
    parser.add_argument(
        "--repeat", type=int, default=1, metavar="STEPS", help="how long an action is pressed"
    )
    parser.add_argument(
        "--masks", action="store_true", help="only draw actions that can change something"
    )
    parser.add_argument("--out", type=Path, default=Path("runs/cleanrl"))
    args = parser.parse_args(argv)
    if args.until is not None and not args.evaluate_every:
        parser.error("--until needs --evaluate-every")
    torch.set_num_threads(args.threads)
    policy = train(args)
    score = evaluate(policy, args, 100)
    print(f"mean score of 100 episodes: {score:.2f}")
    drawn = evaluate(policy, args, 100, 5, sampled=True)
    print(f"mean score of 500 episodes with sampled actions: {drawn:.2f}")
    return score


if __name__ == "__main__":
    main()
