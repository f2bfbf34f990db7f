"""Changes of a scenario's file while an environment watches it."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from setpiece._callbacks import failed
from setpiece._errors import ParameterError, SetpieceError
from setpiece._match import Match
from setpiece._native import Live, Scenario
from setpiece._options import ParamValue
from setpiece._source import Source, path_of, text_of


@dataclass(frozen=True)
class Reload:
    """A changed file and the result; see `FootballEnv.last_reload`.

    - `state`: `"applied"`, `"broken"` (it doesn't compile) or `"held back"` (it would change the
      environment's spaces). Unless it was applied, the previous scenario stays in use.
    - `scenario`: the new scenario; None if it is broken.
    - `error`: why it is broken: a `CompileError` or `FileError`.
    - `why`: the state in one sentence.
    """

    state: Literal["applied", "broken", "held back"]
    scenario: Scenario | None
    error: SetpieceError | None
    why: str


class Watcher:
    """The files of a scenario, checked for changes."""

    scenario: Scenario
    """The scenario as first loaded."""
    last: Reload | None
    """The result of the last change; None before the first."""

    def __init__(
        self,
        source: Source,
        watch: bool | Literal["now"],
        on_reload: Callable[[Reload], object] | None,
        *,
        allow_outside: bool,
    ) -> None:
        if isinstance(source, Scenario) or text_of(source) is not None:
            raise ParameterError(
                "a `Scenario`, a text or a dict has no file to watch: give its path", name="watch"
            )
        self._live = Live(path_of(source), allow_outside=allow_outside)
        self._on_reload = on_reload
        self._waiting: Scenario | None = None
        self._missing: Path | None = None
        self.scenario, self.last = self._live.scenario, None
        self.at_once = watch == "now"

    def at_reset(
        self, match: Match, ready: Callable[[Scenario], Match]
    ) -> tuple[Match, Reload | None]:
        """Returns the match to play from now on, changed or given, and what to report."""
        fresh, broken = self._changed()
        if fresh is None:
            return match, broken
        self._waiting = None
        try:
            new = ready(fresh)
        except SetpieceError as error:
            return match, Reload(
                "held back", fresh, error, f"no environment can be made of it: {error}"
            )
        change = new.change(match, agents=True, players=False)
        if change is not None:
            return match, Reload("held back", fresh, None, change)
        return new, Reload("applied", fresh, None, f"`{fresh.name}` is played from this episode on")

    def at_step(
        self, match: Match, params: Mapping[str, ParamValue]
    ) -> tuple[Match, Reload | None]:
        """Applies changed scripts at once; other changes wait for a reset.

        Returns the match to play and what to report.
        """
        fresh, broken = self._changed()
        if fresh is None or fresh is self._waiting:
            return match, broken
        try:
            scenario = fresh.with_params(**params)
            adopted = match.native.adopt_scripts(scenario)
        except SetpieceError:
            adopted = False
        if not adopted:
            self._waiting = fresh
            return match, None
        new = replace(match, scenario=scenario, digest=scenario.digest)
        return new, Reload(
            "applied", fresh, None, f"the scripts of `{fresh.name}` are run from this step on"
        )

    def tell(self, reload: Reload) -> None:
        """Reports a change, applied or not; raises `CallbackError` if `on_reload` fails.

        Without an `on_reload` a change that isn't applied is a warning.
        """
        self.last = reload
        if self._on_reload is None:
            if reload.state != "applied":
                cause = reload.why if reload.error is None else str(reload.error)
                message = f"the changed file is {reload.state}, the scenario in use stays: {cause}"
                warnings.warn(message, stacklevel=2)
            return
        try:
            self._on_reload(reload)
        except Exception as error:
            raise failed(self._on_reload, None, error) from error

    def _changed(self) -> tuple[Scenario | None, Reload | None]:
        """The scenario of changed files, or one that is still waiting; or what broke them."""
        # Before the files are looked at: a warning may be an error, which no change may be lost to.
        self._warn_of_missing()
        try:
            return self._live.poll() or self._waiting, None
        except SetpieceError as error:
            return None, Reload("broken", None, error, "the scenario's files have errors")

    def _warn_of_missing(self) -> None:
        """Warns once when a file is gone, and once when it is back."""
        before, self._missing = self._missing, self._live.missing
        if self._missing == before:
            return
        if before is not None and before.exists():
            warnings.warn(f"`{before}` is back: its changes are reloaded again", stacklevel=2)
        if self._missing is not None:
            message = f"`{self._missing}` is gone: the scenario in use stays until it is back"
            warnings.warn(message, stacklevel=2)


def check_watch(watch: object) -> None:
    """Raises `ParameterError` for another value of `watch`."""
    if watch not in (False, True, "now"):
        raise ParameterError(f"`watch` is {watch!r}; it can be False, True or 'now'", name="watch")
