"""The words of the language that Python code names: actions, game modes, roles."""

from enum import IntEnum

from setpiece import _native


class Action(IntEnum):
    """An action, by its number in Google Research Football's `full` set, in the agent's own frame.

    The first 19 are GRF's `default` set; `BUILTIN_AI` completes `v2`: `make(..., action_set="v2")`.
    """

    IDLE = 0
    LEFT = 1
    TOP_LEFT = 2
    TOP = 3
    TOP_RIGHT = 4
    RIGHT = 5
    BOTTOM_RIGHT = 6
    BOTTOM = 7
    BOTTOM_LEFT = 8
    LONG_PASS = 9
    HIGH_PASS = 10
    SHORT_PASS = 11
    SHOT = 12
    SPRINT = 13
    RELEASE_DIRECTION = 14
    RELEASE_SPRINT = 15
    SLIDING = 16
    DRIBBLE = 17
    RELEASE_DRIBBLE = 18
    BUILTIN_AI = 19
    KEEPER_RUSH = 20
    PRESSURE = 21
    TEAM_PRESSURE = 22
    SWITCH = 23
    RELEASE_LONG_PASS = 24
    RELEASE_HIGH_PASS = 25
    RELEASE_SHORT_PASS = 26
    RELEASE_SHOT = 27
    RELEASE_KEEPER_RUSH = 28
    RELEASE_SLIDING = 29
    RELEASE_PRESSURE = 30
    RELEASE_TEAM_PRESSURE = 31
    RELEASE_SWITCH = 32

    @property
    def doc(self) -> str:
        """What the action does, in one line."""
        return _native.ACTIONS[self][1]


class GameMode(IntEnum):
    """Open play, or the pending set piece: `game_mode` of raw observations."""

    NORMAL = 0
    KICK_OFF = 1
    GOAL_KICK = 2
    FREE_KICK = 3
    CORNER = 4
    THROW_IN = 5
    PENALTY = 6


class Role(IntEnum):
    """A player's role: `left_team_roles` and `right_team_roles` of raw observations."""

    GK = 0
    CB = 1
    LB = 2
    RB = 3
    DM = 4
    CM = 5
    LM = 6
    RM = 7
    AM = 8
    CF = 9
