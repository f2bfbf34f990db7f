"""The minimap: everybody's place, as a small picture."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece.gfootball.env.config import has_bug

SMM_WIDTH = 96
SMM_HEIGHT = 72
SMM_LAYERS = ["left_team", "right_team", "ball", "active"]
MINIMAP_NORM_X_MIN = -1.0
MINIMAP_NORM_X_MAX = 1.0
MINIMAP_NORM_Y_MIN = -1.0 / 2.25
MINIMAP_NORM_Y_MAX = 1.0 / 2.25
_MARKER_VALUE = 255


def get_smm_layers(config: Any = None) -> list[str]:  # noqa: ARG001  # GRF's signature
    """Returns the names of the four channels."""
    return SMM_LAYERS


def mark_points(frame: NDArray[np.uint8], points: Any) -> None:
    """Marks points, float `(n, 2)` in the units of observations, in a channel, uint8 `(height, width)`.

    A point outside the picture is marked at its edge.
    """
    points = np.asarray(points, np.float64).reshape(-1, 2)
    height, width = frame.shape
    across = (points[:, 0] - MINIMAP_NORM_X_MIN) / (MINIMAP_NORM_X_MAX - MINIMAP_NORM_X_MIN) * width
    down = (points[:, 1] - MINIMAP_NORM_Y_MIN) / (MINIMAP_NORM_Y_MAX - MINIMAP_NORM_Y_MIN) * height
    columns = np.minimum(np.maximum(across.astype(np.int64), 0), width - 1)
    rows = np.minimum(np.maximum(down.astype(np.int64), 0), height - 1)
    frame[rows, columns] = _MARKER_VALUE


def generate_smm(
    observation: Sequence[dict[str, Any]],
    config: Any = None,
    channel_dimensions: tuple[int, int] = (SMM_WIDTH, SMM_HEIGHT),
) -> NDArray[np.uint8]:
    """Returns the minimaps of n raw observations: uint8 `(n, height, width, 4)`, 0 or 255.

    - `observation`: with arrays or lists; a missing part is a blank channel, and without `*_active`
      everybody plays.
    - `config`: GRF also marks players who were sent off; with `grf_bugs` in a config they are
      marked here too.
    - `channel_dimensions`: width and height.
    """
    keep = has_bug(config, "sent_off")
    layers = get_smm_layers(config)
    width, height = channel_dimensions
    frames = np.zeros((len(observation), height, width, len(layers)), np.uint8)
    for frame, seen in zip(frames, observation, strict=True):
        for index, layer in enumerate(layers):
            if layer in seen:
                mark_points(frame[:, :, index], _points(seen, layer, keep))
    return frames


def _points(seen: dict[str, Any], layer: str, keep: bool) -> Any:
    """The places that a channel shows; players who were sent off only with `keep`."""
    if layer == "ball":
        return seen["ball"][:2]
    if layer == "active":
        return [] if seen["active"] == -1 else seen["left_team"][seen["active"]]
    team = np.asarray(seen[layer], np.float64)
    return team if keep else team[playing(seen, layer)]


def playing(seen: dict[str, Any], team: str) -> NDArray[np.bool_]:
    """Returns who of a team (`left_team`, `right_team`) is on the pitch: everybody by default."""
    active = seen.get(f"{team}_active")
    return np.ones(len(seen[team]), np.bool_) if active is None else np.asarray(active, np.bool_)
