"""The studio beside a running program: a page that shows what it plays."""

from __future__ import annotations

import atexit
import os
import time
import webbrowser
from collections.abc import Callable, Mapping, Sequence
from html import escape
from types import TracebackType
from typing import Any, TypedDict

from setpiece import _native
from setpiece._environment import FootballEnv
from setpiece._errors import ParameterError, ReplayError
from setpiece._held import Held
from setpiece._native import AGENTS, Scenario
from setpiece._opponents import (
    Opponent,
    Seat,
    ask,
    is_word,
    player_of,
    policy_of,
    sees_masks,
    sighted,
)
from setpiece._options import check_flag
from setpiece._rows import Picker
from setpiece._source import Source, load, name_of, path_of, text_of
from setpiece._vector import FootballVectorEnv

PORT_MAX = 65_535
TAKEN = (*AGENTS, "nobody", "you")
"""Names that mean something else in the page."""
FRAME_PX = 900
"""The height of the page in a notebook."""

_running: set[Studio] = set()
"""They run until they are closed, whether or not the program keeps them."""


class Parts(TypedDict):
    """A scenario's path or name, its text and its compiled form, as far as they are known."""

    path: str
    text: str | None
    scenario: Scenario | None


class Opened(Parts):
    """What the native studio opens, with the scenario whose parameters hold."""

    bound: Scenario | None
    allow_outside: bool


class NativePolicy(TypedDict):
    """A policy as the native studio takes it."""

    name: str
    observation: str
    scale: bool
    repeat: int
    play: Callable[[Any, Sequence[str]], list[int]]


class Studio:
    """A studio that runs beside the program: see `setpiece.studio`.

    It is a context manager, and in a notebook it shows itself.
    """

    address: str
    """The page's address, with its token."""
    port: int
    """Its port on this machine."""

    def __init__(self, native: _native.Studio, every_s: float) -> None:
        """Takes what serves it, and the least time between two episodes that it shows."""
        self._native, self._every_s, self._next = native, every_s, 0.0
        self._followed: list[FootballEnv | FootballVectorEnv] = []
        self.address, self.port = native.address, native.port
        self._process, self._closed = os.getpid(), False
        _running.add(self)

    def __repr__(self) -> str:
        """Returns its address."""
        return f"Studio({self.address})"

    def _repr_html_(self) -> str:
        style = f"width: 100%; height: {FRAME_PX}px; border: 0"
        address = escape(self.address, quote=True)
        return f'<iframe src="{address}" style="{style}" title="Setpiece studio"></iframe>'

    def __enter__(self) -> Studio:
        """Returns itself."""
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        """Ends it."""
        self.close()

    def follow(self, env: Any) -> None:
        """Shows a sample of an environment's episodes from now on, each as it ends.

        Of a vector it shows the first environment. Raises `ParameterError` for anything else.
        """
        inner = _inner(env)
        if inner is None:
            raise ParameterError(f"`{env!r}` is no environment of Setpiece", name="env")
        if self._closed:
            raise ParameterError("the studio has ended: start another one", name="env")
        inner.mirrors.append(self._take)
        self._followed.append(inner)

    def open(self) -> None:
        """Opens the page in the browser."""
        webbrowser.open(self.address)

    def close(self) -> None:
        """Ends it: the port is free afterwards, and no environment is followed any more."""
        for env in self._followed:
            env.mirrors.remove(self._take)
        self._followed, self._closed = [], True
        _running.discard(self)
        # A forked process has no part in its parent's studio.
        if self._process == os.getpid():
            self._native.close()

    def _take(self, replay: Callable[[], bytes]) -> None:
        """Shows an episode that has ended, unless one was shown a moment ago."""
        now = time.monotonic()
        # A forked process has no part in its parent's studio.
        if now < self._next or self._process != os.getpid():
            return
        self._next = now + self._every_s
        try:
            recorded = replay()
        except ReplayError:
            # It has no beginning, or is too long: the next one may have one.
            return
        self._native.watch(recorded)


def studio(
    source: Source | Any = "academy_3_vs_1_with_keeper",
    *,
    policies: Mapping[str, Opponent] | None = None,
    every_s: float = 2.0,
    port: int = 0,
    allow_outside: bool = False,
) -> Studio:
    """Starts the studio beside the program, and returns it at once.

    - `source`: a scenario in any form, or an environment of `make`, `make_vec` or `parallel_env`,
      wrapped or not. Of an environment a sample of its episodes is shown while the program goes on:
      a vector's first environment, at most one episode every `every_s` seconds.
    - `policies`: what the page can choose as *agent*, by name: everything that `opponents` of
      `make` takes but the names of behaviours. Without an observation of its own a policy sees that
      of the environment, without a stack and in its usual size, else `"simple115v2"`.
    - `port`: 0 for any that is free.

    The page is at `address`; `open` shows it in the browser. In a notebook the studio shows itself.
    It ends with `close`, at the end of a `with` block, or with the program. Raises `ParameterError`,
    and for a scenario what `load` raises.

    >>> import setpiece
    >>> env = setpiece.make("academy_empty_goal_close")
    >>> with setpiece.studio(env, policies={"right": lambda observation: 5}) as page:
    ...     page.address.startswith("http://127.0.0.1:")
    True
    """
    env = _inner(source)
    outside = check_flag("allow_outside", allow_outside)
    if not isinstance(every_s, int | float) or isinstance(every_s, bool) or not every_s >= 0:
        raise ParameterError(
            f"`every_s` is {every_s!r}; expected seconds, 0 or more", name="every_s"
        )
    number = port if isinstance(port, int) and not isinstance(port, bool) else -1
    if not 0 <= number <= PORT_MAX:
        raise ParameterError(f"`port` is {port!r}; expected 0..{PORT_MAX}", name="port")
    look = ("simple115v2", False) if env is None else env.sight
    given = [_native_policy(name, one, look) for name, one in _read(policies).items()]
    made_of: Source = source if env is None else env.source
    bound = None if env is None else env.scenario
    opened: Opened = {**_parts(made_of, outside), "bound": bound, "allow_outside": outside}
    page = Studio(_native.Studio(opened, given, port=number), float(every_s))
    if env is not None:
        page.follow(env)
    return page


def _inner(env: Any) -> FootballEnv | FootballVectorEnv | None:
    """The environment inside wrappers; None if there is none."""
    if isinstance(env, str):
        return None
    env = getattr(env, "unwrapped", env)
    env = getattr(env, "env", env)
    return env if isinstance(env, FootballEnv | FootballVectorEnv) else None


def _read(policies: Mapping[str, Opponent] | None) -> Mapping[str, Opponent]:
    if policies is None:
        return {}
    if not isinstance(policies, Mapping) or not all(isinstance(name, str) for name in policies):
        raise ParameterError(
            f"expected `policies` as a mapping from names, found `{policies!r}`", name="policies"
        )
    for name in policies:
        if name in TAKEN or not name.strip():
            raise ParameterError(
                f"no policy can be called {name!r}: the page has that name already",
                name="policies",
            )
    return policies


def _native_policy(name: str, given: Opponent, look: tuple[str, bool]) -> NativePolicy:
    """A policy, ready to be asked for the actions of all agents."""
    if is_word(given):
        raise ParameterError(
            f"`policies[{name!r}]` is {given!r}, which the page offers anyway if the file has it",
            name="policies",
        )
    unsighted = policy_of(name, given, "policies")
    function, held = player_of(unsighted)
    policy = sighted(unsighted, function)
    if sees_masks(policy, function):
        raise ParameterError(
            f"`policies[{name!r}]` sees masks, which the page doesn't show", name="policies"
        )

    def play(seen: Any, ids: Sequence[str]) -> list[int]:
        n = len(ids)
        at = [*range(n)]
        # The studio keeps the actions of each episode that it shows.
        seat = Seat(tuple(ids), at, Picker(n, at), policy, function, Held(1), None)
        return ask(seat, seat.pick(seen), [0] * n)

    own = policy.observation is not None
    observation, scale = (policy.observation or "", policy.scale) if own else look
    return {
        "name": name,
        "observation": observation,
        "scale": scale,
        "repeat": held.repeat,
        "play": play,
    }


def _parts(source: Source, outside: bool) -> Parts:
    if isinstance(source, Scenario):
        return {"path": source.name, "text": None, "scenario": source}
    text = text_of(source)
    if text is not None:
        return {"path": name_of(source), "text": text, "scenario": None}
    # What can't be loaded raises here as it does everywhere.
    load(source, allow_outside=outside)
    return {"path": path_of(source), "text": None, "scenario": None}


@atexit.register
def _end() -> None:
    for page in [*_running]:
        page.close()
