"""The scenarios of the standard library, and their names in Gymnasium's registry."""

from __future__ import annotations

import builtins
from functools import cache

import gymnasium

from setpiece import _native

NAMESPACE = "setpiece"


class Entry(str):
    """A scenario of the library: its name, with a title and the number of players on each side."""

    title: str  # type: ignore[assignment]  # hides `str.title`, which no name needs
    players: tuple[int, int]

    def __new__(cls, name: str, title: str, players: tuple[int, int]) -> Entry:
        """Makes an entry; `players` counts the left and the right team."""
        entry = super().__new__(cls, name)
        entry.title = title
        entry.players = players
        return entry

    def __getnewargs__(self) -> tuple[str, str, tuple[int, int]]:  # type: ignore[override]
        return str(self), self.title, self.players

    @property
    def name(self) -> str:
        """The name, as a plain string."""
        return str(self)


@cache
def _entries() -> tuple[Entry, ...]:
    return tuple(Entry(one.name, one.title, one.players) for one in _native.library())


def list() -> builtins.list[Entry]:
    """Returns the scenarios of the library by name; an entry is a name with `title` and `players`.

    >>> import setpiece
    >>> "academy_corner" in setpiece.list()
    True
    """
    return [*_entries()]


def register_envs() -> None:
    """Registers every scenario of the library as `setpiece/NAME-v0`.

    Importing the package has already done it.
    """
    for name in _entries():
        env_id = f"{NAMESPACE}/{name}-v0"
        if env_id not in gymnasium.registry:
            gymnasium.register(
                env_id,
                entry_point="setpiece._environment:FootballEnv",
                vector_entry_point="setpiece._vector:FootballVectorEnv",
                kwargs={"scenario": name.name},
            )
