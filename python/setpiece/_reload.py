"""What happened to a scenario's file while an environment watched it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from setpiece._errors import ParameterError, SetpieceError
from setpiece._native import Live, Scenario
from setpiece._source import Source, path_of, text_of


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


class Watcher:
    """The files of a scenario, looked at for changes."""

    scenario: Scenario
    """The scenario as it was found first."""
    last: Reload | None
    """What became of the last change; None before the first."""

    def __init__(self, source: Source, watch: bool | Literal["now"], on_reload: Callable[[Reload], object] | None):
        if isinstance(source, Scenario) or text_of(source) is not None:
            raise ParameterError("a `Scenario`, a text or a dict has no file to watch: give its path", name="watch")
        self._live = Live(path_of(source))
        self._on_reload = on_reload
        self._waiting: Scenario | None = None
        self.scenario, self.last = self._live.scenario, None
        self.at_once = watch == "now"

    def changed(self) -> Scenario | None:
        """Returns the scenario of files that have changed, or one that is still waiting; None where nothing has."""
        try:
            return self._live.poll() or self._waiting
        except SetpieceError as error:
            self.tell(Reload("broken", None, error, "the scenario's files have errors"))
            return None

    def wait(self, scenario: Scenario | None) -> None:
        """Keeps a changed scenario for the next reset; None: nothing waits any more."""
        self._waiting = scenario

    def waits(self, scenario: Scenario) -> bool:
        """Whether it is this one that waits for the next reset."""
        return scenario is self._waiting

    def tell(self, reload: Reload) -> None:
        """Says what has become of a change."""
        self.last = reload
        if self._on_reload is not None:
            self._on_reload(reload)


def check_watch(watch: object) -> None:
    """Raises `ParameterError` for another value of `watch`."""
    if watch not in (False, True, "now"):
        raise ParameterError(f"`watch` is {watch!r}; it can be False, True or 'now'", name="watch")
