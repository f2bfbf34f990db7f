"""Options shared by several kinds of environments, validated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from operator import index
from os import PathLike, fsencode, fspath
from pathlib import Path
from typing import Any

import numpy as np

from setpiece._errors import ParameterError
from setpiece._source import Source
from setpiece._words import similar

ParamValue = bool | int | float | str
"""A parameter's value: SI units, or a string as in the language (`"12m"`, `"60%"`, `"left"`)."""

RESET_OPTIONS = ("episode", "params", "scenario", "snapshot")
NUMBER_MAX = 2**64 - 1


@dataclass(frozen=True)
class ResetOptions:
    """The `options` of a single environment's `reset`; None if not given."""

    episode: int | None
    params: dict[str, ParamValue] | None
    scenario: Source | None
    snapshot: bytes | None


def read_reset_options(options: Mapping[str, Any] | None) -> ResetOptions:
    """Returns the options of a `reset`, or raises `ParameterError`."""
    options = check_keys(options, RESET_OPTIONS)
    episode, snapshot = options.get("episode"), options.get("snapshot")
    return ResetOptions(
        None if episode is None else check_number("episode", episode),
        check_params(options.get("params")),
        options.get("scenario"),
        None if snapshot is None else check_snapshot(snapshot),
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
