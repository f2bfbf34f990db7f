"""A trained policy: its weights, its inputs' scale and its file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from network import Mlp
from places import Roster

ACTIONS = 19
CLIP = 5.0
"""Scaled inputs are clamped to this."""
SCALE_MIN = 0.5
"""Least deviation of inputs: what is constant in one game may move by a cell in the other."""


class Scale:
    """Mean and deviation of the inputs seen so far."""

    def __init__(self, features: int) -> None:
        self.count = 0
        self.mean, self.variance = np.zeros(features), np.ones(features)

    def take(self, inputs: np.ndarray) -> None:
        """Takes more inputs, `(rows, features)`."""
        count, mean, variance = (
            len(inputs),
            inputs.mean(0, dtype=np.float64),
            inputs.var(0, dtype=np.float64),
        )
        total = self.count + count
        gap = mean - self.mean
        self.variance = (
            self.variance * self.count + variance * count + gap * gap * self.count * count / total
        ) / total
        self.mean = self.mean + gap * count / total
        self.count = total

    def parts(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns mean and divisor, float32."""
        divisor = np.maximum(np.sqrt(self.variance), SCALE_MIN)
        return self.mean.astype(np.float32), divisor.astype(np.float32)


def scaled(inputs: np.ndarray, mean: np.ndarray, divisor: np.ndarray) -> np.ndarray:
    """Returns the inputs in the form for a network, float32."""
    return np.clip((inputs - mean) / divisor, -CLIP, CLIP)


def draw(logits: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Draws an action for each row of logits."""
    return (logits + rng.gumbel(size=logits.shape)).argmax(-1)


class Policy:
    """Rates the 19 actions by the features of a `Tracker`."""

    def __init__(
        self, roster: Roster, mean: np.ndarray, divisor: np.ndarray, weights: np.ndarray
    ) -> None:
        self.roster, self.mean, self.divisor, self.weights = roster, mean, divisor, weights
        self.actor = Mlp(roster.features, ACTIONS, weights)

    def logits(self, features: np.ndarray) -> np.ndarray:
        """Returns float32 `(rows, 19)` for float32 features `(rows, roster.features)`."""
        return self.actor.forward(scaled(features, self.mean, self.divisor))[-1]

    def save(self, path: Path) -> None:
        """Writes the policy with half the weights' precision."""
        parts = {"mean": self.mean, "divisor": self.divisor}
        roster = {"own": self.roster.own, "opponents": self.roster.opponents}
        np.savez_compressed(path, weights=self.weights.astype(np.float16), **parts, **roster)

    @classmethod
    def load(cls, path: Path) -> Policy:
        """Reads a policy."""
        with np.load(path) as file:
            roster = Roster(file["own"], file["opponents"])
            return cls(roster, file["mean"], file["divisor"], file["weights"].astype(np.float32))
