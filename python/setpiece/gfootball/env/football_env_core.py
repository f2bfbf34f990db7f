"""The match itself: episodes of a config's scenario, seen as a whole and by each slot."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

import setpiece
from setpiece import _native
from setpiece._errors import ParameterError, SnapshotError
from setpiece.gfootball._translation import LIMIT_MAX
from setpiece.gfootball.env import football_action_set as actions
from setpiece.gfootball.env._whole_match import slot_view, whole_match
from setpiece.gfootball.env.football_action_set import NUMBERS, CoreAction, get_sticky_actions
from setpiece.gfootball.env.observation_rotation import flip_observation, flip_single_action
from setpiece.gfootball.env.scenario_builder import Source
from setpiece.gfootball.env.scenario_config import ScenarioConfig

if TYPE_CHECKING:
    from setpiece.gfootball.env.config import Config

STEP_S = 0.1
STALLED = 20
"""Steps after which a pending set piece is taken for the agents."""
TURNING = 30
"""Steps after which its taker is sent the other way."""

Clock = tuple[int | None, int | None]
"""The steps of an episode and those before its second half, or None."""

_KINDS = {
    "snapshot": bytes,
    "waiting": int,
    "step_count": int,
    "cumulative_reward": float,
    "done": bool,
}
"""Types of the parts of a state that are stored unchanged."""

# Where GRF assumes that the players of a team stand, by index, when it assigns the slots of the
# first observation: to the players nearest the centre spot.
_TEMPLATE = (
    *((-1.0, 0.0), (-0.74, 0.77), (-1.0, 0.25), (-1.0, -0.25), (-0.74, -0.77), (0.05, 0.42)),
    *((-0.23, 0.0), (0.05, -0.42), (0.36, 0.85), (1.0, 0.0), (0.36, -0.85)),
)
_CENTRAL = [x * x + y * y for x, y in _TEMPLATE]


class AgentCountError(ParameterError, AssertionError):
    """The scenario has `control_all_players`, but agents play only a part of a team.

    It is an `AssertionError` in GRF.
    """


class FootballEnvCore:
    """A match with a slot for each played player, the left team's first.

    Slots in excess of the controllable players have none: they see the match with `active` -1.
    """

    def __init__(self, config: Config) -> None:
        self._config = config
        self._asked = config.number_of_left_players(), config.number_of_right_players()
        self._played = (1, 0)
        self._env: setpiece.FootballEnv | None = None
        self._source: Source | None = None
        self._clock: Clock = (None, None)
        self._swapped = False
        self.slots: list[dict[str, Any]] = []
        """What each slot sees, in its team's own frame."""
        self.whole: dict[str, Any] = {}
        """The whole match, in the frame of the pitch."""
        self.score = (0, 0)
        self.waiting = 0
        self.step_count = -1
        self.cumulative_reward = 0.0
        self.done = True
        self._next_frame = 0.0

    def reset(self, inc: int = 1) -> None:
        """Begins the next episode, or with `inc=0` the same one again."""
        config = self._config
        config.NewScenario(inc)
        recorded = config.ScenarioConfig()
        _check_agents(recorded)
        swapped = recorded.reverse_team_processing and _is_symmetric(recorded)
        clock = _length(recorded), _half_time(recorded)
        self._enter(config.Scenario().source, clock, self._playable(recorded), swapped)
        assert self._env is not None
        observed, info = self._env.reset(
            seed=recorded.game_engine_random_seed, options={"episode": config["episode_number"] % 2}
        )
        self.waiting, self.step_count, self.cumulative_reward, self.done = 0, -1, 0.0, False
        self._see(observed, info)
        if config.has_bug("first_active"):
            self._first_active(recorded)

    def step(self, chosen: Sequence[CoreAction]) -> float:
        """Plays 100 ms with an action for each slot; returns the change of the left team's lead.

        Actions are in the frame of the pitch.
        """
        if self.done or self._env is None:
            raise gymnasium.error.ResetNeeded(
                "call `reset` before `step`: no episode is being played"
            )
        numbers = self._numbers(self._hurried(chosen))
        observed, _, terminated, truncated, info = self._env.step(
            numbers[0] if len(numbers) == 1 else numbers
        )
        lead = self.score[0] - self.score[1]
        self._see(observed, info)
        reward = float(self.score[0] - self.score[1] - lead)
        self.step_count += 1
        self.cumulative_reward += reward
        self.waiting = self.waiting + 1 if self.whole["game_mode"] != 0 else 0
        self.done = terminated or truncated
        if self._config["real_time"]:
            self._pace()
        return reward

    def state(self) -> dict[str, Any]:
        """Returns everything needed to continue the match."""
        assert self._env is not None
        assert self._source is not None
        source = self._source
        return {
            "source": (source.name, source.text, source.folder),
            "clock": self._clock,
            "played": self._played,
            "swapped": self._swapped,
            "agents": self._asked,
            "snapshot": self._env.snapshot(),
            "waiting": self.waiting,
            "step_count": self.step_count,
            "cumulative_reward": self.cumulative_reward,
            "done": self.done,
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Continues from a state; raises `SnapshotError` for other slots or another scenario.

        Nothing has changed then. A damaged state raises it too, or a `TypeError`, `ValueError` or
        `LookupError`.
        """
        if tuple(state["agents"]) != self._asked:
            raise SnapshotError(
                f"the state has {state['agents']} played players, this environment {self._asked}"
            )
        for part, kind in _KINDS.items():
            if not isinstance(state[part], kind):
                raise SnapshotError(f"the state is damaged: its `{part}` is {state[part]!r}")
        source = Source(*state["source"])
        if self._source is None or source.name != self._source.name:
            raise SnapshotError(
                f"the state is one of `{source.name}`, not of `{self._config['level']}`"
            )
        before = self._env, self._source, self._clock, self._played, self._swapped
        try:
            self._enter(source, state["clock"], state["played"], state["swapped"])
            assert self._env is not None
            observed, info = self._env.restore(state["snapshot"])
        except Exception:
            self._env, self._source, self._clock, self._played, self._swapped = before
            raise
        self.waiting, self.step_count = state["waiting"], state["step_count"]
        self.cumulative_reward, self.done = state["cumulative_reward"], state["done"]
        self._see(observed, info)

    def _enter(self, source: Source, clock: Clock, played: tuple[int, int], swapped: bool) -> None:
        """Makes the environment of a scenario, unless it is the current one.

        With `swapped` the left slots play the engine's right team.
        """
        wanted = source, clock, played, swapped
        if self._env is None or wanted != (self._source, self._clock, self._played, self._swapped):
            left, right = reversed(played) if swapped else played
            scenario = source.compiled(str(left), str(right), *clock)
            self._env = setpiece.FootballEnv(
                scenario, observation="raw", rewards=[], action_set="full"
            )
            self._source, self._clock, self._played, self._swapped = wanted

    def _playable(self, recorded: ScenarioConfig) -> tuple[int, int]:
        """How many slots the engine has: at least one, because somebody must see the match."""
        left = min(self._asked[0], recorded.controllable_left_players)
        right = min(self._asked[1], recorded.controllable_right_players)
        if left + right == 0:
            return (1, 0) if recorded.controllable_left_players else (0, 1)
        return left, right

    def _see(self, observed: Any, info: dict[str, Any]) -> None:
        """Stores what the engine shows."""
        self.score = (info["score"][0], info["score"][1])
        left, right = self._played
        views = [
            self._view(each) for each in (observed if isinstance(observed, tuple) else (observed,))
        ]
        if self._swapped:
            self.score = (info["score"][1], info["score"][0])
            views = views[right:] + views[:right]
        first = views[0] if left else flip_observation(views[0], self._config)
        asked_left, asked_right = self._asked
        own = views[:left][:asked_left]
        other = views[left:][:asked_right]
        nobody = {**first, "active": -1, "sticky_actions": _nothing_held(self._config)}
        if len(own) < asked_left:
            own += [nobody] * (asked_left - len(own))
        if len(other) < asked_right:
            designated = other[0]["designated"] if other else -1
            turned = {**flip_observation(nobody, self._config), "designated": designated}
            other += [turned] * (asked_right - len(other))
        self.slots = own + other
        self.whole = whole_match(first, own, other, self._config, seen_by_left=left > 0)

    def _view(self, native: dict[str, Any]) -> dict[str, Any]:
        """A slot's observation with GRF's types."""
        return slot_view(native, self._config)

    def _hurried(self, chosen: Sequence[CoreAction]) -> list[CoreAction]:
        """The actions; one that takes a set piece if it has waited for too long."""
        if self.waiting < STALLED:
            return list(chosen)
        if self.waiting == STALLED:
            return [actions.action_short_pass] * len(chosen)
        hurried = [actions.action_idle] * len(chosen)
        left = self._asked[0]
        for number, slot in enumerate(self.slots):
            if slot["ball_owned_team"] == 0 and slot["active"] == slot["ball_owned_player"]:
                onwards = (number < left) == (self.waiting < TURNING)
                hurried[number] = actions.action_right if onwards else actions.action_left
        return hurried

    def _numbers(self, chosen: Sequence[CoreAction]) -> list[int]:
        """The engine's numbers of the actions of slots with a player, in their own frames."""
        left, right = self._played
        asked_left, asked_right = self._asked
        if asked_left + asked_right == 0 or not self.slots:
            return [NUMBERS["builtin_ai"]]
        own = list(chosen[:asked_left])[:left]
        other = [flip_single_action(action, self._config) for action in chosen[asked_left:]][:right]
        if not own and not other:
            return [NUMBERS["builtin_ai"]]
        ordered = (*other, *own) if self._swapped else (*own, *other)
        return [NUMBERS[action.name] for action in ordered]

    def _first_active(self, recorded: ScenarioConfig) -> None:
        """Makes the first observation show GRF's active players.

        GRF assigns the slots by a layout in which nobody actually stands.
        """
        teams = (recorded.left_team, recorded.right_team)
        slots = [self.slots[: self._asked[0]], self.slots[self._asked[0] :]]
        for side, (entries, views) in enumerate(zip(teams, slots, strict=True)):
            playable = [number for number, entry in enumerate(entries) if entry.controllable]
            if not 0 < len(views) < len(playable):
                continue
            dealt = sorted(sorted(playable, key=lambda number: _CENTRAL[number])[: len(views)])
            slots[side] = [
                {**view, "active": number} for view, number in zip(views, dealt, strict=True)
            ]
            self.whole[f"{('left', 'right')[side]}_agent_controlled_player"] = dealt
        self.slots = slots[0] + slots[1]

    def moments(self) -> list[_native.Moment]:
        """Returns what the last step led to, to be kept for a video."""
        return [] if self._env is None else self._env.moments()

    def picture(self, size: tuple[int, int], *, news: bool) -> NDArray[np.uint8]:
        """Returns a picture of the match, uint8 `(height, width, 3)`, with `news` or without."""
        if self._env is None:
            raise gymnasium.error.ResetNeeded("call `reset`: there is nothing to be seen yet")
        return self._env.picture(size, news=news)

    def _pace(self) -> None:
        """Waits until the step's time has passed."""
        now = time.monotonic()
        if self._next_frame < now - STEP_S:
            self._next_frame = now
        self._next_frame += STEP_S
        time.sleep(max(0.0, self._next_frame - now))


def _check_agents(recorded: ScenarioConfig) -> None:
    """Raises `AgentCountError` if agents play only a part of a team that they must play whole."""
    if not recorded.control_all_players or not recorded.dynamic_player_selection:
        return
    left, right = recorded.controllable_left_players, recorded.controllable_right_players
    raise AgentCountError(
        f"this scenario needs agents for no player of a team or for all of them, found {recorded.left_agents} of {left}"
        f" on the left and {recorded.right_agents} of {right} on the right",
        name="players",
        help=f"ask for 0 or {left} on the left, and for 0 or {right} on the right",
    )


def _nothing_held(config: Config) -> Any:
    return np.zeros(len(get_sticky_actions(config)), np.uint8)


def _is_symmetric(recorded: ScenarioConfig) -> bool:
    """Whether both teams start alike, so that only GRF's processing order distinguishes them."""
    left, right = (
        [(entry.position, entry.role, entry.lazy, entry.controllable) for entry in team]
        for team in (recorded.left_team, recorded.right_team)
    )
    alike = left == right and recorded.left_team_difficulty == recorded.right_team_difficulty
    return alike and not any(recorded.ball_position[:2])


def _half_time(recorded: ScenarioConfig) -> int | None:
    """The steps before half-time, or None: GRF plays one more than it says."""
    return (
        recorded.second_half + 1
        if recorded.second_half < min(recorded.game_duration, LIMIT_MAX)
        else None
    )


def _length(recorded: ScenarioConfig) -> int | None:
    """The steps of an episode: GRF plays one more than it says."""
    return recorded.game_duration + 1 if recorded.game_duration < LIMIT_MAX else None
