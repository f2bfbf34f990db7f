"""The forms of a scenario: a name, a path, a text, a dict, or compiled."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike, fspath

from setpiece import _native
from setpiece._errors import ParameterError, SetpieceError, UnknownScenarioError
from setpiece._level import Level, read_level, read_listed
from setpiece._native import Scenario
from setpiece._scenario_dict import ScenarioDict, pitch_text, scenario_name

Source = Scenario | ScenarioDict | Level | str | PathLike[str]
"""A scenario: compiled, a `ScenarioDict`, a name in the library, a file's path, a text, or a level.
"""


def load(source: Source, name: str | None = None, *, allow_outside: bool = False) -> Scenario:
    """Loads a scenario: a name of the library, the path of a file, a text, or a `ScenarioDict`.

    - `name`: which of several in a file or a text; None: the last that isn't abstract.
    - `allow_outside`: imports and scripts must be in the file's folder or below (for a text: in the
      working directory), unless this permits other places.

    Files are `.pitch` or `.pitchc`. A string with a `{` is a text. A `Level` and its text stand for
    their scenario with its parameters. Raises `UnknownScenarioError`, `FileError`, `CompileError`,
    `FormatError`, `LevelError` for a level of another version, and `ParameterError` for a dict that
    isn't a scenario.

    >>> import setpiece
    >>> setpiece.load("academy_corner")
    Scenario(academy_corner: difficulty=0.6, left_difficulty=1)
    """
    if name is not None and not isinstance(name, str):
        raise ParameterError(f"expected a scenario's name, found `{name!r}`", name="name")
    if (level := level_of(source)) is not None:
        scenario = load(level.scenario, name, allow_outside=allow_outside)
        level.check_digest(scenario)
        return scenario.with_params(**level.params)
    if isinstance(source, Scenario):
        if name not in (None, source.name):
            raise UnknownScenarioError(
                f"the loaded scenario is `{source.name}`, not `{name}`",
                name=str(name),
                help="give its file or text instead of it",
            )
        return source
    text = text_of(source)
    if text is not None:
        return _native.compile(text, name_of(source), scenario=name, allow_outside=allow_outside)
    return _native.load(path_of(source), name, allow_outside=allow_outside)


def level_of(source: Source) -> Level | None:
    """The level that is given instead of a scenario, if it is one."""
    if isinstance(source, Level):
        return source
    if isinstance(source, Mapping) and "scenario" in source:
        return read_listed(source, None)
    if not isinstance(source, str) or "#" not in source:
        return None
    try:
        return read_level(source)
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


def is_text(source: object) -> bool:
    """Whether it is a text or a dict of the language."""
    return isinstance(source, Mapping) or (isinstance(source, str) and text_of(source) is not None)


def is_file(source: object) -> bool:
    """Whether it is the path of a `.pitch` file."""
    return isinstance(source, str | PathLike) and str(fspath(source)).endswith(".pitch")


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
