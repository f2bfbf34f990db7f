"""The spaces of observations and actions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from setpiece import _native
from setpiece._errors import ParameterError
from setpiece._options import check_flag
from setpiece._words import check_word

COUNT_MAX = 2**32 - 1
"""The largest count of goals or steps: the engine counts in 32 bits."""

OBSERVATIONS = (
    "simple115v2",
    "simple115v2+sticky",
    "simple115",
    "egocentric",
    "smm",
    "pixels",
    "pixels_gray",
    "raw",
    "vector",
)

UNSCALED = {
    "simple115": "what its columns hold depends on how many players there are",
    "smm": "its pixels are bytes",
    "pixels": "they are bytes",
    "pixels_gray": "they are bytes",
    "raw": "raw observations are dicts",
    "vector": "its units are those that the scenario declares",
}
"""Observations that can't be scaled, and why."""

ALIASES = {"extracted": "smm"}
"""GRF's names of observations that have another name here."""

MAP_MAX = 1024
"""The most pixels of a super mini map on either side."""

PICTURE_MAX = 4096
"""The most pixels of a picture on either side."""

STACK_MAX = 64
"""The most observations of a stack."""


class Observing(Protocol):
    """Anything that observes: a native environment, or a batch of them."""

    @property
    def agents(self) -> list[_native.AgentInfo]: ...
    @property
    def players(self) -> tuple[int, int]: ...
    @property
    def held_actions(self) -> int: ...
    @property
    def observation_shape(self) -> list[int]: ...
    @property
    def blocks(self) -> list[_native.BlockInfo]: ...
    @property
    def bounds(self) -> _native.Bounds | None: ...


class Block(NamedTuple):
    """A block on the last axis of an observation: related numbers."""

    start: int
    length: int
    meaning: str
    unit: str


class Key(NamedTuple):
    """A key of a raw observation."""

    name: str
    dtype: str
    shape: tuple[int, ...]
    meaning: str


Layout = tuple[Block, ...] | tuple[Key, ...]
"""The layout of an observation: blocks of an array, or the keys of a dict."""


def check_observation(name: object) -> str:
    """Returns the name of an observation, or raises `ParameterError`."""
    name = ALIASES.get(name, name) if isinstance(name, str) else name
    return check_word("observation", name, OBSERVATIONS)


def check_action_set(name: object) -> str:
    """Returns the name of a set of actions, or raises `ParameterError`."""
    return check_word("action_set", name, tuple(_native.ACTION_SETS))


def check_stack(stack: object, observation: str) -> int:
    """Returns how many observations a stack has, or raises `ParameterError`."""
    if (
        isinstance(stack, bool)
        or not isinstance(stack, int | np.integer)
        or not 1 <= stack <= STACK_MAX
    ):
        raise ParameterError(
            f"`stack` is {stack!r}; it can be an integer in 1..{STACK_MAX}", name="stack"
        )
    if stack > 1 and observation == "raw":
        raise ParameterError("raw observations are dicts, which can't be stacked", name="stack")
    return int(stack)


def check_size(size: object, most: int, name: str = "size") -> tuple[int, int]:
    """Returns the width and height of a map or a picture, or raises `ParameterError`."""
    if (
        isinstance(size, Sequence)
        and len(size) == 2
        and all(
            isinstance(n, int | np.integer) and not isinstance(n, bool) and 1 <= n <= most
            for n in size
        )
    ):
        return int(size[0]), int(size[1])
    raise ParameterError(
        f"`{name}` is {size!r}; it can be (width, height), each in 1..{most}", name=name
    )


def check_scale(scale: object, observation: str) -> bool:
    """Returns whether an observation is scaled, or raises `ParameterError`."""
    scale = check_flag("scale", scale)
    if scale and observation in UNSCALED:
        scalable = "`, `".join(name for name in OBSERVATIONS if name not in UNSCALED)
        raise ParameterError(
            f"`{observation}` can't be scaled: {UNSCALED[observation]}",
            name="scale",
            help=f"`{scalable}` can",
        )
    return scale


def one_action_space(action_set: str) -> spaces.Discrete | spaces.Box:
    """Returns the space of one agent's action."""
    if action_set == "continuous":
        low, high = _native.CONTINUOUS
        return spaces.Box(np.array(low, np.float32), np.array(high, np.float32), dtype=np.float32)
    return spaces.Discrete(_native.ACTION_SETS[action_set])


def action_space(n_agents: int, action_set: str) -> spaces.Space[Any]:
    """Returns the space of one agent's action, or of several agents' (or no agents') actions."""
    one = one_action_space(action_set)
    if n_agents == 1:
        return one
    if isinstance(one, spaces.Box):
        return spaces.Box(
            np.tile(one.low, (n_agents, 1)), np.tile(one.high, (n_agents, 1)), dtype=np.float32
        )
    return spaces.MultiDiscrete(np.full(n_agents, one.n, np.int64))


def observation_space(
    native: Observing, observation: str, agents: Sequence[_native.AgentInfo] | None = None
) -> spaces.Space[Any]:
    """Returns the space of the observations of all agents of an environment, or of some of them.

    With several agents, or none, an array gains a leading axis, and a raw observation becomes a
    tuple with one part per agent.
    """
    agents = native.agents if agents is None else agents
    n_agents = len(agents)
    if observation == "raw":
        parts = [one_observation_space(native, observation, agent.team) for agent in agents]
        return parts[0] if n_agents == 1 else spaces.Tuple(parts)
    shape = (
        tuple(native.observation_shape) if n_agents == 1 else (n_agents, *native.observation_shape)
    )
    bounds = native.bounds
    if bounds is None:
        return spaces.Box(0, 255, shape, np.uint8)
    # A stack repeats the bounds, and every agent has the same.
    low, high = (
        np.tile(bound, (*shape[:-1], shape[-1] // len(bound)))
        for bound in (bounds.low, bounds.high)
    )
    return spaces.Box(low, high, dtype=np.float32)


def difference(before: spaces.Space[Any], after: spaces.Space[Any]) -> str | None:
    """Returns in words how a space would change; None if it stays the same."""
    if before == after:
        return None
    if (
        isinstance(before, spaces.Tuple)
        and isinstance(after, spaces.Tuple)
        and len(before) == len(after)
    ):
        return next(
            why
            for pair in zip(before.spaces, after.spaces, strict=True)
            if (why := difference(*pair))
        )
    if isinstance(before, spaces.Dict) and isinstance(after, spaces.Dict):
        # Raw observations have the same keys; only their shapes depend on the scenario.
        name = next(name for name in before if before[name] != after[name])
        return f"{difference(before[name], after[name])} at `{name}`"
    if _described(before) == _described(after):
        return f"of {_described(before)} would have other bounds"
    return f"would change from {_described(before)} to {_described(after)}"


def _described(space: spaces.Space[Any]) -> str:
    if isinstance(space, spaces.Box):
        return f"{space.dtype} {space.shape}"
    if isinstance(space, spaces.MultiDiscrete):
        return f"{len(space.nvec)} actions"
    if isinstance(space, spaces.Tuple):
        return f"{len(space)} dicts"
    return {spaces.Discrete: "one action", spaces.Dict: "one dict"}.get(type(space), str(space))


def one_observation_space(native: Observing, observation: str, team: int) -> spaces.Space[Any]:
    """Returns the space of the observation of one agent of a team, 0 left, 1 right."""
    if observation == "raw":
        return _raw_space(native.players, team, native.held_actions)
    return observation_space(native, observation, native.agents[:1])


def observation_layout(native: Observing, observation: str, stack: int) -> Layout:
    """Returns the layout of one agent's observation: the last axis's blocks, or a dict's keys."""
    if observation == "raw":
        space = _raw_space(native.players, 0, native.held_actions)
        return tuple(
            Key(
                name,
                *_typed(part),
                RAW_MEANINGS[name.removeprefix("left_team").removeprefix("right_team") or name],
            )
            for name, part in space.items()
        )
    if observation in PLANES:
        planes, unit = PLANES[observation]
        blocks = [Block(i, 1, meaning, unit) for i, meaning in enumerate(planes)]
    else:
        blocks = [Block(one.start, one.length, one.meaning, one.unit) for one in native.blocks]
    width = blocks[-1].start + blocks[-1].length if blocks else 0
    if stack == 1:
        return tuple(blocks)
    ago = [
        f", {n} step{'s' if n > 1 else ''} ago" if n else ", now" for n in range(stack - 1, -1, -1)
    ]
    return tuple(
        block._replace(start=block.start + i * width, meaning=block.meaning + when)
        for i, when in enumerate(ago)
        for block in blocks
    )


PLANES = {
    "smm": (("own team", "opponents", "the ball", "the controlled player"), "0 or 255"),
    "pixels": (("red", "green", "blue"), "0..255"),
    "pixels_gray": (("gray",), "0..255"),
}
"""The meanings of the last axis of observations of bytes, and their unit."""


RAW_MEANINGS = {
    "ball": "x, y normalised, z in metres",
    "ball_direction": "displacement per step: x, y normalised, z in metres",
    "ball_rotation": "turn per millisecond about the axes, scaled as GRF scales it",
    "ball_owned_team": "-1 nobody, 0 the own team, 1 the opponents",
    "ball_owned_player": "index within the owner's team, or -1",
    "designated": "index of the own team's player who is foremost for the ball, or -1",
    "active": "index of the agent's player, or -1",
    "sticky_actions": "held actions: eight directions from left clockwise, sprint, dribble; with the set `full` also "
    "keeper rush, pressure, team pressure",
    "score": "own goals, the opponents' goals",
    "steps_left": "steps until the limit; -1 without one",
    "game_mode": "a `GameMode`",
    "left_team": "the own team's players: x, y normalised",
    "right_team": "the opponents: x, y normalised",
    "_direction": "displacement per step of that team's players, normalised",
    "_tired_factor": "tiredness of that team's players: 0 fresh to 1",
    "_yellow_card": "whether each player of that team has a card",
    "_active": "whether each player of that team is on the pitch",
    "_roles": "each player's `Role`",
}


def _typed(space: spaces.Space[Any]) -> tuple[str, tuple[int, ...]]:
    return (
        ("int", ()) if isinstance(space, spaces.Discrete) else (str(space.dtype), space.shape or ())
    )


def _raw_space(players: tuple[int, int], team: int, held_actions: int) -> spaces.Dict:
    """Returns the space of one agent's raw observation; its own team is always the left one."""
    place, stride = np.array([2.0, 1.5]), np.array([1.0, 1.0])

    def around(bound: NDArray[np.float64], size: int) -> spaces.Box:
        high = np.broadcast_to(bound, (size, 2))
        return spaces.Box(-high, high, dtype=np.float64)

    parts: dict[str, spaces.Space[Any]] = {
        "ball": spaces.Box(
            np.array([-2.0, -1.5, 0.0]), np.array([2.0, 1.5, 100.0]), dtype=np.float64
        ),
        "ball_direction": spaces.Box(
            np.array([-1.0, -1.0, -10.0]), np.array([1.0, 1.0, 10.0]), dtype=np.float64
        ),
        "ball_rotation": spaces.Box(-1.0, 1.0, (3,), dtype=np.float64),
        "ball_owned_team": spaces.Discrete(3, start=-1),
        "ball_owned_player": spaces.Discrete(12, start=-1),
        "designated": spaces.Discrete(12, start=-1),
        "active": spaces.Discrete(12, start=-1),
        "sticky_actions": spaces.Box(0, 1, (held_actions,), dtype=np.uint8),
        "score": spaces.Box(0, COUNT_MAX, (2,), dtype=np.int64),
        "steps_left": spaces.Box(-1, COUNT_MAX, (), dtype=np.int64),
        "game_mode": spaces.Discrete(7),
    }
    for side, size in zip(
        ("left_team", "right_team"), players if team == 0 else players[::-1], strict=True
    ):
        parts[side] = around(place, size)
        parts[f"{side}_direction"] = around(stride, size)
        parts[f"{side}_tired_factor"] = spaces.Box(0.0, 1.0, (size,), dtype=np.float64)
        parts[f"{side}_yellow_card"] = spaces.Box(0, 1, (size,), dtype=np.bool_)
        parts[f"{side}_active"] = spaces.Box(0, 1, (size,), dtype=np.bool_)
        parts[f"{side}_roles"] = spaces.Box(0, 9, (size,), dtype=np.int64)
    return spaces.Dict(parts)


class ManyMatches(Protocol):
    """Whatever has the space of a match's agents."""

    @property
    def agents(self) -> tuple[str, ...]: ...
    @property
    def single_observation_space(self) -> spaces.Space[Any]: ...
    @property
    def single_action_space(self) -> spaces.Space[Any]: ...


def box_of_one_agent(envs: ManyMatches) -> spaces.Box:
    """Returns what one agent sees in a vector; the space of several has their axis first."""
    space = envs.single_observation_space
    # A vector stacks arrays only.
    assert isinstance(space, spaces.Box)
    if len(envs.agents) == 1:
        return space
    return spaces.Box(space.low[0], space.high[0], dtype=space.low.dtype.type)


def action_of_one_agent(envs: ManyMatches) -> spaces.Discrete | spaces.Box:
    """Returns what one agent does in a vector; the space of several has their axis first."""
    space = envs.single_action_space
    if isinstance(space, spaces.MultiDiscrete):
        return spaces.Discrete(int(space.nvec.flat[0]))
    assert isinstance(space, spaces.Discrete | spaces.Box)
    if isinstance(space, spaces.Box) and len(envs.agents) > 1:
        return spaces.Box(space.low[0], space.high[0], dtype=np.float32)
    return space
