"""Who plays: the caller some of the agents, opponents of all kinds the others."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike, fspath
from typing import Any, Literal, TypeGuard

import numpy as np
from numpy.typing import NDArray

from setpiece._actions import integers
from setpiece._errors import ActionError, FormatError, OpponentError, ParameterError
from setpiece._held import Held
from setpiece._native import ACTION_SETS, AgentInfo, Scenario
from setpiece._onnx import REPEAT_MAX, OnnxPolicy, baseline_policy, onnx_policy
from setpiece._options import check_count, check_flag
from setpiece._rows import Picker, pick_info
from setpiece._spaces import check_observation, check_scale
from setpiece._vocabulary import Action
from setpiece._words import similar

SIDES: tuple[Literal["left"], Literal["right"]] = ("left", "right")
BOT = "bot"
BASELINE = "baseline"


@dataclass(frozen=True)
class Policy:
    """A policy that plays agents of an environment, with the observation that it wants.

    - `play`: a function of observations that returns actions, the path of an `.onnx` file, or an
      object with the `predict` of Stable-Baselines3.
    - `observation`: what it sees, as in `setpiece.make` without a stack; None: what the `.onnx`
      file says, otherwise what the caller sees, including the stack.
    - `batched`: True: it gets the observations of all its n agents at once, an array with a leading
      axis n (a tuple of n dicts for `"raw"`), and returns n actions. False: it gets one agent's and
      returns one, agent by agent.
    - `scale`: whether that `observation` is scaled, as in `setpiece.make`. With None as
      `observation`, the caller's scale applies.
    - `repeat`: how many steps a decision lasts: its action is pressed in all of them. None: what
      the `.onnx` file says, otherwise 1.
    - `masks`: whether `play` also gets masks, as its second argument: int8 `(n, 20)`, or `(20,)` if
      it isn't `batched`; 1 for the actions that can have an effect. None: whether the `.onnx` file
      takes them, otherwise False.

    Every agent sees itself attacking towards +x. Actions are integers 0..19; 19 hands the step over
    to the bot.
    """

    play: Callable[..., Any] | str | PathLike[str] | Any
    observation: str | None = None
    batched: bool = True
    scale: bool = False
    repeat: int | None = None
    masks: bool | None = None


Look = tuple[str, bool]
"""The name of an observation, and whether it is scaled."""

Opponent = Policy | Callable[[Any], Any] | str | PathLike[str] | Any
"""What plays agents instead of the caller; `setpiece.make` describes the forms."""


def native_action_set(action_set: str, opponents: Mapping[str, Opponent] | None) -> str:
    """Returns the action set of all agents: opponents may always hand a step over to the bot."""
    if opponents is not None and action_set == "continuous":
        raise ParameterError(
            "with opponents the caller must press keys: continuous actions are for all agents",
            name="action_set",
        )
    return "v2" if opponents is not None and action_set == "default" else action_set


@dataclass(frozen=True)
class Seat:
    """Agents that one opponent plays."""

    agents: tuple[str, ...]
    at: list[int]
    pick: Picker
    policy: Policy
    play: Callable[..., Any]
    held: Held
    side: Literal["left", "right"] | None
    what: str = "opponent"
    masked: bool = False
    """Whether the opponent also sees masks."""

    @property
    def look(self) -> Look | None:
        """The observation that the opponent wants; None: the caller's."""
        policy = self.policy
        return None if policy.observation is None else (policy.observation, policy.scale)


class Table:
    """The agents of a match: the caller's, and those of opponents."""

    n_agents: int
    """How many agents there are."""
    n_actions: int
    """How many actions the caller has."""
    mine: list[int]
    """The caller's agents, among all."""
    seats: list[Seat]
    """The opponents that are asked for actions; the engine plays the others."""
    seen: Any
    """What all agents were shown last; opponents without their own observation see this."""

    def __init__(
        self,
        agents: Sequence[AgentInfo],
        opponents: Mapping[str, Opponent],
        n_actions: int,
        scenario: Scenario,
        what: str = "opponent",
    ) -> None:
        """Seats opponents; `what` they are called in errors.

        `scenario` is what they play, which may have the policy of `"baseline"`.
        """
        self.n_agents, self.n_actions = len(agents), n_actions
        owner = _owners(agents, read_opponents(opponents))
        self.mine = [at for at in range(self.n_agents) if at not in owner]
        self._pick = Picker(self.n_agents, self.mine[0] if len(self.mine) == 1 else self.mine)
        self.seats = []
        for who, opponent in opponents.items():
            at = [slot for slot, key in owner.items() if key == who]
            if not at or is_word(opponent):
                continue
            is_baseline = isinstance(opponent, str) and opponent == BASELINE
            given = Policy(baseline_policy(scenario)) if is_baseline else policy_of(who, opponent)
            ids = tuple(agents[slot].id for slot in at)
            teams = {agents[slot].team for slot in at}
            side = SIDES[teams.pop()] if len(teams) == 1 else None
            play, held = player_of(given)
            policy = sighted(given, play)
            pick = Picker(self.n_agents, at)
            masked = sees_masks(policy, play)
            self.seats.append(Seat(ids, at, pick, policy, play, held, side, what, masked))
        self.seen = None

    @property
    def observations(self) -> set[Look]:
        """The observations of opponents with their own."""
        return {seat.look for seat in self.seats if seat.look is not None}

    def shown(self, observation: Any, info: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
        """Returns the caller's part of what all agents see; keeps the rest for the opponents."""
        self.seen = observation
        return self._pick(observation), self.info(info)

    def info(self, info: dict[str, Any]) -> dict[str, Any]:
        """Returns the caller's part of an `info` about everyone."""
        return pick_info(info, self._pick, self.n_agents, self.n_actions)

    def paid(self, reward: Any) -> Any:
        """Returns the caller's part of the rewards."""
        paid = self._pick(reward)
        return paid.astype(np.float32, copy=False) if isinstance(paid, np.ndarray) else paid

    def mask(self, mask: Any) -> Any:
        """Returns the caller's part of everyone's masks."""
        return self._pick(mask)[..., : self.n_actions]

    @property
    def held(self) -> list[list[int]]:
        """The actions that opponents keep pressed, for copies of the environment."""
        return [seat.held.actions for seat in self.seats]

    @held.setter
    def held(self, held: list[list[int]]) -> None:
        for seat, actions in zip(self.seats, held, strict=True):
            seat.held.actions = [*actions]

    def actions(
        self,
        action: Any,
        look: Callable[[str, bool], Any],
        mask: Callable[[], NDArray[np.int8]],
        step: int,
    ) -> list[int]:
        """Returns everyone's actions: the caller's, and the opponents' for the last observation.

        `step` steps of the episode have been played. `look` observes the match in another kind of
        observation, `mask` returns the masks of all agents. Raises `ActionError` for the caller's
        action, `OpponentError` if an opponent fails.
        """
        all_actions = [int(Action.BUILTIN_AI)] * self.n_agents
        for at, one in zip(self.mine, self._read_actions(action), strict=True):
            all_actions[at] = one
        looks: dict[Look | None, Any] = {None: self.seen}
        for seat in self.seats:
            kind = seat.look
            if kind is not None and kind not in looks:
                looks[kind] = look(*kind)
            masks = mask().reshape(self.n_agents, -1)[seat.at] if seat.masked else None
            acts = ask(seat, seat.pick(looks[kind]), [step] * len(seat.at), masks)
            for at, one in zip(seat.at, acts, strict=True):
                all_actions[at] = one
        return all_actions

    def _read_actions(self, action: Any) -> list[int]:
        n = len(self.mine)
        actions = integers(action, (n,), self.n_actions)
        if actions is None and n == 1:
            actions = integers(action, (), self.n_actions)
        if actions is None:
            what = "an integer" if n == 1 else f"{n} actions, integers"
            raise ActionError(f"expected {what} in 0..{self.n_actions - 1}, found `{action!r}`")
        return _listed(actions.ravel())


def ask(
    seat: Seat, seen: Any, steps: Sequence[int], masks: NDArray[np.int8] | None = None
) -> list[int]:
    """Returns an opponent's actions for what its agents see; raises `OpponentError`.

    The episode of each agent has played so many `steps`. `masks`, if it sees them, have a row for
    each agent.
    """

    def decide(rows: Sequence[int]) -> list[int]:
        shown = None if masks is None else masks[[*rows], : ACTION_SETS["v2"]]
        return _decided(seat, some_rows(seen, rows), shown, rows)

    return seat.held.after(steps, decide)


def some_rows(seen: Any, rows: Sequence[int]) -> Any:
    """Returns some rows of what agents see: an array, or a tuple of dicts."""
    if len(rows) == len(seen):
        return seen
    return seen[[*rows]] if isinstance(seen, np.ndarray) else tuple(seen[at] for at in rows)


def _decided(
    seat: Seat, seen: Any, masks: NDArray[np.int8] | None, rows: Sequence[int]
) -> list[int]:
    """Returns the actions of the agents of some rows; raises `OpponentError`."""
    n, n_actions = len(rows), ACTION_SETS["v2"]
    if seat.policy.batched:
        given = _asked(seat, seat.agents, seen, masks)
        actions = integers(given, (n,), n_actions)
        if actions is None:
            raise _no_action(seat, seat.agents, f"{n} actions, integers", given)
        return _listed(actions)
    # The agents of one match after those of another.
    agents = [seat.agents[at % len(seat.agents)] for at in rows]
    each = [None] * n if masks is None else masks
    given = [
        _asked(seat, (agent,), one, mask)
        for agent, one, mask in zip(agents, seen, each, strict=True)
    ]
    # All at once is faster than one by one.
    actions = integers(given, (n,), n_actions)
    if actions is not None:
        return _listed(actions)
    return [_one_action(seat, agent, one) for agent, one in zip(agents, given, strict=True)]


def _one_action(seat: Seat, agent: str, given: Any) -> int:
    """Reads the action that an opponent returned for one agent."""
    action = integers(given, (), ACTION_SETS["v2"])
    if action is None:
        raise _no_action(seat, (agent,), "an integer", given)
    return int(action)


def _asked(seat: Seat, agents: tuple[str, ...], seen: Any, masks: NDArray[np.int8] | None) -> Any:
    """Calls an opponent for these of its agents."""
    try:
        return seat.play(seen) if masks is None else seat.play(seen, masks)
    except FormatError as error:
        # What is wrong with the file keeps its code and help.
        message = f"the {seat.what} {_of(agents)} failed: {error.args[0]}"
        raise OpponentError(
            message, slots=seat.agents, side=seat.side, code=error.code, help=error.help
        ) from error
    except Exception as error:
        why = f"failed: {type(error).__name__}: {error}"
        raise OpponentError(
            f"the {seat.what} {_of(agents)} {why}", slots=seat.agents, side=seat.side
        ) from error


def _listed(actions: NDArray[np.int64]) -> list[int]:
    listed: list[int] = actions.tolist()
    return listed


def _no_action(seat: Seat, agents: tuple[str, ...], expected: str, given: Any) -> OpponentError:
    """Builds the error for an opponent's wrong answer for these of its agents."""
    last = ACTION_SETS["v2"] - 1
    why = f"gave no action: expected {expected} in 0..{last}, found `{given!r}`"
    return OpponentError(f"the {seat.what} {_of(agents)} {why}", slots=seat.agents, side=seat.side)


def _of(agents: tuple[str, ...]) -> str:
    return f"of {', '.join(f'`{agent}`' for agent in agents)}"


def read_opponents(opponents: Mapping[str, Opponent] | None) -> Mapping[str, Opponent]:
    """Returns opponents, an empty mapping without any, or raises `ParameterError`."""
    if opponents is None:
        return {}
    if not isinstance(opponents, Mapping):
        raise ParameterError(
            "expected `opponents` as a mapping, such as `{'right': 'bot'}`, "
            f"found `{opponents!r}`",
            name="opponents",
        )
    return opponents


def _owners(agents: Sequence[AgentInfo], opponents: Mapping[str, Opponent]) -> dict[int, str]:
    """Which opponent plays which agent: one named for the agent, else its side's."""
    ids = [agent.id for agent in agents]
    owner: dict[int, str] = {}
    for who, opponent in opponents.items():
        if who in SIDES:
            at = [
                slot
                for slot, agent in enumerate(agents)
                if SIDES[agent.team] == who and agent.id not in opponents
            ]
            if not any(SIDES[agent.team] == who for agent in agents) and not is_word(opponent):
                raise ParameterError(
                    f"the {who} side has no agent that an opponent could play",
                    name="opponents",
                    help=f"give it some: `{who}='all'`, or a count",
                )
            owner.update(dict.fromkeys(at, who))
        elif who in ids:
            owner[ids.index(who)] = who
        else:
            raise no_agent(who, ids)
    return dict(sorted(owner.items()))


def no_agent(who: str, ids: Sequence[str]) -> ParameterError:
    """Builds the error for an opponent of an unknown agent."""
    return ParameterError(
        f"no agent `{who}`; opponents play `left`, `right` or one of {', '.join(f'`{one}`' for one in ids)}",
        name="opponents",
        help=similar(who, [*SIDES, *ids]),
    )


def policy_of(who: str, opponent: Opponent, argument: str = "opponents") -> Policy:
    """Returns an opponent as a policy, or raises `ParameterError` for the argument."""
    if isinstance(opponent, Policy):
        if opponent.repeat is not None:
            check_count("repeat", opponent.repeat, REPEAT_MAX)
        if opponent.masks is not None:
            check_flag("masks", opponent.masks)
        if opponent.observation is not None:
            kind = check_observation(opponent.observation)
            return replace(opponent, observation=kind, scale=check_scale(opponent.scale, kind))
        if check_flag("scale", opponent.scale):
            raise ParameterError(
                f"`{argument}[{who!r}]` scales nothing without an observation of its own",
                name="scale",
                help='name one: `Policy(…, "simple115v2", scale=True)`',
            )
        return opponent
    if is_onnx(opponent) or callable(getattr(opponent, "predict", None)):
        return Policy(opponent)
    if callable(opponent):
        return Policy(opponent, batched=False)
    named = argument == "opponents"
    words = "'bot', 'baseline', a behaviour's name, " if named else ""
    files = "a `.rhai` or `.onnx`" if named else "an `.onnx`"
    raise ParameterError(
        f"`{argument}[{who!r}]` is {opponent!r}; it can be {words}a function, a `setpiece.Policy`, "
        f"an object with `predict`, or the path of {files} file",
        name=argument,
    )


def sees_masks(policy: Policy, play: Callable[..., Any]) -> bool:
    """Whether the function that plays a policy is called with masks too."""
    if policy.masks is not None:
        return bool(policy.masks)
    return isinstance(play, OnnxPolicy) and play.masks


def sighted(policy: Policy, play: Callable[..., Any]) -> Policy:
    """Returns a policy with the observation that its file names, if it names none itself."""
    if policy.observation is not None or not isinstance(play, OnnxPolicy):
        return policy
    if play.observation is None:
        return policy
    scale = check_scale(play.scale, play.observation)
    return replace(policy, observation=play.observation, scale=scale)


def player_of(policy: Policy) -> tuple[Callable[..., Any], Held]:
    """Returns the function that is called with observations, and what keeps its actions pressed."""
    function = _function_of(policy)
    own = function.repeat if isinstance(function, OnnxPolicy) else 1
    return function, Held(own if policy.repeat is None else policy.repeat)


def _function_of(policy: Policy) -> Callable[..., Any]:
    if is_onnx(policy.play):
        return onnx_policy(policy.play)
    predict = getattr(policy.play, "predict", None)
    if callable(predict):
        return _Predictor(predict)
    if callable(policy.play):
        return policy.play
    raise ParameterError(f"a policy can't be played by {policy.play!r}", name="opponents")


@dataclass(frozen=True)
class _Predictor:
    """The `predict` of Stable-Baselines3: deterministic, returns actions and a state."""

    predict: Callable[..., Any]

    def __call__(self, observation: Any) -> Any:
        return self.predict(observation, deterministic=True)[0]


def is_word(opponent: object) -> TypeGuard[str | PathLike[str]]:
    """Whether it is the bot, a behaviour or a script, which the engine plays."""
    is_name = isinstance(opponent, str) and opponent != BASELINE and not is_onnx(opponent)
    return ends_with(opponent, ".rhai") or is_name


def is_onnx(opponent: object) -> TypeGuard[str | PathLike[str]]:
    """Whether it is the path of an ONNX file."""
    return ends_with(opponent, ".onnx")


def ends_with(opponent: object, ending: str) -> bool:
    """Whether it is the path of a file with an ending."""
    return isinstance(opponent, str | PathLike) and str(fspath(opponent)).endswith(ending)
