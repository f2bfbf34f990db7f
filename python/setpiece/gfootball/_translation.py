"""Translates a recorded scenario of Google Research Football to a `.pitch` text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from setpiece import _native
from setpiece._errors import SetpieceError

if TYPE_CHECKING:
    from setpiece.gfootball.env.scenario_config import ScenarioConfig

LIMIT_MAX = _native.GRF_LIMIT_MAX
"""The largest number of steps for `end limit`."""


class TranslationError(SetpieceError):
    """A scenario script contains what a `.pitch` text can't express; the message says what."""


def identifier(name: str) -> str:
    """Returns a valid name: that of a level, or of a path without folder and ending."""
    # A path may hold bytes that aren't text.
    return _native.grf_name(name.encode(errors="replace").decode())


def to_pitch(recorded: ScenarioConfig, name: str, other: ScenarioConfig | None = None) -> str:
    """Returns the text of a recorded scenario; it compiles and has the layout of `setpiece fmt`.

    - `recorded`: the script's result in even episodes, so in the first one.
    - `other`: its result in odd episodes, if that may differ.

    Raises `TranslationError` if the two differ in more than `kickoff alternate(…)` or a number
    `alternate(…, …)` can express.
    """
    return _native.grf_text(recorded, recorded if other is None else other, name)
