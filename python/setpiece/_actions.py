"""Reads actions from whatever form they are given in."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def array_of(value: Any) -> NDArray[Any] | None:
    """Returns a value as an array; None if it can't be one, such as lists of different lengths."""
    try:
        return np.asarray(value)
    except (ValueError, TypeError):
        return None


def integers(value: Any, shape: tuple[int, ...], n_actions: int) -> NDArray[np.int64] | None:
    """Reads actions of a shape, each in 0..n_actions; None for anything else."""
    array = array_of(value)
    if array is None or array.shape != shape:
        return None
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() >= n_actions):
        return None
    return array.astype(np.int64)
