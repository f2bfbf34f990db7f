"""Scenic's sampler: starts from the same distribution with the same requirements."""

from __future__ import annotations

from contests import Contest, per_cpu_second

# Metres. Six players and the ball in boxes, some in need of room, like an Academy scenario with
# draws.
SCENIC = """
class Footballer:
    width: 0.5
    length: 0.5

ego = new Footballer at (Range(8, 14), Range(-3, 3))
left_wing = new Footballer at (Range(10, 20), Range(6, 20))
right_wing = new Footballer at (Range(10, 20), Range(-20, -6))
defender = new Footballer at (Range(30, 42), Range(-8, 8))
other = new Footballer at (Range(30, 42), Range(-8, 8))
keeper = new Footballer at (Range(50, 54), Range(-2, 2))
ball = new Object at (Range(16, 20), Range(-3, 3)), with width 0.22, with length 0.22
require (distance from defender to other) > 4
require (distance from ego to ball) > 3
"""
PITCH = """scenario start {
    agents { left: [passer] }
    ball at (uniform(16m, 20m), uniform(-3m, 3m))
    team left {
        passer: CM at (uniform(8m, 14m), uniform(-3m, 3m))
        CM at (uniform(10m, 20m), uniform(6m, 20m))
        CM at (uniform(10m, 20m), uniform(-20m, -6m))
    }
    team right {
        defender: CB at (uniform(30m, 42m), uniform(-8m, 8m))
        other: CB at (uniform(30m, 42m), uniform(-8m, 8m))
        GK at (uniform(50m, 54m), uniform(-2m, 2m))
    }
    require distance(defender, other) > 4m
    require distance(passer, ball) > 3m
    end limit 100 steps
}
"""


def scenic_scenes(_: str, seconds: float) -> float:
    """Scenes per CPU-second of Scenic's rejection sampler, in its 2D mode."""
    import scenic

    scenario = scenic.scenarioFromString(SCENIC, mode2D=True)
    return per_cpu_second(lambda: scenario.generate(maxIterations=10_000), 1, seconds)


def resets(_: str, seconds: float) -> float:
    """Resets per CPU-second of an environment in Python, with its observation."""
    import setpiece

    env = setpiece.make(setpiece.compile(PITCH, name="start.pitch"), seed=1)
    return per_cpu_second(env.reset, 1, seconds)


SCENIC_SAMPLER = Contest(
    title="Scenic's sampler",
    unit="starts per CPU-second",
    text="Six players and the ball drawn in boxes under two requirements on distances. Ours sets up the match too.",
    packages=("scenic",),
    cases=("six players, two requirements",),
    players={"Scenic": scenic_scenes, "setpiece.make": resets},
)
