"""Scenarios as dicts, and the texts that they are converted to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from numbers import Real
from typing import Any, TypedDict

import numpy as np

from setpiece._errors import ParameterError
from setpiece._words import similar

Value = bool | float | str | Sequence[Any] | Mapping[str, Any]
"""A value: True and False are `on` and `off`, a tuple is `(a, b)`, a dict `{ key: value }`.

A string is written as in the language: `"lazy"`, `"3m/s"`, `"uniform(-0.1, 0.1)"`.
"""

Place = tuple[float | str, float | str] | tuple[float | str, float | str, Mapping[str, Value]] | str
Player = (
    tuple[str, float | str, float | str]
    | tuple[str, float | str, float | str, Mapping[str, Value]]
    | str
)

DEFAULT_NAME = "from_dict"


class ScenarioDict(TypedDict, total=False):
    """A scenario as a dict; every key may be left out. `pitch_text` shows its text.

    Places are x, y in the world's frame, normalised like GRF's: goals at (-1, 0) and (1, 0), +y
    down. A string instead of a value is written as in the language.

    - `name`: a word; `"from_dict"` without it. `extends`: a scenario of the library, such as
      `"academy"`.
    - `ball`: `(x, y)`, `(x, y, {option: value})`, or words: `"ahead of carrier by 1m"`.
    - `left`, `right`: lists of players: `(role, x, y)`, `(role, x, y, {option: value})` with the
      options of the language (`ai`, `velocity`, `stats`, …) and `name`, or words: `"3 CB in
      right.box"`.
    - `difficulty`: `{"left": 1.0, "right": 0.6}`.
    - `agents`: `{"left": count, "all" or names, "right": …, "others": "hold", "switching":
      "fixed"}`.
    - `rules`: `{"offside": False, …}`. `world`: `{"gravity": 9.81, "wind": "(4m/s, 0m/s)", …}`.
      `pitch`: `{"length": "60m", "width": "40m", …}`.
    - `limit`: steps, or words: `"30s"`.
    - `rewards`: a list of names or words: `"scoring"`, `"checkpoints(regions: 5) * 0.5"`, `"effort
      { give -0.01 when ball in left.half as 'back' }"` (with double quotes).
    - `ends`: a list of words: `"success scored when goal by left"`.
    """

    name: str
    extends: str
    ball: Place
    left: Sequence[Player]
    right: Sequence[Player]
    difficulty: Mapping[str, float | str]
    agents: Mapping[str, int | str | Sequence[str]]
    rules: Mapping[str, Value]
    world: Mapping[str, Value]
    pitch: Mapping[str, Value]
    limit: int | str
    rewards: Sequence[str]
    ends: Sequence[str]


KEYS = tuple(ScenarioDict.__annotations__)
SIDES = ("left", "right")


def scenario_name(scenario: Mapping[str, Any]) -> str:
    """Returns the name of a scenario in this form."""
    return str(scenario.get("name", DEFAULT_NAME))


def pitch_text(scenario: ScenarioDict) -> str:
    """Returns the text of a scenario that is given as a dict, in the layout of `setpiece fmt`.

    Raises `ParameterError` for a key or value that doesn't fit this form. The compiler checks the
    meaning of the text.

    >>> import setpiece
    >>> print(setpiece.pitch_text({"ball": (0.8, 0), "left": [("CF", 0.75, 0, {"name": "anna"})], "limit": 50}))
    scenario from_dict {
        ball at (0.8, 0)
    <BLANKLINE>
        team left {
            anna: CF at (0.75, 0)
        }
    <BLANKLINE>
        end limit 50 steps
    }
    <BLANKLINE>
    """
    _check_keys(scenario, KEYS, "scenario")
    head = f"scenario {_word(scenario_name(scenario), 'name')}"
    if "extends" in scenario:
        head += f" extends {_words(scenario['extends'], 'extends')}"
    first = [
        *([f"    rules {_options(scenario['rules'], 'rules')}"] if "rules" in scenario else []),
        *([f"    world {_options(scenario['world'], 'world')}"] if "world" in scenario else []),
        *([f"    pitch {_options(scenario['pitch'], 'pitch')}"] if "pitch" in scenario else []),
        *([f"    agents {_agents(scenario['agents'])}"] if "agents" in scenario else []),
        *([f"    ball {_place(scenario['ball'], 'ball')}"] if "ball" in scenario else []),
    ]
    blocks = [
        first,
        *_teams(scenario),
        [f"    reward {_words(text, 'rewards')}" for text in _list(scenario, "rewards")],
        [
            *(f"    end {_words(text, 'ends')}" for text in _list(scenario, "ends")),
            *([f"    end limit {_limit(scenario['limit'])}"] if "limit" in scenario else []),
        ],
    ]
    body = "\n\n".join("\n".join(block) for block in blocks if block)
    return f"{head} {{\n{body}\n}}\n"


def number_text(value: Any) -> str:
    """Returns a number as the language writes it."""
    return np.format_float_positional(float(value) + 0.0, trim="-")


def _teams(scenario: ScenarioDict) -> list[list[str]]:
    difficulty = scenario.get("difficulty", {})
    _check_keys(difficulty, SIDES, "difficulty")
    teams = []
    for side in SIDES:
        players = [
            _player(player, f"{side}[{at}]") for at, player in enumerate(_list(scenario, side))
        ]
        level = (
            [f"difficulty: {_value(difficulty[side], 'difficulty')}"] if side in difficulty else []
        )
        lines = [f"        {line}" for line in [*level, *players]]
        if lines:
            teams.append([f"    team {side} {{", *lines, "    }"])
    return teams


def _player(player: object, where: str) -> str:
    if isinstance(player, str):
        return _words(player, where)
    if not isinstance(player, Sequence) or len(player) not in (3, 4):
        raise _wrong(where, "(role, x, y), (role, x, y, options) or words", player)
    options = dict(player[3]) if len(player) == 4 and isinstance(player[3], Mapping) else {}
    name = options.pop("name", None)
    place = (
        *player[1:3],
        options if len(player) == 3 or isinstance(player[3], Mapping) else player[3],
    )
    who = "" if name is None else f"{_word(name, where)}: "
    return f"{who}{_word(player[0], where)} {_place(place, where)}"


def _place(place: object, where: str) -> str:
    if isinstance(place, str):
        return _words(place, where)
    if not isinstance(place, Sequence) or len(place) not in (2, 3):
        raise _wrong(where, "(x, y), (x, y, options) or words", place)
    options = place[2] if len(place) == 3 else {}
    spot = f"at {_value(tuple(place[:2]), where)}"
    return f"{spot} {_options(options, where)}" if options != {} else spot


def _agents(agents: object) -> str:
    if not isinstance(agents, Mapping):
        raise _wrong("agents", "a dict", agents)
    listed = {
        key: f"[{', '.join(_word(one, 'agents') for one in value)}]"
        if isinstance(value, Sequence) and not isinstance(value, str)
        else value
        for key, value in agents.items()
    }
    return _options(listed, "agents")


def _options(options: object, where: str) -> str:
    if not isinstance(options, Mapping):
        raise _wrong(where, "options as a dict", options)
    pairs = [f"{_word(key, where)}: {_value(value, where)}" for key, value in options.items()]
    return f"{{ {', '.join(pairs)} }}"


def _value(value: object, where: str) -> str:
    if isinstance(value, bool | np.bool_):
        return "on" if value else "off"
    if isinstance(value, Real) and isfinite(value):
        return number_text(value)
    if isinstance(value, str):
        return _words(value, where)
    if isinstance(value, Mapping):
        return _options(value, where)
    if isinstance(value, Sequence | np.ndarray):
        return f"({', '.join(_value(part, where) for part in value)})"
    raise _wrong(where, "a finite number, a bool, a string, a tuple or a dict", value)


def _limit(limit: object) -> str:
    if isinstance(limit, str):
        return _words(limit, "limit")
    if isinstance(limit, int | np.integer) and not isinstance(limit, bool):
        return f"{limit} steps"
    raise _wrong("limit", "steps as an integer, or words", limit)


def _list(scenario: Mapping[str, Any], key: str) -> Sequence[Any]:
    listed = scenario.get(key, ())
    if isinstance(listed, str) or not isinstance(listed, Sequence):
        raise _wrong(key, "a list", listed)
    return listed


def _word(word: object, where: str) -> str:
    if isinstance(word, str) and word.isidentifier():
        return word
    raise _wrong(where, "a word", word)


def _words(words: object, where: str) -> str:
    if isinstance(words, str) and words.strip():
        return words.strip()
    raise _wrong(where, "the language's words", words)


def _check_keys(given: object, known: tuple[str, ...], where: str) -> None:
    if not isinstance(given, Mapping):
        raise _wrong(where, "a dict", given)
    for key in given:
        if key not in known:
            raise ParameterError(
                f"a {where} has no `{key}`; it has `{'`, `'.join(known)}`",
                name=str(key),
                help=similar(key, known),
            )


def _wrong(where: str, expected: str, found: object) -> ParameterError:
    return ParameterError(f"`{where}`: expected {expected}, found `{found!r}`", name=where)
