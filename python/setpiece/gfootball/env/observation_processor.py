"""Dumps: an episode as consecutive pickled dicts.

A record has `debug` (`action`: the actions, in the frame of the pitch; `frame_cnt`, `reward`,
`time`; the first record also `config`), `observation` (of the whole match), `reward` and
`cumulative_reward`.
"""

from __future__ import annotations

import pickle
import time
from collections import deque
from collections.abc import Iterable
from datetime import datetime
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from setpiece import _native
from setpiece._errors import FileError, FormatError
from setpiece._record import write
from setpiece._video import QUALITIES, write_moments
from setpiece.gfootball.env.football_action_set import CoreAction

if TYPE_CHECKING:
    from setpiece.gfootball.env.config import Config

LAST = 100
"""Steps in a dump before the moment that it shows."""
EPISODE_MAX = 10_000
"""The most steps kept of an episode."""
SCORE_PAUSE_S = 600.0
"""Seconds between two dumps of goals of the same kind."""

PROTOCOL = 4
"""The pickle protocol of dumps: the newest that every Python for GRF can load."""
ACTIONS = "gfootball.env.football_action_set"
"""GRF's module of actions."""

Trace = dict[str, Any]


class _Actions:
    """Represents GRF's module of actions in a pickle."""


_ACTIONS = _Actions()


class _Writer(pickle.Pickler):
    """Pickles records that GRF can load, without names of this package or internals of NumPy."""

    def reducer_override(self, value: object) -> Any:
        """Returns how to rebuild an action or an array; anything else is pickled as usual."""
        if isinstance(value, CoreAction):
            return getattr, (_ACTIONS, f"action_{value.name}")
        if value is _ACTIONS:
            return import_module, (ACTIONS,)
        if isinstance(value, np.ndarray) and value.size:
            # Pickles of NumPy 2 can't be loaded by the versions in most installations of GRF.
            return np.array, (value.tolist(), value.dtype.str)
        return NotImplemented


class _Reader(pickle.Unpickler):
    """Loads records of this package and of GRF, with or without a package `gfootball`."""

    def find_class(self, module: str, name: str) -> Any:
        """Returns the object that a pickle names; GRF's own names map to this package's."""
        if module == "importlib" and name == "import_module":
            return lambda called: import_module(_own(called))
        if name == "e_BackendAction":
            return int
        return super().find_class(_own(module), name)


def _own(module: str) -> str:
    return f"setpiece.{module}" if module.split(".", 1)[0] == "gfootball" else module


Step = tuple[Trace, list[_native.Moment]]
"""A step's record, and what it led to if videos are written."""

SMALL = (800, 450)
"""The size of a video at the lowest quality."""


class ObservationProcessor:
    """Keeps the last steps of an episode and writes the requested dumps."""

    def __init__(self, config: Config) -> None:
        self._config = config
        self._last: deque[Step] = deque(maxlen=LAST + 1)
        self._episode: deque[Step] = deque(maxlen=EPISODE_MAX)
        self._pending: str | None = None
        self._written: dict[str, float] = {}

    def add(
        self, trace: Trace, reward: float, done: bool, moments: list[_native.Moment]
    ) -> list[dict[str, str]]:
        """Records a step, with its moments for videos; returns the dumps that it completed."""
        finished = []
        self._last.append((trace, moments))
        if self._config["dump_full_episodes"]:
            self._episode.append((trace, moments))
        if self._pending is not None:
            finished += self._score_dump(self._pending)
            self._pending = None
        if reward and self._config["dump_scores"]:
            self._pending = "score" if reward > 0 else "lost_score"
        if done:
            if self._pending is not None:
                finished += self._score_dump(self._pending)
                self._pending = None
            if self._config["dump_full_episodes"]:
                finished.append(self._write("episode_done", list(self._episode)))
        return finished

    def write_dump(self, name: str) -> str | None:
        """Writes the last steps under a name; returns the path, or None.

        None if that was done before or nothing was played.
        """
        if name in self._written or not self._last:
            return None
        self._written[name] = time.monotonic()
        return self._write(name, list(self._last)[-LAST:])["dump"]

    def _score_dump(self, name: str) -> list[dict[str, str]]:
        now = time.monotonic()
        if name in self._written and now - self._written[name] < SCORE_PAUSE_S:
            return []
        self._written[name] = now
        return [self._write(name, list(self._last))]

    def _write(self, name: str, steps: list[Step]) -> dict[str, str]:
        folder = Path(self._config["tracesdir"])
        path = folder / f"{name}_{datetime.now():%Y%m%d-%H%M%S%f}.dump"
        config = self._config
        write_dump(path, config.get_dictionary(), [trace for trace, _ in steps])
        moments = [moment for _, moments in steps for moment in moments]
        if not moments:
            return {"name": name, "dump": str(path)}
        level = config["video_quality_level"]
        size = config["render_resolution_x"], config["render_resolution_y"]
        video = path.with_suffix(".mp4")
        # GRF's smallest videos are smaller than its pictures.
        write_moments(video, moments, SMALL if level == 0 else size, QUALITIES[level])
        return {"name": name, "dump": str(path), "video": str(video)}


def trace_of(
    chosen: list[CoreAction],
    step: int,
    reward: float,
    cumulative_reward: float,
    time_s: float,
    whole: dict[str, Any],
) -> Trace:
    """Returns the record of a step: every slot's action, in the pitch's frame, and the match."""
    return {
        "debug": {"action": chosen, "frame_cnt": step, "reward": reward, "time": time_s},
        "observation": whole,
        "reward": reward,
        "cumulative_reward": cumulative_reward,
    }


def write_dump(path: Path, config: dict[str, Any], traces: Iterable[Trace]) -> None:
    """Writes records, and the settings into the first; raises `FileError` if it can't."""
    records = BytesIO()
    for number, trace in enumerate(traces):
        debug = {**trace["debug"], "config": config} if number == 0 else trace["debug"]
        _Writer(records, PROTOCOL).dump({**trace, "debug": debug})
    write(path, records.getvalue())


def read_dump(path: str) -> list[Trace]:
    """Returns the records of a dump.

    Unpickling runs code from the file: only read dumps that you trust. Raises `FileError` if the
    file can't be read, `FormatError` if it isn't a dump.
    """
    records = []
    if Path(path).exists() and not Path(path).is_file():
        raise FileError(f"`{path}` is not a regular file", path=path, code="SP0017")
    try:
        with Path(path).open("rb") as file:
            while file.peek(1):
                records.append(_Reader(file).load())
    except OSError as error:
        raise FileError(f"`{path}` can't be read: {error.strerror}", path=path) from error
    except Exception as error:
        raise FormatError(f"`{path}` is not a dump, or truncated") from error
    if not records or not all(isinstance(each, dict) and "debug" in each for each in records):
        raise FormatError(f"`{path}` is not a dump, or truncated")
    return records
