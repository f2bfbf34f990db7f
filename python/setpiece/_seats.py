"""A scenario with other players in the hands of agents."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from os import PathLike, fspath
from pathlib import Path

from setpiece import _library
from setpiece._errors import CompileError, ParameterError
from setpiece._native import Scenario, compile, load

Seats = int | str | Sequence[str] | None
"""How many agents play on a side: a count, `"all"`, the names of players, or None for what the scenario says."""

NAME = re.compile(r"[^\W\d]\w*")
SIDES = ("left", "right")


def seated(
    scenario: Scenario | str | PathLike[str],
    left: Seats = None,
    right: Seats = None,
    *,
    fixed: bool = False,
    ai: Mapping[str, str] | None = None,
) -> Scenario:
    """Returns a scenario whose agents play other players.

    - `left`, `right`: see `Seats`.
    - `fixed`: whether every agent keeps its player, whatever its side's count.
    - `ai`: by side, who plays its players without an agent, as `ai:` of the language says it: `"lazy"`, `"marker(3m)"`.
      A player with an `ai` of his own keeps it.

    Raises `ParameterError` for seats that the scenario hasn't got, and for a compiled scenario, which is as it is.
    """
    seats = {side: _written(side, value) for side, value in zip(SIDES, (left, right), strict=True) if value is not None}
    ai = ai or {}
    if not (seats or fixed or ai):
        return scenario if isinstance(scenario, Scenario) else load(fspath(scenario))
    if isinstance(scenario, Scenario) or Path(scenario).suffix == ".pitchc":
        if not (seats or ai):
            return scenario if isinstance(scenario, Scenario) else load(fspath(scenario))
        raise ParameterError(
            f"a compiled scenario keeps its agents: {_options(seats, ai)} can't change them",
            name=next(iter(seats or ai)),
            help="give the scenario's name or the path of its `.pitch` file, or write `agents { … }` in the text",
        )
    base = load(fspath(scenario))
    words = [f"{side}: {value}" for side, value in seats.items()] + ["switching: fixed"] * fixed
    teams = [f"team {side} {{ each all {{ ai: {who} }} }}" for side, who in ai.items()]
    origin, name, parent = _origin(scenario, base)
    doc = f"/// {base.title}\n" if base.title else ""
    body = "\n".join([f"agents {{ {' '.join(words)} }}", *teams] if words else teams)
    text = f"{origin}\n{doc}scenario {name} extends {parent} {{\n{body}\n}}"
    try:
        return compile(text, base.name)
    except CompileError as error:
        first = error.diagnostics[0]
        message = f"`{base.name}` can't be played with {_options(seats, ai)}: {first.message}"
        raise ParameterError(
            message, name=next(iter(seats or ai), "agents"), code=first.code, help=first.help
        ) from None


def _origin(scenario: str | PathLike[str], base: Scenario) -> tuple[str, str, str]:
    """The import that brings a scenario, what its child is called, and what it is called itself."""
    if fspath(scenario) in _library.list():
        return "", f"{base.name}_seated", base.name
    path = Path(scenario).resolve().as_posix()
    if '"' in path or "\n" in path:
        raise ParameterError(f"the path of the scenario can't be imported: {path!r}", name="scenario")
    # Twice: `origin` brings the scenario under another name than its child's, the other what `ai:` may name.
    return f'import "{path}" as origin\nimport "{path}"', base.name, f"origin.{base.name}"


def _options(seats: Mapping[str, str], ai: Mapping[str, str]) -> str:
    return ", ".join([f"`{side}={value}`" for side, value in seats.items()] + [f"`{who}`" for who in ai.values()])


def _written(side: str, value: object) -> str:
    """Seats as the language writes them."""
    if value == "all" or (isinstance(value, int) and not isinstance(value, bool) and value >= 0):
        return str(value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        for name in value:
            if not isinstance(name, str) or not NAME.fullmatch(name):
                raise ParameterError(f"`{side}` lists {name!r}, which is no player's name", name=side)
        return f"[{', '.join(value)}]"
    meant = None
    if isinstance(value, str) and NAME.fullmatch(value):
        meant = "'all'" if get_close_matches(value, ["all"]) else f"`{side}=['{value}']`"
    raise ParameterError(
        f"`{side}` is {value!r}; it can be a count, 'all' or a list of players' names",
        name=side,
        help=f"did you mean {meant}?" if meant else None,
    )
