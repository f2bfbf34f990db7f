"""GRF's features that aren't supported in this version."""

from __future__ import annotations

from setpiece._errors import UnavailableError


def unavailable(name: str, what: str, instead: str | None = None) -> UnavailableError:
    """Returns the error for a feature of GRF that isn't supported in this version."""
    return UnavailableError(f"{what} is not in this version", name=name, help=instead)
