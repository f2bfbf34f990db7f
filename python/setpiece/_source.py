"""The forms of a scenario: a name, a path, a text, a dict, or compiled."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike, fspath

from setpiece import _native
from setpiece._errors import ParameterError, SetpieceError
from setpiece._native import Scenario
from setpiece._scenario_dict import ScenarioDict, pitch_text, scenario_name

Source = Scenario | ScenarioDict | str | PathLike[str]
"""A scenario: compiled, a `ScenarioDict`, a name in the library, a file's path, or a text."""


def load(source: Source, *, allow_outside: bool = False) -> Scenario:
    """Loads a scenario: a name of the library, the path of a file, a text, or a `ScenarioDict`.

    Files are `.pitch` or `.pitchc`. A string with a `{` is a text. Imports and scripts must be in
    the file's folder or below (for a text: in the working directory), unless `allow_outside`
    permits other places. Raises `UnknownScenarioError`, `FileError`, `CompileError`, `FormatError`,
    and `ParameterError` for a dict that isn't a scenario, or a level.

    >>> import setpiece
    >>> setpiece.load("academy_corner")
    Scenario(academy_corner: difficulty=0.6, left_difficulty=1)
    """
    if isinstance(source, Scenario):
        return source
    if (scenario := _scenario_of_level(source)) is not None:
        raise ParameterError(
            f"`{source!s}` is a level, one episode of `{scenario}`",
            name="scenario",
            help=f"make `{scenario}` and begin the level by `reset(options={{'level': ...}})`",
        )
    text = text_of(source)
    if text is not None:
        return _native.compile(text, name_of(source), allow_outside=allow_outside)
    return _native.load(path_of(source), allow_outside=allow_outside)


def _scenario_of_level(source: Source) -> str | None:
    if not isinstance(source, str) or "#" not in source:
        return None
    try:
        return str(_native.level(source)["scenario"])
    except SetpieceError:
        return None


def text_of(source: Source) -> str | None:
    """Returns the text of a scenario given as a text or a dict; None for other forms."""
    if isinstance(source, Mapping):
        return pitch_text(source)
    is_text = (
        isinstance(source, str) and "{" in source and not source.endswith((".pitch", ".pitchc"))
    )
    return source if is_text and isinstance(source, str) else None


def name_of(source: Source) -> str:
    """Returns the name of a text in reports."""
    return scenario_name(source) if isinstance(source, Mapping) else "<text>"


def path_of(source: object) -> str:
    """Returns a name or path as a string, or raises `ParameterError`."""
    if isinstance(source, str | PathLike):
        path = fspath(source)
        if isinstance(path, str):
            return path
    raise ParameterError(
        f"expected a scenario's name, path, text, dict, or a `Scenario`, found `{source!r}`",
        name="scenario",
    )
