"""Names that a user may have misspelt."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from setpiece._errors import ParameterError, UnavailableError


def similar(name: object, known: Iterable[str]) -> str | None:
    """Returns a question that suggests the known name nearest to one that isn't."""
    found = get_close_matches(str(name), list(known), n=1)
    return f"did you mean `{found[0]}`?" if found else None


def check_word(option: str, name: object, known: tuple[str, ...]) -> None:
    """Raises `ParameterError` where an option's value is none of those known."""
    if not isinstance(name, str) or name not in known:
        raise ParameterError(
            f"no {option.replace('_', ' ')} `{name}`; there are `{'`, `'.join(known)}`",
            name=option,
            help=similar(name, known),
        )


def unavailable(name: str, what: str, instead: str | None = None) -> UnavailableError:
    """Returns the error of what GRF has and this version has not."""
    return UnavailableError(f"{what} is not in this version", name=name, help=instead)
