"""Videos of episodes."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TypedDict

from setpiece import _native
from setpiece._env_options import CAMERAS
from setpiece._errors import ParameterError
from setpiece._options import check_path
from setpiece._spaces import PICTURE_MAX, check_size
from setpiece._words import check_word

FORMATS = ("mp4", "gif")
QUALITIES = ("low", "medium", "high")
"""GRF's `video_quality_level` 0, 1 and 2."""

SPEEDS = (0.05, 20.0)
"""The slowest and the fastest speed of a video, relative to the match."""

LEAST = 16
"""The fewest pixels of an MP4's side."""

SIZES = {"low": (640, 360), "medium": (1280, 720), "high": (1280, 720)}
"""The usual size of a video by its quality."""


class VideoForm(TypedDict):
    """What a video looks like; the native module reads it."""

    format: str
    size: tuple[int, int]
    camera: str
    speed: float
    quality: str


def read_form(
    path: str | PathLike[str],
    size: tuple[int, int] | None,
    camera: str,
    speed: float,
    quality: str,
) -> tuple[Path, VideoForm]:
    """Returns a video's path and its form, or raises `ParameterError`."""
    target = check_path("path", path)
    ending = target.suffix.lower().removeprefix(".")
    if ending not in FORMATS:
        raise ParameterError(
            f"a video can't be written as `{target}`",
            name="path",
            help=f"name it `{target.with_suffix('.mp4')}`",
        )
    quality = check_word("quality", quality, QUALITIES)
    if (
        isinstance(speed, bool)
        or not isinstance(speed, int | float)
        or not SPEEDS[0] <= speed <= SPEEDS[1]
    ):
        raise ParameterError(f"`speed` is {speed!r}; it can be a number in 0.05..20", name="speed")
    width, height = SIZES[quality] if size is None else check_size(size, PICTURE_MAX)
    if ending == "mp4" and (width % 2 or height % 2 or min(width, height) < LEAST):
        raise ParameterError(
            f"an MP4 has even sides of {LEAST} pixels or more, not {width} x {height}", name="size"
        )
    form = VideoForm(
        format=ending,
        size=(width, height),
        camera=check_word("camera", camera, CAMERAS),
        speed=float(speed),
        quality=quality,
    )
    return target, form


def write_moments(
    path: Path, moments: Sequence[_native.Moment], size: tuple[int, int], quality: str
) -> None:
    """Writes the video of moments that follow each other; raises `FileError` if it can't."""
    target, form = read_form(path, size, "broadcast", 1.0, quality)
    _native.write(target, _native.moments_video(list(moments), form))
