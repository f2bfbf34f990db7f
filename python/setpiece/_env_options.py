"""The options of an environment: one value, validated once and passed down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, TypedDict

from setpiece._callbacks import (
    Callbacks,
    EndFunction,
    Ends,
    RewardFunction,
    Rewards,
    copied,
    read_ends,
    read_rewards,
)
from setpiece._casting import behaviors, revivable
from setpiece._errors import ParameterError
from setpiece._level import Level
from setpiece._opponents import Opponent, native_action_set
from setpiece._options import ParamValue, check_flag, check_number, check_params
from setpiece._seats import Seats
from setpiece._source import Source, level_of
from setpiece._spaces import (
    MAP_MAX,
    PICTURE_MAX,
    check_action_set,
    check_observation,
    check_scale,
    check_size,
    check_stack,
)
from setpiece._window import pygame_ce
from setpiece._words import check_word

RENDER_MODES = ("ansi", "rgb_array", "human")

CAMERAS = ("broadcast", "above")
"""Where pictures for people are taken from."""


class VectorArguments(TypedDict, total=False):
    """The arguments of `setpiece.make` and `setpiece.make_vec`; `setpiece.make` describes them."""

    left: Seats
    right: Seats
    opponents: Mapping[str, Opponent] | None
    observation: str
    rewards: Rewards
    seed: int | None
    copy: bool
    render_mode: str | None
    render_size: tuple[int, int]
    camera: str
    action_set: str
    stack: int
    size: tuple[int, int]
    scale: bool
    switching: Literal["auto", "fixed"] | None
    allow_outside: bool


class SharedArguments(VectorArguments, total=False):
    """The same with parameters, which a vector may have for each environment."""

    params: Mapping[str, ParamValue] | None


class EnvArguments(SharedArguments, total=False):
    """A single environment's arguments, except those for files."""

    ends: Ends
    events: bool
    bot_action: bool


class EvaluateArguments(TypedDict, total=False):
    """The arguments of `Suite.evaluate` beside the policy."""

    threads: int | None
    observation: str
    stack: int
    size: tuple[int, int]
    scale: bool
    rewards: Rewards


@dataclass(frozen=True)
class EnvOptions:
    """Validated arguments of an environment or a vector; the native module reads its attributes.

    What depends on the scenario (names of players, rewards and parameters) is validated when a
    scenario is prepared.
    """

    left: Seats
    right: Seats
    switching: Literal["auto", "fixed"] | None
    scripted: dict[str, str]
    """The behaviours and scripts among the opponents: by side or agent, the text of `ai:`."""
    opponents: dict[str, Opponent] | None
    """The opponents of a scenario that already has its behaviours."""
    observation: str
    reward_names: list[str] | None
    """Names of the scenario's rewards; None for its own choice."""
    reward_functions: Sequence[RewardFunction]
    ends: Sequence[EndFunction]
    params: dict[str, ParamValue]
    seed: int | None
    events: bool
    """Whether the caller's `info` lists events."""
    copy: bool
    render_mode: str | None
    render_size: tuple[int, int]
    camera: str
    action_set: str
    native_action_set: str
    """The actions of all agents: opponents may have one more than the caller."""
    bot_action: bool
    stack: int
    size: tuple[int, int]
    scale: bool
    allow_outside: bool

    @classmethod
    def read(cls, arguments: Mapping[str, Any], known: type = EnvArguments) -> EnvOptions:
        """Validates arguments; omitted ones have the defaults of `setpiece.make`.

        Raises `ParameterError` for a wrong value, `TypeError` for a name that isn't among the
        `known` ones.
        """
        for name in arguments:
            if name not in known.__annotations__:
                raise TypeError(f"unexpected keyword argument '{name}'")
        given = arguments.get
        render_mode = given("render_mode")
        if render_mode is not None:
            check_word("render_mode", render_mode, RENDER_MODES)
        if render_mode == "human":
            pygame_ce('`render_mode="human"`')
        reward_names, reward_functions = read_rewards(given("rewards"))
        ends = read_ends(given("ends"))
        observation = check_observation(given("observation", "simple115v2"))
        action_set = check_action_set(given("action_set", "default"))
        opponents, seed = revivable(given("opponents")), given("seed")
        return cls(
            left=given("left"),
            right=given("right"),
            switching=given("switching"),
            scripted=behaviors(given("opponents")),
            opponents=opponents,
            observation=observation,
            reward_names=reward_names,
            reward_functions=reward_functions,
            ends=ends,
            params=check_params(given("params")) or {},
            seed=None if seed is None else check_number("seed", seed),
            events=check_flag("events", given("events", False)),
            copy=check_flag("copy", given("copy", True)),
            render_mode=render_mode,
            render_size=check_size(given("render_size", (1280, 720)), PICTURE_MAX, "render_size"),
            camera=check_word("camera", given("camera", "broadcast"), CAMERAS),
            action_set=action_set,
            native_action_set=native_action_set(action_set, opponents),
            bot_action=check_flag("bot_action", given("bot_action", False)),
            stack=check_stack(given("stack", 1), observation),
            size=check_size(
                given("size", (96, 72)), MAP_MAX if observation == "smm" else PICTURE_MAX
            ),
            scale=check_scale(given("scale", False), observation),
            allow_outside=check_flag("allow_outside", given("allow_outside", False)),
        )

    @property
    def needs_events(self) -> bool:
        """Whether the native `info` lists events: for the caller, or for functions in Python."""
        return self.events or bool(self.reward_functions or self.ends)

    def callbacks(self) -> Callbacks | None:
        """Returns rewards and endings in Python with separate memory; None without any."""
        if not self.reward_functions and not self.ends:
            return None
        return Callbacks(self.reward_functions, self.ends, show_events=self.events)

    def copied(self, memo: dict[int, Any]) -> EnvOptions:
        """Returns options with copies of the functions, and the same opponents.

        Raises `CallbackError` for a function that can't be copied.
        """
        return replace(
            self, reward_functions=copied(self.reward_functions, memo), ends=copied(self.ends, memo)
        )


def begun_in(scenario: Source, options: EnvOptions) -> tuple[Source, Level | None, EnvOptions]:
    """What an environment is made of: a scenario, and the level that is given instead of one.

    The options bind the parameters of the level. Raises `ParameterError` for options that the level
    decides.
    """
    level = level_of(scenario)
    if level is None:
        return scenario, None, options
    for name, given in (("params", options.params or None), ("seed", options.seed)):
        if given is not None and (name == "params" or level.seed is not None):
            raise ParameterError(f"a level and `{name}` exclude each other", name=name)
    begun = None if level.seed is None else level
    return level.scenario, begun, replace(options, params=level.params)
