"""What GRF has and this version has not."""

from __future__ import annotations

from setpiece._errors import UnavailableError


def unavailable(name: str, what: str, instead: str | None = None) -> UnavailableError:
    """Returns the error of what GRF has and this version has not."""
    return UnavailableError(f"{what} is not in this version", name=name, help=instead)
