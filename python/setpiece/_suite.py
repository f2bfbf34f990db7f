"""Suites: frozen episodes on which agents and policies are compared."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from io import StringIO
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np

from setpiece import _native
from setpiece._callbacks import Rewards, refuse_functions
from setpiece._crowd import Crowd
from setpiece._env_options import EnvOptions
from setpiece._errors import ParameterError
from setpiece._levels import LevelSource, ListedLevels, place_of
from setpiece._native import ACTION_SETS, AGENTS, EPISODES_MAX
from setpiece._opponents import SIDES, Opponent, Table, is_onnx, is_word, policy_of
from setpiece._optional import need
from setpiece._options import (
    ParamValue,
    check_count,
    check_flag,
    check_number,
    check_params,
    check_threads,
)
from setpiece._source import Source, load
from setpiece._turn import one_thread
from setpiece._words import check_word

ENVS = 64
"""So many episodes are played at once."""


@dataclass(frozen=True)
class Estimate:
    """A measured value with the ends of its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class SuiteRow:
    """How a policy did in an entry of a suite.

    - `entry`: the scenario, and the parameters that differ from their defaults.
    - `success_rate`: with Wilson's interval, as a `mean_score` of nothing but 0 and 1; the other
      means have those of a bootstrap.
    - `mean_score`: goals of the left team less those of the right.
    - `mean_return`: of an agent. `mean_length_s`: seconds.
    - `digest`: the fingerprint of all episodes' final states.
    """

    entry: str
    episodes: int
    seed: int
    success_rate: Estimate
    mean_score: Estimate
    mean_return: Estimate
    mean_length_s: Estimate
    digest: str


MEASURES = ("success_rate", "mean_score", "mean_return", "mean_length_s")


@dataclass(frozen=True)
class SuiteTable:
    """How a policy did in a suite; printed, it is the table of `setpiece run SUITE`."""

    suite: str
    policy: str
    rows: tuple[SuiteRow, ...]
    text: str = field(repr=False)

    def __str__(self) -> str:
        """Returns the table as text."""
        return self.text

    def to_dicts(self) -> list[dict[str, Any]]:
        """Returns a dict per entry; the ends of the intervals are `…_low` and `…_high`."""
        rows = []
        for row in self.rows:
            line: dict[str, Any] = {
                "entry": row.entry,
                "policy": self.policy,
                "episodes": row.episodes,
                "seed": row.seed,
            }
            for name in MEASURES:
                measured: Estimate = getattr(row, name)
                line[name] = measured.value
                line[f"{name}_low"], line[f"{name}_high"] = measured.low, measured.high
            rows.append({**line, "digest": row.digest})
        return rows

    def to_csv(self) -> str:
        """Returns the rows of `to_dicts` as CSV, under a line of their names."""
        rows, text = self.to_dicts(), StringIO()
        writer = csv.DictWriter(text, [*rows[0]] if rows else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
        return text.getvalue()

    def to_pandas(self) -> Any:
        """Returns the rows of `to_dicts` as a `DataFrame`.

        Raises `MissingPackageError` without pandas.
        """
        return need("pandas", "pandas", "`to_pandas`").DataFrame(self.to_dicts())


@dataclass(frozen=True)
class SuiteEntry:
    """The first episodes of a scenario under a seed."""

    entry: str
    episodes: int
    seed: int


class Suite:
    """A suite of the language; `setpiece.suite` loads one."""

    def __init__(self, native: _native.Suite) -> None:
        self._native = native

    @classmethod
    def over(
        cls,
        scenario: Source,
        params: Sequence[Mapping[str, ParamValue]],
        *,
        episodes: int = 1,
        seed: int = 0,
    ) -> Suite:
        """Makes a suite of a scenario: an entry for each of some parameters.

        Raises `ParameterError` for parameters that the scenario doesn't allow.

        >>> import setpiece
        >>> setpiece.Suite.over("academy_corner", [{"difficulty": 0.1}, {"difficulty": 0.9}])
        Suite(academy_corner: 2 entries)
        """
        if isinstance(params, Mapping) or not isinstance(params, Sequence):
            raise ParameterError(
                f"expected a list of parameters, found `{params!r}`", name="params"
            )
        each = [check_params(one) or {} for one in params]
        count = check_count("episodes", episodes, EPISODES_MAX)
        native = _native.Suite.over(load(scenario), each, count, check_number("seed", seed))
        return cls(native)

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def doc(self) -> str:
        """The documentation above it."""
        return self._native.doc

    @property
    def entries(self) -> tuple[SuiteEntry, ...]:
        """What is played, every `each` written out."""
        return tuple(SuiteEntry(*entry) for entry in self._native.entries)

    @property
    def levels(self) -> LevelSource:
        """Its levels, again and again: `levels` of `setpiece.make_vec`."""
        return ListedLevels(self._native.listed())

    def __repr__(self) -> str:
        """Returns the name and the number of entries."""
        return f"Suite({self.name}: {len(self._native.entries)} entries)"

    def evaluate(
        self,
        policy: Opponent,
        *,
        threads: int | None = None,
        observation: str = "simple115v2",
        stack: int = 1,
        size: tuple[int, int] = (96, 72),
        scale: bool = False,
        rewards: Rewards = None,
    ) -> SuiteTable:
        """Plays every episode of the suite and returns how the policy did.

        - `policy`: plays all agents, those of the right side too. An agent of the command
          (`"bot"`, `"random"`, `"run_and_shoot"`, `"idle"`, `"baseline"`), the path of an `.onnx` file, a
          function of one observation, a `Policy`, or an object with the `predict` of
          Stable-Baselines3. Actions are those of `opponents`: 0..19.
        - `threads`: None: one per core. Results don't depend on it.
        - `observation`, `stack`, `size`, `scale`: what a policy sees that names no observation of
          its own, as in `setpiece.make_vec`.
        - `rewards`: names of rewards that are paid instead of the scenarios' own.

        Many episodes are played at once: a batched policy sees a row for each agent of each of
        them, also where an episode has ended and the others go on.

        Raises `ParameterError`, `OpponentError` if the policy fails, `DrawError` and `ScriptError`
        for an episode that can't be played.

        >>> import setpiece
        >>> suite = setpiece.suite("suite s { academy_empty_goal_close for 20 episodes }")
        >>> suite.evaluate("run_and_shoot").rows[0].success_rate.value
        0.95
        """
        options = EnvOptions.read(
            {
                "observation": observation,
                "stack": stack,
                "size": size,
                "scale": scale,
                "rewards": rewards,
                "action_set": "v2",
            }
        )
        refuse_functions(options.reward_functions)
        name, play = self._player(policy, options, threads)
        rows = [play(at) for at in range(len(self._native.entries))]
        text = _native.suite_text(rows)
        return SuiteTable(self.name, name, tuple(_row(row) for row in rows), text)

    def _player(
        self, policy: Opponent, options: EnvOptions, threads: int | None
    ) -> tuple[str, Callable[[int], _native.SuiteRow]]:
        """The name of a policy, and what plays an entry with it."""
        if isinstance(policy, str) and not is_onnx(policy) and not policy.endswith(".rhai"):
            name = check_word("agent", policy, AGENTS)
            n_threads = check_threads(threads, 1_024)
            # Reported before anything is played.
            self._native.check(name, options.reward_names)
            return name, lambda at: self._native.play(at, name, options.reward_names, n_threads)
        if is_word(policy):
            raise ParameterError(
                f"a script plays players, not agents: {fspath(policy)!r}",
                name="policy",
                help='write `ai: script "FILE.rhai"` in a scenario',
            )
        policy_of("policy", policy, "policy")
        name = Path(policy).name if is_onnx(policy) else "policy"
        return name, lambda at: self._played(at, name, policy, options, threads)

    def _played(
        self, at: int, name: str, policy: Opponent, options: EnvOptions, threads: int | None
    ) -> _native.SuiteRow:
        levels = self._native.levels(at)
        n = min(ENVS, levels.n_unfinished)
        scenario = self._native.scenario(at)
        batch = _native.Batch(
            scenario,
            n,
            options,
            threads=check_threads(threads, n),
            next_step=True,
            levels=levels,
        )
        agents = batch.agents
        sides: dict[str, Opponent] = {SIDES[agent.team]: policy for agent in agents}
        table = Table(agents, sides, ACTION_SETS["v2"], scenario, "policy")
        crowd = Crowd(table, n)
        for kind in table.observations:
            batch.look(*kind)
        arrays, none = batch.arrays(), [None] * n
        nobody = np.zeros((n, 0), np.int64)
        with one_thread:
            batch.reset(arrays, [True] * n, none, none, False)
        while levels.n_unfinished:
            actions = crowd.actions(
                nobody, arrays.observations, batch.look, arrays.masks, batch.steps
            )
            with one_thread:
                batch.step(arrays, actions)
        return self._native.row(at, name, levels)


def suite(
    source: str | PathLike[str], name: str | None = None, *, allow_outside: bool = False
) -> Suite:
    """Loads a suite of the language.

    - `source`: the name of a suite in the library, the path of a `.pitch` file, or a text.
    - `name`: which of several in a file or a text.
    - `allow_outside`: as in `setpiece.load`.

    Raises `ParameterError` if there is no such suite, `FileError` or `CompileError`.

    >>> import setpiece
    >>> setpiece.suite("academy")
    Suite(academy: 11 entries)
    """
    outside = check_flag("allow_outside", allow_outside)
    return Suite(_native.Suite(*place_of(source, name), outside))


def suites() -> list[str]:
    """Returns the names of the library's suites; `setpiece list` shows them too.

    >>> import setpiece
    >>> "academy" in setpiece.suites()
    True
    """
    return [name for name, *_ in _native.library_suites()]


def _row(row: _native.SuiteRow) -> SuiteRow:
    success, score, paid, length = (Estimate(*numbers) for numbers in row.measured)
    return SuiteRow(
        row.entry, row.episodes, row.seed, success, score, paid, length, digest=row.digest
    )
