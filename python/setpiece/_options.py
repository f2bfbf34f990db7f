"""Options shared by several kinds of environments, validated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from operator import index
from os import PathLike, fsencode, fspath
from pathlib import Path
from typing import Any

import numpy as np

from setpiece import _native
from setpiece._errors import LevelError, ParameterError
from setpiece._source import Source
from setpiece._words import similar

ParamValue = bool | int | float | str
"""A parameter's value: SI units, or a string as in the language (`"12m"`, `"60%"`, `"left"`)."""

RESET_OPTIONS = ("episode", "level", "params", "scenario", "snapshot")
LEVEL_KEYS = ("scenario", "digest", "params", "seed", "episode")
NUMBER_MAX = 2**64 - 1


@dataclass(frozen=True)
class Level:
    """One episode of a scenario."""

    scenario: str
    seed: int
    episode: int
    params: dict[str, ParamValue]
    digest: str | None

    def check(self, name: str, digest: str) -> None:
        """Raises `LevelError` if the level is of another scenario."""
        if self.scenario != name:
            raise LevelError(
                f"the level is of `{self.scenario}`, and this environment plays `{name}`",
                code="SP0019",
                help="give its `scenario` too, or make an environment of it",
            )
        if self.digest not in (None, digest):
            raise LevelError(
                f"the level was taken of another version of `{name}`",
                code="SP0019",
            )


@dataclass(frozen=True)
class ResetOptions:
    """The `options` of a single environment's `reset`; None if not given."""

    episode: int | None
    params: dict[str, ParamValue] | None
    scenario: Source | None
    snapshot: bytes | None
    level: Level | None


def read_reset_options(options: Mapping[str, Any] | None) -> ResetOptions:
    """Returns the options of a `reset`, or raises `ParameterError`."""
    options = check_keys(options, RESET_OPTIONS)
    episode, snapshot = options.get("episode"), options.get("snapshot")
    level = read_level(options, ("episode", "params", "snapshot"))
    if level is not None:
        return ResetOptions(level.episode, level.params, options.get("scenario"), None, level)
    return ResetOptions(
        None if episode is None else check_number("episode", episode),
        check_params(options.get("params")),
        options.get("scenario"),
        None if snapshot is None else check_snapshot(snapshot),
        None,
    )


def read_level(options: Mapping[str, Any], others: tuple[str, ...]) -> Level | None:
    """Returns the level of a `reset`, or raises `ParameterError`, also if `others` are given."""
    given = options.get("level")
    if given is None:
        return None
    for other in others:
        if options.get(other) is not None:
            raise ParameterError(f"`level` and `{other}` exclude each other", name=other)
    if isinstance(given, str):
        given = _native.level(given)
    if not isinstance(given, Mapping):
        raise ParameterError(
            f"expected a level as a text or a dict, found `{given!r}`", name="level"
        )
    for key in given:
        if key not in LEVEL_KEYS:
            raise ParameterError(
                f"a level has no `{key}`; it has `{'`, `'.join(LEVEL_KEYS)}`",
                name="level",
                help=similar(str(key), LEVEL_KEYS),
            )
    for key in ("scenario", "seed"):
        if key not in given:
            raise ParameterError(f"the level has no `{key}`", name="level")
    return Level(
        given["scenario"],
        check_number("seed", given["seed"]),
        check_number("episode", given.get("episode", 0)),
        check_params(given.get("params")) or {},
        given.get("digest"),
    )


def check_keys(options: Mapping[str, Any] | None, known: tuple[str, ...]) -> Mapping[str, Any]:
    """Returns the options of a `reset`, or raises `ParameterError` for an unknown one."""
    options = {} if options is None else options
    if not isinstance(options, Mapping):
        raise ParameterError(
            f"expected `options` as a mapping, found `{options!r}`", name="options"
        )
    for key in options:
        if key not in known:
            raise ParameterError(
                f"no reset option `{key}`; there are `{'`, `'.join(known)}`",
                name=str(key),
                help=similar(key, known),
            )
    return options


def check_params(params: object) -> dict[str, ParamValue] | None:
    """Returns parameters, None without any, or raises `ParameterError`."""
    if params is not None and not isinstance(params, Mapping):
        raise ParameterError(f"expected `params` as a mapping, found `{params!r}`", name="params")
    return None if params is None else dict(params)


def check_number(name: str, value: object) -> int:
    """Returns a seed or an index, or raises `ParameterError`."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = index(value)  # type: ignore[arg-type]
    except TypeError:
        raise ParameterError(
            f"expected an integer as `{name}`, found `{value!r}`", name=name
        ) from None
    if not 0 <= number <= NUMBER_MAX:
        raise ParameterError(f"`{name}` is {number}, outside 0..2**64-1", name=name)
    return number


def check_flag(name: str, value: object) -> bool:
    """Returns a bool, or raises `ParameterError`."""
    if isinstance(value, bool | np.bool_):
        return bool(value)
    raise ParameterError(f"expected True or False as `{name}`, found `{value!r}`", name=name)


def check_path(name: str, value: object) -> Path:
    """Returns a path, or raises `ParameterError`."""
    if isinstance(value, str | PathLike):
        path = fspath(value)
        if isinstance(path, str) and "\0" not in path and _is_encodable(path):
            return Path(path)
    raise ParameterError(f"expected a path as `{name}`, found `{value!r}`", name=name)


def _is_encodable(path: str) -> bool:
    """Whether a file can have this name: its only surrogates may be those that stand for bytes."""
    try:
        fsencode(path)
    except UnicodeEncodeError:
        return False
    return True


def check_snapshot(snapshot: object) -> bytes:
    """Returns the bytes of a snapshot, or raises `ParameterError`."""
    if isinstance(snapshot, bytes | bytearray | memoryview):
        return bytes(snapshot)
    raise ParameterError(
        f"expected a snapshot as bytes, found `{type(snapshot).__name__}`", name="snapshot"
    )
