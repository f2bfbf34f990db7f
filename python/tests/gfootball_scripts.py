"""What the tests of scenario scripts in GRF's form share."""

from pathlib import Path
from typing import Any

import numpy as np

from setpiece.gfootball.env.scenario_builder import record, script_of
from setpiece.gfootball.env.scenario_config import FormationEntry, ScenarioConfig

HEAD = "from . import *\n\ndef build_scenario(builder):\n    config = builder.config()\n"

ONE_TEAM = """
    config.game_duration = 20
    builder.SetTeam(Team.e_Left)
    builder.AddPlayer(-1.0, 0.0, e_PlayerRole_GK)
"""


def script_file(folder: Path, text: str, name: str = "mine") -> str:
    path = folder / f"{name}.py"
    path.write_text(HEAD + text, encoding="utf-8")
    return str(path)


def recorded(path: str, episode: int) -> ScenarioConfig:
    from setpiece.gfootball.env.scenario_builder import load_script

    return record(script_of(load_script(path), path), episode)


def places(entries: list[FormationEntry], sign: float) -> list[tuple[float, float]]:
    # Scripts place players on a wider scale than that of observations.
    return [
        (sign * entry.position[0] * 55 / 54.4, sign * entry.position[1] * 84.96 / 83.6)
        for entry in entries
    ]


def starts_as(seen: dict[str, Any], said: ScenarioConfig) -> None:
    """Whether an observation of the whole match matches the script's settings."""
    assert np.allclose(seen["left_team"], places(said.left_team, 1.0), atol=1e-4)
    assert np.allclose(seen["right_team"], places(said.right_team, -1.0), atol=1e-4)
    assert np.allclose(seen["ball"][:2], said.ball_position[:2], atol=1e-6)
    assert seen["left_team_roles"].tolist() == [int(entry.role) for entry in said.left_team]
    assert seen["right_team_roles"].tolist() == [int(entry.role) for entry in said.right_team]
