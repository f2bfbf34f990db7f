"""Recorded episodes as datasets of kloppy: `load_tracking` and `load_event`.

They read the folders that `setpiece replay FILE --format cdf|csv -o FOLDER` and `Replay.export`
write. Coordinates are metres from the centre spot, with +y at the top; the home team is the left
one and attacks towards +x in both halves.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from os import PathLike
from pathlib import Path
from typing import Any

from setpiece._errors import ParameterError
from setpiece._optional import need

need("kloppy.domain", "kloppy", "`setpiece.kloppy`")
from kloppy.domain import (  # noqa: E402
    BallState,
    BodyPart,
    BodyPartQualifier,
    CardType,
    CustomCoordinateSystem,
    DatasetFlag,
    Dimension,
    DuelQualifier,
    DuelResult,
    DuelType,
    Event,
    EventDataset,
    EventFactory,
    Frame,
    GoalkeeperActionType,
    GoalkeeperQualifier,
    Ground,
    InterceptionResult,
    Metadata,
    MetricPitchDimensions,
    Orientation,
    Origin,
    PassResult,
    Period,
    Player,
    PlayerData,
    Point,
    Point3D,
    Provider,
    Score,
    SetPieceQualifier,
    SetPieceType,
    ShotResult,
    Team,
    TrackingDataset,
    VerticalOrientation,
)
from kloppy.domain.services.frame_factory import create_frame  # noqa: E402

__all__ = ["load_event", "load_tracking"]

PERIODS = {"first_half": 1, "second_half": 2}
START = datetime(1970, 1, 1, tzinfo=timezone.utc)
"""The moment of frame 0 in files of the Common Data Format."""

FIGURES = [
    "goal_width",
    "goal_height",
    "penalty_area_length",
    "penalty_area_width",
    "six_yard_length",
    "six_yard_width",
    "penalty_spot_distance",
    "circle_radius",
]
"""What `pitch.json` says of the pitch, metres, by the names that kloppy has for it. Without that
file, kloppy's own figures stand."""

SHOT = {
    "successful": ShotResult.GOAL,
    "saved": ShotResult.SAVED,
    "blocked": ShotResult.BLOCKED,
    "wide": ShotResult.OFF_TARGET,
    "woodwork": ShotResult.POST,
    "own_goal": ShotResult.OWN_GOAL,
}
PASS = {
    "successful": PassResult.COMPLETE,
    "out_of_play": PassResult.OUT,
    "offside": PassResult.OFFSIDE,
}
BODY = {"hands": BodyPart.BOTH_HANDS, "head": BodyPart.HEAD}
SET_PIECES = {
    "throw_in": SetPieceType.THROW_IN,
    "corner_kick": SetPieceType.CORNER_KICK,
    "goal_kick": SetPieceType.GOAL_KICK,
    "free_kick": SetPieceType.FREE_KICK,
    "penalty_kick": SetPieceType.PENALTY,
    "kick_off": SetPieceType.KICK_OFF,
}
KEEPER = {
    "save": GoalkeeperActionType.SAVE,
    "claim": GoalkeeperActionType.CLAIM,
    "parry": GoalkeeperActionType.PUNCH,
}


def load_tracking(folder: str | PathLike[str]) -> TrackingDataset:
    """Reads the tracking data of a folder.

    Frames have the ids of the steps and players' `speed` in m/s; those of tables `ball_speed`, too.

    Raises `FileNotFoundError` if the folder holds neither `tracking.jsonl` nor `tracking.csv`.
    """
    path, match = _file(folder, "tracking"), _Match.read(folder)
    read = _frames_of_cdf if path.suffix == ".jsonl" else _frames_of_csv
    flags = DatasetFlag.BALL_OWNING_TEAM | DatasetFlag.BALL_STATE
    return TrackingDataset(records=[*read(path, match)], metadata=match.metadata(flags))


def load_event(
    folder: str | PathLike[str], event_factory: EventFactory | None = None
) -> EventDataset:
    """Reads the event data of a folder.

    Passes, shots, interceptions, tackles, fouls, cards, saves, recoveries and balls out of play
    become kloppy's events of these kinds; the others become generic ones with the `sub_type` as
    their name. `raw_event` is the event as the file has it.

    Raises `FileNotFoundError` if the folder holds neither `event.jsonl` nor `events.csv`.
    """
    path, match = _file(folder, "event"), _Match.read(folder)
    read = _events_of_cdf if path.suffix == ".jsonl" else _events_of_csv
    factory = event_factory or EventFactory()
    records = [_event(factory, match, raw) for raw in read(path)]
    return EventDataset(records=records, metadata=match.metadata(DatasetFlag(0), records))


def _file(folder: str | PathLike[str], what: str) -> Path:
    names = [f"{what}.jsonl", "events.csv" if what == "event" else f"{what}.csv"]
    for name in names:
        path = Path(folder) / name
        if path.is_file():
            return path
    raise FileNotFoundError(f"`{folder}` holds neither {names[0]} nor {names[1]}")


@dataclass
class _Match:
    """What `meta.json` and `pitch.json` say about the match."""

    sheet: dict[str, Any]
    figures: dict[str, float]
    teams: list[Team]
    players: dict[str, Player]
    periods: dict[str, Period]

    @classmethod
    def read(cls, folder: str | PathLike[str]) -> _Match:
        sheet = json.loads((Path(folder) / "meta.json").read_text(encoding="utf-8"))
        pitch = Path(folder) / "pitch.json"
        figures = json.loads(pitch.read_text(encoding="utf-8")) if pitch.is_file() else {}
        teams, players = [], {}
        for side, ground in (("home", Ground.HOME), ("away", Ground.AWAY)):
            given = sheet["teams"][side]
            team = Team(team_id=given["id"], name=given["name"], ground=ground)
            for one in given["players"]:
                player = Player(
                    player_id=one["id"],
                    team=team,
                    jersey_no=one["jersey_number"],
                    name=one["id"],
                    starting=one["is_starter"],
                )
                team.players.append(player)
                players[one["id"]] = player
            teams.append(team)
        periods = {}
        for given in sheet["match"]["periods"]:
            periods[given["period"]] = Period(
                id=PERIODS[given["period"]],
                start_timestamp=_since_start(given["start_time"]),
                end_timestamp=_since_start(given["end_time"]),
            )
        return cls(sheet, figures, teams, players, periods)

    def metadata(self, flags: DatasetFlag, events: list[Event] | None = None) -> Metadata:
        length, width = (self.sheet["venue"][key] for key in ("pitch_length", "pitch_width"))
        figures = {key: self.figures[key] for key in FIGURES if key in self.figures}
        pitch = MetricPitchDimensions(
            x_dim=Dimension(-length / 2, length / 2),
            y_dim=Dimension(-width / 2, width / 2),
            pitch_length=length,
            pitch_width=width,
            standardized=False,
            penalty_arc_radius=figures.get("circle_radius", 9.15),
            **figures,
        )
        return Metadata(
            periods=[*self.periods.values()],
            teams=self.teams,
            coordinate_system=CustomCoordinateSystem(
                Origin.CENTER, VerticalOrientation.BOTTOM_TO_TOP, pitch
            ),
            pitch_dimensions=pitch,
            orientation=Orientation.STATIC_HOME_AWAY,
            flags=flags,
            provider=Provider.OTHER,
            frame_rate=self.sheet["meta"]["tracking"]["fps"] if events is None else None,
            score=None if events is None else self._score(events),
            game_id=self.sheet["match"]["id"],
        )

    def _score(self, events: list[Event]) -> Score:
        """The goals that fell in the episode."""
        goals = {team.team_id: 0 for team in self.teams}
        home, away = goals
        for event in events:
            raw = event.raw_event
            if raw["type"] == "shot" and raw["outcome_type"] == "own_goal":
                goals[away if raw["team_id"] == home else home] += 1
            elif (raw["type"], raw["outcome_type"]) == ("shot", "successful") or (
                raw["type"],
                raw["sub_type"],
            ) == ("misc", "goal"):
                goals[raw["team_id"]] += 1
        return Score(home=goals[home], away=goals[away])

    def team(self, team_id: str | None) -> Team | None:
        return next((team for team in self.teams if team.team_id == team_id), None)

    def frame(
        self,
        number: int,
        time: timedelta,
        period: str,
        in_play: bool,
        owner: str | None,
        ball: tuple[float, float, float],
        ball_mps: float | None,
        players: list[tuple[str, float, float, float]],
    ) -> Frame:
        half = self.periods[period]
        return create_frame(
            frame_id=number,
            timestamp=time - half.start_timestamp,
            period=half,
            ball_state=BallState.ALIVE if in_play else BallState.DEAD,
            ball_owning_team=self.team(owner),
            ball_coordinates=Point3D(*ball),
            ball_speed=ball_mps,
            players_data={
                self.players[name]: PlayerData(coordinates=Point(x, y), speed=speed)
                for name, x, y, speed in players
            },
            other_data={},
        )


def _since_start(moment: str) -> timedelta:
    return datetime.strptime(moment, "%Y-%m-%dT%H:%M:%S.%f%z") - START


def _frames_of_cdf(path: Path, match: _Match) -> Iterator[Frame]:
    with path.open(encoding="utf-8") as lines:
        for line in lines:
            it = json.loads(line)
            ball = it["ball"]
            everyone = it["teams"]["home"]["players"] + it["teams"]["away"]["players"]
            yield match.frame(
                it["frame_id"],
                _since_start(it["timestamp"]),
                it["period"],
                ball["status"],
                ball.get("poss_team_id"),
                (ball["x"], ball["y"], ball["z"]),
                None,
                [(one["id"], one["x"], one["y"], one["vel"]) for one in everyone],
            )


def _frames_of_csv(path: Path, match: _Match) -> Iterator[Frame]:
    with path.open(encoding="utf-8", newline="") as table:
        rows: list[dict[str, str]] = []
        for row in csv.DictReader(table):
            if rows and row["frame_id"] != rows[0]["frame_id"]:
                yield _frame_of_rows(rows, match)
                rows = []
            rows.append(row)
        if rows:
            yield _frame_of_rows(rows, match)


def _frame_of_rows(rows: list[dict[str, str]], match: _Match) -> Frame:
    ball, *players = rows
    speed = _length(ball, "vx", "vy", "vz")
    return match.frame(
        int(ball["frame_id"]),
        timedelta(seconds=float(ball["time_s"])),
        ball["period"],
        ball["in_play"] == "true",
        ball["possession"] or None,
        (float(ball["x"]), float(ball["y"]), float(ball["z"])),
        speed,
        [
            (one["id"], float(one["x"]), float(one["y"]), _length(one, "vx", "vy"))
            for one in players
        ],
    )


def _length(row: dict[str, str], *axes: str) -> float:
    return float(sum(float(row[axis]) ** 2 for axis in axes) ** 0.5)


def _events_of_cdf(path: Path) -> Iterator[dict[str, Any]]:
    with path.open(encoding="utf-8") as lines:
        for line in lines:
            it = json.loads(line)
            raw = {**it["event"], **it["tracking"]}
            raw["time_s"] = _since_start(raw["time"]).total_seconds()
            received = raw["receiver_time"]
            raw["receiver_time_s"] = received and _since_start(received).total_seconds()
            yield raw


def _events_of_csv(path: Path) -> Iterator[dict[str, Any]]:
    numbers = {"time_s", "receiver_time_s", "x", "y", "x_end", "y_end"}
    with path.open(encoding="utf-8", newline="") as table:
        for row in csv.DictReader(table):
            raw: dict[str, Any] = {key: value or None for key, value in row.items()}
            for key in numbers:
                raw[key] = None if raw[key] is None else float(raw[key])
            raw["is_successful"] = row["is_successful"] == "true"
            related = row["related_event_ids"]
            raw["related_event_ids"] = related.split(";") if related else None
            yield raw


def _event(factory: EventFactory, match: _Match, raw: dict[str, Any]) -> Event:
    kind, sub_kind, outcome = raw["type"], raw["sub_type"], raw["outcome_type"]
    half = match.periods.get(raw["period"])
    if half is None:
        raise ParameterError(f"meta.json has no period `{raw['period']}`", name="folder")
    team = match.team(raw.get("team_id"))
    shared: dict[str, Any] = {
        "event_id": raw["id"],
        "period": half,
        "timestamp": timedelta(seconds=raw["time_s"]) - half.start_timestamp,
        "team": team,
        "player": match.players.get(raw.get("player_id") or ""),
        "coordinates": Point(raw["x"], raw["y"]),
        "ball_owning_team": team,
        "ball_state": BallState.DEAD if kind == "referee" else BallState.ALIVE,
        "raw_event": raw,
        "related_event_ids": raw["related_event_ids"] or [],
        "result": None,
        "qualifiers": None,
    }
    if kind in ("pass", "shot"):
        shared["qualifiers"] = [
            *([BodyPartQualifier(BODY[raw["body_part"]])] if raw["body_part"] in BODY else []),
            *([SetPieceQualifier(SET_PIECES[sub_kind])] if sub_kind else []),
        ]
    end = None if raw["x_end"] is None else Point(raw["x_end"], raw["y_end"])
    if kind == "pass":
        received = raw["receiver_time_s"]
        shared["result"] = PASS.get(outcome, PassResult.INCOMPLETE)
        return factory.build_pass(
            **shared,
            receiver_player=match.players.get(raw["receiver_id"] or ""),
            receiver_coordinates=end,
            receive_timestamp=received and timedelta(seconds=received) - half.start_timestamp,
        )
    if kind == "shot":
        shared["result"] = SHOT.get(outcome)
        return factory.build_shot(**shared, result_coordinates=end)
    if kind == "goalkeeping":
        shared["qualifiers"] = [GoalkeeperQualifier(KEEPER[sub_kind])]
        return factory.build_goalkeeper_event(**shared)
    return _other(factory, kind, sub_kind, shared)


def _other(factory: EventFactory, kind: str, sub_kind: str, shared: dict[str, Any]) -> Event:
    """An event that is neither a pass, nor a shot, nor a keeper's."""
    if kind == "referee":
        pass
    elif sub_kind == "interception":
        return factory.build_interception(**{**shared, "result": InterceptionResult.SUCCESS})
    elif sub_kind == "tackle":
        duel = {"result": DuelResult.WON, "qualifiers": [DuelQualifier(DuelType.TACKLE)]}
        return factory.build_duel(**{**shared, **duel})
    elif sub_kind == "ball_won":
        return factory.build_recovery(**shared)
    elif sub_kind == "out_of_play":
        return factory.build_ball_out(**shared)
    elif sub_kind == "foul":
        return factory.build_foul_committed(**shared)
    elif sub_kind in ("yellow_card", "red_card"):
        card = CardType.RED if sub_kind == "red_card" else CardType.FIRST_YELLOW
        return factory.build_card(**shared, card_type=card)
    return factory.build_generic(**shared, event_name=sub_kind)
