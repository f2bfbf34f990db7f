"""Recording episodes as files that can be played again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import count
from os import PathLike
from pathlib import Path
from typing import Literal

import numpy as np

from setpiece import _native
from setpiece._errors import FileError, ParameterError, ReplayError
from setpiece._options import check_path
from setpiece._video import QUALITIES, read_form
from setpiece._words import check_word

When = Literal["always", "goal"] | int
"""Which episodes are recorded: all, those with a goal, or each n-th."""


def read_record(
    folder: str | PathLike[str] | None, when: When, quality: str | None = None
) -> Record | None:
    """Returns where episodes are recorded, if they are."""
    if folder is not None:
        return Record(folder, when, quality)
    if quality is not None:
        raise ParameterError(
            f"`record_quality={quality!r}` needs a folder: `record=…`", name="record_quality"
        )
    if when != "always":
        raise ParameterError(
            f"`record_when={when!r}` needs a folder: `record=…`", name="record_when"
        )
    return None


class Record:
    """A folder, and which episodes are written to it."""

    video: str | None = None
    """The last episode's video, if one was written."""

    def __init__(self, folder: str | PathLike[str], when: When, quality: str | None = None) -> None:
        self.quality = None if quality is None else check_word("quality", quality, QUALITIES)
        every = isinstance(when, int | np.integer) and not isinstance(when, bool) and when >= 1
        if not every and when not in ("always", "goal"):
            raise ParameterError(
                f"`record_when` is {when!r}; it can be 'always', 'goal' or a count",
                name="record_when",
            )
        self._folder, self._when = check_path("record", folder), when
        # Now, so that an unwritable folder is reported before an episode is played.
        make_folder(self._folder)
        self._ended = 0
        self._failed = False

    def end(self, native: _native.Environment, name: str, score: Sequence[int]) -> str | None:
        """Writes the episode that has just ended, if it is to be recorded; returns its path.

        An episode that was restored has no beginning to replay, so it is never recorded. Raises
        `FileError` for the first one that can't be written (a full disk), and records no more; play
        continues.
        """
        wanted, self.video = self._wants(score), None
        self._ended += 1
        episode = native.episode
        if not wanted or self._failed or episode is None:
            return None
        seed, index = episode.seed, episode.index
        try:
            replay = native.replay()
        except ReplayError:
            return None
        try:
            path = _write_beside(self._folder, f"{name}_{seed}_{index}", replay)
            if self.quality is not None:
                target, form = read_form(
                    path.with_suffix(".mp4"), None, "broadcast", 1.0, self.quality
                )
                _native.write(target, _native.replay_video(_native.Replay(path), form))
                self.video = str(target)
            return str(path)
        except FileError as error:
            self._failed = True
            raise FileError(
                error.args[0],
                path=error.path,
                code=error.code,
                help="no further episode of this environment is recorded; `reset` plays on",
            ) from None

    def _wants(self, score: Sequence[int]) -> bool:
        if self._when == "goal":
            return any(score)
        return self._when == "always" or self._ended % int(self._when) == 0


def write(path: Path, replay: bytes) -> None:
    """Writes a replay and creates its folders; raises `FileError` if it can't."""
    make_folder(path.parent)
    _native.write(path, replay)


def make_folder(folder: Path) -> None:
    """Creates a folder and its parents if they don't exist; raises `FileError` if it can't."""
    with _writing(folder):
        folder.mkdir(parents=True, exist_ok=True)


def _write_beside(folder: Path, stem: str, replay: bytes) -> Path:
    """Writes a replay; appends a number to its name if that is taken. Returns the path."""
    free = folder / f"{stem}.pitchr"
    if free.parent != folder:
        # No scenario has a name that leads out of the folder, but a caller could pass one.
        raise FileError(f"`{free}` doesn't lie in `{folder}`", path=str(free))
    make_folder(folder)
    for number in count(2):
        # The creator of the file owns the name; other threads and processes may write there too.
        if _native.write_new(free, replay):
            break
        free = folder / f"{stem}_{number}.pitchr"
    return free


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    """Raises `FileError` if something can't be written."""
    try:
        yield
    except OSError as error:
        raise FileError(f"`{path}` can't be written: {error.strerror}", path=str(path)) from None
