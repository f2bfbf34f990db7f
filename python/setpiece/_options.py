"""Options shared by several kinds of environments, validated."""

from __future__ import annotations

import os
from collections.abc import Mapping
from operator import index
from os import PathLike, fsencode, fspath
from pathlib import Path
from typing import Any

import numpy as np

from setpiece._errors import ParameterError
from setpiece._words import similar

ParamValue = bool | int | float | str
"""A parameter's value: SI units, or a string as in the language (`"12m"`, `"60%"`, `"left"`)."""

NUMBER_MAX = 2**64 - 1

THREADS_MAX = 1_024
"""The most threads of a vector."""


def check_keys(
    options: Mapping[str, Any], known: tuple[str, ...], what: str = "reset option"
) -> Mapping[str, Any]:
    """Returns a mapping with known keys, or raises `ParameterError` for an unknown one."""
    for key in options:
        if key not in known:
            raise ParameterError(
                f"no {what} `{key}`; there are `{'`, `'.join(known)}`",
                name=str(key),
                help=similar(str(key), known),
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


def check_count(name: str, value: object, most: int) -> int:
    """Returns a count, or raises `ParameterError`."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 1 <= value <= most:
        raise ParameterError(f"`{name}` is {value!r}; it can be an integer in 1..{most}", name=name)
    return int(value)


def check_threads(threads: object, most: int) -> int:
    """Returns a number of threads: without one a thread per core, at most `most`."""
    if threads is None:
        return min(os.cpu_count() or 1, most)
    return check_count("threads", threads, THREADS_MAX)


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
