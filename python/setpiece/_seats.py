"""Who plays: agents asked for instead of the scenario's, and behaviours in their place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path

from setpiece import _library
from setpiece._errors import CompileError, ParameterError
from setpiece._native import Scenario, compile, load

Seats = int | str | Sequence[str] | None
"""How many agents play on a side: a count, `"all"`, the names of players, or None for what the scenario says."""


def scripted_scenario(scenario: Scenario | str | PathLike[str], ai: Mapping[str, str]) -> Scenario:
    """Returns a scenario whose sides are played by behaviours.

    - `ai`: by side, who plays its players without an agent, as `ai:` of the language says it: `"lazy"`, `"marker(3m)"`.
      A player with an `ai` of his own keeps it.

    Raises `ParameterError` for a behaviour that the scenario hasn't got, and for a compiled one, which is as it is.
    """
    if not ai:
        return scenario if isinstance(scenario, Scenario) else load(fspath(scenario))
    words = ", ".join(f"`{who}`" for who in ai.values())
    if isinstance(scenario, Scenario) or Path(scenario).suffix == ".pitchc":
        raise ParameterError(
            f"a compiled scenario keeps who plays its players: {words} can't change them",
            name=next(iter(ai)),
            help="give the scenario's name or the path of its `.pitch` file, or write `ai: …` in the text",
        )
    base = load(fspath(scenario))
    teams = [f"team {side} {{ each all {{ ai: {who} }} }}" for side, who in ai.items()]
    origin, name, parent = _origin(scenario, base)
    doc = f"/// {base.title}\n" if base.title else ""
    body = "\n".join(teams)
    text = f"{origin}\n{doc}scenario {name} extends {parent} {{\n{body}\n}}"
    try:
        return compile(text, base.name)
    except CompileError as error:
        first = error.diagnostics[0]
        message = f"`{base.name}` can't be played with {words}: {first.message}"
        raise ParameterError(message, name=next(iter(ai)), code=first.code, help=first.help) from None


def _origin(scenario: str | PathLike[str], base: Scenario) -> tuple[str, str, str]:
    """The import that brings a scenario, what its child is called, and what it is called itself."""
    if fspath(scenario) in _library.list():
        return "", f"{base.name}_scripted", base.name
    path = Path(scenario).resolve().as_posix()
    if '"' in path or "\n" in path:
        raise ParameterError(f"the path of the scenario can't be imported: {path!r}", name="scenario")
    # Twice: `origin` brings the scenario under another name than its child's, the other what `ai:` may name.
    return f'import "{path}" as origin\nimport "{path}"', base.name, f"origin.{base.name}"
