"""What a scenario in Google Research Football's form imports: teams and roles.

A module of such a form has `build_scenario(builder)`. `create_environment` finds it below this
package (append a folder
to `__path__`, or put the module into `sys.modules`), by its own dotted name, or as a path that ends
in `.py`.
"""

from enum import IntEnum

__all__ = [
    "PlayerRole",
    "Team",
    "e_PlayerRole_AM",
    "e_PlayerRole_CB",
    "e_PlayerRole_CF",
    "e_PlayerRole_CM",
    "e_PlayerRole_DM",
    "e_PlayerRole_GK",
    "e_PlayerRole_LB",
    "e_PlayerRole_LM",
    "e_PlayerRole_RB",
    "e_PlayerRole_RM",
]


class Team(IntEnum):
    """A team, as `SetTeam` takes it."""

    e_Left = 0  # noqa: N815
    e_Right = 1  # noqa: N815


class PlayerRole(IntEnum):
    """A role, as `AddPlayer` takes it: the numbers of observations."""

    e_PlayerRole_GK = 0  # noqa: N815
    e_PlayerRole_CB = 1  # noqa: N815
    e_PlayerRole_LB = 2  # noqa: N815
    e_PlayerRole_RB = 3  # noqa: N815
    e_PlayerRole_DM = 4  # noqa: N815
    e_PlayerRole_CM = 5  # noqa: N815
    e_PlayerRole_LM = 6  # noqa: N815
    e_PlayerRole_RM = 7  # noqa: N815
    e_PlayerRole_AM = 8  # noqa: N815
    e_PlayerRole_CF = 9  # noqa: N815


e_PlayerRole_GK = PlayerRole.e_PlayerRole_GK  # noqa: N816  # the names are GRF's
e_PlayerRole_CB = PlayerRole.e_PlayerRole_CB  # noqa: N816
e_PlayerRole_LB = PlayerRole.e_PlayerRole_LB  # noqa: N816
e_PlayerRole_RB = PlayerRole.e_PlayerRole_RB  # noqa: N816
e_PlayerRole_DM = PlayerRole.e_PlayerRole_DM  # noqa: N816
e_PlayerRole_CM = PlayerRole.e_PlayerRole_CM  # noqa: N816
e_PlayerRole_LM = PlayerRole.e_PlayerRole_LM  # noqa: N816
e_PlayerRole_RM = PlayerRole.e_PlayerRole_RM  # noqa: N816
e_PlayerRole_AM = PlayerRole.e_PlayerRole_AM  # noqa: N816
e_PlayerRole_CF = PlayerRole.e_PlayerRole_CF  # noqa: N816
