"""Two small networks in NumPy and their optimizer."""

from __future__ import annotations

import numpy as np

HIDDEN = 128
"""Width of a hidden layer."""


class Mlp:
    """Two hidden layers of tanh and a linear one, over a slice of a flat array of weights."""

    def __init__(self, inputs: int, outputs: int, flat: np.ndarray) -> None:
        """Takes weights from float32 `flat`, of length `size(inputs, outputs)`; a view of it is kept."""
        self.layers, at = [], 0
        for rows, columns in self.shapes(inputs, outputs):
            weights = flat[at : at + rows * columns].reshape(rows, columns)
            at += rows * columns
            self.layers.append((weights, flat[at : at + columns]))
            at += columns

    @staticmethod
    def shapes(inputs: int, outputs: int) -> list[tuple[int, int]]:
        """Returns the shapes of the weights."""
        return [(inputs, HIDDEN), (HIDDEN, HIDDEN), (HIDDEN, outputs)]

    @staticmethod
    def size(inputs: int, outputs: int) -> int:
        """Returns the number of weights and biases."""
        return sum((rows + 1) * columns for rows, columns in Mlp.shapes(inputs, outputs))

    def draw(self, rng: np.random.Generator, gain: float) -> None:
        """Draws orthogonal weights, the last layer's scaled to `gain`, and clears the biases."""
        for (weights, bias), scale in zip(self.layers, (2**0.5, 2**0.5, gain), strict=True):
            long, short = max(weights.shape), min(weights.shape)
            basis, triangle = np.linalg.qr(rng.standard_normal((long, short)))
            basis = basis * np.sign(np.diag(triangle))
            weights[:] = scale * (basis if weights.shape == (long, short) else basis.T)
            bias[:] = 0

    def forward(self, inputs: np.ndarray) -> list[np.ndarray]:
        """Returns the inputs and the output of every layer."""
        seen = [inputs]
        for weights, bias in self.layers[:-1]:
            sums = seen[-1] @ weights
            sums += bias
            seen.append(np.tanh(sums, out=sums))
        weights, bias = self.layers[-1]
        seen.append(seen[-1] @ weights + bias)
        return seen

    def backward(self, seen: list[np.ndarray], slope: np.ndarray, into: Mlp) -> None:
        """Writes the gradient into `into`, from the result of `forward` and the loss's slope."""
        for at in range(len(self.layers) - 1, -1, -1):
            weights, bias = into.layers[at]
            np.matmul(seen[at].T, slope, out=weights)
            bias[:] = slope.sum(0)
            if at:
                slope = slope @ self.layers[at][0].T
                slope *= 1.0 - seen[at] * seen[at]


class Adam:
    """Adam over a flat array of weights."""

    def __init__(self, weights: np.ndarray) -> None:
        self.weights, self.steps = weights, 0
        self.mean, self.square = np.zeros_like(weights), np.zeros_like(weights)

    def step(self, gradient: np.ndarray, rate: float, norm_max: float) -> None:
        """Takes a step against the gradient, whose norm is limited to `norm_max`."""
        gradient = gradient * min(1.0, norm_max / (float(np.linalg.norm(gradient)) + 1e-8))
        self.steps += 1
        self.mean += 0.1 * (gradient - self.mean)
        self.square += 0.001 * (gradient * gradient - self.square)
        mean = self.mean / (1.0 - 0.9**self.steps)
        square = self.square / (1.0 - 0.999**self.steps)
        self.weights -= rate * mean / (np.sqrt(square) + 1e-5)
