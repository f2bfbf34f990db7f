"""The environment without wrappers: players, actions and observations, as in old Gym."""

from __future__ import annotations

import importlib
import pickle
import random
import sys
import time
from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from setpiece._errors import ParameterError, SetpieceError, SnapshotError
from setpiece._window import Window
from setpiece._words import check_word, similar
from setpiece.gfootball.env._old_gym import Stepped, refuse_seed
from setpiece.gfootball.env.config import Config, parse_player_definition
from setpiece.gfootball.env.football_action_set import (
    CoreAction,
    get_action_set,
    named_action_from_action_set,
)
from setpiece.gfootball.env.football_env_core import FootballEnvCore
from setpiece.gfootball.env.observation_processor import ObservationProcessor, trace_of
from setpiece.gfootball.env.observation_rotation import flip_observation, flip_single_action
from setpiece.gfootball.env.player_base import PlayerBase
from setpiece.gfootball.env.players.agent import Player as Agent

PLAYERS = ("agent", "bot", "builtin_ai", "gamepad", "keyboard", "lazy", "ppo2_cnn", "replay")
MANY = 2**31 - 1
"""The largest count in an observation's space."""
PLAYER_PACKAGES = ("setpiece.gfootball.env.players", "gfootball.env.players")


class FootballEnv(gymnasium.Env[Any, Any]):
    """A match whose players are played as `config["players"]` says.

    - `reset()` returns the raw observations of the agent's players: a list of dicts, the left
      team's first; without an agent the whole match as one dict.
    - `step(action)` takes one action, or one for each of the agent's players: numbers of the action
      set or `CoreAction`s. It returns observation, reward, done and info. The reward is float32
      `(n,)`, +1 for a goal of the player's team; without an agent a float, for the left team.
      `info` has `score_reward`, for the left team, and if dumps were completed `dumps`: a list of
      `{"name", "dump"}`.

    `step` before the first `reset` plays the episode that the constructor begins, as in GRF. Raises
    `ActionError` for other actions, and `gymnasium.error.ResetNeeded` after the end of an episode
    and after `close`.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 10}

    def __init__(self, config: Config) -> None:
        self._config = config
        self._core = FootballEnvCore(config)
        self._agent: Agent | None = None
        self._agent_slots: list[int] = []
        self._rendering = False
        self._window: Window | None = None
        self._players = self._make_players()
        count = len(self._agent_slots)
        actions = len(get_action_set(config))
        self.action_space = (
            spaces.Discrete(actions)
            if count == 1
            else spaces.MultiDiscrete(np.full(count, actions, np.int64))
        )
        self._core.reset(inc=0)
        self.observation_space = _raw_space(self.observation())
        self._processor = ObservationProcessor(config)

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins the next episode and returns its first observation."""
        refuse_seed(seed, options)
        self._core.reset()
        self._processor = ObservationProcessor(self._config)
        for player, _, _ in self._players:
            player.reset()
        self._show()
        return self.observation()

    def step(self, action: Any) -> Stepped:  # type: ignore[override]
        """Plays 100 ms; see the class."""
        if self._core.done:
            raise gymnasium.error.ResetNeeded(
                "call `reset` before `step`: no episode is being played"
            )
        chosen = self._actions(action)
        reward = self._core.step(chosen)
        core = self._core
        trace = trace_of(
            chosen, core.step_count, reward, core.cumulative_reward, time.time(), core.whole
        )
        info: dict[str, Any] = {"score_reward": reward}
        moments = core.moments() if self._config["write_video"] else []
        dumps = self._processor.add(trace, reward, core.done, moments)
        if dumps:
            info["dumps"] = dumps
        self._show()
        if self._agent is None:
            return self.observation(), reward, self._core.done, info
        left = self._agent.num_controlled_left_players()
        right = self._agent.num_controlled_right_players()
        return (
            self.observation(),
            np.array([reward] * left + [-reward] * right, np.float32),
            self._core.done,
            info,
        )

    def observation(self) -> Any:
        """Returns the current observation, without playing."""
        # Copies: dumps keep the match without frames.
        seen = dict(self._core.whole) if self._agent is None else self._agent_observations()
        if self._rendering:
            frame = self.picture()
            for each in [seen] if isinstance(seen, dict) else seen:
                each["frame"] = frame
        return seen

    def picture(
        self, size: tuple[int, int] | None = None, *, news: bool = False
    ) -> NDArray[np.uint8]:
        """Returns a picture of the match, uint8 `(height, width, 3)`, red, green, blue.

        - `size`: width and height; None: `render_resolution_x` and `render_resolution_y`.
        - `news`: whether a banner shows what has just happened. Without it the picture depends on
          the state alone, as an observation should.
        """
        config = self._config
        own = config["render_resolution_x"], config["render_resolution_y"]
        return self._core.picture(own if size is None else size, news=news)

    def seed(self, seed: int | None = None) -> list[int]:
        """Draws the seeds of future episodes from a separate stream; returns the stream's seed."""
        number = random.randrange(2**31) if seed is None else int(seed)
        self._config.draw = random.Random(number).randint
        return [number]

    def write_dump(self, name: str) -> str | None:
        """Dumps the last 100 steps under a name, once per episode; returns the path, or None."""
        return self._processor.write_dump(name)

    def get_state(self, to_pickle: dict[str, Any] | None = None) -> bytes:
        """Returns the whole state: the match, and the content of `to_pickle` from wrappers."""
        state = {
            "level": self._config["level"],
            "core": self._core.state(),
            "wrappers": dict(to_pickle or {}),
        }
        # Twice, so that the identity of equal objects doesn't affect the bytes.
        return pickle.dumps(pickle.loads(pickle.dumps(state)))

    def set_state(self, state: bytes) -> dict[str, Any]:
        """Continues from a state of `get_state` and returns what wrappers had put into it.

        Unpickling runs code from the bytes: only set states that you trust. Raises `SnapshotError`
        for anything but a state of the same level and numbers of players, and compile errors if its
        source can't be read; nothing has changed then.
        """
        try:
            read = pickle.loads(state)
            level, core, wrappers = read["level"], read["core"], read["wrappers"]
        except Exception as error:
            raise SnapshotError("these bytes are no state of `get_state`, or damaged") from error
        if level != self._config["level"]:
            raise SnapshotError(f"the state is one of `{level}`, not of `{self._config['level']}`")
        try:
            self._core.set_state(core)
        except SetpieceError:
            raise
        except (TypeError, ValueError, LookupError) as error:
            raise SnapshotError(f"the state is damaged: {error}") from error
        kept: dict[str, Any] = wrappers
        return kept

    def render(self, mode: str = "human") -> Any:
        """Begins to draw: from now on raw observations have `frame`, uint8 `(height, width, 3)`.

        - `"human"`: every step is also shown in a window (needs `setpiece[human]`); returns True.
        - `"rgb_array"`: returns the current picture. (GRF returns it with red and blue swapped.)

        `disable_render` ends it.
        """
        mode = check_word("mode", mode, ("human", "rgb_array"))
        if mode == "human" and self._window is None:
            self._window = Window(str(self._config["level"]), self.metadata["render_fps"])
        self._rendering = True
        if mode == "rgb_array":
            return self.picture(news=True)
        self._show()
        return True

    @property
    def window_closed(self) -> bool:
        """Whether the user has closed the window that `render` opened."""
        return self._window is not None and self._window.closed

    def disable_render(self) -> bool:
        """Ends drawing, closes the window and returns True."""
        self._rendering = False
        if self._window is not None:
            self._window.close()
            self._window = None
        return True

    def _show(self) -> None:
        if self._window is not None and self._rendering:
            self._window.show(self.picture(news=True))

    def tracker_setup(self, start: int, end: int) -> None:
        """No-op.

        GRF's tracker finds where two runs diverge. Here compare `get_state` of both, step by step.
        """
        del start, end

    def close(self) -> None:
        """Releases the match and closes the window; `reset` begins another."""
        self._core.done = True
        if self._window is not None:
            self._window.close()

    def _make_players(self) -> list[tuple[PlayerBase, list[int], int]]:
        """Returns each player with their slots, and how many of those are on the left.

        Slots are assigned in order.
        """
        definitions = [parse_player_definition(each) for each in self._config["players"]]
        left, right = 0, self._config.number_of_left_players()
        made: list[tuple[PlayerBase, list[int], int]] = []
        counts: dict[str, int] = {}
        for name, settings in definitions:
            ordinal = counts.get(name, 0)
            counts[name] = ordinal + 1
            settings = {
                **settings,
                "index": left if settings["left_players"] else right,
                f"player_{name}": ordinal,
            }
            player = _player_class(name)(settings, self._config)
            lefts, rights = (
                player.num_controlled_left_players(),
                player.num_controlled_right_players(),
            )
            slots = [*range(left, left + lefts), *range(right, right + rights)]
            left, right = left + lefts, right + rights
            made.append((player, slots, lefts))
            if name == "agent":
                self._agent, self._agent_slots = player, slots
        if self._agent is not None and not self._agent_slots:
            self._agent = None
        return made

    def _agent_observations(self) -> list[dict[str, Any]]:
        return [dict(self._core.slots[slot]) for slot in self._agent_slots]

    def _actions(self, action: Any) -> list[CoreAction]:
        """Every slot's action, in the frame of the pitch."""
        actions = get_action_set(self._config)
        slots = self._core.slots
        chosen: list[CoreAction] = [actions[0]] * len(slots)
        if self._agent is not None:
            self._agent.set_action(action)
        for player, own, lefts in self._players:
            if not own:
                continue
            turned = player.can_play_right()
            views = [
                flip_observation(slots[slot], self._config)
                if turned and at >= lefts
                else dict(slots[slot])
                for at, slot in enumerate(own)
            ]
            taken = player.take_action(views)
            taken = taken if isinstance(taken, (list, tuple, np.ndarray)) else [taken]
            for at, (slot, each) in enumerate(zip(own, taken, strict=True)):
                named = named_action_from_action_set(actions, each)
                chosen[slot] = (
                    flip_single_action(named, self._config) if at >= lefts and not turned else named
                )
        return chosen


def _player_class(name: str) -> Any:
    """Returns the class `Player` of a module below `players`; `ParameterError` if it is unknown."""
    for package in PLAYER_PACKAGES:
        if package.split(".", 1)[0] not in sys.modules:
            continue
        module = f"{package}.{name}"
        try:
            return importlib.import_module(module).Player
        except ModuleNotFoundError as error:
            if error.name not in (module, package, *(package.rsplit(".", n)[0] for n in (1, 2))):
                raise
    raise ParameterError(
        f"no player `{name}`; there are `{'`, `'.join(PLAYERS)}`",
        name="players",
        help=similar(name, PLAYERS),
    )


def _raw_space(shown: Any) -> spaces.Space[Any]:
    """The space of raw observations, with GRF's infinite bounds.

    A list of dicts, one for each of the agent's players, or without an agent the dict of the whole
    match.
    """
    if isinstance(shown, dict):
        return spaces.Dict(
            {
                key: spaces.MultiDiscrete([MANY, MANY]) if key == "score" else _raw_space(value)
                for key, value in shown.items()
            }
        )
    if isinstance(shown, list):
        return spaces.Tuple([_raw_space(each) for each in shown])
    if not isinstance(shown, np.ndarray):
        return spaces.Discrete(MANY, start=-1)
    if shown.dtype == np.bool_ or shown.dtype == np.uint8:
        return spaces.Box(0, 1, shown.shape, shown.dtype.type)
    if shown.dtype.kind == "i":
        return spaces.Box(0, MANY, shown.shape, shown.dtype.type)
    return spaces.Box(-np.inf, np.inf, shown.shape, np.float64)
