"""How agents are asked for, instead of those that the scenario seats."""

from __future__ import annotations

from collections.abc import Sequence

Seats = int | str | Sequence[str] | None
"""How many agents play on a side: a count, `"all"`, the names of players, or None for what the scenario says."""
