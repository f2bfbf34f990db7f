"""Whose turn it is with an environment: one thread's at a time, and of nobody whom it asks."""

from __future__ import annotations

import gymnasium

from setpiece._errors import InUseError


class Turn:
    """The turn of whoever resets, steps or restores an environment, taken by `with`.

    Another thread can't have it meanwhile, nor can somebody else's code that is asked in the middle: a reward, an
    ending, an opponent, `on_reload`. Raises `InUseError` for these, `ClosedEnvironmentError` where it is `closed`.
    """

    __slots__ = ("_taken", "closed")

    closed: bool
    """Whether nobody can have it any more."""

    def __init__(self) -> None:
        self._taken = self.closed = False

    def __enter__(self) -> None:
        if self.closed:
            raise gymnasium.error.ClosedEnvironmentError("the environment is closed: make another one")
        if self._taken:
            raise InUseError(
                "this environment is in the middle of a step or reset: make one for each thread, and let no reward, "
                "ending, opponent or `on_reload` play it"
            )
        self._taken = True

    # Three names: gathering them in a tuple takes time, and this is in every step.
    def __exit__(self, _kind: object, _error: object, _trace: object) -> None:
        self._taken = False


class _OneThread:
    """Around one call of the native module: raises `InUseError` where another thread is in the middle of one."""

    __slots__ = ()

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _trace: object) -> None:
        # The binding's word for a second thread.
        if kind is RuntimeError and "borrowed" in str(error):
            raise InUseError("another thread is using this environment: make one for each thread") from None


one_thread = _OneThread()
