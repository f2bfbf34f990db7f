"""Behaviours and scripts as opponents: the engine plays them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from setpiece import _native
from setpiece._errors import CompileError, ParameterError
from setpiece._native import AgentInfo, Scenario
from setpiece._opponents import BOT, SIDES, Opponent, ends_with, is_word, no_agent, read_opponents
from setpiece._options import ParamValue
from setpiece._source import Source, load, name_of, path_of, text_of

if TYPE_CHECKING:
    from setpiece._env_options import EnvOptions


class Casting(NamedTuple):
    """What plays a team, or one player of it."""

    team: int
    """0 left, 1 right."""
    place: int | None
    """The player's index in the team; None for the whole team."""
    ai: str
    """The scenario's text after `ai:`."""


def behaviors(opponents: Mapping[str, Opponent] | None) -> dict[str, str]:
    """Returns the sides and agents that behaviours play, with the text after `ai:`.

    Agents assigned to the bot are included: the bot plays them even in a side that a behaviour
    plays.
    """
    words = {who: _ai(one) for who, one in read_opponents(opponents).items() if is_word(one)}
    if all(word == BOT for word in words.values()):
        return {}
    return {who: word for who, word in words.items() if word != BOT or who not in SIDES}


def revivable(opponents: Mapping[str, Opponent] | None) -> dict[str, Opponent] | None:
    """Returns the opponents for a scenario that already has its behaviours."""
    scripted = behaviors(opponents)
    return {
        who: BOT if who in scripted else one for who, one in read_opponents(opponents).items()
    } or None


def scripted_scenario(
    scenario: Source,
    options: EnvOptions,
    params: Mapping[str, ParamValue],
    name: str | None = None,
) -> Scenario:
    """Returns a scenario whose players are played by the behaviours and scripts of `options`.

    A side's behaviour plays its players without an `ai` of their own; an agent's behaviour plays
    the player that the agent keeps. `params` are bound only to determine the agents; the returned
    scenario doesn't have them. `name` is which of several in a file or a text, as in
    `setpiece.load`.

    Raises `ParameterError` for an unknown behaviour, for an agent that doesn't exist or that
    changes players, and for a compiled scenario, which can't be changed.
    """
    ai, outside = options.scripted, options.allow_outside
    if not ai:
        return load(scenario, name, allow_outside=outside)
    casting = [Casting(SIDES.index(who), None, word) for who, word in ai.items() if who in SIDES]
    named = {who: word for who, word in ai.items() if who not in SIDES}
    if named:
        agents = _native.agents(
            load(scenario, name, allow_outside=outside).with_params(**params), options
        )
        casting += [
            one
            for who, word in named.items()
            if (one := _of_agent(who, word, agents, ai)) is not None
        ]
    words = ", ".join(f"`{word}`" for word in (one.ai for one in casting))
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
            return _native.load_cast(path_of(scenario), name, casting, allow_outside=outside)
        return _native.compile_cast(text, name_of(scenario), name, casting, allow_outside=outside)
    except CompileError as error:
        # A scenario with errors of its own raises them here.
        base = load(scenario, name, allow_outside=outside)
        first = next(one for one in error.diagnostics if one.severity == "error")
        message = f"`{base.name}` can't be played with {words}: {first.message}"
        raise ParameterError(message, name="opponents", code=first.code, help=first.help) from None


def _of_agent(
    who: str, word: str, agents: Sequence[AgentInfo], ai: Mapping[str, str]
) -> Casting | None:
    """The player whose `ai` an agent's opponent is; None for a bot that plays them anyway."""
    agent = next((agent for agent in agents if agent.id == who), None)
    if agent is None:
        raise no_agent(who, [agent.id for agent in agents])
    if word == BOT and SIDES[agent.team] not in ai:
        return None
    if agent.place is None:
        raise ParameterError(
            f"`{word}` can't play `{who}`, which changes players: a behaviour plays only one player",
            name="opponents",
            help=f"let it keep its player (`switching='fixed'`), or name the side: {SIDES[agent.team]!r}",
        )
    return Casting(agent.team, agent.place, word)


def _ai(opponent: str | PathLike[str]) -> str:
    """The text after `ai:`: a behaviour unchanged, a script's file as a behaviour."""
    if not ends_with(opponent, ".rhai"):
        return fspath(opponent)
    path = Path(opponent).resolve().as_posix()
    if '"' in path or "\n" in path:
        raise ParameterError(
            f"a scenario can't name the path of the script: {path!r}", name="opponents"
        )
    return f'script "{path}"'
