"""What an agent of this folder sees: places in GRF's coordinates, from raw observations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# Metres per unit along x and y, so that distances are those on the pitch.
METRES = np.array([54.4, 83.6], dtype=np.float64)


@dataclass
class Scene:
    """One moment as the left team sees it, in metres.

    (0, 0) is the centre spot, and y points towards the bottom.
    """

    ball: np.ndarray  # (2,) metres
    ball_step: np.ndarray  # (2,) metres since the step before
    height: float  # metres; 0 where the observation has none
    me: int  # index of the agent's player
    ours: np.ndarray  # (n, 2) metres, the keeper first
    theirs: np.ndarray  # (m, 2) metres, the keeper first
    mine: bool  # the ball is at the agent's feet, as far as places tell
    our_ball: bool  # a player of ours is nearest to it
    step: int

    @property
    def place(self) -> np.ndarray:
        """Where the agent's player is, (2,) metres."""
        return self.ours[self.me]

    def pressed(self, within: float = 4.0) -> bool:
        """Whether an outfield opponent is within this distance, metres."""
        return bool(self.nearest_opponent() < within)

    def nearest_opponent(self) -> float:
        """Distance of the nearest opponent, metres."""
        if len(self.theirs) == 0:
            return 99.0
        return float(np.linalg.norm(self.theirs - self.place, axis=1).min())


# A player this near to a low ball has it, metres.
AT_FEET = 1.7


def scene_of(ball, ball_before, height, me, ours, theirs, step) -> Scene:
    """A scene from places in metres.

    The owner of the ball is derived from places, in the same way for every source.
    """
    away = np.linalg.norm(ours - ball, axis=1)
    their_away = np.linalg.norm(theirs - ball, axis=1) if len(theirs) else np.array([99.0])
    low = height < 1.0
    mine = low and away[me] < AT_FEET and away[me] <= their_away.min() + 0.3
    return Scene(
        ball,
        ball - ball_before,
        height,
        me,
        ours,
        theirs,
        bool(mine),
        bool(away.min() <= their_away.min()),
        step,
    )


def scene_of_raw(raw: dict, ball_before, step: int) -> Scene:
    """A scene from a raw observation in Google Research Football's form."""
    ball = raw["ball"][:2] * METRES
    return scene_of(
        ball,
        ball if ball_before is None else ball_before,
        float(raw["ball"][2]),
        int(raw["active"]),
        np.asarray(raw["left_team"]) * METRES,
        np.asarray(raw["right_team"]) * METRES,
        step,
    )
