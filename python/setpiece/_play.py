"""A match between two Kaggle-style agents."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from setpiece._callbacks import Rewards
from setpiece._casting import scripted_scenario
from setpiece._env_options import EnvOptions
from setpiece._environment import FootballEnv
from setpiece._errors import OpponentError, ParameterError
from setpiece._native import ACTION_SETS
from setpiece._opponents import SIDES, Opponent, Policy, Table, is_onnx
from setpiece._options import ParamValue
from setpiece._seats import Seats
from setpiece._source import Source

Agent = Callable[[Any], Any] | Opponent


@dataclass(frozen=True)
class Played:
    """The result of a match between two agents.

    - `score`: goals of left and right; `winner`: the side with more goals, or whose opponent
      failed; None for a draw.
    - `rewards`: the return of each side, the average over its agents.
    - `length`: steps played; `outcome`: the ending's name, None if an agent failed.
    - `seed`, `digest`: the same agents with the same seed end in the same state, and this is its
      hash; None if an agent failed.
    - `actions`: int8 `(length, n)`: the actions of the n agents of `slots`, with which the match
      can be played again.
    - `errors`: by side, the error of an agent that failed.
    """

    score: tuple[int, int]
    winner: Literal["left", "right"] | None
    rewards: tuple[float, float]
    length: int
    outcome: str | None
    seed: int
    digest: str | None
    slots: tuple[str, ...]
    actions: NDArray[np.int8]
    errors: dict[str, OpponentError]


class KaggleObservation(dict[str, Any]):
    """An observation of Kaggle's football environment: a dict whose keys are attributes too."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None


def play(
    scenario: Source,
    left_agent: Agent,
    right_agent: Agent,
    *,
    left: Seats = None,
    right: Seats = None,
    seed: int = 0,
    params: Mapping[str, ParamValue] | None = None,
    rewards: Rewards = None,
    on_error: Literal["raise", "lose"] = "raise",
) -> Played:
    """Plays one match between two agents and returns a `Played`.

    - `left_agent`, `right_agent`: a function as in Kaggle's football environment. It gets
      `players_raw`, a raw observation for each of its n players with lists instead of arrays;
      `controlled_players`, n; and `step`, the number of steps played. It returns a list of n
      actions 0..19, or one action if n is 1. Both see themselves as the left team. Or anything that
      `opponents` of `setpiece.make` takes for a side: `"bot"`, a `Policy`, the path of an `.onnx`
      or `.rhai` file; a policy sees `simple115v2` unless it says otherwise.
    - `left`, `right`: how many play on each side, as in `setpiece.make`; None: as the scenario
      says. If the scenario leaves a side without agents, each side has one, or that side has one
      against the other side's agents. Such an agent controls the player nearest the ball.
    - `seed`, `params`, `rewards`: as in `setpiece.make`.
    - `on_error`: `"raise"` raises the `OpponentError` of an agent that fails; with `"lose"` it
      loses, and the error is in `errors`.

    >>> import setpiece
    >>> def runner(observation):
    ...     return [5] * observation["controlled_players"]
    >>> played = setpiece.play("1_vs_1_easy", runner, "bot", seed=3)
    >>> played.length == len(played.actions) > 0
    True
    """
    if on_error not in ("raise", "lose"):
        raise ParameterError(
            f"`on_error` is {on_error!r}; it can be 'raise' or 'lose'", name="on_error"
        )
    clock = _Clock()
    agents = {
        side: _opponent(agent, clock)
        for side, agent in zip(SIDES, (left_agent, right_agent), strict=True)
    }
    options = EnvOptions.read({"opponents": agents})
    chosen = scripted_scenario(scenario, options, {})
    seated = {agent.team for agent in FootballEnv(chosen, left=left, right=right).slots}
    if left is None and right is None and seated != {0, 1}:
        left = right = 1
    elif left is None and 0 not in seated:
        left = 1
    elif right is None and 1 not in seated:
        right = 1
    env = FootballEnv(
        chosen,
        left=left,
        right=right,
        observation="raw",
        params=params,
        rewards=rewards,
        action_set="v2",
    )
    table = Table(env.slots, options.opponents or {}, ACTION_SETS["v2"], chosen)
    return _played(env, table, seed, clock, on_error)


class _Clock:
    """The number of steps played."""

    steps = 0


def _played(env: FootballEnv, table: Table, seed: int, clock: _Clock, on_error: str) -> Played:
    observation, info = env.reset(seed=seed)
    actions: list[list[int]] = []
    paid = np.zeros(len(env.slots))
    errors: dict[str, OpponentError] = {}
    while "outcome" not in info and not errors:
        table.shown(observation, info)
        try:
            actions.append(table.actions([], env.look, env.action_masks, len(actions)))
        except OpponentError as error:
            if on_error == "raise" or error.side is None:
                raise
            errors[error.side] = error
        else:
            observation, reward, _, _, info = env.step(
                actions[-1] if len(actions[-1]) > 1 else actions[-1][0]
            )
            paid += reward
            clock.steps += 1
    sides = (paid[[agent.team == team for agent in env.slots]] for team in (0, 1))
    left, right = (float(side.mean()) if side.size else 0.0 for side in sides)
    score = (info["score"][0], info["score"][1])
    return Played(
        score=score,
        winner=_winner(score, errors),
        rewards=(left, right),
        length=len(actions),
        outcome=info.get("outcome"),
        seed=seed,
        digest=info["setpiece"]["digest"] if "setpiece" in info else None,
        slots=env.agents,
        actions=np.array(actions, np.int8).reshape(len(actions), len(env.slots)),
        errors=errors,
    )


def _winner(
    score: tuple[int, int], errors: Mapping[str, OpponentError]
) -> Literal["left", "right"] | None:
    if errors:
        return "right" if "left" in errors else "left"
    if score[0] == score[1]:
        return None
    return "left" if score[0] > score[1] else "right"


def _opponent(agent: Agent, clock: _Clock) -> Opponent:
    """An agent as an opponent: plain functions are Kaggle's, others get the default observation."""
    if isinstance(agent, Policy):
        return agent if agent.observation else replace(agent, observation="simple115v2")
    if callable(getattr(agent, "predict", None)) or is_onnx(agent):
        return Policy(agent, "simple115v2")
    if not callable(agent):
        return agent

    def act(raws: Sequence[dict[str, Any]]) -> Any:
        seen = [{key: _jsonable(value) for key, value in raw.items()} for raw in raws]
        given = agent(
            KaggleObservation(players_raw=seen, controlled_players=len(seen), step=clock.steps)
        )
        return [given] if np.ndim(given) == 0 else given

    return Policy(act, observation="raw")


def _jsonable(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value
