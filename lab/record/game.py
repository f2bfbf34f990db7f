"""Plays Google Research Football on our own stages, with difficulties and a seed per episode."""

import os
import sys
import types

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

import gfootball_engine as libgame
from gfootball.env import config as configs
from gfootball.env import football_env_core

SCALE = (54.4, 83.6)
"""Metres per unit of a place, of the ball and of observations."""

STAGE = "stage_of_the_lab"


class Game:
    """One engine; every `reset` plays on another stage."""

    def __init__(self, agents):
        """Starts an engine for this many agents of the left and the right team."""
        self.left_agents = agents[0]
        self.stage = EMPTY
        module = types.ModuleType(STAGE)
        module.build_scenario = self._build
        sys.modules["gfootball.scenarios." + STAGE] = module
        players = [f"agent:left_players={agents[0]},right_players={agents[1]}"]
        self.config = configs.Config({"level": STAGE, "players": players, "action_set": "v2"})
        self.core = football_env_core.FootballEnvCore(self.config)

    def _build(self, builder):
        stage, settings = self.stage, builder.config()
        settings.game_duration = stage.get("duration", 3000)
        settings.deterministic = False
        settings.offsides = stage.get("offside", False)
        settings.left_team_difficulty, settings.right_team_difficulty = stage["difficulty"]
        settings.end_episode_on_score = False
        settings.end_episode_on_out_of_play = False
        settings.end_episode_on_possession_change = False
        builder.SetBallPosition(*stage["ball"])
        teams = (
            (libgame.e_Team.e_Left, 1, stage["left"]),
            (libgame.e_Team.e_Right, -1, stage["right"]),
        )
        for team, side, players in teams:
            builder.SetTeam(team)
            for role, x, y, flags in players:
                role = getattr(libgame.e_PlayerRole, "e_PlayerRole_" + role)
                builder.AddPlayer(side * x, side * y, role, "lazy" in flags, "nobody" not in flags)

    def reset(self, stage, seed):
        """Begins an episode; returns its first view."""
        self.stage = stage
        self.config["game_engine_random_seed"] = seed
        self.config["reverse_team_processing"] = bool(seed % 2)
        self.core.reset()
        return self._view([], None)

    def step(self, actions, before):
        """Plays a step of actions' names, each in its team's frame; returns the view after it."""
        turned = [TURNED.get(action, action) for action in actions[self.left_agents :]]
        self.core.step([NUMBERS[action] for action in actions[: self.left_agents] + turned])
        return self._view(actions, before)

    def _view(self, actions, before):
        seen = self.core._observation
        x, y, z = seen["ball"]
        ball = [x * SCALE[0], y * SCALE[1], z]
        speed = 0.0
        if before:
            speed = (
                (ball[0] - before["ball"][0]) ** 2 + (ball[1] - before["ball"][1]) ** 2
            ) ** 0.5 * 10
        left, right = (
            [[x * SCALE[0], y * SCALE[1]] for x, y in seen[team]]
            for team in ("left_team", "right_team")
        )
        return {
            "ball": ball,
            "vel": [
                seen["ball_direction"][0] * SCALE[0] * 10,
                seen["ball_direction"][1] * SCALE[1] * 10,
            ],
            "speed": speed,
            "owner": seen["ball_owned_team"],
            "who": seen["ball_owned_player"],
            "mode": seen["game_mode"],
            "teams": [left, right],
            "pressed": actions,
            "active": seen["left_agent_controlled_player"] + seen["right_agent_controlled_player"],
            "score": seen["score"],
        }


MANY = [("GK", -1, 0, ""), ("CB", -0.5, 0.1, ""), ("CB", -0.5, -0.1, "")]
EMPTY = {"ball": (0, 0), "left": MANY, "right": MANY, "difficulty": (1.0, 0.6)}

NAMES = [
    "idle",
    "left",
    "top_left",
    "top",
    "top_right",
    "right",
    "bottom_right",
    "bottom",
    "bottom_left",
    "long_pass",
    "high_pass",
    "short_pass",
    "shot",
    "sprint",
    "release_direction",
    "release_sprint",
    "sliding",
    "dribble",
    "release_dribble",
    "builtin_ai",
]
NUMBERS = {name: number for number, name in enumerate(NAMES)}

WAYS = ["right", "top_right", "top", "top_left", "left", "bottom_left", "bottom", "bottom_right"]
TURNED = {way: WAYS[(number + 4) % 8] for number, way in enumerate(WAYS)}
"""The engine takes the right team's directions in the frame of the pitch."""
