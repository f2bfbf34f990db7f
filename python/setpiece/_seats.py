"""How agents are requested instead of those that the scenario defines."""

from __future__ import annotations

from collections.abc import Sequence

Seats = int | str | Sequence[str] | None
"""The agents of a side: a count, `"all"`, names of players, or None for the scenario's."""
