"""The actions of Google Research Football, as objects, and the three sets of them.

`action_set_dict` has the sets by name: `default` (19), `v2` (20, with `builtin_ai`) and `full`
(33). An action's place in its set is the number that agents send.
"""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING, Any

from setpiece._errors import ActionError
from setpiece._words import check_word

if TYPE_CHECKING:
    from setpiece.gfootball.env.config import Config

BACKEND_NAMES = (
    *(
        "idle",
        "left",
        "top_left",
        "top",
        "top_right",
        "right",
        "bottom_right",
        "bottom",
        "bottom_left",
    ),
    *(
        "long_pass",
        "high_pass",
        "short_pass",
        "shot",
        "keeper_rush",
        "sliding",
        "pressure",
        "team_pressure",
        "switch",
    ),
    *(
        "sprint",
        "dribble",
        "release_direction",
        "release_long_pass",
        "release_high_pass",
        "release_short_pass",
    ),
    *(
        "release_shot",
        "release_keeper_rush",
        "release_sliding",
        "release_pressure",
        "release_team_pressure",
    ),
    *("release_switch", "release_sprint", "release_dribble", "builtin_ai"),
)
"""Every action's name, by its number in GRF's engine."""

DIRECTIONS = BACKEND_NAMES[1:9]
HELD = ("sprint", "dribble", "keeper_rush", "pressure", "team_pressure")
"""Buttons that stay pressed until they are released."""


class CoreAction:
    """An action: its name, its number in GRF's engine, and whether it stays pressed.

    Two are equal when their names are. `step` takes any of them, also those outside the configured
    set.
    """

    def __init__(
        self, backend_action: int, name: str, sticky: bool = False, directional: bool = False
    ) -> None:
        self._backend_action = backend_action
        self._name = name
        self._sticky = sticky
        self._directional = directional

    @property
    def backend_action(self) -> int:
        """The number in GRF's engine, 0..32."""
        return self._backend_action

    @property
    def name(self) -> str:
        """The name: `short_pass`."""
        return self._name

    @property
    def sticky(self) -> bool:
        """Whether it lasts until it is released."""
        return self._sticky

    @property
    def directional(self) -> bool:
        """Whether it is one of the eight directions."""
        return self._directional

    def is_in_actionset(self, config: Config | dict[str, Any]) -> bool:
        """Returns whether the action belongs to the set of `config["action_set"]`."""
        return self in get_action_set(config)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, CoreAction) and other._name == self._name

    def __hash__(self) -> int:
        return hash(self._name)

    def __str__(self) -> str:
        return self._name

    def __repr__(self) -> str:
        return f"CoreAction({self._name})"


_BY_NAME = {
    name: CoreAction(
        number, name, sticky=name in DIRECTIONS or name in HELD, directional=name in DIRECTIONS
    )
    for number, name in enumerate(BACKEND_NAMES)
}

action_idle = _BY_NAME["idle"]
action_left = _BY_NAME["left"]
action_top_left = _BY_NAME["top_left"]
action_top = _BY_NAME["top"]
action_top_right = _BY_NAME["top_right"]
action_right = _BY_NAME["right"]
action_bottom_right = _BY_NAME["bottom_right"]
action_bottom = _BY_NAME["bottom"]
action_bottom_left = _BY_NAME["bottom_left"]
action_long_pass = _BY_NAME["long_pass"]
action_high_pass = _BY_NAME["high_pass"]
action_short_pass = _BY_NAME["short_pass"]
action_shot = _BY_NAME["shot"]
action_keeper_rush = _BY_NAME["keeper_rush"]
action_sliding = _BY_NAME["sliding"]
action_pressure = _BY_NAME["pressure"]
action_team_pressure = _BY_NAME["team_pressure"]
action_switch = _BY_NAME["switch"]
action_sprint = _BY_NAME["sprint"]
action_dribble = _BY_NAME["dribble"]
action_release_direction = _BY_NAME["release_direction"]
action_release_long_pass = _BY_NAME["release_long_pass"]
action_release_high_pass = _BY_NAME["release_high_pass"]
action_release_short_pass = _BY_NAME["release_short_pass"]
action_release_shot = _BY_NAME["release_shot"]
action_release_keeper_rush = _BY_NAME["release_keeper_rush"]
action_release_sliding = _BY_NAME["release_sliding"]
action_release_pressure = _BY_NAME["release_pressure"]
action_release_team_pressure = _BY_NAME["release_team_pressure"]
action_release_switch = _BY_NAME["release_switch"]
action_release_sprint = _BY_NAME["release_sprint"]
action_release_dribble = _BY_NAME["release_dribble"]
action_builtin_ai = _BY_NAME["builtin_ai"]

_DEFAULT = (
    *(
        "idle",
        *DIRECTIONS,
        "long_pass",
        "high_pass",
        "short_pass",
        "shot",
        "sprint",
        "release_direction",
    ),
    *("release_sprint", "sliding", "dribble", "release_dribble"),
)
_ONLY_FULL = (
    *(
        "keeper_rush",
        "pressure",
        "team_pressure",
        "switch",
        "release_long_pass",
        "release_high_pass",
    ),
    *(
        "release_short_pass",
        "release_shot",
        "release_keeper_rush",
        "release_sliding",
        "release_pressure",
    ),
    *("release_team_pressure", "release_switch"),
)

action_set_v1 = [_BY_NAME[name] for name in _DEFAULT]
action_set_v2 = [*action_set_v1, action_builtin_ai]
full_action_set = [*action_set_v2, *(_BY_NAME[name] for name in _ONLY_FULL)]
action_set_full = full_action_set
action_set_dict = {"default": action_set_v1, "v2": action_set_v2, "full": full_action_set}

NUMBERS = {name: number for number, name in enumerate(action.name for action in full_action_set)}
"""Every action's number in the `full` set, which is the same in the smaller sets."""


_RELEASES = {
    name: f"release_{name}"
    for name in (*BACKEND_NAMES[9:18], "sprint", "dribble")  # All buttons, held or not.
}
_COUNTERPARTS = {**_RELEASES, **{release: name for name, release in _RELEASES.items()}}


def disable_action(action: CoreAction) -> CoreAction:
    """Returns the action that ends another one.

    Every direction, and `release_direction` itself, gives `release_direction`. A button gives its
    release, and a release gives its button. Raises `ActionError` for `idle` and `builtin_ai`, which
    have no end, and for a number.

    >>> disable_action(action_sprint)
    CoreAction(release_sprint)
    """
    if not isinstance(action, CoreAction):
        raise ActionError(
            f"expected a `CoreAction`, found `{action!r}`",
            help="take it from the action set by its number",
        )
    if action.directional or action == action_release_direction:
        return action_release_direction
    if action.name not in _COUNTERPARTS:
        raise ActionError(
            f"no action ends `{action.name}`", help="directions and buttons can be released"
        )
    return _BY_NAME[_COUNTERPARTS[action.name]]


def get_action_set(config: Config | dict[str, Any]) -> list[CoreAction]:
    """Returns the actions of `config["action_set"]`, in order; `ParameterError` if it is unknown."""
    name = config["action_set"]
    check_word("action_set", name, tuple(action_set_dict))
    return action_set_dict[name]


def get_sticky_actions(config: Config | dict[str, Any]) -> list[CoreAction]:
    """Returns the actions that `sticky_actions` shows, in order: 10, or 13 in the full set."""
    return [action for action in get_action_set(config) if action.sticky]


def held_by(action: object) -> object:
    """Returns the content of a NumPy array or number, anything else unchanged.

    Raises `ValueError` for an array of several.
    """
    return action.item() if hasattr(action, "item") else action


def named_action_from_action_set(action_set: list[CoreAction], action: object) -> CoreAction:
    """Returns an action of a set by its number; an action object is returned unchanged.

    A NumPy array with one of them is also accepted. Raises `ActionError` for anything else.
    """
    try:
        held = held_by(action)
        if isinstance(held, CoreAction):
            return held
        if isinstance(held, bool):
            raise TypeError
        number = index(held)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ActionError(
            f"expected an action's number or a `CoreAction`, found `{action!r}`"
        ) from None
    if not 0 <= number < len(action_set):
        raise ActionError(f"action {number} is outside 0..{len(action_set) - 1}")
    return action_set[number]
