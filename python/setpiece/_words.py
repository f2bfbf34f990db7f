"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from setpiece._errors import ParameterError


def similar(name: object, known: Iterable[str]) -> str | None:
    """Returns a question that suggests the known name nearest to an unknown one."""
    found = get_close_matches(str(name), list(known), n=1)
    return f"did you mean `{found[0]}`?" if found else None


def is_text(text: str) -> bool:
    """Whether a string is valid Unicode; lone surrogates can't reach the engine or a file."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def check_word(option: str, name: object, known: tuple[str, ...]) -> str:
    """Returns an option's value, or raises `ParameterError` if it isn't a known one."""
    if isinstance(name, str) and name in known:
        return name
    raise ParameterError(
        f"no {option.replace('_', ' ')} `{name}`; there are `{'`, `'.join(known)}`",
        name=option,
        help=similar(name, known),
    )
