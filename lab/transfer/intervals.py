"""95 % intervals of mean scores and of the share that is kept."""

from __future__ import annotations

import math

import numpy as np

Z = 1.959964
# Student's t at 97.5 % by degrees of freedom; beyond the last one the normal distribution is near
# enough.
# fmt: off
T = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
    2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
]
# fmt: on


def mean_interval(scores: np.ndarray) -> tuple[float, float]:
    """Returns the interval of the mean: Wilson's for scores of 0 or 1, otherwise Student's t."""
    count, mean = len(scores), float(np.mean(scores))
    if np.isin(scores, (0, 1)).all():
        scale = 1 + Z * Z / count
        middle = (mean + Z * Z / (2 * count)) / scale
        half = Z / scale * math.sqrt(mean * (1 - mean) / count + Z * Z / (4 * count * count))
        return max(0.0, middle - half), min(1.0, middle + half)
    t = T[count - 2] if count - 2 < len(T) else Z
    half = t * float(np.std(scores, ddof=1)) / math.sqrt(count)
    return mean - half, mean + half


def share_interval(here: np.ndarray, there: np.ndarray) -> tuple[float, float, float] | None:
    """Returns the mean there over the mean here and its interval; None if this may be 0.

    The interval is built from those of the two means (Donner and Zou, "Closed-form confidence
    intervals for functions of the normal mean and standard deviation", 2012).
    """
    a, b = float(np.mean(there)), float(np.mean(here))
    (a_low, a_high), (b_low, b_high) = mean_interval(there), mean_interval(here)
    if b_low <= 0:
        return None
    product = a * b
    low = product * product - a_low * b_high * (2 * a - a_low) * (2 * b - b_high)
    high = product * product - a_high * b_low * (2 * a - a_high) * (2 * b - b_low)
    return (
        a / b,
        (product - math.sqrt(max(low, 0.0))) / (b_high * (2 * b - b_high)),
        (product + math.sqrt(max(high, 0.0))) / (b_low * (2 * b - b_low)),
    )
