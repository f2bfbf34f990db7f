"""Pictures of the pitch from above with something drawn over them, and PNG files."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Point = Sequence[float] | NDArray[Any]
"""Metres from the centre spot, x and y."""
Colour = tuple[int, int, int]

WHITE: Colour = (255, 255, 255)
GOLD: Colour = (255, 214, 64)
RED: Colour = (226, 62, 62)
CYAN: Colour = (96, 220, 235)
NIGHT: Colour = (17, 21, 27)

USUAL_M = (110.0, 72.0)
"""The length and width of the usual pitch."""
MARGIN_M = (9.0, 7.0)
"""How much more than the pitch the camera above shows."""
PALETTE = 256


class Panel:
    """A part of the pitch seen from above, `size` pixels wide and high."""

    def __init__(self, middle: Point, width_m: float, size: tuple[int, int]) -> None:
        width, height = size
        self.scale = width / width_m
        self.corner = np.asarray(middle, float) - np.array(size) / 2 / self.scale
        self.size = size
        x, y = np.arange(width) + 0.5, np.arange(height) + 0.5
        self.x = self.corner[0] + x[None, :] / self.scale + 0 * y[:, None]
        """The place of every pixel, metres."""
        self.y = self.corner[1] + y[:, None] / self.scale + 0 * x[None, :]
        self.pixels = np.zeros((height, width, 3))

    def show(self, env: Any, pitch_m: tuple[float, float] = USUAL_M) -> None:
        """Draws the match as it is now, on a pitch of this length and width."""
        shown = np.add(pitch_m, MARGIN_M)
        width, height = np.round(shown * self.scale).astype(int)
        whole = env.picture((int(width), int(height)), camera="above", news=False)
        left, top = np.round((self.corner + shown / 2) * self.scale).astype(int)
        columns = np.clip(np.arange(left, left + self.size[0]), 0, width - 1)
        rows = np.clip(np.arange(top, top + self.size[1]), 0, height - 1)
        self.pixels = whole[rows][:, columns].astype(float)

    def wash(self, colour: Colour, share: NDArray[Any] | float) -> None:
        """Mixes a colour into every pixel: 0 leaves it, 1 replaces it."""
        alpha = np.broadcast_to(np.asarray(share, float), self.x.shape)[..., None]
        self.pixels = self.pixels * (1 - alpha) + np.array(colour) * alpha

    def dot(self, at: Point, radius: float, colour: Colour, share: float = 1.0) -> None:
        """Draws a disc, `radius` in pixels."""
        away = np.hypot(self.x - at[0], self.y - at[1]) * self.scale
        self.wash(colour, share * np.clip(radius + 0.5 - away, 0, 1))

    def ring(self, at: Point, radius: float, colour: Colour) -> None:
        """Draws a ring, `radius` in pixels."""
        away = np.hypot(self.x - at[0], self.y - at[1]) * self.scale
        self.wash(colour, np.clip(2.0 - np.abs(away - radius), 0, 1))

    def line(
        self, points: Sequence[Point], width: float, colour: Colour, share: float = 1.0
    ) -> None:
        """Draws a line through some points, `width` in pixels."""
        nearest = np.full(self.x.shape, np.inf)
        for start, end in pairwise(points):
            way = np.subtract(end, start).astype(float)
            length = max(float(way @ way), 1e-9)
            along = ((self.x - start[0]) * way[0] + (self.y - start[1]) * way[1]) / length
            along = np.clip(along, 0, 1)
            away = np.hypot(self.x - start[0] - along * way[0], self.y - start[1] - along * way[1])
            nearest = np.minimum(nearest, away)
        self.wash(colour, share * np.clip(width / 2 + 0.5 - nearest * self.scale, 0, 1))

    def arrow(self, start: Point, way: Point, colour: Colour) -> None:
        """Draws an arrow, `way` in metres."""
        end, way = np.add(start, way), np.asarray(way, float)
        back, side = -0.3 * way, 0.18 * np.array([-way[1], way[0]])
        self.line([start, end], 3, colour)
        self.line([end + back + side, end, end + back - side], 3, colour)


def sheet(panels: Sequence[Panel], columns: int = 2, gap: int = 6) -> NDArray[np.uint8]:
    """Lays panels of one size side by side, row by row."""
    width, height = panels[0].size
    rows = -(-len(panels) // columns)
    shape = (rows * (height + gap) - gap, columns * (width + gap) - gap, 3)
    pixels = np.empty(shape)
    pixels[:] = NIGHT
    for index, panel in enumerate(panels):
        top, left = index // columns * (height + gap), index % columns * (width + gap)
        pixels[top : top + height, left : left + width] = panel.pixels
    return np.clip(np.round(pixels), 0, 255).astype(np.uint8)


def indexed(pixels: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """Returns the palette's colours `(n, 3)`, and for every pixel which of them is nearest."""
    flat = pixels.reshape(-1, 3)
    colours, which, counts = np.unique(flat // 4, axis=0, return_inverse=True, return_counts=True)
    common = colours[np.argsort(-counts, kind="stable")[:PALETTE]].astype(int)
    away = ((colours[:, None, :].astype(int) - common[None]) ** 2).sum(-1)
    index = away.argmin(1)[which.reshape(-1)]
    palette = np.minimum(common * 4 + 2, 255)
    return palette.astype(np.uint8), index.reshape(pixels.shape[:2]).astype(np.uint8)


def save(path: Path, pixels: NDArray[np.uint8]) -> None:
    """Writes a PNG with a palette."""
    palette, index = indexed(pixels)
    height, width = index.shape
    lines = np.zeros((height, width + 1), np.uint8)  # The first byte says: unfiltered.
    lines[:, 1:] = index

    def chunk(name: bytes, content: bytes) -> bytes:
        sum_of = zlib.crc32(name + content)
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", sum_of)

    head = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"PLTE", palette.tobytes())
        + chunk(b"IDAT", zlib.compress(lines.tobytes(), 9))
        + chunk(b"IEND", b"")
    )
