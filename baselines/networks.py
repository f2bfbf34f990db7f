"""What networks are made of."""

from __future__ import annotations

import torch
from torch import Tensor, nn


class Running(nn.Module):
    """Mean and variance of all numbers that it has taken so far."""

    mean: Tensor
    variance: Tensor
    taken: Tensor

    def __init__(self, inputs: int, least: float) -> None:
        """`least` is the least standard deviation that numbers are divided by."""
        super().__init__()
        self.register_buffer("mean", torch.zeros(inputs))
        self.register_buffer("variance", torch.ones(inputs))
        self.register_buffer("taken", torch.zeros((), dtype=torch.float64))
        self.least = least

    @property
    def deviation(self) -> Tensor:
        """The standard deviation, which is never close to 0."""
        return self.variance.sqrt().clamp(min=self.least)

    def forward(self, numbers: Tensor) -> Tensor:
        """Standardises numbers, none further from 0 than 10."""
        return ((numbers - self.mean) / self.deviation).clamp(-10, 10)

    def take(self, numbers: Tensor, memory: float = float("inf")) -> None:
        """Takes a batch; of earlier numbers at most `memory` count."""
        variance, mean = torch.var_mean(numbers, 0, correction=0)
        before = min(float(self.taken), memory)
        share, away = len(numbers) / (before + len(numbers)), mean - self.mean
        self.mean += share * away
        self.variance += share * (variance - self.variance + (1 - share) * away.square())
        self.taken.fill_(before + len(numbers))


def layer(inputs: int, outputs: int, gain: float = 2**0.5) -> nn.Linear:
    """A layer with orthogonal weights."""
    made = nn.Linear(inputs, outputs)
    nn.init.orthogonal_(made.weight, gain)
    nn.init.zeros_(made.bias)
    return made


def body(inputs: int, width: int) -> list[nn.Module]:
    """Two layers of `width` units."""
    return [layer(inputs, width), nn.Tanh(), layer(width, width), nn.Tanh()]


class Eye(nn.Module):
    """Turns pictures, uint8 `(…, height, width, channels)`, into `width` features."""

    def __init__(self, shape: tuple[int, ...], width: int) -> None:
        super().__init__()
        self.filters = nn.Sequential(
            nn.Conv2d(shape[2], 16, 8, stride=4),
            nn.ReLU(),
            nn.Conv2d(16, 32, 4, stride=2),
            nn.ReLU(),
            nn.Flatten(),
        )
        found = self.filters(torch.zeros(1, shape[2], *shape[:2])).shape[1]
        self.features = nn.Sequential(layer(found, width), nn.ReLU())

    def forward(self, pictures: Tensor) -> Tensor:
        """Returns the features."""
        every = pictures.flatten(0, -4).permute(0, 3, 1, 2).float() / 255
        seen: Tensor = self.features(self.filters(every))
        return seen.view(*pictures.shape[:-3], seen.shape[-1])


def log_odds(logits: Tensor, masks: Tensor | None) -> Tensor:
    """Returns the logarithms of the actions' probabilities; masked actions have none."""
    return (logits if masks is None else logits.masked_fill(~masks, -1e9)).log_softmax(-1)


def draw(odds: Tensor, random: torch.Generator) -> Tensor:
    """Draws an action `(…,)` from the logarithms of probabilities `(…, actions)`."""
    every = torch.multinomial(odds.exp().flatten(0, -2), 1, generator=random)
    return every.view(odds.shape[:-1])
