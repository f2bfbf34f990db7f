"""The `options` of a `reset`, validated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import ParameterError
from setpiece._level import Level, read_level
from setpiece._options import (
    NUMBER_MAX,
    ParamValue,
    check_keys,
    check_number,
    check_params,
    check_snapshot,
)
from setpiece._source import Source

RESET_OPTIONS = ("episode", "level", "params", "scenario", "snapshot")
VECTOR_RESET_OPTIONS = ("reset_mask", "params", "episode", "level")


@dataclass(frozen=True)
class ResetOptions:
    """What a single environment's `reset` was asked for; None if not given."""

    seed: int | None
    episode: int | None
    params: dict[str, ParamValue] | None
    scenario: Source | None
    snapshot: bytes | None
    level: Level | None


def read_reset_options(seed: object, options: object) -> ResetOptions:
    """Returns what a single environment's `reset` is asked for, or raises `ParameterError`."""
    given = check_keys(_mapping(options), RESET_OPTIONS)
    scenario = given.get("scenario")
    if given.get("level") is not None:
        _alone(seed, given, ("episode", "params", "snapshot"))
        level = read_level(given["level"])
        return ResetOptions(level.seed, level.episode, level.params, scenario, None, level)
    snapshot = given.get("snapshot")
    return ResetOptions(
        None if seed is None else check_number("seed", seed),
        _episode(given),
        check_params(given.get("params")),
        scenario,
        None if snapshot is None else check_snapshot(snapshot),
        None,
    )


@dataclass(frozen=True)
class VectorReset:
    """What a vector's `reset` was asked for, one entry per environment; None if not given."""

    mask: NDArray[np.bool_]
    seeds: list[int | None] | None
    episode: int | None
    params: list[dict[str, ParamValue] | None] | None
    levels: list[Level | None] | None


def read_vector_reset(seed: object, options: object, num_envs: int, *, levels: bool) -> VectorReset:
    """Returns what a vector's `reset` is asked for, or raises `ParameterError`.

    `levels`: whether the vector has a source of levels, which chooses parameters and episodes.
    """
    given = check_keys(_mapping(options), VECTOR_RESET_OPTIONS)
    mask = _mask(given.get("reset_mask"), num_envs)
    if given.get("level") is None:
        if levels:
            _sourced(seed, given)
        return VectorReset(
            mask,
            None if seed is None else read_seeds(seed, num_envs),
            _episode(given),
            read_each_params(given.get("params"), num_envs),
            None,
        )
    _alone(seed, given, ("episode", "params"))
    return VectorReset(mask, None, None, None, _levels(given["level"], mask))


def _sourced(seed: object, given: Mapping[str, Any]) -> None:
    """Refuses what a source of levels chooses."""
    if seed is not None and not isinstance(seed, int | np.integer):
        raise ParameterError("the levels of a vector have one seed", name="seed")
    for name in ("episode", "params"):
        if given.get(name) is not None:
            raise ParameterError(f"`levels` of the vector chooses `{name}`", name=name)


def read_each_params(params: object, num_envs: int) -> list[dict[str, ParamValue] | None] | None:
    """Returns parameters for each environment, None without any, or raises `ParameterError`."""
    if not isinstance(params, list | tuple):
        one = check_params(params)
        return None if one is None else [one] * num_envs
    each = [check_params(one) for one in params]
    if len(each) != num_envs:
        raise ParameterError(
            f"expected parameters of {num_envs} environments, found {len(each)}", name="params"
        )
    return each


def _mapping(options: object) -> Mapping[str, Any]:
    options = {} if options is None else options
    if not isinstance(options, Mapping):
        raise ParameterError(
            f"expected `options` as a mapping, found `{options!r}`", name="options"
        )
    return options


def _alone(seed: object, given: Mapping[str, Any], others: tuple[str, ...]) -> None:
    """Refuses what a level says itself."""
    for name, value in (("seed", seed), *((other, given.get(other)) for other in others)):
        if value is not None:
            raise ParameterError(f"`level` and `{name}` exclude each other", name=name)


def _episode(given: Mapping[str, Any]) -> int | None:
    episode = given.get("episode")
    return None if episode is None else check_number("episode", episode)


def _mask(mask: object, num_envs: int) -> NDArray[np.bool_]:
    if mask is None:
        return np.ones(num_envs, bool)
    if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (num_envs,):
        raise ParameterError(
            f"`reset_mask` is an array of {num_envs} truth values", name="reset_mask"
        )
    if not mask.any():
        raise ParameterError("`reset_mask` marks no environment", name="reset_mask")
    return mask


def _levels(given: object, mask: NDArray[np.bool_]) -> list[Level | None]:
    """The levels of the environments that begin, None for the others."""
    if isinstance(given, np.ndarray):
        given = given.tolist()
    if not isinstance(given, list | tuple):
        level = read_level(given)
        return [level if begins else None for begins in mask]
    if len(given) != len(mask):
        raise ParameterError(f"expected {len(mask)} levels, found {len(given)}", name="level")
    for at in np.flatnonzero(mask):
        if given[at] is None:
            raise ParameterError(f"environment {at} begins and has no level", name="level")
    marked = zip(mask, given, strict=True)
    return [read_level(one) if begins else None for begins, one in marked]


def read_seeds(seed: Any, num_envs: int) -> list[int | None]:
    """Returns a seed for each environment, or raises `ParameterError`."""
    if isinstance(seed, list | tuple) or (isinstance(seed, np.ndarray) and seed.ndim > 0):
        if len(seed) != num_envs:
            raise ParameterError(f"expected {num_envs} seeds, found {len(seed)}", name="seed")
        return [None if one is None else check_number("seed", one) for one in seed]
    first = check_number("seed", seed)
    return [(first + at) % (NUMBER_MAX + 1) for at in range(num_envs)]
