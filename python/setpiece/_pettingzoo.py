"""PettingZoo: multi-agent environments, and their names in its registry."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING, Any

from setpiece import _library
from setpiece._callbacks import Ends, Rewards
from setpiece._environment import FootballEnv
from setpiece._errors import MissingPackageError
from setpiece._opponents import Opponent
from setpiece._optional import need
from setpiece._options import ParamValue
from setpiece._record import When, read_record
from setpiece._seats import Seats
from setpiece._source import Source

if TYPE_CHECKING:
    from setpiece._parallel import ParallelFootballEnv


def parallel_env(
    scenario: Source,
    *,
    left: Seats = None,
    right: Seats = None,
    opponents: Mapping[str, Opponent] | None = None,
    observation: str = "simple115v2",
    rewards: Rewards = None,
    ends: Ends = None,
    params: Mapping[str, ParamValue] | None = None,
    seed: int | None = None,
    events: bool = False,
    render_mode: str | None = None,
    render_size: tuple[int, int] = (1280, 720),
    camera: str = "broadcast",
    action_set: str = "default",
    bot_action: bool = False,
    stack: int = 1,
    size: tuple[int, int] = (96, 72),
    scale: bool = False,
    max_cycles: int | None = None,
    record: str | PathLike[str] | None = None,
    record_when: When = "always",
    record_quality: str | None = None,
    allow_outside: bool = False,
) -> ParallelFootballEnv:
    """Makes a PettingZoo `ParallelEnv` of a scenario, in which every agent keeps its player.

    The arguments are those of `setpiece.make`, except `switching` (nobody changes players), `copy`,
    `watch` and `on_reload`. In addition, `max_cycles` truncates every agent after this many steps
    if the scenario hasn't ended before; None leaves it to the scenario.

    - Agents have the names of their players (`anna`, `left_CM_1`) and keep them; each side may have
      any number. Every agent sees itself attacking towards +x. Observations, actions 0..18 and
      spaces are those of one agent of `FootballEnv`, rewards are floats.
    - Rewards in Python are called for each agent. An ending in Python is called once per step, with
      the step of the first agent of `possible_agents`, and ends the episode for all.
    - `info` of an agent: its `action_mask` (int8 `(19,)`), `reward_terms`, `return` and
      `bot_action`; `score` [left, right] and `events` are everyone's.
    - A replay is recorded (`record`, `record_when`) when `agents` becomes empty, also after
      `max_cycles`; the last `info["setpiece"]` of the remaining agents has `replay`.
    - An agent whose player is sent off is terminated and leaves `agents` for the rest of the
      episode; the others play on. When the scenario ends, all terminate; at its limit all are
      truncated; then `agents` is empty.
    - `state()`: float32, one view of the whole match in the world's frame, in which left attacks
      towards +x. For every player, the left team's first in source order: x, y, dx, dy (as in raw
      observations), tiredness, booked, on the pitch, has the ball (8 numbers); then the ball: x, y,
      z, dx, dy, dz, spin x, y, z; one-hot game mode (7); score left, right; steps left / 1000 (0
      without a limit). Its space is `state_space`.

    Raises what `setpiece.make` does, and `MissingPackageError` without the package `pettingzoo`.

    >>> import setpiece
    >>> env = setpiece.parallel_env("academy_3_vs_1_with_keeper", left=3, right="all")
    >>> observations, infos = env.reset(seed=1)
    >>> env.agents
    ['left_CM_1', 'left_CM_2', 'left_CM_3', 'right_GK_1', 'right_CB_1']
    >>> observations, rewards, *_ = env.step({agent: setpiece.Action.RIGHT for agent in env.agents})
    >>> rewards["right_CB_1"]
    0.0
    """
    # Before any other name is bound, so that these are the caller's arguments, except those that
    # aren't the environment's.
    arguments: dict[str, Any] = {**locals()}
    for name in ("max_cycles", "record", "record_when", "record_quality"):
        del arguments[name]
    need("pettingzoo", "pettingzoo", "`parallel_env`")
    from setpiece._parallel import ParallelFootballEnv

    env = FootballEnv(switching="fixed", **arguments)
    return ParallelFootballEnv(env, max_cycles, read_record(record, record_when, record_quality))


def register_pettingzoo() -> None:
    """Registers every scenario of the library with PettingZoo, as `setpiece/NAME-v0`.

    Then `pettingzoo.make("parallel", "setpiece/academy_corner-v0", left=3)` makes one. Raises
    `MissingPackageError` without a PettingZoo that has a registry (1.27).

    >>> import pettingzoo, setpiece
    >>> setpiece.register_pettingzoo()
    >>> pettingzoo.make("parallel", "setpiece/academy_corner-v0").possible_agents
    ['left_LB_1']
    """
    pettingzoo = need("pettingzoo", "pettingzoo", "`register_pettingzoo`")
    if not hasattr(pettingzoo, "parallel_registry"):
        raise MissingPackageError(
            "this PettingZoo has no registry",
            name="pettingzoo",
            help="pip install 'pettingzoo>=1.27'",
        )
    for name in _library.list():
        env_id = f"{_library.NAMESPACE}/{name}-v0"
        if env_id not in pettingzoo.parallel_registry:
            kwargs = {"scenario": name.name}
            pettingzoo.register(
                "parallel", env_id, entry_point="setpiece._pettingzoo:parallel_env", kwargs=kwargs
            )
