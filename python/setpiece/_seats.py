"""Who plays: agents asked for instead of the scenario's, and behaviours in their place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from setpiece import _library
from setpiece._errors import CompileError, ParameterError
from setpiece._native import Scenario, compile
from setpiece._source import Source, load, path_of, text_of

Seats = int | str | Sequence[str] | None
"""How many agents play on a side: a count, `"all"`, the names of players, or None for what the scenario says."""


def scripted_scenario(scenario: Source, ai: Mapping[str, str]) -> Scenario:
    """Returns a scenario whose sides are played by behaviours.

    - `ai`: by side, who plays its players without an agent, as `ai:` of the language says it: `"lazy"`, `"marker(3m)"`.
      A player with an `ai` of his own keeps it.

    Raises `ParameterError` for a behaviour that the scenario hasn't got, and for a compiled one, which is as it is.
    """
    base = load(scenario)
    if not ai:
        return base
    words = ", ".join(f"`{who}`" for who in ai.values())
    text = text_of(scenario)
    if isinstance(scenario, Scenario) or (text is None and Path(path_of(scenario)).suffix == ".pitchc"):
        raise ParameterError(
            f"a compiled scenario keeps who plays its players: {words} can't change them",
            name=next(iter(ai)),
            help="give the scenario's name or the path of its `.pitch` file, or write `ai: …` in the text",
        )
    teams = [f"team {side} {{ each all {{ ai: {who} }} }}" for side, who in ai.items()]
    origin, name, parent = _origin(path_of(scenario), base) if text is None else (text, *_heir(base))
    doc = f"/// {base.title}\n" if base.title else ""
    body = "\n".join(teams)
    try:
        return compile(f"{origin}\n{doc}scenario {name} extends {parent} {{\n{body}\n}}", base.name)
    except CompileError as error:
        first = error.diagnostics[0]
        message = f"`{base.name}` can't be played with {words}: {first.message}"
        raise ParameterError(message, name=next(iter(ai)), code=first.code, help=first.help) from None


def _origin(scenario: str, base: Scenario) -> tuple[str, str, str]:
    """The import that brings a scenario, what its child is called, and what it is called itself."""
    if scenario in _library.list():
        return "", *_heir(base)
    path = Path(scenario).resolve().as_posix()
    if '"' in path or "\n" in path:
        raise ParameterError(f"the path of the scenario can't be imported: {path!r}", name="scenario")
    # Twice: `origin` brings the scenario under another name than its child's, the other what `ai:` may name.
    return f'import "{path}" as origin\nimport "{path}"', base.name, f"origin.{base.name}"


def _heir(base: Scenario) -> tuple[str, str]:
    """What the child of a scenario is called that stands beside it, and the scenario itself."""
    return f"{base.name}_scripted", base.name
