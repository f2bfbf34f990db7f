"""The turn of an environment: one thread's at a time, and never that of code it calls."""

from __future__ import annotations

import gymnasium

from setpiece._errors import InUseError


class Turn:
    """The turn to reset, step or restore an environment, taken by `with`.

    Meanwhile no other thread can have it, and neither can code that the environment calls: a
    reward, an ending, an opponent, `on_reload`. Raises `InUseError` for these,
    `ClosedEnvironmentError` if it is `closed`.
    """

    __slots__ = ("_taken", "closed")

    closed: bool
    """Whether the environment is closed."""

    def __init__(self) -> None:
        self._taken = self.closed = False

    def __enter__(self) -> None:
        if self.closed:
            raise gymnasium.error.ClosedEnvironmentError(
                "the environment is closed: make another one"
            )
        if self._taken:
            raise InUseError(
                "this environment is in the middle of a step or reset: make one for each thread, and let no reward, "
                "ending, opponent or `on_reload` play it"
            )
        self._taken = True

    # Three names, because building a tuple takes time, and this runs in every step.
    def __exit__(self, _kind: object, _error: object, _trace: object) -> None:
        self._taken = False


class _OneThread:
    """Wraps a call of the native module; raises `InUseError` if another thread is inside one."""

    __slots__ = ()

    def __enter__(self) -> None:
        pass

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _trace: object
    ) -> None:
        # The binding's message about a second thread.
        if kind is RuntimeError and "borrowed" in str(error):
            raise InUseError(
                "another thread is using this environment: make one for each thread"
            ) from None


one_thread = _OneThread()
