"""What happened to a scenario's file while an environment watched it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from setpiece._errors import SetpieceError
from setpiece._native import Scenario


@dataclass(frozen=True)
class Reload:
    """A changed file, and what became of it; see `FootballEnv.last_reload`.

    - `state`: `"applied"`, `"broken"` (it doesn't compile) or `"held back"` (it would change the environment's spaces);
      unless it was applied, the scenario before it goes on.
    - `scenario`: the new scenario; None where it is broken.
    - `error`: why it is broken: a `CompileError` or `FileError`.
    - `why`: the state in one sentence.
    """

    state: Literal["applied", "broken", "held back"]
    scenario: Scenario | None
    error: SetpieceError | None
    why: str
