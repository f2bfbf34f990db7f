"""Colours for `.pitch` texts in everything that uses Pygments: notebooks, Sphinx, MkDocs, a shell.

Pygments finds the lexer by itself once the package is installed:

>>> from pygments.lexers import get_lexer_by_name
>>> get_lexer_by_name("pitch").name
'Setpiece'

The patterns are those of the grammar for editors, `pitch.tmLanguage.json`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from setpiece._optional import need

if TYPE_CHECKING:
    from pygments import lexer as base
    from pygments import token
else:
    base = need("pygments.lexer", "pygments", "the lexer for .pitch texts")
    token = need("pygments.token", "pygments", "the lexer for .pitch texts")

Token = Any
"""A token type of Pygments."""

GRAMMAR = "pitch.tmLanguage.json"
"""The grammar for editors: the file of the repository's `grammar/`."""

TOKENS: Mapping[str, Token] = {
    "comment.line": token.Comment.Single,
    "comment.block": token.Comment.Multiline,
    "comment.block.documentation": token.String.Doc,
    "constant.character.escape": token.String.Escape,
    "constant.language.boolean": token.Keyword.Constant,
    "constant.language.role": token.Name.Class,
    "constant.numeric": token.Number,
    "entity.name": token.Name.Function,
    "entity.other.inherited-class": token.Name.Function,
    "keyword.control": token.Keyword,
    "keyword.declaration": token.Keyword.Declaration,
    "keyword.operator": token.Operator,
    "keyword.other.unit": token.Keyword.Type,
    "string.quoted": token.String.Double,
    "support.constant.event": token.Name.Constant,
    "support.constant.qualifier": token.Name.Constant,
    "support.function": token.Name.Builtin,
    "support.type": token.Keyword.Type,
    "variable.language": token.Name.Builtin.Pseudo,
    "variable.other": token.Name,
    "variable.other.property": token.Name.Attribute,
    "variable.parameter": token.Name.Attribute,
}
"""The token type of each scope of the grammar; the longest prefix counts."""


def token_of(scope: str) -> Token:
    """Returns the token type of a scope: of its longest prefix in `TOKENS`."""
    words = scope.split(".")
    for length in range(len(words), 0, -1):
        found = TOKENS.get(".".join(words[:length]))
        if found is not None:
            return found
    raise KeyError(scope)


Rule = tuple[Any, ...]
Part = tuple[int, Token, str]


def _pieces(groups: Mapping[int, Token]) -> Callable[[Any, re.Match[str]], Iterator[Part]]:
    """Returns what yields the captures of a match with their tokens, and the rest as text."""

    def pieces(lexer: Any, match: re.Match[str]) -> Iterator[Part]:
        at = match.start()
        for group, kind in groups.items():
            start, end = match.span(group)
            if start < 0:
                continue
            yield from lexer.between(at, match.string[at:start])
            yield start, kind, match[group]
            at = end
        yield from lexer.between(at, match.string[at : match.end()])

    return pieces


def _rules(
    grammar: Mapping[str, Any], entries: list[Mapping[str, Any]], states: dict[str, list[Rule]]
) -> Iterator[Rule]:
    """Yields the rules of Pygments for entries of the grammar; adds the states that they open."""
    for entry in entries:
        if "include" in entry:
            name = entry["include"].removeprefix("#")
            # Scripts are in another language, which Pygments doesn't know.
            if name in grammar["repository"]:
                yield from _rules(grammar, grammar["repository"][name]["patterns"], states)
        elif "begin" in entry:
            kind, state = token_of(entry["name"]), f"inside-{len(states)}"
            states[state] = []
            inner = list(_rules(grammar, entry.get("patterns", []), states))
            end = entry["end"]
            states[state] = [*inner, (end, kind, "#pop"), (r".|\n", kind)]
            yield entry["begin"], kind, state
        elif "captures" in entry:
            groups = {
                int(group): token_of(scope["name"]) for group, scope in entry["captures"].items()
            }
            yield entry["match"], _pieces(groups)
        else:
            yield entry["match"], token_of(entry["name"])


def _states() -> dict[str, list[Rule]]:
    """Returns the states of the lexer, made of the grammar."""
    grammar = json.loads(files("setpiece").joinpath(GRAMMAR).read_text(encoding="utf-8"))
    states: dict[str, list[Rule]] = {"root": []}
    states["root"] = [
        (r"\s+", token.Whitespace),
        *_rules(grammar, grammar["patterns"], states),
        (r"\w+", token.Name),
        (r"[(){}\[\]:;,.?]", token.Punctuation),
    ]
    return states


class PitchLexer(base.RegexLexer):
    """Colours the language of scenarios; `get_lexer_by_name("pitch")` returns it."""

    name = "Setpiece"
    aliases = ["pitch", "setpiece"]
    filenames = ["*.pitch"]
    mimetypes = ["text/x-setpiece"]
    flags = re.MULTILINE | re.ASCII
    tokens = _states()

    def between(self, at: int, text: str) -> Iterator[Part]:
        """Yields what a pattern matched without a scope for it: spaces and punctuation."""
        for found in re.finditer(r"(\s+)|(\w+)|[^\w\s]", text):
            kind = (token.Punctuation, token.Whitespace, token.Name)[found.lastindex or 0]
            yield at + found.start(), kind, found[0]
