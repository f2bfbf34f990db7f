"""What the tests of `create_environment` share."""

from typing import Any

from setpiece.gfootball.env import create_environment
from setpiece.gfootball.env.football_env import FootballEnv

CLOSE = "academy_empty_goal_close"

THREE = "academy_3_vs_1_with_keeper"

FULL = "11_vs_11_stochastic"

SEEDED = {"game_engine_random_seed": 7}


def make(name: str = THREE, left: int = 1, right: int = 0, **kwargs: Any) -> Any:
    options = {**SEEDED, **kwargs.pop("other_config_options", {})}
    return create_environment(
        name,
        number_of_left_players_agent_controls=left,
        number_of_right_players_agent_controls=right,
        other_config_options=options,
        **kwargs,
    )


def inside(env: Any) -> FootballEnv:
    found = env.unwrapped
    assert isinstance(found, FootballEnv)
    return found
