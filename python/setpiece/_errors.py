"""Everything that can go wrong, as one tree of exceptions under `SetpieceError`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Label:
    """A place that a diagnostic points at: lines and columns count from 1, columns in characters; the end is behind."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    text: str


@dataclass(frozen=True)
class Diagnostic:
    """A problem that the compiler found; the first label is the place itself, the others explain it."""

    code: str
    severity: Literal["error", "warning"]
    message: str
    help: str | None
    labels: tuple[Label, ...]

    def __str__(self) -> str:
        """Returns the problem on one line: place, code and message."""
        place = f"{self.labels[0].file}:{self.labels[0].line}:{self.labels[0].column}: " if self.labels else ""
        return f"{place}{self.code}: {self.message}"


class SetpieceError(Exception):
    """Any error of this package; `code` is the stable code where there is one, `help` says what to do instead."""

    code: str | None
    help: str | None

    def __init__(self, message: str, *, code: str | None = None, help: str | None = None) -> None:
        super().__init__(message)
        self.code = code
        self.help = help

    def __str__(self) -> str:
        message = super().__str__()
        return f"{message}\n  help: {self.help}" if self.help else message


class CompileError(SetpieceError):
    """A text has errors; `diagnostics` lists every error and warning, `str()` is the rendered report."""

    diagnostics: list[Diagnostic]

    def __init__(self, report: str, *, diagnostics: list[Diagnostic] | None = None, code: str | None = None) -> None:
        super().__init__(report, code=code)
        self.diagnostics = diagnostics or []


class FileError(SetpieceError, OSError):
    """A file is missing, a directory, too large, not UTF-8, or can't be read or written; `path` names it."""

    path: str

    def __init__(self, message: str, *, path: str = "", code: str | None = None, help: str | None = None) -> None:
        super().__init__(message, code=code, help=help)
        self.path = path


class UnknownScenarioError(SetpieceError, LookupError):
    """Neither a scenario of the library nor a file has this name; `name` is what was asked for."""

    name: str

    def __init__(self, message: str, *, name: str = "", code: str | None = None, help: str | None = None) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name


class FormatError(SetpieceError):
    """A compiled scenario is cut off, changed, of another version, or none at all."""


class ParameterError(SetpieceError, ValueError):
    """A parameter or option is unknown, of another type, or out of its range; `name` says which."""

    name: str

    def __init__(self, message: str, *, name: str = "", code: str | None = None, help: str | None = None) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name


class RewardError(SetpieceError, ValueError):
    """The scenario has no reward of this name."""


class DrawError(SetpieceError):
    """No start could be drawn: the scenario's requirements are never met together."""


class ScriptError(SetpieceError):
    """A script failed while an episode ran; says where, in which hook, and in which episode."""

    script: str
    line: int
    column: int
    hook: str
    seed: int
    episode: int
    step: int

    def __init__(
        self,
        message: str,
        *,
        script: str = "",
        line: int = 1,
        column: int = 1,
        hook: str = "",
        seed: int = 0,
        episode: int = 0,
        step: int = 0,
        code: str | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.script, self.line, self.column = script, line, column
        self.hook, self.seed, self.episode, self.step = hook, seed, episode, step


class SnapshotError(SetpieceError, ValueError):
    """Bytes are no snapshot, damaged, of another scenario, or of other players; a running episode goes on."""


class ActionError(SetpieceError, ValueError):
    """An action is of another type or shape, or out of range; the episode is untouched."""


class ReplayError(SetpieceError, ValueError):
    """An episode can't be recorded: none has begun, or it went on from a snapshot or with changed scripts.

    Or a recorded one can't be played again: its file is no replay, damaged, or of a version that plays otherwise.
    """


class InUseError(SetpieceError, RuntimeError):
    """Two threads use one environment at the same time, or somebody whom it asks plays it; each needs its own."""


class OpponentError(SetpieceError, RuntimeError):
    """A player that isn't the caller's failed: it raised (`__cause__`) or gave something that is no action.

    `slots` names whom it plays, `side` their team where it is one.
    """

    slots: tuple[str, ...]
    side: Literal["left", "right"] | None

    def __init__(
        self,
        message: str,
        *,
        slots: tuple[str, ...] = (),
        side: Literal["left", "right"] | None = None,
        code: str | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.slots, self.side = slots, side


class CallbackError(SetpieceError, RuntimeError):
    """A reward or ending in Python failed: it raised (`__cause__`) or gave something that is no payment or verdict.

    Or it can't be copied, as a copy of its environment needs; or an `on_reload` raised. `function` names it, `agent`
    whose step it judged; None where it judged none.
    """

    function: str
    agent: str | None

    def __init__(
        self,
        message: str,
        *,
        function: str = "",
        agent: str | None = None,
        code: str | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.function, self.agent = function, agent


class GrfScriptError(SetpieceError, RuntimeError):
    """A script of Google Research Football's form failed: `__cause__` is what it raised, `path` the script."""

    path: str

    def __init__(self, message: str, *, path: str = "", code: str | None = None, help: str | None = None) -> None:
        super().__init__(message, code=code, help=help)
        self.path = path


class MissingPackageError(SetpieceError, ImportError):
    """An optional package isn't installed; `name` says which, `help` how to get it."""

    name: str

    def __init__(self, message: str, *, name: str = "", code: str | None = None, help: str | None = None) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name


class UnavailableError(SetpieceError, NotImplementedError):
    """What is asked for is no part of this version; `name` says what."""

    name: str

    def __init__(self, message: str, *, name: str = "", code: str | None = None, help: str | None = None) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name
