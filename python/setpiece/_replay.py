"""Recorded episodes, played again from their files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece import _native
from setpiece._errors import FileError, ReplayError, SetpieceError, SnapshotError
from setpiece._native import Scenario, load
from setpiece._replay_file import FILE_MAX, DamagedError, Recorded, read
from setpiece._rows import Picker
from setpiece._spaces import check_observation
from setpiece._steering import numbers_of
from setpiece._vocabulary import Action

BAD_REPLAY = "SP0014"
FILE_MISSING = "SP0001"

Pressed = Action | NDArray[np.float32]
"""What an agent does in a step: a key, or the four numbers of continuous actions."""


@dataclass(frozen=True)
class Moment:
    """A moment of an episode: the start, or what a step came to. What is told of agents stands under their ids."""

    step: int
    """Steps played so far, of 100 ms; 0 is the start."""
    observations: dict[str, Any]
    """What each agent sees now, in its own frame: it attacks towards +x."""
    actions: dict[str, Pressed]
    """What each agent did in this step: an `Action`, or float32 `(4,)` of continuous ones. Empty at the start."""
    rewards: dict[str, float]
    """What each agent was paid for it; empty at the start."""
    events: list[dict[str, Any]]
    """What happened in it: as `info["events"]`."""
    info: dict[str, Any]
    """What `FootballEnv.step` told: `score` [left, right], at the end `outcome` too."""


class Replay:
    """A recorded episode; iterating plays it again, bit for bit, and gives the `Moment` of the start and of every step.

    - `path`: a file that `record=` or `save_replay` wrote.

    Raises `FileError` where the file can't be read, `ReplayError` where it is no replay, or one that is cut off,
    changed or of another version.

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
    """The fingerprint of the last state, 16 hexadecimal digits: that of the last `info["setpiece"]`."""
    agents: tuple[_native.AgentInfo, ...]
    """Who acted, opponents too, in order: `id` and `team` (0 left, 1 right)."""

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = Path(fspath(path))
        self._recorded = self._read()
        self.seed, self.index, self.length = self._recorded.seed, self._recorded.index, self._recorded.length
        self.digest = f"{self._recorded.digest:016x}"
        self.scenario = self._scenario()
        try:
            self.agents = tuple(self._environment("raw").agents)
        except ReplayError:
            raise
        except SetpieceError as error:
            raise self._error("it is damaged: nobody can have played it so") from error
        noted = self.length * len(self.agents)
        if len(self._recorded.actions) != noted or len(self._recorded.steers) not in (0, noted):
            raise self._error("it is damaged: it has not one action for each agent and step")

    def __iter__(self) -> Iterator[Moment]:
        return self.moments()

    def __repr__(self) -> str:
        return f"Replay({self.scenario.name}, seed={self.seed}, index={self.index}, length={self.length})"

    @property
    def snapshot(self) -> bytes | None:
        """The snapshot that it began in; None where it began as its scenario does."""
        return self._recorded.start

    @property
    def score(self) -> list[int]:
        """Goals of the left and the right team."""
        score: list[int] = self._end["score"]
        return score

    @property
    def outcome(self) -> str | None:
        """The name of the ending; None where the episode was written down before it ended."""
        return self._end.get("outcome")

    @property
    def action_set(self) -> str:
        """The smallest set that has all that was pressed: `"default"`, `"v2"` or `"full"`; or `"continuous"`."""
        if self._recorded.steers:
            return "continuous"
        most = max(self._recorded.actions, default=0)
        for name, size in _native.ACTION_SETS.items():
            if most < size:
                return name
        raise self._error(f"it is damaged: no action has the number {most}")

    def moments(self, observation: str = "raw") -> Iterator[Moment]:
        """Plays the episode from its start and gives every moment of it, with observations of any kind.

        - `observation`: one of those of `setpiece.make`; `sticky_actions` of raw ones are those of `action_set`.

        Raises `ReplayError` where this build comes to another end, and `ScriptError` where a script fails.
        """
        native = self._environment(check_observation(observation))
        try:
            observed, info = native.reset(self.seed, self.index, {}, self._recorded.start)
        except SnapshotError as error:
            raise self._error("the snapshot that it began in can't be read") from error
        self._compare(native, 0)
        yield self._moment(0, observed, [], [], info)
        for step in range(self.length):
            if not native.running:
                raise self._differs(step)
            actions = self._actions(step)
            observed, reward, _, _, info = native.step(np.asarray(actions))
            self._compare(native, step + 1)
            yield self._moment(step + 1, observed, actions, np.atleast_1d(reward).tolist(), info)

    def _compare(self, native: _native.Environment, step: int) -> None:
        """Raises where the last state is not the one that was recorded: a replay of this one tells its fingerprint."""
        if step == self.length and read(native.replay()).digest != self._recorded.digest:
            raise self._differs(step)

    @cached_property
    def _end(self) -> dict[str, Any]:
        """What the last step told."""
        info: dict[str, Any] = {}
        for moment in self:
            info = moment.info
        return info

    def _actions(self, step: int) -> list[Pressed]:
        """What every agent did in a step, as `FootballEnv.step` takes it."""
        now = slice(step * len(self.agents), (step + 1) * len(self.agents))
        try:
            keys = [Action(number) for number in self._recorded.actions[now]]
            if not self._recorded.steers:
                return [*keys]
            return [numbers_of(key, steer) for key, steer in zip(keys, self._recorded.steers[now], strict=True)]
        except (TypeError, ValueError) as error:
            raise self._error(f"step {step}: what the agents did can't be read: {error}") from error

    def _moment(
        self, step: int, observed: Any, actions: list[Pressed], rewards: list[float], info: dict[str, Any]
    ) -> Moment:
        ids = [agent.id for agent in self.agents]
        return Moment(
            step=step,
            observations={one: Picker(len(ids), at)(observed) for at, one in enumerate(ids)},
            actions=dict(zip(ids, actions, strict=False)),
            rewards=dict(zip(ids, rewards, strict=False)),
            events=info.pop("events"),
            info=info,
        )

    def _read(self) -> Recorded:
        try:
            if self.path.stat().st_size > FILE_MAX:
                raise self._error(f"it is larger than {FILE_MAX >> 20} MiB")
            return read(self.path.read_bytes())
        except OSError as error:
            raise FileError(
                f"`{self.path}` can't be read: {error.strerror}", path=str(self.path), code=FILE_MISSING
            ) from None
        except DamagedError as error:
            raise self._error(str(error)) from None

    def _scenario(self) -> Scenario:
        """The scenario in it, bound to the values in it."""
        try:
            # The native module reads compiled scenarios from files alone.
            with TemporaryDirectory() as folder:
                file = Path(folder, "scenario.pitchc")
                file.write_bytes(self._recorded.scenario)
                scenario = load(file)
            values = zip(scenario.params.values(), self._recorded.params, strict=True)
            return scenario.with_params(**{param.name: _value(param, value) for param, value in values})
        except (SetpieceError, ValueError, IndexError) as error:
            raise self._error("this build can't read the scenario in it") from error

    def _environment(self, observation: str) -> _native.Environment:
        recorded = self._recorded
        return _native.Environment(
            self.scenario,
            observation=observation,
            rewards=recorded.rewards,
            events=True,
            copy=True,
            action_set=self.action_set,
            bot_action=False,
            stack=1,
            size=(96, 72),
            left=recorded.left,
            right=recorded.right,
            switching=recorded.switching,
        )

    def _differs(self, step: int) -> ReplayError:
        return self._error(f"step {step}: this build plays the episode otherwise than the one that wrote it")

    def _error(self, why: str) -> ReplayError:
        return ReplayError(f"`{self.path}`: {why}", code=BAD_REPLAY)


def _value(param: _native.Param, value: float) -> bool | int | float | str:
    """A parameter's value as `with_params` takes it, from the number that the engine keeps for it."""
    if param.type == "bool":
        return value != 0.0
    if param.type == "int":
        return int(value)
    if param.type == "team":
        return ("left", "right", "none")[int(value)]
    if param.type == "string":
        return str(param.choices[int(value)])
    return value
