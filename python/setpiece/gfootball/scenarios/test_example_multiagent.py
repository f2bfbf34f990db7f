"""Three attackers, a defender, and a right keeper who has left his goal: the level of GRF's example of many agents."""

from setpiece.gfootball.env.scenario_builder import Recorder
from setpiece.gfootball.scenarios import PlayerRole, Team


def build_scenario(builder: Recorder) -> None:
    """Says the scenario."""
    config = builder.config()
    config.game_duration = 100
    config.offsides = False
    config.end_episode_on_score = True
    config.end_episode_on_out_of_play = True
    config.end_episode_on_possession_change = True
    builder.SetBallPosition(0.62, 0.0)
    builder.SetTeam(Team.e_Left)
    builder.AddPlayer(-1.0, 0.0, PlayerRole.e_PlayerRole_GK)
    for x, y in ((0.6, 0.0), (0.7, 0.2), (0.7, -0.2)):
        builder.AddPlayer(x, y, PlayerRole.e_PlayerRole_CM)
    builder.SetTeam(Team.e_Right)
    builder.AddPlayer(1.0, 0.0, PlayerRole.e_PlayerRole_GK)
    builder.AddPlayer(-0.75, 0.0, PlayerRole.e_PlayerRole_CB)
