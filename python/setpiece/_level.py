"""Levels: one episode of a scenario, from its text or a dict."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field

from setpiece import _native
from setpiece._errors import LevelError, ParameterError
from setpiece._native import Scenario
from setpiece._options import ParamValue, check_keys, check_number, check_params

KEYS = ("scenario", "digest", "params", "seed", "episode")


@dataclass(frozen=True)
class Level:
    """One episode of a scenario: what decides its start and chance.

    - `scenario`: its name. `params`: what differs from its defaults.
    - `seed` and `episode`, the index under the seed. Without a seed it is any episode.
    - `digest`: the fingerprint of the compiled scenario, which must have it then.

    `str` is its text, and `Level.of` reads it. Everything that takes a level takes a `Level`, its
    text, or a dict with its fields.

    >>> import setpiece
    >>> level = setpiece.Level("academy_corner", seed=7, params={"difficulty": 0.8})
    >>> str(level)
    'academy_corner{difficulty=0.8}#7'
    >>> setpiece.Level.of("academy_corner#7:3").episode
    3
    """

    scenario: str
    seed: int | None = None
    episode: int = 0
    params: dict[str, ParamValue] = field(default_factory=dict)
    digest: str | None = None

    @classmethod
    def of(cls, level: LevelLike) -> Level:
        """Returns a level of its text or of a dict, or raises `ParameterError`."""
        return read_level(level)

    def __str__(self) -> str:
        """Returns the text, without the digest."""
        fields = {
            "scenario": self.scenario,
            "params": self.params,
            "seed": self.seed or 0,
            "episode": self.episode,
        }
        text = _native.level_text(json.dumps(fields))
        return text if self.seed is not None else text.rpartition("#")[0]

    def __hash__(self) -> int:
        """Of equal levels the same."""
        params = tuple(sorted(self.params.items()))
        return hash((self.scenario, self.seed, self.episode, params, self.digest))

    @property
    def key(self) -> tuple[int, int]:
        """Seed and index of its episode, the first one without a seed."""
        return self.seed or 0, self.episode

    def check(self, scenario: Scenario) -> None:
        """Raises `LevelError` if the level is of another scenario."""
        if self.scenario != scenario.name:
            raise LevelError(
                f"the level is of `{self.scenario}`, and this environment plays `{scenario.name}`",
                code="SP0019",
                help="give its `scenario` too, or make an environment of it",
            )
        self.check_digest(scenario)

    def check_digest(self, scenario: Scenario) -> None:
        """Raises `LevelError` if the level is of another version of its scenario."""
        if self.digest is not None and not scenario._has_digest(self.digest):
            raise LevelError(
                f"the level was taken of another version of `{scenario.name}`",
                code="SP0019",
            )


LevelLike = Level | Mapping[str, object] | str
"""A level, its text, or a dict with its fields."""


def read_level(given: object) -> Level:
    """Returns the level of an episode, or raises `ParameterError`."""
    # A text has to be whole, and says how it is written.
    level = read_listed(_native.level(given) if isinstance(given, str) else given, None)
    if level.seed is None:
        raise ParameterError(
            "the level has no `seed`",
            name="level",
            help=f"`{level}#7` is the first episode of the seed 7",
        )
    return level


def read_listed(given: object, scenario: str | None) -> Level:
    """Returns a level that may lack a seed, or raises `ParameterError`.

    `scenario`: the name of the scenario that a dict means which names none.
    """
    if isinstance(given, Level):
        given = {key: getattr(given, key) for key in KEYS}
    if isinstance(given, str):
        # Without a seed it is a scenario, perhaps with parameters.
        is_episode = "#" in given or given.lstrip().startswith("{")
        given = _native.level(given if is_episode else f"{given}#0")
        given = given if is_episode else {**given, "seed": None}
    if not isinstance(given, Mapping):
        raise ParameterError(
            f"expected a level as a text or a dict, found `{given!r}`", name="level"
        )
    _check_fields(given)
    name, digest = given.get("scenario", scenario), given.get("digest")
    if name is None:
        raise ParameterError("the level has no `scenario`", name="level")
    if not isinstance(name, str) or not isinstance(digest, str | None):
        raise ParameterError(
            "`scenario` and `digest` of a level are texts, without a digest None", name="level"
        )
    seed, episode = given.get("seed"), given.get("episode", 0)
    if seed is None and episode:
        raise ParameterError("a level with an `episode` needs its `seed`", name="level")
    return Level(
        name,
        None if seed is None else check_number("seed", seed),
        check_number("episode", episode),
        check_params(given.get("params")) or {},
        digest,
    )


def _check_fields(given: Mapping[str, object]) -> None:
    """Refuses keys that a level doesn't have."""
    if given and not any(key in KEYS for key in given):
        raise ParameterError(
            f"no key of a level is called `{next(iter(given))}`",
            name=str(next(iter(given))),
            help=f"parameters are written `{{'params': {dict(given)!r}}}`",
        )
    check_keys(given, KEYS, "key of a level")
