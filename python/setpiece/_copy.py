"""Copies and pickles of an environment: its arguments, and a snapshot of its episode."""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Any

from setpiece._callbacks import copied, rewards_of

if TYPE_CHECKING:
    from setpiece._environment import FootballEnv


def reduced(env: FootballEnv) -> tuple[Any, ...]:
    """Returns what makes a copy, and what it is called with: see `object.__reduce__`."""
    kwargs = {
        **env._options,
        "scenario": env.scenario,
        "events": env._events,
        "seed": env._first_seed,
        "render_mode": env.render_mode,
        "opponents": env._opponents,
    }
    tally = None
    if env._callbacks is not None:
        kwargs["rewards"] = rewards_of(kwargs["rewards"], env._callbacks.rewards.values())
        kwargs["ends"] = env._callbacks.ends
        tally = env._callbacks.tally
    snapshot = None if env._native.episode is None else (env.snapshot(), env._native.frames())
    # A stack of frames can't be told from the state.
    seen = None if env._table is None else env._table.seen
    attributes = {
        "spec": env.spec,
        "_np_random": env._np_random,
        "_np_random_seed": env._np_random_seed,
        "_playing": env._playing,
        "_same_agents": env._same_agents,
        "_scripted": env._scripted,
    }
    return revived, (kwargs, snapshot, tally, seen, attributes, env._turn.closed)


def copy_of(env: FootballEnv, memo: dict[int, Any]) -> FootballEnv:
    """Returns a copy that shares the opponents; raises `CallbackError` for a function that can't be copied."""
    kwargs, snapshot, tally, seen, attributes, closed = reduced(env)[1]
    for name in ("rewards", "ends"):
        if name in kwargs:
            kwargs[name] = copied(kwargs[name], memo)
    attributes["_np_random"] = deepcopy(attributes["_np_random"], memo)
    return revived(kwargs, snapshot, deepcopy(tally, memo), deepcopy(seen, memo), attributes, closed)


def revived(
    kwargs: dict[str, Any],
    snapshot: tuple[bytes, bytes] | None,
    tally: dict[str, Any] | None,
    seen: Any,
    attributes: dict[str, Any],
    closed: bool,
) -> FootballEnv:
    """Returns the environment of a copy or pickle."""
    from setpiece._environment import FootballEnv

    env = FootballEnv(**kwargs)
    if snapshot is not None:
        env.restore(snapshot[0])
        env._native.set_frames(snapshot[1])
    if env._table is not None:
        env._table.seen = seen
    if env._callbacks is not None and tally is not None:
        env._callbacks.tally = tally
    for name, value in attributes.items():
        setattr(env, name, value)
    env._turn.closed = closed
    return env
