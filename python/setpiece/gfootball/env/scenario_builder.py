"""Finds a scenario by its level's name, and runs its script if it is one of GRF's form."""

from __future__ import annotations

import importlib
import importlib.util
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass, field
from functools import lru_cache
from math import isfinite
from pathlib import Path
from traceback import walk_tb
from types import ModuleType
from typing import TYPE_CHECKING, Any

import setpiece
from setpiece._errors import (
    FileError,
    GrfScriptError,
    ParameterError,
    SetpieceError,
    UnknownScenarioError,
)
from setpiece._words import similar
from setpiece.gfootball import scenarios
from setpiece.gfootball._translation import identifier, to_pitch
from setpiece.gfootball.env import scenario_config
from setpiece.gfootball.env.scenario_config import NEVER, FormationEntry, ScenarioConfig
from setpiece.gfootball.scenarios import PlayerRole, Team

if TYPE_CHECKING:
    from setpiece.gfootball.env.config import Config

PACKAGES = ("setpiece.gfootball.scenarios", "gfootball.scenarios")
TESTS = "tests."
"""GRF's prefix of the names of its own tests' scenarios."""
STEPS_PER_S = 10
SECOND_HALF = "second_half"
"""The parameter with the step at which the second half begins, for scenarios without a script."""
Script = Callable[["Recorder"], object]


def all_scenarios() -> list[str]:
    """Returns the levels of the library."""
    return [entry.name for entry in setpiece.list()]


@dataclass
class Recorder:
    """The `builder` of a script: it records what the script sets.

    >>> recorder = Recorder(episode_number=2)
    >>> recorder.SetTeam(Team.e_Right)
    >>> recorder.AddPlayer(-1.0, 0.0, PlayerRole.e_PlayerRole_GK, lazy=True)
    >>> recorder.config().right_team[0].lazy
    True
    """

    episode_number: int
    recorded: ScenarioConfig = field(default_factory=ScenarioConfig)
    team: Team = Team.e_Left

    def config(self) -> ScenarioConfig:
        """Returns what the script sets directly."""
        return self.recorded

    def ScenarioConfig(self) -> ScenarioConfig:  # noqa: N802  # GRF's names
        """Returns the same as `config`."""
        return self.recorded

    def SetTeam(self, team: Team) -> None:  # noqa: N802
        """Sets the team of the players added from now on."""
        try:
            self.team = Team(team)
        except ValueError:
            raise ParameterError(
                f"no team `{team!r}`",
                name="team",
                help="there are `Team.e_Left` and `Team.e_Right`",
            ) from None

    def AddPlayer(  # noqa: N802
        self, x: float, y: float, role: PlayerRole, lazy: bool = False, controllable: bool = True
    ) -> None:
        """Adds a player, in their team's own frame: their own goal is at x = -1."""
        try:
            entry = FormationEntry(_place(x, y), PlayerRole(role), bool(lazy), bool(controllable))
        except (TypeError, ValueError):
            raise ParameterError(
                f"AddPlayer({x!r}, {y!r}, {role!r}) is not a player",
                name="AddPlayer",
                help="write two numbers and a role such as `e_PlayerRole_CM`",
            ) from None
        (self.recorded.left_team if self.team == Team.e_Left else self.recorded.right_team).append(
            entry
        )

    def SetBallPosition(self, x: float, y: float) -> None:  # noqa: N802
        """Places the ball, in the left team's frame."""
        try:
            self.recorded.ball_position[:2] = _place(x, y)
        except (TypeError, ValueError):
            raise ParameterError(
                f"SetBallPosition({x!r}, {y!r}) is not a place",
                name="SetBallPosition",
                help="write two numbers",
            ) from None

    def EpisodeNumber(self) -> int:  # noqa: N802
        """Returns the number of the episode; that of the first `reset` is 2."""
        return self.episode_number


def _place(x: float, y: float) -> tuple[float, float]:
    """Returns two finite numbers; raises `TypeError` or `ValueError` for anything else."""
    place = float(x), float(y)
    if not all(map(isfinite, place)):
        raise ValueError("not finite")
    return place


def record(script: Script, episode_number: int) -> ScenarioConfig:
    """Runs a script for one episode and returns what it set.

    A team without players gets a lazy keeper, as in GRF. Raises `GrfScriptError` if the script
    fails, `ParameterError` for an impossible value.
    """
    recorder = Recorder(episode_number)
    with _running(getattr(getattr(script, "__code__", None), "co_filename", repr(script))):
        script(recorder)
        recorder.recorded.check()
    for team in (recorder.recorded.left_team, recorder.recorded.right_team):
        if not team:
            team.append(FormationEntry((-1.0, 0.42), PlayerRole.e_PlayerRole_GK, lazy=True))
    return recorder.recorded


@dataclass(frozen=True)
class Source:
    """A scenario as text: `text` defines `name`; imports are read from `folder`."""

    name: str
    text: str = ""
    folder: str = ""

    def compiled(
        self, left: str, right: str, steps: int | None, half_time: int | None = None
    ) -> setpiece.Scenario:
        """Returns the scenario with these agents, steps, and steps before half-time.

        A count of agents is a number, or `all`. GRF hurries agents but never lazy players, so the
        environment does it instead of the engine.
        """
        half = "" if half_time is None else f", half_time: {half_time} steps"
        limit = "" if steps is None else f" end limit {steps} steps"
        return _compiled(
            self,
            f"rules {{ anti_stalling: off{half} }} agents {{ left: {left}, right: {right} }}{limit}",
        )

    def agents_on_the_left(self) -> int:
        """Returns how many agents the scenario itself requests."""
        env = setpiece.FootballEnv(_compiled(self, ""), rewards=[])
        return sum(agent.team == 0 for agent in env.slots)


@lru_cache(maxsize=256)
def _compiled(source: Source, said: str) -> setpiece.Scenario:
    name = f"{source.name}_in_gfootball"
    text = f"scenario {name} extends {source.name} {{ {said} }}\n"
    return setpiece.compile(source.text + text, str(Path(source.folder, f"{name}.pitch")))


@lru_cache(maxsize=256)
def _measured(source: Source) -> ScenarioConfig:
    """Returns the visible facts of a scenario without a script: players, agents and length."""
    scenario = source.compiled("all", "all", None)
    env = setpiece.FootballEnv(scenario, observation="raw", rewards=[])
    observed, _ = env.reset(seed=0)
    views = observed if isinstance(observed, tuple) else (observed,)
    teams = [agent.team for agent in env.slots]
    if not teams:
        raise ParameterError(f"nobody of `{source.name}` can be played by an agent", name="level")
    first, turned = views[0], teams[0] == 1
    recorded = ScenarioConfig()
    recorded.game_duration = int(first["steps_left"]) if first["steps_left"] >= 0 else NEVER
    defaults = {name: param.default for name, param in scenario.params.items()}
    recorded.left_team_difficulty = float(
        defaults.get("left_difficulty", recorded.left_team_difficulty)
    )
    recorded.right_team_difficulty = float(
        defaults.get("difficulty", recorded.right_team_difficulty)
    )
    if SECOND_HALF in defaults:
        recorded.second_half = round(float(defaults[SECOND_HALF]) * STEPS_PER_S)
    recorded.ball_position = [float(number) for number in first["ball"]]
    if turned:
        recorded.ball_position[:2] = [-number for number in recorded.ball_position[:2]]
    for team, entries in enumerate((recorded.left_team, recorded.right_team)):
        own = (team == 1) == turned
        block, sign = ("left_team", 1.0) if own else ("right_team", -1.0)
        played = {view["active"] for view, side in zip(views, teams, strict=True) if side == team}
        for number, (place, role) in enumerate(
            zip(first[block], first[f"{block}_roles"], strict=True)
        ):
            position = (sign * float(place[0]), sign * float(place[1]))
            entries.append(FormationEntry(position, PlayerRole(int(role)), False, number in played))
    recorded.control_all_players = (
        1 < recorded.controllable_left_players == source.agents_on_the_left()
    )
    return recorded


class Scenario:
    """The scenario of one episode, from its script or from the library."""

    source: Source
    """The text that is played."""

    def __init__(self, config: Config) -> None:
        """Builds the scenario of `config["level"]` for the episode `config["episode_number"]`."""
        level = config["level"]
        found = find(level)
        if isinstance(found, Source):
            self.source = found
            self._recorded = deepcopy(_measured(found))
        else:
            self._recorded = record(found, config["episode_number"])
            name = identifier(level)
            self.source = Source(name, to_pitch(self._recorded, name))

    def config(self) -> ScenarioConfig:
        """Returns the known settings of the scenario."""
        return self._recorded

    ScenarioConfig = config


def find(level: object) -> Source | Script:
    """Returns the scenario of a level's name: a text of the library or a file, or a script.

    Scenarios of the library can also be named by GRF's names of its tests' scenarios:
    `tests.penalty` is `penalty`.

    Raises `UnknownScenarioError`, `FileError` for a path that can't be read, `GrfScriptError` for a
    module that fails.
    """
    if not isinstance(level, str) or not level:
        raise ParameterError(
            "the level needs a name", name="level", help="for example `academy_3_vs_1_with_keeper`"
        )
    if level.endswith(".py"):
        return script_of(load_script(level), level)
    if level.endswith(".pitch"):
        path = Path(level).resolve()
        return Source(setpiece.load(path).name, f'import "{path.name}"\n', str(path.parent))
    names = [f"{package}.{level}" for package in PACKAGES if package in sys.modules]
    # A name that begins with a dot is a path, not a module.
    for name in [*names, level] if "." in level and level[0] != "." else names:
        module = _imported(name)
        if module is not None and (hasattr(module, "build_scenario") or name != level):
            return script_of(module, name)
    known = level.removeprefix(TESTS)
    if known in all_scenarios():
        return Source(known)
    raise UnknownScenarioError(
        f"no scenario `{level}`",
        name=level,
        help=similar(level, all_scenarios())
        or "a module of your own goes by its dotted name or its path",
    )


def load_script(path: str) -> ModuleType:
    """Runs a script's file as a module of the scenarios' package.

    So `from . import *` works in it. Raises `FileError` if there is no such file, `GrfScriptError`
    if it fails.
    """
    file = Path(path)
    if not file.is_file():
        raise FileError(f"no file `{path}`", path=path)
    return _load_script(str(file.resolve()), file.stat().st_mtime_ns)


@contextmanager
def _running(path: str) -> Iterator[None]:
    """Reports whatever a user's script raises, including an exit, with its name and line."""
    try:
        yield
    except ParameterError as error:
        file, line = _failed_at(error) or (path, None)
        raise ParameterError(
            f"`{file}`{_at(line)}: {error.args[0]}", name=error.name, help=error.help
        ) from error
    except SetpieceError:
        raise
    except (Exception, SystemExit) as error:
        file, line = _failed_at(error) or (path, None)
        message = f"`{path}` failed{_at(line)}: {type(error).__name__}: {error}"
        raise GrfScriptError(message, path=file) from error


def _at(line: int | None) -> str:
    return "" if line is None else f" at line {line}"


def _failed_at(error: BaseException) -> tuple[str, int] | None:
    """Returns the file and line at which the script failed; None if none of its lines ran."""
    if isinstance(error, SyntaxError) and error.filename is not None and error.lineno is not None:
        return error.filename, error.lineno
    ran = [(frame.f_code.co_filename, line) for frame, line in walk_tb(error.__traceback__)]
    # Frames that load the script come before it, and checks after its end have no line of it.
    loading = {__file__, scenario_config.__file__, importlib.__file__}
    file = next(
        (file for file, _ in ran if file not in loading and not file.startswith("<frozen ")), None
    )
    return None if file is None else (file, [line for each, line in ran if each == file][-1])


@lru_cache(maxsize=64)
def _load_script(path: str, _changed: int) -> ModuleType:
    name = f"{scenarios.__name__}.{re.sub(r'[^0-9a-zA-Z_]', '_', Path(path).stem)}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise FileError(f"`{path}` is no Python file", path=path)
    module = importlib.util.module_from_spec(spec)
    with _running(path):
        spec.loader.exec_module(module)
    return module


def _imported(name: str) -> ModuleType | None:
    """Returns a module, or None if there is none of this name; `GrfScriptError` if it fails."""
    with _running(name):
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError as error:
            if error.name is None or not f"{name}.".startswith(f"{error.name}."):
                raise
    return None


def script_of(module: ModuleType, name: str) -> Script:
    """Returns a module's `build_scenario`; raises `SetpieceError` if it has none."""
    script: Any = getattr(module, "build_scenario", None)
    if not callable(script):
        raise SetpieceError(
            f"`{name}` has no `build_scenario`",
            help="write `def build_scenario(builder):`, as scenarios of GRF do",
        )
    found: Script = script
    return found
