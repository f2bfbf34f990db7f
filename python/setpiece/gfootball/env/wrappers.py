"""The wrappers by name: they change what a match shows, pays and dumps."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from operator import index
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from setpiece._errors import ActionError, ParameterError
from setpiece.gfootball.env import football_action_set, observation_preprocessing
from setpiece.gfootball.env._old_gym import ObservationWrapper, RewardWrapper, Wrapper

Env = gymnasium.Env[Any, Any]
BLOCK = 22
"""Values in a block of simple115: x and y of eleven players."""
BLOCKS = ("left_team", "left_team_direction", "right_team", "right_team_direction")
SIMPLE = 115
LUMA = np.array([0.299, 0.587, 0.114])
"""The shares of red, green and blue in gray: ITU-R BT.601, as OpenCV has them."""


def agents_of(env: Env) -> int:
    """How many actions a step of an environment takes."""
    space = env.action_space
    return 1 if isinstance(space, spaces.Discrete) else len(space.nvec)  # type: ignore[attr-defined]


class GetStateWrapper(Wrapper):
    """The outermost wrapper: provides `get_state` and `set_state` of everything inside."""


class PeriodicDumpWriter(Wrapper):
    """Lets only every k-th episode be dumped, starting with the first.

    - `render`: whether these episodes, and no others, are drawn.
    """

    def __init__(self, env: Env, dump_frequency: int, render: bool = False) -> None:
        super().__init__(env)
        if dump_frequency < 1:
            raise ParameterError(
                f"`dump_frequency` is {dump_frequency}; it is 1 or more", name="dump_frequency"
            )
        self._dump_frequency, self._render = dump_frequency, render
        config = env.unwrapped._config  # type: ignore[attr-defined]
        self._asked = {key: config[key] for key in ("dump_full_episodes", "dump_scores")}
        self._episode = 0

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins an episode and returns its observation."""
        dumped = self._episode % self._dump_frequency == 0
        config = self.env.unwrapped._config  # type: ignore[attr-defined]
        config.update(self._asked if dumped else dict.fromkeys(self._asked, False))
        self._episode += 1
        if self._render and dumped:
            self.env.render()
        elif self._render:
            self.env.unwrapped.disable_render()  # type: ignore[attr-defined]
        return super().reset(seed=seed, options=options)


class CheckpointRewardWrapper(Wrapper):
    """Pays an agent's player 0.1 for each of ten regions, once per episode.

    A region pays when the player carries the ball into it. The first begins 0.99 from the point (1,
    0), the last one 0.19. A goal pays what is left.
    """

    NUMBER = 10
    VALUE = 0.1

    def __init__(self, env: Env) -> None:
        super().__init__(env)
        self._collected_checkpoints: dict[int, int] = {}

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins an episode and returns its observation."""
        self._collected_checkpoints = {}
        return super().reset(seed=seed, options=options)

    def step(self, action: Any) -> Any:
        """Plays 100 ms and returns observation, reward, done and info."""
        observation, reward, done, info = self._stepped(action)
        if isinstance(observation, list):
            reward = np.array(
                [
                    self._paid(slot, *pair)
                    for slot, pair in enumerate(zip(observation, reward, strict=True))
                ],
                np.float32,
            )
        return observation, reward, done, info

    def _paid(self, slot: int, seen: dict[str, Any], reward: float) -> float:
        collected = self._collected_checkpoints.get(slot, 0)
        if reward == 1:
            self._collected_checkpoints[slot] = self.NUMBER
            return float(reward) + self.VALUE * (self.NUMBER - collected)
        if seen["ball_owned_team"] != 0 or seen["ball_owned_player"] != seen["active"]:
            return float(reward)
        distance = float(np.hypot(seen["ball"][0] - 1.0, seen["ball"][1]))
        reached = collected
        while reached < self.NUMBER and distance <= 0.99 - 0.8 / (self.NUMBER - 1) * reached:
            reached += 1
        self._collected_checkpoints[slot] = reached
        return float(reward) + self.VALUE * (reached - collected)

    def get_state(self, to_pickle: dict[str, Any] | None = None) -> bytes:
        """Returns the whole state."""
        return super().get_state(
            {**(to_pickle or {}), "CheckpointRewardWrapper": dict(self._collected_checkpoints)}
        )

    def set_state(self, state: bytes) -> dict[str, Any]:
        """Continues from a state of `get_state`."""
        kept = super().set_state(state)
        self._collected_checkpoints = dict(kept.get("CheckpointRewardWrapper", {}))
        return kept


class Simple115StateWrapper(ObservationWrapper):
    """Shows each raw observation as 115 numbers: float32 `(n, 115)`.

    - `fixed_positions`: True for `simple115v2`; False for the older `simple115`, in which the
      blocks of a team with fewer than eleven players move up, and the rest of the 88 numbers is -1.
    """

    def __init__(self, env: Env, fixed_positions: bool = False) -> None:
        super().__init__(env)
        self._fixed_positions = fixed_positions
        self._sent_off_stay = env.unwrapped._config.has_bug("sent_off")  # type: ignore[attr-defined]
        self.observation_space = spaces.Box(-np.inf, np.inf, (agents_of(env), SIMPLE), np.float32)

    def observation(self, observation: Any) -> NDArray[np.float32]:
        """Returns the numbers of raw observations."""
        return Simple115StateWrapper.convert_observation(
            observation, self._fixed_positions, self._sent_off_stay
        )

    @staticmethod
    def convert_observation(
        observation: list[dict[str, Any]], fixed_positions: bool, sent_off_stay: bool = False
    ) -> NDArray[np.float32]:
        """Returns the numbers of raw observations: float32 `(n, 115)`.

        - `observation`: with arrays or lists. Without `*_team_active` everybody plays, without
          `active` nobody is shown as active.
        - `sent_off_stay`: whether players who were sent off keep their last numbers, as in GRF, or
          have -1.
        """
        result = np.zeros((len(observation), SIMPLE), np.float32)
        for row, seen in zip(result, observation, strict=True):
            row[: 4 * BLOCK] = -1.0
            at = 0
            for number, block in enumerate(BLOCKS):
                values = np.asarray(seen[block], np.float64)
                if not sent_off_stay:
                    playing = observation_preprocessing.playing(
                        seen, block.removesuffix("_direction")
                    )
                    values = np.where(playing[:, None], values, -1.0)
                values = values.ravel()
                at = number * BLOCK if fixed_positions else at
                row[at : at + len(values)] = values
                at += len(values)
            row[88:91] = seen["ball"]
            row[91:94] = seen["ball_direction"]
            row[94 + seen["ball_owned_team"] + 1] = 1.0
            if seen.get("active", -1) != -1:
                row[97 + seen["active"]] = 1.0
            row[108 + seen["game_mode"]] = 1.0
        return result


class SMMWrapper(ObservationWrapper):
    """Shows each raw observation as a minimap: uint8 `(n, height, width, 4)`.

    - `channel_dimensions`: width and height.
    """

    def __init__(
        self,
        env: Env,
        channel_dimensions: tuple[int, int] = (
            observation_preprocessing.SMM_WIDTH,
            observation_preprocessing.SMM_HEIGHT,
        ),
    ) -> None:
        super().__init__(env)
        self._channel_dimensions = check_dimensions(channel_dimensions)
        width, height = self._channel_dimensions
        layers = len(observation_preprocessing.get_smm_layers())
        self.observation_space = spaces.Box(
            0, 255, (agents_of(env), height, width, layers), np.uint8
        )

    def observation(self, observation: Any) -> NDArray[np.uint8]:
        """Returns the minimaps of raw observations."""
        config = self.env.unwrapped._config  # type: ignore[attr-defined]
        return observation_preprocessing.generate_smm(observation, config, self._channel_dimensions)


class PixelsStateWrapper(ObservationWrapper):
    """Shows the match as a picture: uint8 `(n, height, width, 3)`, or `(n, height, width, 1)`.

    All of the agent's players see the same picture. It is drawn at its size, which needs no display
    and no `render`.

    - `grayscale`: whether it is gray.
    - `channel_dimensions`: width and height.
    """

    def __init__(
        self, env: Env, grayscale: bool = True, channel_dimensions: tuple[int, int] = (96, 72)
    ) -> None:
        super().__init__(env)
        self._grayscale, self._size = bool(grayscale), check_dimensions(channel_dimensions)
        width, height = self._size
        shape = (agents_of(env), height, width, 1 if grayscale else 3)
        self.observation_space = spaces.Box(0, 255, shape, np.uint8)

    def observation(self, observation: Any) -> NDArray[np.uint8]:
        """Returns the picture, once for each raw observation."""
        picture: NDArray[np.uint8] = self.env.unwrapped.picture(self._size)  # type: ignore[attr-defined]
        if self._grayscale:
            picture = (picture @ LUMA).round().astype(np.uint8)[..., None]
        return np.repeat(picture[None], len(observation), axis=0)


class SingleAgentObservationWrapper(ObservationWrapper):
    """Removes the axis of agents."""

    def __init__(self, env: Env) -> None:
        super().__init__(env)
        space = env.observation_space
        if not isinstance(space, spaces.Box):
            raise ParameterError("only an array has an axis of agents", name="representation")
        self.observation_space = spaces.Box(space.low[0], space.high[0], dtype=space.dtype.type)

    def observation(self, observation: Any) -> Any:
        """Returns the first agent's part."""
        return observation[0]


class SingleAgentRewardWrapper(RewardWrapper):
    """Pays one agent a number instead of an array."""

    def reward(self, reward: Any) -> Any:
        """Returns the first agent's part."""
        return reward[0]


class FrameStack(Wrapper):
    """Shows the last observations, oldest first, on the last axis; the first one fills the stack."""

    def __init__(self, env: Env, stack: int = 4) -> None:
        super().__init__(env)
        space = env.observation_space
        if not isinstance(space, spaces.Box):
            raise ParameterError(
                "only arrays can be stacked, raw observations can't", name="stacked"
            )
        self._seen: deque[NDArray[Any]] = deque(maxlen=stack)
        low, high = (np.concatenate([bound] * stack, axis=-1) for bound in (space.low, space.high))
        self.observation_space = spaces.Box(low, high, dtype=space.dtype.type)

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins an episode and returns its observation."""
        first = super().reset(seed=seed, options=options)
        self._seen.extend([first] * (self._seen.maxlen or 1))
        return self._shown()

    def step(self, action: Any) -> Any:
        """Plays 100 ms and returns observation, reward, done and info."""
        observation, reward, done, info = self._stepped(action)
        # Before the first `reset` nothing was seen.
        self._seen.extend([observation] * (1 if self._seen else self._seen.maxlen or 1))
        return self._shown(), reward, done, info

    def get_state(self, to_pickle: dict[str, Any] | None = None) -> bytes:
        """Returns the whole state."""
        return super().get_state({**(to_pickle or {}), "FrameStack": list(self._seen)})

    def set_state(self, state: bytes) -> dict[str, Any]:
        """Continues from a state of `get_state`."""
        kept = super().set_state(state)
        self._seen.extend(kept.get("FrameStack", []))
        return kept

    def _shown(self) -> NDArray[Any]:
        return np.concatenate(list(self._seen), axis=-1)


class MultiAgentToSingleAgent(Wrapper):
    """Turns an agent that plays all players into one per side.

    It plays the designated player, and the engine's bot plays the others.

    - `left_players`, `right_players`: how many the agent inside plays on each side.

    Observations, actions and rewards have one part per side that has players.
    """

    def __init__(self, env: Env, left_players: int, right_players: int) -> None:
        super().__init__(env)
        self._sides = [
            range(start, start + count)
            for start, count in ((0, left_players), (left_players, right_players))
            if count
        ]
        self._chosen: list[int] = []
        inner = env.action_space
        number = int(inner.n if isinstance(inner, spaces.Discrete) else inner.nvec[0])  # type: ignore[attr-defined]
        self.action_space = (
            spaces.Discrete(number)
            if len(self._sides) == 1
            else spaces.MultiDiscrete(np.full(len(self._sides), number, np.int64))
        )
        space = env.observation_space
        if isinstance(space, spaces.Tuple):
            self.observation_space = spaces.Tuple([space[side[0]] for side in self._sides])

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:
        """Begins an episode and returns its observation."""
        return self._of(super().reset(seed=seed, options=options))

    def step(self, action: Any) -> Any:
        """Plays 100 ms and returns observation, reward, done and info."""
        if not self._chosen:  # Before the first `reset`.
            self._of(self.env.unwrapped.observation())  # type: ignore[attr-defined]
        given = (
            list(action)
            if hasattr(action, "__len__") and getattr(action, "ndim", 1) != 0
            else [action]
        )
        if len(given) != len(self._chosen):
            raise ActionError(f"expected {len(self._chosen)} actions, found {len(given)}")
        actions: list[Any] = [football_action_set.action_builtin_ai] * sum(map(len, self._sides))
        for slot, each in zip(self._chosen, given, strict=True):
            actions[slot] = each
        observation, reward, done, info = self._stepped(actions)
        paid = np.array([reward[side[0]] for side in self._sides], np.float32)
        return self._of(observation), paid, done, info

    def set_state(self, state: bytes) -> dict[str, Any]:
        """Continues from a state of `get_state`."""
        kept = super().set_state(state)
        self._of(self.env.unwrapped.observation())  # type: ignore[attr-defined]
        return kept

    def _of(self, observation: list[dict[str, Any]]) -> list[dict[str, Any]]:
        """The designated players' observations; a team's first if there is none."""
        self._chosen = [
            next(
                (
                    slot
                    for slot in side
                    if observation[slot]["active"] == observation[slot]["designated"]
                ),
                side[0],
            )
            for side in self._sides
        ]
        return [observation[slot] for slot in self._chosen]


def check_dimensions(dimensions: Any) -> tuple[int, int]:
    """Returns the width and height of a minimap.

    Raises `ParameterError` for anything but two integers from 1 on.
    """
    try:
        width, height = (index(each) for each in dimensions)
        if width < 1 or height < 1:
            raise ValueError
    except (TypeError, ValueError):
        raise ParameterError(
            f"`channel_dimensions` is {dimensions!r}; it is a width and a height",
            name="channel_dimensions",
        ) from None
    return width, height
