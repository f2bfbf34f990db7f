"""Translates a recorded scenario of Google Research Football to a `.pitch` text."""

from __future__ import annotations

import re
from dataclasses import dataclass, fields
from math import hypot

from setpiece._errors import SetpieceError
from setpiece._scenario_dict import number_text
from setpiece.gfootball.env.scenario_config import FIXED_SEED, FormationEntry, ScenarioConfig

METRES = (54.4, 83.6)
"""Metres per unit of x and y."""
PLACED = (55.0, 84.96)
"""Metres per unit of a player's x and y in a script: wider than the ball's and observations'."""
OVERLAP = 0.3
"""Metres below which two constant places overlap."""
AT_THE_BALL = 2.0
"""A kick-off with a player within this many metres of the ball leaves everybody in place."""
LIMIT_MAX = 1_000_000
"""The largest number of steps for `end limit`."""


class TranslationError(SetpieceError):
    """A scenario script contains what a `.pitch` text can't express; the message says what."""


def identifier(name: str) -> str:
    """Returns a valid name: that of a level, or of a path without folder and ending."""
    stem = name.replace("\\", "/").rsplit("/", 1)[-1].removesuffix(".py")
    return re.sub(r"\W", "_", stem, flags=re.ASCII) or "scenario"


def to_pitch(recorded: ScenarioConfig, name: str, other: ScenarioConfig | None = None) -> str:
    """Returns the text of a recorded scenario; it compiles and has the layout of `setpiece fmt`.

    - `recorded`: the script's result in even episodes, so in the first one.
    - `other`: its result in odd episodes, if that may differ.

    Raises `TranslationError` if the two differ in more than `kickoff alternate(…)` or a number
    `alternate(…, …)` can express.
    """
    other = recorded if other is None else other
    _check_same(recorded, other)
    kickoff = _kickoff(recorded, other)
    formations = [] if kickoff is None else kickoff.formations(name)
    head = [f"/// {name}, as a script of Google Research Football has it.", f"scenario {name} {{"]
    opening = (
        [f"    ball at ({_either(recorded, other, 0)}, {_either(recorded, other, 1)})"]
        if kickoff is None
        else ["    ball at centre", kickoff.statement(name)]
    )
    blocks = [[*_rules(recorded), *_agents(recorded), *opening]]
    for side in ("left", "right"):
        level = _both(
            getattr(recorded, f"{side}_team_difficulty"), getattr(other, f"{side}_team_difficulty")
        )
        players = [] if kickoff is not None else _players(recorded, other, side)
        if players:
            blocks.append(
                [f"    team {side} {{", f"        difficulty: {level}", *players, "    }"]
            )
        else:
            blocks.append([f"    team {side} {{ difficulty: {level} }}"])
    blocks.append(["    reward scoring"])
    endings = _endings(recorded)
    if endings:
        blocks.append(endings)
    body = "\n\n".join("\n".join(block) for block in blocks)
    return "\n".join([*formations, *head, body, "}", ""])


def _rules(recorded: ScenarioConfig) -> list[str]:
    rules = []
    if not recorded.offsides:
        rules.append("offside: off")
    rules.append("kickoff_circle: off")
    if not recorded.use_magnet:
        rules.append("assist: off")
    if recorded.deterministic and recorded.game_engine_random_seed == FIXED_SEED:
        rules.append("stochastic: off")
    if recorded.second_half < min(recorded.game_duration, LIMIT_MAX):
        rules.append(f"half_time: {recorded.second_half} steps")
    return [f"    rules {{ {', '.join(rules)} }}"]


def _agents(recorded: ScenarioConfig) -> list[str]:
    if recorded.control_all_players:
        return ["    agents { left: all }"]
    return [] if recorded.controllable_left_players else ["    agents { left: 0 }"]


def _endings(recorded: ScenarioConfig) -> list[str]:
    endings = []
    if recorded.end_episode_on_score:
        endings += [
            "    end success scored when goal by left",
            "    end failure conceded when goal by right",
        ]
    if recorded.end_episode_on_out_of_play:
        endings.append("    end out when out_of_play or ball_dead")
    if recorded.end_episode_on_possession_change:
        endings.append("    end possession when possession changes")
    if recorded.game_duration <= LIMIT_MAX:
        endings.append(f"    end limit {recorded.game_duration} steps")
    else:
        endings.append(
            f"    // Its game_duration of {recorded.game_duration} steps is more than a limit can be: none."
        )
    return endings


def _players(recorded: ScenarioConfig, other: ScenarioConfig, side: str) -> list[str]:
    entries, others = _team(recorded, side), _team(other, side)
    frame = "" if side == "left" else "own "
    crowded = _crowded(recorded, side) | _crowded(other, side)
    lines = []
    for number, (entry, twin) in enumerate(zip(entries, others, strict=True)):
        x, y = (_both(here, there) for here, there in zip(_place(entry), _place(twin), strict=True))
        lines.append(
            f"        {_role(entry)} at {frame}({x}, {y}){_options(entry, number in crowded)}"
        )
    return lines


def _options(entry: FormationEntry, crowded: bool) -> str:
    options = [
        *(["ai: lazy"] if entry.lazy else []),
        *([] if entry.controllable else ["controllable: off"]),
        *(["overlap: allowed"] if crowded else []),
    ]
    return f" {{ {', '.join(options)} }}" if options else ""


def _crowded(recorded: ScenarioConfig, side: str) -> set[int]:
    """Returns the players of a team who stand on somebody else's spot."""
    teams = {
        team: [_metres(entry, team) for entry in _team(recorded, team)]
        for team in ("left", "right")
    }
    everybody = [*teams["left"], *teams["right"]]
    return {
        number
        for number, place in enumerate(teams[side])
        if sum(hypot(place[0] - spot[0], place[1] - spot[1]) < OVERLAP for spot in everybody) > 1
    }


def _metres(entry: FormationEntry, side: str) -> tuple[float, float]:
    sign = 1.0 if side == "left" else -1.0
    return sign * entry.position[0] * PLACED[0], sign * entry.position[1] * PLACED[1]


@dataclass(frozen=True)
class _Kickoff:
    """A kick-off by one team or by both alternately, with the layouts of both roles."""

    team: str
    kicking: list[FormationEntry]
    receiving: list[FormationEntry]
    crowded: set[int]

    def statement(self, name: str) -> str:
        return f"    kickoff {self.team} {{ kicking: {name}_kicking, receiving: {name}_receiving }}"

    def formations(self, name: str) -> list[str]:
        lines = [f"/// The team that kicks off in {name}.", f"formation {name}_kicking {{"]
        for number, entry in enumerate(self.kicking):
            lines.append(
                f"    {_role(entry)} at {_point(entry)}{_options(entry, number in self.crowded)}"
            )
        lines += ["}", "", f"/// The other team in {name}.", f"formation {name}_receiving {{"]
        lines += [f"    {_role(entry)} at {_point(entry)}" for entry in self.receiving]
        return [*lines, "}", ""]


def _kickoff(recorded: ScenarioConfig, other: ScenarioConfig) -> _Kickoff | None:
    """Returns the kick-off of two layouts, so that it can be repeated after a goal, or None.

    The layouts must have one shape.
    """
    kicker, second = _kicker(recorded), _kicker(other)
    if kicker is None or second is None or recorded.end_episode_on_out_of_play:
        return None
    receiver = "right" if kicker == "left" else "left"
    kicking, receiving = _team(recorded, kicker), _team(recorded, receiver)
    if [_shape(entry) for entry in kicking] != [_shape(entry) for entry in receiving]:
        return None
    swapped = kicker != second
    if (
        _team(other, second) != kicking
        or _team(other, receiver if not swapped else kicker) != receiving
    ):
        return None
    crowded = _crowded(recorded, "left") | _crowded(recorded, "right")
    return _Kickoff(
        f"alternate({kicker}, {second})" if swapped else kicker, kicking, receiving, crowded
    )


def _kicker(recorded: ScenarioConfig) -> str | None:
    """Returns the team with the player at the ball if the ball lies on the centre spot."""
    if any(recorded.ball_position[:2]):
        return None
    nearest = {
        side: min(hypot(*_metres(entry, side)) for entry in _team(recorded, side))
        for side in ("left", "right")
    }
    if min(nearest.values()) > AT_THE_BALL or nearest["left"] == nearest["right"]:
        return None
    return min(nearest, key=lambda side: nearest[side])


def _shape(entry: FormationEntry) -> tuple[object, ...]:
    return entry.role, entry.lazy, entry.controllable


def _check_same(recorded: ScenarioConfig, other: ScenarioConfig) -> None:
    """Raises `TranslationError` if two episodes differ in what no text can alternate."""
    may_differ = (
        *(
            "ball_position",
            "left_team",
            "right_team",
            "left_team_difficulty",
            "right_team_difficulty",
        ),
        "reverse_team_processing",  # The order of the teams has no effect here.
    )
    for each in fields(recorded):
        if each.name not in may_differ and getattr(recorded, each.name) != getattr(
            other, each.name
        ):
            raise TranslationError(
                f"`{each.name}` is {getattr(recorded, each.name)} in even and {getattr(other, each.name)} in odd"
                " episodes; a text can't express that",
                help="write two scenarios, one for each",
            )
    if _kickoff(recorded, other) is not None:
        return
    for side in ("left", "right"):
        entries, others = _team(recorded, side), _team(other, side)
        if [_shape(entry) for entry in entries] != [_shape(entry) for entry in others]:
            raise TranslationError(
                f"the {side} team has other players in odd than in even episodes; a text can only alternate places",
                help="the same number of players, roles, `lazy` and `controllable` in every episode, or two scenarios",
            )


def _team(recorded: ScenarioConfig, side: str) -> list[FormationEntry]:
    return recorded.left_team if side == "left" else recorded.right_team


def _role(entry: FormationEntry) -> str:
    return entry.role.name.rpartition("_")[2]


def _place(entry: FormationEntry) -> tuple[float, float]:
    """Returns a player's place as observations show it, rounded to half a centimetre."""
    x, y = (round(entry.position[axis] * PLACED[axis] / METRES[axis], 4) for axis in (0, 1))
    return x, y


def _point(entry: FormationEntry) -> str:
    x, y = _place(entry)
    return f"({number_text(x)}, {number_text(y)})"


def _either(recorded: ScenarioConfig, other: ScenarioConfig, axis: int) -> str:
    return _both(recorded.ball_position[axis], other.ball_position[axis])


def _both(even: float, odd: float) -> str:
    return (
        number_text(even) if even == odd else f"alternate({number_text(even)}, {number_text(odd)})"
    )
