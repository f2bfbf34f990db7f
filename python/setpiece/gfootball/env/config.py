"""The settings of an environment, and the definitions of its players."""

from __future__ import annotations

import random
import tempfile
from collections.abc import Callable, Mapping
from operator import index
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from setpiece._errors import ParameterError
from setpiece._video import QUALITIES
from setpiece._words import check_word, similar
from setpiece.gfootball._unavailable import unavailable
from setpiece.gfootball.env.football_action_set import action_set_dict
from setpiece.gfootball.env.scenario_builder import Scenario
from setpiece.gfootball.env.scenario_config import ScenarioConfig

SEED_MAX = 2_000_000_000
"""The largest seed drawn for an episode."""
BUGS = ("first_active", "kick_off_mode", "sent_off")
"""The bugs that `grf_bugs` can restore; see docs/gfootball.md."""
WHOLE = ("episode_number", "render_resolution_x", "render_resolution_y")
"""Settings that accept any integer."""
OPTIONAL = ("game_engine_random_seed", "reverse_team_processing", "episode_number", "grf_bugs")
"""Settings without a default."""

PlayerDefinition = tuple[str, dict[str, Any]]


def parse_player_definition(definition: str) -> PlayerDefinition:
    """Returns a player's name and settings.

    >>> parse_player_definition("lazy:right_players=2")
    ('lazy', {'left_players': 0, 'right_players': 2})
    >>> parse_player_definition("bot")
    ('bot', {'left_players': 1, 'right_players': 0})
    """
    if not isinstance(definition, str) or not definition:
        raise ParameterError(
            f"expected a player's definition, found `{definition!r}`", name="players"
        )
    name, _, rest = definition.partition(":")
    settings: dict[str, Any] = {"left_players": 0, "right_players": 0}
    for part in filter(None, rest.split(",")):
        key, equals, value = part.partition("=")
        if not equals:
            raise ParameterError(
                f"`{part}` in `{definition}` is not a setting",
                name="players",
                help="write `agent:left_players=1`",
            )
        settings[key] = value
    # GRF compares with the number 0, so an explicit zero counts as given.
    if settings["left_players"] == 0 and settings["right_players"] == 0:
        settings["left_players"] = 1
    for key in ("left_players", "right_players"):
        if not str(settings[key]).isdecimal():
            raise ParameterError(f"`{key}` in `{definition}` is no count", name="players")
        settings[key] = int(settings[key])
    return name, settings


def count_left_players(definition: str) -> int:
    """Returns how many players of the left team a definition plays."""
    return int(parse_player_definition(definition)[1]["left_players"])


def count_right_players(definition: str) -> int:
    """Returns how many players of the right team a definition plays."""
    return int(parse_player_definition(definition)[1]["right_players"])


def count_players(definition: str) -> int:
    """Returns how many players a definition plays."""
    return count_left_players(definition) + count_right_players(definition)


def get_agent_number_of_players(players: list[str]) -> int:
    """Returns how many players the `agent` among some definitions plays."""
    return sum(
        count_players(each) for each in players if parse_player_definition(each)[0] == "agent"
    )


def defaults() -> dict[str, Any]:
    """Returns GRF's settings with their defaults."""
    return {
        "action_set": "default",
        "custom_display_stats": None,
        "display_game_stats": True,
        "dump_full_episodes": False,
        "dump_scores": False,
        "players": ["agent:left_players=1"],
        "level": "11_vs_11_stochastic",
        "physics_steps_per_frame": 10,
        "render_resolution_x": 1280,
        "render_resolution_y": 720,
        "real_time": False,
        "tracesdir": str(Path(tempfile.gettempdir(), "dumps")),
        "video_format": "avi",
        "video_quality_level": 0,
        "write_video": False,
        "grf_bugs": ["kick_off_mode"],
    }


class Config:
    """The settings by name, with GRF's defaults, and the scenario of the current episode.

    Use `config["level"]`. In addition to GRF's settings there is `grf_bugs`: True or a list of
    names in `BUGS`. Raises `ParameterError` for an unknown setting or an impossible value,
    `UnavailableError` for one that this version doesn't support.
    """

    def __init__(self, values: dict[str, Any] | None = None) -> None:
        self._values = defaults()
        self._scenario_values: dict[str, Any] = {}
        self._scenario: Scenario
        # The source of the episodes' seeds; `FootballEnv.seed` replaces it by its own stream.
        self.draw: Callable[[int, int], int] = random.randint
        values = dict(values or {})
        if "render_resolution_x" in values and "render_resolution_y" not in values:
            width = _checked("render_resolution_x", values["render_resolution_x"])
            values["render_resolution_y"] = int(0.5625 * width)
        number = _checked("episode_number", values.pop("episode_number", 0))
        self.update(values)
        self._values["episode_number"] = number
        self.NewScenario()

    def __getitem__(self, key: str) -> Any:
        if key in self._scenario_values:
            return self._scenario_values[key]
        if key not in self._values:
            raise ParameterError(
                f"no setting `{key}`", name=str(key), help=similar(key, self._values)
            )
        return self._values[key]

    def __setitem__(self, key: str, value: Any) -> None:
        self._values[key] = _checked(key, value)

    def __contains__(self, key: object) -> bool:
        return key in self._scenario_values or key in self._values

    def __repr__(self) -> str:
        return f"Config({self.get_dictionary()})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Config) and self.get_dictionary() == other.get_dictionary()

    def serialize(self) -> dict[str, Any]:
        """Returns the settings without those of this episode."""
        return dict(self._values)

    def get(self, key: str, default: Any = None) -> Any:
        """Returns a setting, or `default` if it has no value."""
        return self.get_dictionary().get(key, default)

    def get_dictionary(self) -> dict[str, Any]:
        """Returns all settings, with their values in this episode."""
        return {**self._values, **self._scenario_values}

    def update(self, values: dict[str, Any]) -> None:
        """Sets several settings."""
        for key, value in values.items():
            self[key] = value

    def set_scenario_value(self, key: str, value: Any) -> None:
        """Sets a value for this episode only."""
        self._scenario_values[key] = value

    def number_of_left_players(self) -> int:
        """Returns how many players of the left team are controlled."""
        return sum(count_left_players(each) for each in self["players"])

    def number_of_right_players(self) -> int:
        """Returns how many players of the right team are controlled."""
        return sum(count_right_players(each) for each in self["players"])

    def number_of_players_agent_controls(self) -> int:
        """Returns how many players the `agent` plays."""
        return get_agent_number_of_players(self["players"])

    def has_bug(self, name: str) -> bool:
        """Whether a bug of GRF is restored."""
        return has_bug(self, name)

    def Scenario(self) -> Scenario:  # noqa: N802  # GRF's names
        """Returns the scenario of this episode."""
        return self._scenario

    def ScenarioConfig(self) -> ScenarioConfig:  # noqa: N802
        """Returns what the scenario of this episode sets."""
        return self._scenario.config()

    def NewScenario(self, inc: int = 1) -> None:  # noqa: N802
        """Builds the scenario of the next episode and draws its seed.

        `inc=0` builds the same scenario again.
        """
        self._scenario_values = {}
        self._values["episode_number"] += inc
        self._scenario = Scenario(self)
        recorded = self._scenario.config()
        if "reverse_team_processing" in self._values:
            recorded.reverse_team_processing = self._values["reverse_team_processing"]
        recorded.real_time = bool(self["real_time"])
        recorded.left_agents = self.number_of_left_players()
        recorded.right_agents = self.number_of_right_players()
        seed = self._values.get("game_engine_random_seed")
        if seed is None:
            seed = self.draw(0, SEED_MAX)
        if not recorded.deterministic:
            recorded.game_engine_random_seed = seed
        self._scenario_values["game_engine_random_seed"] = recorded.game_engine_random_seed


def has_bug(config: object, name: str) -> bool:
    """Whether a `Config`, or a dict of its settings, restores a bug of GRF.

    Anything else restores none.
    """
    bugs = (
        config["grf_bugs"]
        if isinstance(config, (Config, Mapping)) and "grf_bugs" in config
        else False
    )
    if isinstance(bugs, str):
        return bugs == name
    return name in bugs if isinstance(bugs, (list, tuple)) else bugs is True


def _checked(key: str, value: Any) -> Any:
    """Returns a setting's value; raises for an unknown, impossible or unsupported one.

    Integers are returned as Python's own, paths as text, because dumps hold them.
    """
    known = (*defaults(), *OPTIONAL)
    if key not in known:
        raise ParameterError(f"no setting `{key}`", name=str(key), help=similar(key, known))
    if key == "action_set":
        check_word(key, value, tuple(action_set_dict))
    elif key == "level":
        if not isinstance(value, str) or not value:
            raise ParameterError(
                "the level needs a name", name=key, help="for example `academy_3_vs_1_with_keeper`"
            )
    elif key == "players":
        _check_players(value)
    elif key == "tracesdir":
        return check_folder(key, value)
    elif key in WHOLE:
        return check_whole(key, value)
    elif key == "physics_steps_per_frame" and value != 10:
        raise unavailable(key, "another length of a step than 100 ms", "leave it at 10")
    elif key == "reverse_team_processing":
        # No effect on the match: the engine treats both teams alike, in either order.
        return ScenarioConfig(reverse_team_processing=value).reverse_team_processing
    elif key == "video_format":
        check_word(key, value, ("avi", "webm"))
    elif key == "video_quality_level" and check_whole(key, value, 0) >= len(QUALITIES):
        raise ParameterError(f"`{key}` is {value!r}; it is 0, 1 or 2", name=key)
    elif key == "game_engine_random_seed":
        return check_whole(key, value, 0)
    elif key == "grf_bugs" and not isinstance(value, bool):
        names = [value] if isinstance(value, str) else value
        if not isinstance(names, (list, tuple)):
            raise ParameterError(
                f"`{key}` is {value!r}; it is True, False or a list of names", name=key
            )
        for name in names:
            check_word(key, name, BUGS)
    return value


def check_whole(name: str, value: object, least: int | None = None) -> int:
    """Returns an integer, of Python or NumPy, as Python's; else raises `ParameterError`."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = index(value)  # type: ignore[arg-type]
        if least is not None and number < least:
            raise TypeError
    except TypeError:
        reach = "" if least is None else f" from {least} on"
        raise ParameterError(f"`{name}` is {value!r}; it is an integer{reach}", name=name) from None
    return number


def check_folder(name: str, value: object) -> str:
    """Returns a folder's path as text; raises `ParameterError` for anything else."""
    if isinstance(value, (str, PathLike)):
        path = fspath(value)
        if isinstance(path, str):
            return path
    raise ParameterError(f"`{name}` is {value!r}; it is the path of a folder", name=name)


def _check_players(definitions: Any) -> None:
    if isinstance(definitions, str) or not isinstance(definitions, (list, tuple)):
        raise ParameterError(
            f"expected a list of players' definitions, found `{definitions!r}`", name="players"
        )
    if sum(parse_player_definition(each)[0] == "agent" for each in definitions) > 1:
        raise ParameterError("there is at most one `agent` among the players", name="players")
