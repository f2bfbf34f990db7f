"""Recorded episodes, played again from their files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece import _native
from setpiece._errors import ParameterError, ReplayError, SnapshotError
from setpiece._native import Scenario
from setpiece._options import check_path
from setpiece._record import write
from setpiece._rows import Picker
from setpiece._spaces import check_observation
from setpiece._video import read_form
from setpiece._vocabulary import Action
from setpiece._words import check_word

BAD_REPLAY = "SP0014"

FORMS = ("cdf", "csv")
"""The forms of `Replay.export`."""

Pressed = Action | NDArray[np.float32]
"""What an agent does in a step: a key, or the four numbers of continuous actions."""


@dataclass(frozen=True)
class Moment:
    """A moment of an episode: the start, or the result of a step. Keys are agents' ids."""

    step: int
    """Steps played so far, of 100 ms; 0 is the start."""
    observations: dict[str, Any]
    """What each agent sees now, in its own frame: it attacks towards +x."""
    actions: dict[str, Pressed]
    """Each agent's action in this step: an `Action`, or float32 `(4,)`. Empty at the start."""
    rewards: dict[str, float]
    """Each agent's reward for it; empty at the start."""
    events: list[dict[str, Any]]
    """What happened in it, as in `info["events"]`."""
    info: dict[str, Any]
    """The `info` of `FootballEnv.step`: `score` [left, right], at the end `outcome` too."""


class Replay:
    """A recorded episode; iterating plays it again, bit for bit, and yields its `Moment`s.

    They are the start, and the result of every step.

    - `path`: a file that `record=` or `save_replay` wrote.

    Raises `FileError` if the file can't be read, `ReplayError` if it isn't a replay, or is
    truncated, changed or of another version, `ParameterError` if `path` isn't a path.

    >>> import setpiece, tempfile
    >>> path = f"{tempfile.mkdtemp()}/three.pitchr"
    >>> env = setpiece.make("academy_corner")
    >>> _ = env.reset(seed=1)
    >>> for _ in range(3):
    ...     _ = env.step(setpiece.Action.HIGH_PASS)
    >>> env.save_replay(path)
    >>> replay = setpiece.Replay(path)
    >>> replay
    Replay(academy_corner, seed=1, index=0, length=3)
    >>> [moment.observations["left_0"]["steps_left"].item() for moment in replay]
    [400, 399, 398, 397]
    """

    path: Path
    scenario: Scenario
    """The scenario, with the parameters that it was played with."""
    seed: int
    index: int
    length: int
    """Steps."""
    digest: str
    """The digest of the last state, 16 hexadecimal digits, as in the last `info["setpiece"]`."""
    agents: tuple[_native.AgentInfo, ...]
    """The agents, opponents included, in order: `id` and `team` (0 left, 1 right)."""
    action_set: str
    """The smallest set with all actions used: `"default"`, `"v2"`, `"full"` or `"continuous"`."""
    snapshot: bytes | None
    """The snapshot that it began in; None if it began at the scenario's start."""

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = check_path("path", path)
        with self._named():
            self._recorded = _native.Replay(self.path)
            self.scenario = self._recorded.scenario()
            self.agents = tuple(self._recorded.environment("raw").agents)
        self.seed, self.index, self.length = (
            self._recorded.seed,
            self._recorded.index,
            self._recorded.length,
        )
        self.digest, self.action_set = self._recorded.digest, self._recorded.action_set
        self.snapshot = self._recorded.snapshot

    def __iter__(self) -> Iterator[Moment]:
        return self.moments()

    def __repr__(self) -> str:
        return f"Replay({self.scenario.name}, seed={self.seed}, index={self.index}, length={self.length})"

    @property
    def score(self) -> list[int]:
        """Goals of the left and the right team."""
        score: list[int] = self._end["score"]
        return score

    @property
    def outcome(self) -> str | None:
        """The name of the ending; None if the episode was saved before it ended."""
        return self._end.get("outcome")

    def moments(self, observation: str = "raw") -> Iterator[Moment]:
        """Plays the episode from its start and yields every moment, with observations of any kind.

        - `observation`: one of those of `setpiece.make`; `sticky_actions` of raw ones are those of
          `action_set`.

        Raises `ReplayError` if this build diverges from the recording, and `ScriptError` if a
        script fails.
        """
        kind = check_observation(observation)
        acts = self._recorded.acts
        with self._named():
            native = self._recorded.environment(kind)
            observed, info = native.reset(self.seed, self.index, {}, self.snapshot)
        self._compare(native, 0)
        yield self._moment(0, observed, [], [], info)
        for step in range(self.length):
            if not native.running:
                raise self._differs(step)
            now = acts[step * len(self.agents) : (step + 1) * len(self.agents)]
            observed, reward, _, _, info = native.replayed(self._recorded)
            self._compare(native, step + 1)
            yield self._moment(step + 1, observed, now, np.atleast_1d(reward).tolist(), info)

    def video(
        self,
        path: str | PathLike[str],
        *,
        size: tuple[int, int] | None = None,
        camera: str = "broadcast",
        speed: float = 1.0,
        quality: str = "medium",
    ) -> None:
        """Writes the episode as a video: an `.mp4` or a `.gif`.

        - `size`: width and height, even ones for an `.mp4`; None: 1280 x 720, or 640 x 360 at low
          quality.
        - `camera`: `"broadcast"` or `"above"`.
        - `speed`: how much faster than the match, 0.05..20.
        - `quality`: how much room an `.mp4` takes: `"low"`, `"medium"` or `"high"`.

        Raises `ParameterError` for something else, `FileError` if the file can't be written,
        `ReplayError` if this build diverges from the recording.
        """
        target, form = read_form(path, size, camera, speed, quality)
        with self._named():
            video = _native.replay_video(self._recorded, form)
        write(target, video)

    def export(self, folder: str | PathLike[str], form: str = "cdf") -> list[Path]:
        """Writes tracking and event data into a folder, and returns the paths of the files.

        - `folder`: is made if it isn't there.
        - `form`: `"cdf"`, Common Data Format: `meta.json`, `tracking.jsonl`, `event.jsonl`; or
          `"csv"`: `meta.json`, `tracking.csv`, `events.csv`. Both have `pitch.json`, and
          `setpiece.kloppy` reads both.

        Raises `ParameterError` for another form, `FileError` if the files can't be written,
        `ReplayError` if this build diverges from the recording.
        """
        target = check_path("folder", folder)
        check_word("form", form, FORMS)
        with self._named():
            return self._recorded.export(target, form)

    def _compare(self, native: _native.Environment, step: int) -> None:
        """Raises if the last state isn't the recorded one."""
        if step == self.length and native.digest != self.digest:
            raise self._differs(step)

    @cached_property
    def _end(self) -> dict[str, Any]:
        """The summary from the last step."""
        info: dict[str, Any] = {}
        for moment in self:
            info = moment.info
        return info

    def _moment(
        self,
        step: int,
        observed: Any,
        acts: list[_native.RecordedAct],
        rewards: list[float],
        info: dict[str, Any],
    ) -> Moment:
        ids = [agent.id for agent in self.agents]
        return Moment(
            step=step,
            observations={one: Picker(len(ids), at)(observed) for at, one in enumerate(ids)},
            actions={one: _pressed(act) for one, act in zip(ids, acts, strict=False)},
            rewards=dict(zip(ids, rewards, strict=False)),
            events=info.pop("events"),
            info=info,
        )

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Adds the file's name to errors about it."""
        try:
            yield
        except (ReplayError, SnapshotError, ParameterError) as error:
            raise ReplayError(
                f"`{self.path}`: {error.args[0]}", code=BAD_REPLAY, help=error.help
            ) from error

    def _differs(self, step: int) -> ReplayError:
        why = f"step {step}: this build diverges from the recording"
        return ReplayError(f"`{self.path}`: {why}", code=BAD_REPLAY)


def _pressed(act: _native.RecordedAct) -> Pressed:
    """An agent's action in a step, in the form that `FootballEnv.step` takes."""
    number, steer = act.action, act.steer
    if steer is None:
        return Action(number)
    # The middle of the part of -1..1 that means this key.
    kind = (2 * _native.KINDS.index(Action(number).name.lower()) + 1) / len(_native.KINDS) - 1
    return np.array([steer.x, steer.y, kind, steer.power], np.float32)
