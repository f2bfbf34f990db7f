"""The keys of an agent: each is pressed every step until a condition holds.

`lab/data/README.md` describes their format.
"""

import math

WAYS = ["right", "top_right", "top", "top_left", "left", "bottom_left", "bottom", "bottom_right"]

SHOT_M = 16.0
"""The scripted agent shoots when it owns the ball within this distance of the goal."""


class Keys:
    """An agent working through a plan."""

    def __init__(self, plan, agent, team, mirrored):
        self.plan, self.agent, self.team, self.mirrored = plan, agent, team, mirrored
        self.at = self.pressed = 0
        self.held, self.sprints = None, False

    def press(self, view):
        """The key of the next step."""
        while self.at + 1 < len(self.plan) and self._holds(self.plan[self.at][1], view):
            self.at += 1
            self.pressed = 0
        self.pressed += 1
        key = self.plan[self.at][0]
        side = 1 if self.team == 0 else -1
        me = self._me(view)
        if key == "chase":
            return towards(me, view["ball"], side)
        if key == "goal":
            return towards(me, (54.4 * side, 0), side)
        if key == "scripted":
            return self._scripted(view, me, side)
        if self.mirrored and key in WAYS:
            return WAYS[-WAYS.index(key) % 8]
        return key

    def _scripted(self, view, me, side):
        goal = (54.4 * side, 0)
        owned = self._mine(view)
        way = towards(me, goal if owned else view["ball"], side)
        if owned and math.dist(me, goal) < SHOT_M:
            return "shot"
        if self.held != way:
            self.held = way
            return way
        if self.sprints:
            return "idle"
        self.sprints = True
        return "sprint"

    def _me(self, view):
        return view["teams"][self.team][view["active"][self.agent]]

    def _mine(self, view):
        return view["owner"] == self.team and view["who"] == view["active"][self.agent]

    def _holds(self, until, view):
        if not isinstance(until, str):
            return self.pressed >= until
        word, _, number = until.partition(" ")
        number = float(number or 0)
        me = self._me(view)
        if word == "near":
            return min(math.dist(me, foe) for foe in view["teams"][1 - self.team]) <= number
        if word == "ball":
            return math.dist(me, view["ball"][:2]) <= number
        if word == "x":
            side = 1 if self.team == 0 else -1
            return view["owner"] == self.team and view["ball"][0] * side >= number * 54.4
        return {
            "end": False,
            "owned": self._mine(view),
            "mine": self._mine(view),
            "team": view["owner"] == self.team,
            "fast": view["speed"] >= number,
            "stopped": view["mode"] != 0,
            "play": view["mode"] == 0,
        }[word]


def towards(me, at, side):
    """The nearest of eight directions, in the frame of the team."""
    eighth = math.atan2(-(at[1] - me[1]) * side, (at[0] - me[0]) * side) / (math.pi / 4)
    return WAYS[math.floor(eighth + 0.5) % 8]
