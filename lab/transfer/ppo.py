"""Trains a policy here by PPO, on the places that the super mini map shows."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from games import Here
from network import Adam, Mlp
from places import Roster, Tracker
from policy import ACTIONS, Policy, Scale, draw, scaled

ENVS = 128
STEPS_OF_ENV = 64
"""Steps of each environment between two updates."""
EPOCHS = 3
MINIBATCH = 2_048
GAMMA = 0.997
LAMBDA = 0.95
RATIO_CLIP = 0.2
RATE = 7e-4  # falls to 0
ENTROPY = 0.01
VALUE = 0.5
NORM_MAX = 0.5
HIDDEN_M = 0.6
"""Error of a place throughout a training episode, metres: about half a cell."""
FLICKER_M = 0.2
"""Its variation from step to step, standard deviation in metres."""
RECENT = 1_000
"""Episodes of the score that is reported and that may end the training."""


class Blur:
    """Moves the places that a policy trains on, by as much as a cell hides.

    One part is constant for an episode, the other changes from step to step. A policy that has only
    seen exact paths can't handle rounded ones.
    """

    def __init__(self, roster: Roster, envs: int, rng: np.random.Generator) -> None:
        places = 2 * (2 + roster.players)
        self.rng, self.envs, self.places = rng, envs, places
        # The vector to the ball and the flags lie between the places and the movements since the
        # last maps.
        self.ways = slice(places + 2 + roster.players, roster.features)
        self.offsets = np.zeros((envs, places), np.float32)

    def move(self, features: np.ndarray, first: np.ndarray) -> np.ndarray:
        """Returns the moved features `(envs, features)`.

        `first` is `(envs,)` bool: an episode starts with them.
        """
        drawn = self.rng.uniform(-HIDDEN_M, HIDDEN_M, self.offsets.shape).astype(np.float32)
        self.offsets = np.where(first[:, None], drawn, self.offsets)
        moved = features.copy()
        moved[:, : self.places] += self.offsets
        moved[:, self.places : self.places + 2] += self.offsets[:, 0:2] - self.offsets[:, 2:4]
        for part in (slice(0, self.places + 2), self.ways):
            moved[:, part] += self.rng.normal(0.0, FLICKER_M, moved[:, part].shape).astype(
                np.float32
            )
        return moved


@dataclass
class Trained:
    """A policy and how it was trained."""

    policy: Policy
    steps: int
    score: (
        float  # mean goal difference of the last `RECENT` episodes, drawn actions; NaN without one
    )
    seconds: float


class Learner:
    """Actor and critic over one array of weights."""

    def __init__(self, features: int, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.split = Mlp.size(features, ACTIONS)
        self.weights = np.zeros(self.split + Mlp.size(features, 1), np.float32)
        self.gradient = np.zeros_like(self.weights)
        self.actor, self.critic = self._pair(features, self.weights)
        self.actor_gradient, self.critic_gradient = self._pair(features, self.gradient)
        self.actor.draw(self.rng, 0.01)
        self.critic.draw(self.rng, 1.0)
        self.adam = Adam(self.weights)

    def _pair(self, features: int, flat: np.ndarray) -> tuple[Mlp, Mlp]:
        return Mlp(features, ACTIONS, flat[: self.split]), Mlp(features, 1, flat[self.split :])

    def step(self, rows: dict[str, np.ndarray], rate: float) -> None:
        """Takes a step on a minibatch: `inputs`, `actions`, `logs` (log probabilities), `gains`, `returns`."""
        count = len(rows["actions"])
        every = np.arange(count)
        seen = self.actor.forward(rows["inputs"])
        logs = log_softmax(seen[-1])
        shares = np.exp(logs)
        gains = rows["gains"]
        gains = (gains - gains.mean()) / (gains.std() + 1e-8)
        ratio = np.exp(logs[every, rows["actions"]] - rows["logs"])
        beyond = np.where(gains > 0, ratio > 1 + RATIO_CLIP, ratio < 1 - RATIO_CLIP)
        pull = np.where(beyond, 0.0, -gains * ratio)[:, None]
        slope = -pull * shares
        slope[every, rows["actions"]] += pull[:, 0]
        entropy = -(shares * logs).sum(1, keepdims=True)
        slope += ENTROPY * shares * (logs + entropy)
        self.actor.backward(seen, (slope / count).astype(np.float32), self.actor_gradient)
        seen = self.critic.forward(rows["inputs"])
        slope = VALUE * (seen[-1] - rows["returns"][:, None]) / count
        self.critic.backward(seen, slope.astype(np.float32), self.critic_gradient)
        self.adam.step(self.gradient, rate, NORM_MAX)


def log_softmax(logits: np.ndarray) -> np.ndarray:
    """Returns the logarithms of the actions' probabilities."""
    logits = logits - logits.max(-1, keepdims=True)
    return logits - np.log(np.exp(logits).sum(-1, keepdims=True))


def advantages(
    rewards: np.ndarray, values: np.ndarray, terminated: np.ndarray, over: np.ndarray
) -> np.ndarray:
    """Returns the advantages, `(steps, envs)`; `values` has one more row, for the last maps.

    The map after an episode's last step is its own last one, so that a truncated episode is worth
    what the critic estimates.
    """
    gains = np.zeros_like(rewards)
    gain = np.zeros_like(rewards[0])
    for at in range(len(rewards) - 1, -1, -1):
        delta = rewards[at] + GAMMA * ~terminated[at] * values[at + 1] - values[at]
        gain = delta + GAMMA * LAMBDA * ~over[at] * gain
        gains[at] = gain
    return gains


def train(
    scenario: str,
    steps: int,
    seed: int,
    rewards: str = "scoring,checkpoints",
    enough: float = np.inf,
    report: Callable[[str], None] = print,
) -> Trained:
    """Trains for `steps` steps of all environments together, or until the recent score is `enough`."""
    began = time.monotonic()
    game = Here(scenario, ENVS, seed * ENVS, rewards)
    roster = opening(game)
    maps = game.reset()
    learner, scale = Learner(roster.features, seed), Scale(roster.features)
    tracker, rng = Tracker(roster, ENVS), learner.rng
    shape = (STEPS_OF_ENV, ENVS)
    inputs = np.zeros((STEPS_OF_ENV + 1, ENVS, roster.features), np.float32)
    raw = np.zeros((*shape, roster.features), np.float32)
    actions = np.zeros(shape, np.int64)
    logs, paid = np.zeros(shape, np.float32), np.zeros(shape, np.float32)
    values = np.zeros((STEPS_OF_ENV + 1, ENVS), np.float32)
    terminated, over, idle = (np.zeros(shape, bool) for _ in range(3))
    first, ended = np.ones(ENVS, bool), np.zeros(ENVS, bool)
    blur = Blur(roster, ENVS, rng)
    features = blur.move(tracker.see(maps, first), first)
    recent: deque[int] = deque(maxlen=RECENT)
    size = STEPS_OF_ENV * ENVS
    updates, done = max(2, steps // size), 0
    for update in range(updates):
        mean, divisor = scale.parts()
        for at in range(STEPS_OF_ENV):
            raw[at], inputs[at] = features, scaled(features, mean, divisor)
            logits = learner.actor.forward(inputs[at])[-1]
            actions[at] = draw(logits, rng)
            logs[at] = log_softmax(logits)[np.arange(ENVS), actions[at]]
            turn = game.step(actions[at])
            # The step after an episode's last one only starts the next, so it teaches nothing.
            idle[at], first = ended, ended
            ended = turn.terminated | turn.truncated
            paid[at], terminated[at], over[at] = turn.rewards, turn.terminated, ended
            recent.extend(turn.ahead[ended].tolist())
            features = blur.move(tracker.see(turn.maps, first), first)
        done += size
        scale.take(raw.reshape(size, -1))
        score = float(np.mean(recent)) if recent else float("nan")
        if update % 61 == 60:
            pace = done / (time.monotonic() - began)
            report(f"{scenario}: {done} steps, score {score:.2f}, {pace:.0f} steps per second")
        if len(recent) == RECENT and score >= enough:
            break
        if update == 0:
            # The scale of the first inputs was a guess.
            continue
        inputs[-1] = scaled(features, mean, divisor)
        values[:] = learner.critic.forward(inputs.reshape(size + ENVS, -1))[-1].reshape(
            values.shape
        )
        gains = advantages(paid, values, terminated, over)
        learn(
            learner,
            inputs[:-1],
            actions,
            logs,
            gains,
            gains + values[:-1],
            ~idle,
            RATE * (1 - update / updates),
        )
    game.close()
    policy = Policy(roster, *scale.parts(), learner.weights[: learner.split].copy())
    return Trained(policy, done, score, time.monotonic() - began)


def opening(game: Here) -> Roster:
    """Reads the players from the first second of an episode without any press."""
    maps = [game.reset()[0].copy()]
    for _ in range(10):
        maps.append(game.step(np.zeros(game.envs, np.int64)).maps[0].copy())
    return Roster.of(np.stack(maps))


def learn(
    learner: Learner,
    inputs: np.ndarray,
    actions: np.ndarray,
    logs: np.ndarray,
    gains: np.ndarray,
    returns: np.ndarray,
    counted: np.ndarray,
    rate: float,
) -> None:
    """Makes the epochs of an update over the steps that are `counted`, `(steps, envs)` bool."""
    rows = np.flatnonzero(counted)
    table = {
        "inputs": inputs.reshape(-1, inputs.shape[-1]),
        "actions": actions.reshape(-1),
        "logs": logs.reshape(-1),
        "gains": gains.reshape(-1),
        "returns": returns.reshape(-1),
    }
    for _ in range(EPOCHS):
        for some in np.array_split(
            learner.rng.permutation(rows), max(1, round(len(rows) / MINIBATCH))
        ):
            learner.step({name: part[some] for name, part in table.items()}, rate)
