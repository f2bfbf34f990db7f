"""Environments as Google Research Football makes them.

>>> import setpiece.gfootball.env as football_env
>>> env = football_env.create_environment("academy_empty_goal_close", representation="simple115v2")
>>> env.reset().shape
(115,)
>>> observation, reward, done, info = env.step(5)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import gymnasium

from setpiece._errors import ParameterError
from setpiece._words import check_word, similar
from setpiece.gfootball._unavailable import unavailable
from setpiece.gfootball.env import config as _config
from setpiece.gfootball.env import (
    football_action_set,
    football_env,
    observation_preprocessing,
    wrappers,
)
from setpiece.gfootball.env.config import Config
from setpiece.gfootball.env.football_env import FootballEnv

__all__ = [
    "create_environment",
    "create_remote_environment",
    "football_action_set",
    "football_env",
    "observation_preprocessing",
    "wrappers",
]

Env = gymnasium.Env[Any, Any]
REPRESENTATIONS = ("extracted", "simple115", "simple115v2", "raw", "pixels", "pixels_gray")
REWARDS = ("scoring", "checkpoints")


def create_environment(
    env_name: str = "",
    stacked: bool = False,
    representation: str = "extracted",
    rewards: str = "scoring",
    write_goal_dumps: bool = False,
    write_full_episode_dumps: bool = False,
    render: bool = False,
    write_video: bool = False,
    dump_frequency: int = 1,
    logdir: str | PathLike[str] = "",
    extra_players: Sequence[str] | None = None,
    number_of_left_players_agent_controls: int = 1,
    number_of_right_players_agent_controls: int = 0,
    channel_dimensions: tuple[int, int] = (
        observation_preprocessing.SMM_WIDTH,
        observation_preprocessing.SMM_HEIGHT,
    ),
    other_config_options: Mapping[str, Any] | None = None,
) -> Any:
    """Makes an environment with the interface of old Gym: `step` returns four values.

    - `env_name`: a level of the library, a module or file with a `build_scenario`, or the path of a
      `.pitch` file.
    - `stacked`: whether the last four observations are shown, on the last axis; not for `raw`.
    - `representation`: `"extracted"` (uint8 `(72, 96, 4)`), `"simple115v2"` and `"simple115"`
      (float32 `(115,)`), or `"raw"` (a list of dicts). If the agent has n > 1 players, an array
      gains a leading axis n, and the reward is float32 `(n,)`.
    - `rewards`: `"scoring"` or `"scoring,checkpoints"`.
    - `write_goal_dumps`, `write_full_episode_dumps`, `dump_frequency`, `logdir`: what is dumped,
      how often and where.
    - `extra_players`: definitions of further players, such as `"bot:right_players=1"`.
    - `number_of_left_players_agent_controls`, `number_of_right_players_agent_controls`: how many
      the agent plays.
    - `channel_dimensions`: width and height of `extracted`.
    - `other_config_options`: further settings of `Config`.

    Raises `ParameterError` (a `ValueError`) for an impossible value, `UnknownScenarioError`,
    `FileError` or `CompileError` for the scenario, and `UnavailableError` for `render`,
    `write_video` and the pixels: pictures aren't supported in this version.
    """
    if not isinstance(env_name, str) or not env_name:
        raise ParameterError(
            "`env_name` is empty"
            if env_name == ""
            else f"`env_name` is {env_name!r}; it is a name",
            name="env_name",
            help="name a level, for example `academy_3_vs_1_with_keeper`",
        )
    if other_config_options is not None and not isinstance(other_config_options, Mapping):
        raise ParameterError(
            f"expected `other_config_options` as a mapping, found `{other_config_options!r}`",
            name="other_config_options",
        )
    check_word("representation", representation, REPRESENTATIONS)
    checkpoints = "checkpoints" in _check_rewards(rewards)
    if stacked and representation == "raw":
        raise ParameterError("raw observations can't be stacked", name="stacked")
    left = _check_count(
        "number_of_left_players_agent_controls", number_of_left_players_agent_controls
    )
    right = _check_count(
        "number_of_right_players_agent_controls", number_of_right_players_agent_controls
    )
    frequency = _check_count("dump_frequency", dump_frequency, 1)
    dimensions = wrappers.check_dimensions(channel_dimensions)
    folder = _config.check_folder("logdir", logdir)
    values: dict[str, Any] = {
        "dump_full_episodes": bool(write_full_episode_dumps),
        "dump_scores": bool(write_goal_dumps),
        "level": env_name,
        "write_video": bool(write_video),
        **({"tracesdir": folder} if folder else {}),
    }
    options = dict(other_config_options or {})
    slots = _slots(options.get("level", env_name), left, right)
    agent = f"agent:left_players={slots[0]},right_players={slots[1]}"
    env: Env = FootballEnv(
        Config({**values, "players": [agent, *_check_players(extra_players)], **options})
    )
    if slots != (left, right) and "players" not in options:
        env = wrappers.MultiAgentToSingleAgent(env, *slots)
    if frequency > 1:
        env = wrappers.PeriodicDumpWriter(env, frequency, render=bool(render))
    elif render:
        env.render()
    if checkpoints:
        env = wrappers.CheckpointRewardWrapper(env)
    return wrappers.GetStateWrapper(
        _shown(env, wrappers.agents_of(env), representation, dimensions, stacked)
    )


def _shown(
    env: Env, agents: int, representation: str, channel_dimensions: tuple[int, int], stacked: bool
) -> Env:
    """Wraps an environment to show a representation; without an agent, the whole match."""
    if agents == 0:
        if stacked:
            raise ParameterError(
                "there is no agent whose observations could be stacked", name="stacked"
            )
        return env
    if representation.startswith("simple115"):
        env = wrappers.Simple115StateWrapper(env, fixed_positions=representation == "simple115v2")
    elif representation.startswith("pixels"):
        env = wrappers.PixelsStateWrapper(env, "gray" in representation, channel_dimensions)
    elif representation == "extracted":
        env = wrappers.SMMWrapper(env, channel_dimensions)
    if agents == 1:
        if representation != "raw":
            env = wrappers.SingleAgentObservationWrapper(env)
        env = wrappers.SingleAgentRewardWrapper(env)
    return wrappers.FrameStack(env, 4) if stacked else env


def _slots(env_name: str, left: int, right: int) -> tuple[int, int]:
    """How many players the agent controls inside: all of a team if the scenario requires that."""
    scenario = Config({"level": env_name}).ScenarioConfig()
    if (
        not scenario.control_all_players
        or left not in (0, 1)
        or right not in (0, 1)
        or left + right == 0
    ):
        return left, right
    return (
        left and scenario.controllable_left_players,
        right and scenario.controllable_right_players,
    )


def _check_rewards(rewards: object) -> list[str]:
    if not isinstance(rewards, str):
        raise ParameterError(f"expected `rewards` as names, found `{rewards!r}`", name="rewards")
    names = [name.strip() for name in rewards.split(",")]
    for name in names:
        if name not in REWARDS:
            raise ParameterError(
                f"no reward `{name}`; there are `scoring` and `checkpoints`",
                name="rewards",
                help=similar(name, REWARDS),
            )
    if "scoring" not in names:
        raise ParameterError(
            "`rewards` lacks `scoring`", name="rewards", help="write `scoring,checkpoints`"
        )
    return names


def _check_count(name: str, value: object, least: int = 0) -> int:
    count = _config.check_whole(name, value, least)
    if name.startswith("number_of") and count > 11:
        raise ParameterError(f"`{name}` is {count}; a team has at most 11 players", name=name)
    return count


def _check_players(players: Sequence[str] | None) -> list[str]:
    if players is None:
        return []
    if not isinstance(players, (list, tuple)):
        raise ParameterError(f"`extra_players` is a list: [{players!r}]", name="extra_players")
    return list(players)


def create_remote_environment(
    username: str,
    token: str,
    model_name: str = "",
    track: str = "",
    stacked: bool = False,
    representation: str = "raw",
    rewards: str = "scoring",
    channel_dimensions: tuple[int, int] = (96, 72),
    include_rendering: bool = False,
) -> Any:
    """Raises `UnavailableError`: the service that GRF's clients used no longer exists."""
    del (
        username,
        token,
        model_name,
        track,
        stacked,
        representation,
        rewards,
        channel_dimensions,
        include_rendering,
    )
    raise unavailable(
        "create_remote_environment", "play against a server", "`create_environment` plays here"
    )
