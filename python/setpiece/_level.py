"""Levels: one episode of a scenario, from its text or a dict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from setpiece import _native
from setpiece._errors import LevelError, ParameterError
from setpiece._native import Scenario
from setpiece._options import ParamValue, check_keys, check_number, check_params

KEYS = ("scenario", "digest", "params", "seed", "episode")


@dataclass(frozen=True)
class Level:
    """One episode of a scenario."""

    scenario: str
    seed: int
    episode: int
    params: dict[str, ParamValue]
    digest: str | None

    def check(self, scenario: Scenario) -> None:
        """Raises `LevelError` if the level is of another scenario."""
        if self.scenario != scenario.name:
            raise LevelError(
                f"the level is of `{self.scenario}`, and this environment plays `{scenario.name}`",
                code="SP0019",
                help="give its `scenario` too, or make an environment of it",
            )
        if self.digest is not None and not scenario._has_digest(self.digest):
            raise LevelError(
                f"the level was taken of another version of `{scenario.name}`",
                code="SP0019",
            )


def read_level(given: object) -> Level:
    """Returns a level of its text or of a dict, or raises `ParameterError`."""
    if isinstance(given, str):
        given = _native.level(given)
    if not isinstance(given, Mapping):
        raise ParameterError(
            f"expected a level as a text or a dict, found `{given!r}`", name="level"
        )
    check_keys(given, KEYS, "key of a level")
    for key in ("scenario", "seed"):
        if key not in given:
            raise ParameterError(f"the level has no `{key}`", name="level")
    scenario, digest = given["scenario"], given.get("digest")
    if not isinstance(scenario, str) or not isinstance(digest, str | None):
        raise ParameterError(
            "`scenario` and `digest` of a level are texts, without a digest None", name="level"
        )
    return Level(
        scenario,
        check_number("seed", given["seed"]),
        check_number("episode", given.get("episode", 0)),
        check_params(given.get("params")) or {},
        digest,
    )
