"""A replay as a dump of Google Research Football."""

from __future__ import annotations

from collections.abc import Iterator
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import setpiece
from setpiece._errors import ParameterError, UnavailableError
from setpiece._replay import Moment, Replay
from setpiece.gfootball.env._whole_match import slot_view, whole_match
from setpiece.gfootball.env.config import defaults
from setpiece.gfootball.env.football_action_set import CoreAction, get_action_set
from setpiece.gfootball.env.football_env_core import STALLED, STEP_S
from setpiece.gfootball.env.observation_processor import Trace, trace_of, write_dump
from setpiece.gfootball.env.observation_rotation import flip_observation, flip_single_action
from setpiece.gfootball.env.scenario_builder import Source, all_scenarios

FIRST_EPISODE = 2
"""The number of the episode with index 0; later ones alternate between it and the next."""


def replay_to_dump(replay: Replay | str | PathLike[str], path: str | PathLike[str]) -> None:
    """Writes a replay, or a replay's file, as the dump of a whole episode for `ScriptHelpers`.

    It has a record of every step. `reward` is the change of the left team's lead, `time` is in
    seconds from the start. `ScriptHelpers.replay` plays the match again if the drop-in can: an
    unchanged scenario of the library, one of its first two episodes, and no set piece that waits so
    long that the drop-in takes it. Otherwise the dump's `level` is the replay's path, which isn't a
    level.

    Raises `UnavailableError` if no agent played, or one with continuous actions; `ReplayError` if
    this build diverges from the recording, or a file isn't a replay; `FileError` if one can't be
    read or written.
    """
    if isinstance(replay, (str, PathLike)):
        replay = Replay(replay)
    elif not isinstance(replay, Replay):
        raise ParameterError(
            f"expected a `Replay` or the path of one, found `{replay!r}`", name="replay"
        )
    if not replay.agents:
        raise _untellable(
            replay, "agents", "nobody was an agent, and a dump tells what agents see and do"
        )
    if replay.action_set == "continuous":
        raise _untellable(
            replay, "action_set", "the agents' actions were continuous, and a dump tells of keys"
        )
    # Played before anything is written, so that a diverging replay leaves no file.
    longest = _longest_wait(replay, {**defaults(), "action_set": replay.action_set})
    left, right = _counts(replay)
    config = {
        **defaults(),
        "action_set": replay.action_set,
        "level": replay.scenario.name
        if longest < STALLED and _is_known(replay)
        else str(replay.path),
        "players": [f"agent:left_players={left},right_players={right}"],
        "episode_number": FIRST_EPISODE + replay.index,
        "game_engine_random_seed": replay.seed,
    }
    write_dump(Path(fspath(path)), config, _traces(replay, config))


def _untellable(replay: Replay, name: str, why: str) -> UnavailableError:
    instead = f"`setpiece replay {replay.path} --format jsonl` tells every step"
    return UnavailableError(f"`{replay.path}`: {why}", name=name, help=instead)


def _traces(replay: Replay, config: dict[str, Any]) -> Iterator[Trace]:
    first = before = None
    for moment in replay:
        left, right = moment.info["score"]
        lead = float(left - right)
        if first is None or before is None:
            first = before = lead
            continue
        chosen = _chosen(replay, moment, config)
        time_s = moment.step * STEP_S
        yield trace_of(
            chosen,
            moment.step - 1,
            lead - before,
            lead - first,
            time_s,
            _whole(replay, moment, config),
        )
        before = lead


def _chosen(replay: Replay, moment: Moment, config: dict[str, Any]) -> list[CoreAction]:
    """Every slot's action, in the frame of the pitch."""
    actions = get_action_set(config)
    chosen = [actions[int(moment.actions[agent.id])] for agent in replay.agents]
    return [
        flip_single_action(action, config) if agent.team == 1 else action
        for agent, action in zip(replay.agents, chosen, strict=True)
    ]


def _whole(replay: Replay, moment: Moment, config: dict[str, Any]) -> dict[str, Any]:
    left, right = (
        [
            slot_view(moment.observations[agent.id], config)
            for agent in replay.agents
            if agent.team == team
        ]
        for team in (0, 1)
    )
    first = left[0] if left else flip_observation(right[0], config)
    return whole_match(first, left, right, config, seen_by_left=bool(left))


def _longest_wait(replay: Replay, config: dict[str, Any]) -> int:
    """Returns the longest wait of a set piece in steps, of those that the drop-in counts."""
    longest = waiting = 0
    for moment in replay:
        waiting = (
            waiting + 1
            if slot_view(moment.observations[replay.agents[0].id], config)["game_mode"]
            else 0
        )
        longest = max(longest, waiting)
    return longest


def _is_known(replay: Replay) -> bool:
    """Whether the drop-in has the scenario, with these agents, and reaches this episode."""
    name = replay.scenario.name
    if name not in all_scenarios() or setpiece.load(name).digest != replay.scenario.digest:
        return False
    if replay.snapshot is not None or replay.index > 1:
        return False
    left, right = _counts(replay)
    agents = setpiece.FootballEnv(
        Source(name).compiled(str(left), str(right), None), rewards=[]
    ).agents
    return agents == tuple(agent.id for agent in replay.agents)


def _counts(replay: Replay) -> tuple[int, int]:
    """How many agents played on the left and on the right."""
    right = sum(agent.team for agent in replay.agents)
    return len(replay.agents) - right, right
