"""Behaviours and scripts that play in the place of opponents: the engine plays them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from setpiece import _native
from setpiece._errors import CompileError, ParameterError
from setpiece._native import AgentInfo, Scenario
from setpiece._opponents import BOT, SIDES, Opponent, ends_with, is_word, no_agent, read_opponents
from setpiece._seats import Seats
from setpiece._source import Source, load, name_of, path_of, text_of


def behaviors(opponents: Mapping[str, Opponent] | None) -> dict[str, str]:
    """Returns the sides and agents that behaviours play, with what stands behind `ai:`.

    Beside them the agents that the bot was named for: it plays them in a side that a behaviour plays, too.
    """
    words = {who: _ai(one) for who, one in read_opponents(opponents).items() if is_word(one)}
    if all(word == BOT for word in words.values()):
        return {}
    return {who: word for who, word in words.items() if word != BOT or who not in SIDES}


def revivable(opponents: Mapping[str, Opponent] | None) -> dict[str, Opponent] | None:
    """Returns the opponents for a scenario that has its behaviours already."""
    scripted = behaviors(opponents)
    return {who: BOT if who in scripted else one for who, one in read_opponents(opponents).items()} or None


def scripted_scenario(
    scenario: Source,
    ai: Mapping[str, str],
    *,
    params: Mapping[str, Any] | None = None,
    left: Seats = None,
    right: Seats = None,
    switching: str | None = None,
) -> Scenario:
    """Returns a scenario whose players are played by behaviours.

    - `ai`: by side or agent, who plays, as `ai:` of the language says it: `"lazy"`, `"marker(3m)"`. A side's plays its
      players who have no `ai` of their own, an agent's the player that the agent keeps.
    - `params`, `left`, `right`, `switching`: those of `setpiece.make`, which agents depend on.

    Raises `ParameterError` for a behaviour that the scenario hasn't got, for an agent that isn't there or changes
    players, and for a compiled scenario, which is as it is.
    """
    if not ai:
        return load(scenario)
    sides = {who: word for who, word in ai.items() if who in SIDES}
    casting: list[tuple[int, int | None, str]] = [(SIDES.index(side), None, word) for side, word in sides.items()]
    named = {who: word for who, word in ai.items() if who not in SIDES}
    if named:
        bound = load(scenario).with_params(**(params or {}))
        agents = _native.agents(bound, left=left, right=right, switching=switching)
        casting += [one for who, word in named.items() if (one := _of_agent(who, word, agents, ai)) is not None]
    words = ", ".join(f"`{word}`" for _, _, word in casting)
    if isinstance(scenario, Scenario):
        raise ParameterError(
            f"a compiled scenario keeps who plays its players: {words} can't change them",
            name="opponents",
            code="SP0015",
            help="give the scenario's name or the path of its `.pitch` file, or write `ai: …` in the text",
        )
    text = text_of(scenario)
    try:
        if text is None:
            return _native.load_cast(path_of(scenario), casting)
        return _native.compile_cast(text, name_of(scenario), casting)
    except CompileError as error:
        # A scenario that has errors of its own raises those here.
        base = load(scenario)
        first = next(one for one in error.diagnostics if one.severity == "error")
        message = f"`{base.name}` can't be played with {words}: {first.message}"
        raise ParameterError(message, name="opponents", code=first.code, help=first.help) from None


def _of_agent(
    who: str, word: str, agents: Sequence[AgentInfo], ai: Mapping[str, str]
) -> tuple[int, int | None, str] | None:
    """Whose `ai` an agent's opponent is; None for a bot that is there anyway."""
    agent = next((agent for agent in agents if agent.id == who), None)
    if agent is None:
        raise no_agent(who, [agent.id for agent in agents])
    if word == BOT and SIDES[agent.team] not in ai:
        return None
    if agent.place is None:
        raise ParameterError(
            f"`{word}` can't play `{who}`, who changes players: a behaviour plays one of them",
            name="opponents",
            help=f"let him keep his player (`switching='fixed'`), or give it the whole side: {SIDES[agent.team]!r}",
        )
    return agent.team, agent.place, word


def _ai(opponent: str | PathLike[str]) -> str:
    """What stands behind `ai:`: a behaviour as it is, a script's file as one."""
    if not ends_with(opponent, ".rhai"):
        return fspath(opponent)
    path = Path(opponent).resolve().as_posix()
    if '"' in path or "\n" in path:
        raise ParameterError(f"a scenario can't name the path of the script: {path!r}", name="opponents")
    return f'script "{path}"'
