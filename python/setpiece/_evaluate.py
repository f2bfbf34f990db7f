"""A policy on a suite or a scenario, as a table."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING

from setpiece._env_options import EvaluateArguments
from setpiece._errors import CompileError, ParameterError
from setpiece._levels import is_plan
from setpiece._native import Scenario
from setpiece._opponents import Opponent
from setpiece._options import ParamValue
from setpiece._source import Source, level_of, load
from setpiece._suite import Suite, SuiteTable, suite, suites

if TYPE_CHECKING:
    from typing_extensions import Unpack

EPISODES = 20
"""So many episodes of a scenario are played, as by `setpiece run`."""


def evaluate(
    policy: Opponent,
    what: Suite | Source,
    name: str | None = None,
    *,
    episodes: int | None = None,
    seed: int | None = None,
    params: Mapping[str, ParamValue] | None = None,
    allow_outside: bool = False,
    **arguments: Unpack[EvaluateArguments],
) -> SuiteTable:
    """Plays a policy on a suite or a scenario; returns a table with 95 % intervals.

    - `policy`: plays all agents: see `Suite.evaluate`.
    - `what`: a `Suite`, the name of one in the library, or any form of a scenario; a text or the
      path of a `.pitch` file may have suites, scenarios or both. Its scenario is played unless
      `name` says otherwise, as by `setpiece run`.
    - `name`: which suite or scenario of a file or a text.
    - `episodes`, `seed`, `params`: of a scenario: how many episodes (20), the seed of the first
      (0), and its parameters. The entries of a suite have their own.
    - `allow_outside`: as in `setpiece.load`.
    - `arguments`: those of `Suite.evaluate`: `threads`, `observation`, `stack`, `size`, `scale`,
      `rewards`.

    A ready-made agent has exactly the figures of `setpiece run`. Raises what `setpiece.load`,
    `setpiece.suite` and `Suite.evaluate` do, and `ParameterError` for a level, which is one
    episode.

    >>> import setpiece
    >>> table = setpiece.evaluate("run_and_shoot", "academy_empty_goal_close", episodes=50)
    >>> table.rows[0].episodes, table.rows[0].mean_score.value
    (50, 0.96)
    """
    own = _read(what, name, allow_outside)
    if isinstance(own, Scenario):
        own = Suite.over(
            own,
            [params or {}],
            episodes=EPISODES if episodes is None else episodes,
            seed=0 if seed is None else seed,
        )
    else:
        given = {"episodes": episodes, "seed": seed, "params": params}
        foreign = next((option for option, value in given.items() if value is not None), None)
        if foreign is not None:
            raise ParameterError(
                f"`{foreign}` has no effect on a suite: its entries say what is played",
                name=foreign,
                help="leave it out, or evaluate on a scenario",
            )
    return own.evaluate(policy, **arguments)


def _read(what: Suite | Source, name: str | None, allow_outside: bool) -> Suite | Scenario:
    """The scenario that is meant, otherwise the suite."""
    if isinstance(what, Suite):
        return what
    if isinstance(what, str) and what in suites():
        return suite(what, name)
    if level_of(what) is not None:
        raise ParameterError(
            f"a level is one episode, not a table: `{what}`",
            name="what",
            help="give its scenario, or play it by `setpiece.make`",
        )
    try:
        return load(what, name, allow_outside=allow_outside)
    except CompileError as no_scenario:
        if not isinstance(what, str | PathLike) or not is_plan(what):
            raise
        try:
            return suite(what, name, allow_outside=allow_outside)
        except ParameterError:
            raise no_scenario from None
        except CompileError as wrong:
            # A text with suites needs no scenario: something else is wrong.
            raise wrong from None
