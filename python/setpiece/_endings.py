"""How episodes of a vector have ended: a single environment's last `info`, as columns."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._native import Batch
from setpiece._rows import Picker, pick_info

Column = NDArray[Any]


def endings(batch: Batch, over: NDArray[np.bool_], pick: Picker, n_actions: int) -> dict[str, Any]:
    """Returns `outcome`, `records` and `setpiece` of the environments that are `over`.

    They have the same content as in the environments' `infos`. `pick` takes the caller's part of
    what depends on the agent. A column has a row for every environment; rows of running ones are
    None, NaN in a record of numbers, or 0.
    """
    n_envs, terms = len(over), batch.terms
    outcomes = np.full(n_envs, None, dtype=object)
    records: dict[str, Column] = {}
    returns: dict[str, Column] = {}
    summaries: dict[str, Column] = {}
    for at in np.flatnonzero(over).tolist():
        summary = batch.summary(at)
        if summary is None:
            continue
        outcomes[at] = summary.pop("outcome")
        paid = np.array(summary["return"], np.float64).reshape(pick.n_agents, len(terms)).T
        summary["return"] = dict(
            zip(terms, paid[:, 0] if pick.n_agents == 1 else paid, strict=True)
        )
        info = pick_info(
            {"records": summary.pop("records"), "setpiece": summary}, pick, pick.n_agents, n_actions
        )
        _enter(records, at, info["records"], lambda _, value: _of_record(n_envs, value))
        _enter(
            returns,
            at,
            info["setpiece"].pop("return"),
            lambda _, value: np.zeros((n_envs, *np.shape(value))),
        )
        _enter(
            summaries, at, info["setpiece"], lambda name, value: _of_summary(n_envs, name, value)
        )
    return {"outcome": outcomes, "records": records, "setpiece": {"return": returns, **summaries}}


def _enter(
    columns: dict[str, Column],
    at: int,
    values: Mapping[str, Any],
    fresh: Callable[[str, Any], Column],
) -> None:
    """Writes an environment's row; a column is created for the first value in it."""
    for name, value in values.items():
        if name not in columns:
            columns[name] = fresh(name, value)
        # NumPy converts None to NaN.
        columns[name][at] = value


def _of_record(n_envs: int, value: Any) -> Column:
    if value is None or isinstance(value, float):
        return np.full(n_envs, np.nan)
    return np.full(n_envs, None, dtype=object)


def _of_summary(n_envs: int, name: str, value: Any) -> Column:
    if isinstance(value, str):
        return np.full(n_envs, None, dtype=object)
    return np.zeros(n_envs, np.uint64 if name in ("seed", "index") else np.array(value).dtype)
