"""Recording episodes as files that play them again."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from os import PathLike
from pathlib import Path
from typing import Literal

import numpy as np

from setpiece import _native
from setpiece._errors import FileError, ParameterError, ReplayError

When = Literal["always", "goal"] | int
"""Which episodes are recorded: all, those with a goal, or each n-th."""


def read_record(folder: str | PathLike[str] | None, when: When) -> Record | None:
    """Returns where episodes are recorded, if they are."""
    if folder is not None:
        return Record(folder, when)
    if when != "always":
        raise ParameterError(f"`record_when={when!r}` needs a folder: `record=…`", name="record_when")
    return None


class Record:
    """A folder, and which episodes are written there."""

    def __init__(self, folder: str | PathLike[str], when: When) -> None:
        every = isinstance(when, int | np.integer) and not isinstance(when, bool) and when >= 1
        if not every and when not in ("always", "goal"):
            raise ParameterError(
                f"`record_when` is {when!r}; it can be 'always', 'goal' or a count", name="record_when"
            )
        if not isinstance(folder, str | PathLike):
            raise ParameterError(f"expected a folder as `record`, found `{folder!r}`", name="record")
        self._folder, self._when = Path(folder), when
        # Now, not when an episode has been played that can't be written.
        make_folder(self._folder)
        self._ended = 0

    def end(self, native: _native.Environment, name: str, score: Sequence[int]) -> str | None:
        """Writes the episode that has just ended, if it is one of those; returns where.

        One that was restored in its middle has no beginning to be played from: it is none of them.
        """
        wanted = self._wants(score)
        self._ended += 1
        if not wanted or native.episode is None:
            return None
        seed, index = native.episode
        path = _free(self._folder / f"{name}_{seed}_{index}.pitchr")
        try:
            replay = native.replay()
        except ReplayError:
            return None
        write(path, replay)
        return str(path)

    def _wants(self, score: Sequence[int]) -> bool:
        if self._when == "goal":
            return any(score)
        return self._when == "always" or self._ended % int(self._when) == 0


def _free(path: Path) -> Path:
    """The path, or with a number behind its name where an episode of the same draw lies there already."""
    names = (path.with_stem(f"{path.stem}_{number}") for number in count(2))
    return next((other for other in names if not other.exists()), path) if path.exists() else path


def write(path: Path, replay: bytes) -> None:
    """Writes a replay and the folders it lies in."""
    make_folder(path.parent)
    try:
        path.write_bytes(replay)
    except OSError as error:
        raise FileError(f"`{path}` can't be written: {error.strerror}", path=str(path)) from None


def make_folder(folder: Path) -> None:
    """Makes a folder and those it lies in, where they aren't there; `FileError` where it can't."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"`{folder}` can't be written: {error.strerror}", path=str(folder)) from None
