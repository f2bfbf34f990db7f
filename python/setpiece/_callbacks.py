"""Rewards and endings in Python, in addition to those of the scenario's file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import CallbackError, ParameterError
from setpiece._native import AgentInfo
from setpiece._opponents import SIDES
from setpiece._words import is_text

NONE = "none"
"""Instead of names: none of the scenario's rewards."""


@dataclass(frozen=True)
class Step:
    """A step of 100 ms as one agent saw it, the argument of rewards and endings in Python.

    - `agent`, `team`: its id, as in `env.agents`, and its side.
    - `action`: its action: an int, or float32 `(4,)` with continuous actions.
    - `before`, `now`: raw observations of the agent before and after the step, dicts in its own
      frame: it attacks towards +x, and `left_team` is its own. If play stopped, `now` shows the
      restart; what led to it is in `events` and `now["score"]`.
    - `events`: what happened, as in `info["events"]`: in the world's frame, teams `"left"` and
      `"right"`.
    - `outcome`: for rewards, how the episode ended with this step; else None.
    """

    agent: str
    team: Literal["left", "right"]
    action: int | NDArray[np.float32]
    before: dict[str, Any]
    now: dict[str, Any]
    events: list[dict[str, Any]]
    outcome: str | None


RewardFunction = Callable[[Step], float]
"""A reward in Python: an agent's payment for a step, added to those of the file."""

EndFunction = Callable[[Step], bool | str | None]
"""An ending in Python: False, None or "" to continue; True or a label to end the episode."""

Rewards = str | RewardFunction | Sequence[str | RewardFunction] | None
"""Names that replace the scenario's own choice of rewards, functions that add to it, or both."""

Ends = EndFunction | Sequence[EndFunction] | None
"""Functions that end episodes."""


def read_rewards(rewards: Rewards) -> tuple[list[str] | None, list[RewardFunction]]:
    """Returns the names, None for the scenario's own choice, and the functions."""
    if rewards is None:
        return None, []
    given = (
        rewards.split(",")
        if isinstance(rewards, str)
        else [rewards]
        if callable(rewards)
        else rewards
    )
    if not isinstance(given, Sequence) or not all(
        isinstance(one, str) or callable(one) for one in given
    ):
        raise ParameterError(
            f"expected `rewards` as names or functions, found `{rewards!r}`", name="rewards"
        )
    names = [one.strip() for one in given if isinstance(one, str)]
    if not all(is_text(name) for name in names):
        raise ParameterError(
            f"expected `rewards` as names or functions, found `{rewards!r}`", name="rewards"
        )
    functions = [one for one in given if not isinstance(one, str)]
    if names == [NONE]:
        names = []
    elif functions and not names:
        return None, functions
    return names, functions


def copied(given: Rewards | Ends, memo: dict[int, Any]) -> Any:
    """Returns rewards or endings with copies of the functions.

    Whatever they share with other functions copied under the same memo stays shared. Raises
    `CallbackError` for a function that can't be copied.
    """
    if given is None or isinstance(given, str):
        return given
    if not callable(given):
        return [copied(one, memo) for one in given]
    try:
        return deepcopy(given, memo)
    except Exception as error:
        raise CallbackError(
            f"`{_name(given)}` can't be copied: {type(error).__name__}: {error}",
            function=_name(given),
            help="give it a `__deepcopy__`",
        ) from error


def refuse_functions(functions: Sequence[RewardFunction]) -> None:
    """Raises `ParameterError` for rewards in Python where only the scenario's rewards can pay."""
    if functions:
        raise ParameterError(
            f"`{_name(functions[0])}` can't pay here: many matches at once only support the rewards of the file",
            name="rewards",
            help="put environments of `setpiece.make` (one agent each) into a `gymnasium.vector.SyncVectorEnv`",
        )


def read_ends(ends: Ends) -> list[EndFunction]:
    """Returns the functions that end episodes."""
    given = [] if ends is None else [ends] if callable(ends) else ends
    if not isinstance(given, Sequence) or not all(callable(end) for end in given):
        raise ParameterError(f"expected `ends` as functions, found `{ends!r}`", name="ends")
    return [*given]


class Callbacks:
    """The rewards and endings in Python of one environment, with their memory."""

    tally: dict[str, Any]
    """Each function's payments since the last `reset` or `restore`: a float, or float64 `(n,)`."""

    def __init__(
        self,
        rewards: Sequence[RewardFunction],
        ends: Sequence[EndFunction],
        *,
        show_events: bool = False,
    ) -> None:
        self.rewards = {_name(function): function for function in rewards}
        self.ends = [*ends]
        if len(self.rewards) != len(rewards):
            names = [_name(function) for function in rewards]
            twice = next(name for name in names if names.count(name) > 1)
            raise ParameterError(
                f"two rewards are named `{twice}`: each needs its own term in `info`",
                name="rewards",
                help="give one another `__name__`",
            )
        self._show_events = show_events
        self._before: list[dict[str, Any]] = []
        self.tally = {}

    def begin(self, views: list[dict[str, Any]], info: dict[str, Any]) -> None:
        """Begins an episode; adds the functions' terms to its first `info`."""
        self.check(info)
        for function in [*self.rewards.values(), *self.ends]:
            reset = getattr(function, "reset", None)
            if callable(reset):
                try:
                    reset()
                except Exception as error:
                    raise failed(function, None, error) from error
        self.go_on(views, info)

    def check(self, info: dict[str, Any]) -> None:
        """Raises `ParameterError` for a function with the name of a scenario's reward.

        The first `info` shows these names.
        """
        for name in self.rewards:
            if name in info["reward_terms"]:
                raise ParameterError(f"`{name}` is a reward of the scenario too", name="rewards")

    def go_on(self, views: list[dict[str, Any]], info: dict[str, Any]) -> None:
        """Continues in the middle of an episode."""
        self._events_of(info)
        nothing = [0.0] * len(views)
        info["reward_terms"].update({name: _shaped(nothing) for name in self.rewards})
        if "setpiece" in info:
            info["setpiece"]["return"].update({name: _shaped(nothing) for name in self.rewards})
        self._before = views
        self.tally = dict.fromkeys(self.rewards, 0.0)

    def judge(
        self,
        agents: Sequence[AgentInfo],
        action: Any,
        views: list[dict[str, Any]],
        result: tuple[Any, bool, bool, dict[str, Any]],
        end: Callable[[str], dict[str, Any]],
    ) -> tuple[Any, bool, bool, dict[str, Any]]:
        """Judges a step of these agents; takes and returns reward, terminated, truncated, `info`.

        Puts the functions' terms into `info`. If one of them ends the episode, `end` ends the match
        with its label and returns the summary for the last `info`. Raises `CallbackError`.
        """
        reward, terminated, truncated, info = result
        events = self._events_of(info)
        acts = np.asarray(action).reshape(len(agents), -1)
        steps = [
            Step(agent.id, SIDES[agent.team], _action(act), before, now, events, None)
            for agent, act, before, now in zip(agents, acts, self._before, views, strict=True)
        ]
        # The file's own endings come first, its limit last.
        label = None if terminated else self._label(steps[0])
        outcome = info.get("outcome") if label is None else label
        steps = [replace(step, outcome=outcome) for step in steps]
        paid = {
            name: [_paid(function, step) for step in steps]
            for name, function in self.rewards.items()
        }
        self._before = views
        info["reward_terms"].update({name: _shaped(values) for name, values in paid.items()})
        self.tally = {name: self.tally[name] + info["reward_terms"][name] for name in self.rewards}
        if label is not None:
            terminated, truncated = True, False
            info.update(end(label))
        if "setpiece" in info:
            info["setpiece"]["return"].update(self.tally)
        for values in paid.values():
            reward = reward + (values[0] if len(values) == 1 else np.array(values, np.float32))
        return reward, terminated, truncated, info

    def _events_of(self, info: dict[str, Any]) -> list[dict[str, Any]]:
        """The events of a step; removed from an `info` that the caller wanted without events."""
        events: list[dict[str, Any]] = info["events"] if self._show_events else info.pop("events")
        return events

    def _label(self, step: Step) -> str | None:
        """The label of the first ending that holds."""
        for function in self.ends:
            verdict = _call(function, step.agent, step)
            if isinstance(verdict, str) and is_text(verdict):
                if verdict:
                    return verdict
            elif verdict is not None and not isinstance(verdict, bool | np.bool_):
                raise CallbackError(
                    f"the ending `{_name(function)}` gave {verdict!r}; expected a bool or a label",
                    function=_name(function),
                    agent=step.agent,
                )
            elif verdict:
                return _name(function)
        return None


def _name(function: Callable[..., Any]) -> str:
    return str(getattr(function, "__name__", type(function).__name__))


def _action(act: NDArray[Any]) -> Any:
    return act.item() if len(act) == 1 else act.astype(np.float32)


def _shaped(values: list[float]) -> Any:
    """Values by agent in the shape of `info`: a float for one, float64 `(n,)` for n."""
    return values[0] if len(values) == 1 else np.array(values)


def _paid(function: RewardFunction, step: Step) -> float:
    value = _call(function, step.agent, step)
    try:
        number = np.asarray(value)
        if number.ndim == 0 and number.dtype.kind in "biuf" and isfinite(number):
            return float(number)
    except (ValueError, TypeError):
        pass
    raise CallbackError(
        f"the reward `{_name(function)}` gave {value!r}; expected a finite number",
        function=_name(function),
        agent=step.agent,
    )


def _call(function: Callable[[Step], Any], agent: str, step: Step) -> Any:
    try:
        return function(step)
    except Exception as error:
        raise failed(function, agent, error) from error


def failed(function: Callable[..., Any], agent: str | None, error: Exception) -> CallbackError:
    """Builds the error for a failed function of the caller, for an agent or for nobody."""
    of_agent = "" if agent is None else f" for `{agent}`"
    return CallbackError(
        f"`{_name(function)}` failed{of_agent}: {type(error).__name__}: {error}",
        function=_name(function),
        agent=agent,
    )
