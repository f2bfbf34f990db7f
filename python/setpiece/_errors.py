"""All errors of the package, as one tree of exceptions under `SetpieceError`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Label:
    """The place of a diagnostic: lines and columns from 1, columns in characters, end exclusive."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    text: str


@dataclass(frozen=True)
class Diagnostic:
    """A problem that the compiler found; the first label is its place, the others explain it."""

    code: str
    severity: Literal["error", "warning"]
    message: str
    help: str | None
    labels: tuple[Label, ...]

    def __str__(self) -> str:
        """Returns the problem on one line: place, code and message."""
        place = (
            f"{self.labels[0].file}:{self.labels[0].line}:{self.labels[0].column}: "
            if self.labels
            else ""
        )
        return f"{place}{self.code}: {self.message}"


class SetpieceError(Exception):
    """Any error of this package: `code` is the stable code, if any, `help` what to do instead.

    `environment` is the number of the environment of a vector whose episode failed, if one did.
    """

    code: str | None
    help: str | None
    environment: int | None = None

    def __init__(self, message: str, *, code: str | None = None, help: str | None = None) -> None:
        super().__init__(message)
        self.code = code
        self.help = help

    def __str__(self) -> str:
        message = super().__str__()
        return f"{message}\n  help: {self.help}" if self.help else message


class CompileError(SetpieceError):
    """A text has errors: `diagnostics` lists errors and warnings, `str()` is the full report."""

    diagnostics: list[Diagnostic]

    def __init__(
        self, report: str, *, diagnostics: list[Diagnostic] | None = None, code: str | None = None
    ) -> None:
        super().__init__(report, code=code)
        self.diagnostics = diagnostics or []


class FileError(SetpieceError, OSError):
    """A file is missing, a directory, too large, not UTF-8, or can't be read or written.

    `path` names it.
    """

    path: str

    def __init__(
        self, message: str, *, path: str = "", code: str | None = None, help: str | None = None
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.path = path


class UnknownScenarioError(SetpieceError, LookupError):
    """Neither a scenario of the library nor a file has this name; `name` is the requested one."""

    name: str

    def __init__(
        self, message: str, *, name: str = "", code: str | None = None, help: str | None = None
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name


class FormatError(SetpieceError):
    """A compiled scenario is truncated, changed, of another version, or not a scenario."""


class ParameterError(SetpieceError, ValueError):
    """A parameter or option is unknown, of another type, or out of range; `name` names it."""

    name: str

    def __init__(
        self, message: str, *, name: str = "", code: str | None = None, help: str | None = None
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name


class RewardError(SetpieceError, ValueError):
    """The scenario has no reward of this name."""


class DrawError(SetpieceError):
    """No start could be drawn: the scenario's requirements never hold together."""


class ScriptError(SetpieceError):
    """A script failed in an episode; names the place, the hook and the episode."""

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
    """Bytes are not a snapshot, or damaged, or of another scenario or other players.

    A running episode is unchanged.
    """


class LevelError(SetpieceError, ValueError):
    """A level is of another scenario, of another version of it, or doesn't fit its vector."""


class ActionError(SetpieceError, ValueError):
    """An action has the wrong type or shape, or is out of range; the episode is unchanged."""


class ReplayError(SetpieceError, ValueError):
    """An episode can't be recorded or replayed.

    Recording fails if no episode has begun, or if it continues from a snapshot or with changed
    scripts. Replaying fails if the file isn't a replay, is damaged, or comes from a version that
    plays differently.
    """


class InUseError(SetpieceError, RuntimeError):
    """An environment is used by two threads at once, or by code that it called itself.

    Each user needs their own environment.
    """


class OpponentError(SetpieceError, RuntimeError):
    """An opponent or a policy failed: it raised (`__cause__`) or returned something that isn't an action.

    `slots` names the agents that it plays, `side` their team if they are on one.
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
    """A reward, an ending or a function of levels in Python failed.

    It raised (`__cause__`), returned something that isn't a payment or verdict, or can't be copied
    with its environment; or an `on_reload` raised. `function` names it; `agent` is the agent whose
    step it judged, None without one.
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
    """A script in Google Research Football's format failed.

    `__cause__` is what it raised, `path` the script.
    """

    path: str

    def __init__(
        self, message: str, *, path: str = "", code: str | None = None, help: str | None = None
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.path = path


class MissingPackageError(SetpieceError, ImportError):
    """An optional package isn't installed; `name` names it, `help` says how to install it."""

    name: str

    def __init__(
        self, message: str, *, name: str = "", code: str | None = None, help: str | None = None
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name


class UnavailableError(SetpieceError, NotImplementedError):
    """The requested feature isn't supported in this version; `name` names it."""

    name: str

    def __init__(
        self, message: str, *, name: str = "", code: str | None = None, help: str | None = None
    ) -> None:
        super().__init__(message, code=code, help=help)
        self.name = name
