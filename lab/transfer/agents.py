"""Twelve rule-based agents for whole matches and scenes, using only places.

Each is a function of a scene and of its own memory, and names an action. `Player` presses it and
remembers what it holds. Most press their direction again in every step, as many agents do.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from scene import Scene

GOAL = np.array([54.4, 0.0])
# The 19 actions in their order.
# fmt: off
NAMES = [
    "idle", "left", "top_left", "top", "top_right", "right", "bottom_right", "bottom",
    "bottom_left", "long_pass", "high_pass", "short_pass", "shot", "sprint", "release_direction",
    "release_sprint", "sliding", "dribble", "release_dribble",
]
# fmt: on
ACTION = {name: index for index, name in enumerate(NAMES)}
WAYS = ["right", "bottom_right", "bottom", "bottom_left", "left", "top_left", "top", "top_right"]

Memory = dict
Policy = Callable[[Scene, Memory], str]


def direction(way: np.ndarray) -> str:
    """The direction nearest to a vector (y towards the bottom)."""
    return WAYS[int(np.round(np.arctan2(way[1], way[0]) / (np.pi / 4))) % 8]


def run(memory: Memory, way: np.ndarray, sprint: bool = True) -> str:
    """The next press for running: the direction first, then the gait."""
    wanted = direction(way)
    if memory.get("direction") != wanted:
        return wanted
    if sprint and not memory.get("sprint"):
        return "sprint"
    if not sprint and memory.get("sprint"):
        return "release_sprint"
    return wanted


def to_goal(scene: Scene) -> np.ndarray:
    """The vector to the middle of the goal, metres."""
    return GOAL - scene.place


def chase(scene: Scene, memory: Memory, slides: bool = False) -> str:
    """Without the ball: runs to where it will be, on the goal side while opponents have it."""
    spot = scene.ball + scene.ball_step * 3.0
    if not scene.our_ball and np.linalg.norm(spot - scene.place) > 6.0:
        spot = spot + np.array([-3.0, 0.0])
    if (
        slides
        and not scene.our_ball
        and np.linalg.norm(scene.ball - scene.place) < 1.8
        and scene.step % 7 == 0
    ):
        return "sliding"
    return run(memory, spot - scene.place)


def best_mate(scene: Scene, forward: float) -> tuple[int, float] | None:
    """The free outfield teammate most worth a pass: index and clearance in metres."""
    best = None
    for i, mate in enumerate(scene.ours):
        if i in (0, scene.me):
            continue
        way = mate - scene.place
        length = float(np.linalg.norm(way))
        if not 6.0 < length < 32.0:
            continue
        free = lane(scene, mate)
        worth = free + forward * way[0] - 0.1 * abs(length - 15.0)
        if best is None or worth > best[1]:
            best = (i, worth, free)
    return None if best is None else (best[0], best[2])


def lane(scene: Scene, to: np.ndarray) -> float:
    """The distance of the nearest opponent from the line to a place, metres, at most 8."""
    way = to - scene.place
    length = max(float(np.linalg.norm(way)), 0.1)
    ahead = way / length
    least = 8.0
    for rival in scene.theirs[1:]:
        along = np.clip((rival - scene.place) @ ahead, 0.0, length)
        least = min(least, float(np.linalg.norm(scene.place + ahead * along - rival)))
    return least


def aimed(memory: Memory, way: np.ndarray, kick: str) -> str:
    """Presses the direction of a kick, then the kick."""
    wanted = direction(way)
    return kick if memory.get("direction") == wanted else wanted


def runner(scene: Scene, memory: Memory) -> str:
    """Sprints at goal and shoots from 18 m in any case."""
    if not scene.mine:
        return chase(scene, memory)
    if np.linalg.norm(to_goal(scene)) < 18.0:
        return "shot"
    return run(memory, to_goal(scene))


def long_shooter(scene: Scene, memory: Memory) -> str:
    """Shoots as soon as the goal is 28 m away."""
    if not scene.mine:
        return chase(scene, memory)
    if np.linalg.norm(to_goal(scene)) < 28.0:
        return aimed(memory, to_goal(scene), "shot")
    return run(memory, to_goal(scene))


def charger(scene: Scene, memory: Memory) -> str:
    """Holds the key of every shot for five steps."""
    if memory.get("charge", 0) > 0:
        memory["charge"] -= 1
        return "shot"
    if not scene.mine:
        return chase(scene, memory)
    if np.linalg.norm(to_goal(scene)) < 22.0:
        memory["charge"] = 4
        return "shot"
    return run(memory, to_goal(scene))


def passer(scene: Scene, memory: Memory) -> str:
    """Passes short to the free teammate further up as soon as an opponent is near."""
    if not scene.mine:
        return chase(scene, memory)
    if np.linalg.norm(to_goal(scene)) < 17.0:
        return aimed(memory, to_goal(scene), "shot")
    mate = best_mate(scene, 0.25)
    if scene.pressed(5.0) and mate and mate[1] > 2.0:
        return aimed(memory, scene.ours[mate[0]] - scene.place, "short_pass")
    return run(memory, to_goal(scene))


def builder(scene: Scene, memory: Memory) -> str:
    """Keeps the ball moving: a short pass after every twelve steps on it, walking meanwhile."""
    if not scene.mine:
        memory["held"] = 0
        return chase(scene, memory)
    memory["held"] = memory.get("held", 0) + 1
    if np.linalg.norm(to_goal(scene)) < 15.0:
        return aimed(memory, to_goal(scene), "shot")
    mate = best_mate(scene, 0.12)
    if memory["held"] > 12 and mate and mate[1] > 1.5:
        return aimed(memory, scene.ours[mate[0]] - scene.place, "short_pass")
    return run(memory, to_goal(scene), sprint=False)


def direct(scene: Scene, memory: Memory) -> str:
    """Plays the ball long and forward at once."""
    if not scene.mine:
        return chase(scene, memory)
    if np.linalg.norm(to_goal(scene)) < 20.0:
        return aimed(memory, to_goal(scene), "shot")
    if scene.place[0] < 20.0 and scene.step % 3 == 0:
        return aimed(memory, np.array([1.0, 0.0]), "long_pass")
    return run(memory, np.array([1.0, 0.0]))


def crosser(scene: Scene, memory: Memory) -> str:
    """Runs down the nearer wing and crosses high from beside the box."""
    if not scene.mine:
        return chase(scene, memory)
    side = 1.0 if scene.place[1] >= 0 else -1.0
    if scene.place[0] > 38.0:
        if abs(scene.place[1]) > 14.0:
            return aimed(memory, np.array([0.0, -side]), "high_pass")
        return aimed(memory, to_goal(scene), "shot")
    wing = np.array([scene.place[0] + 12.0, side * 26.0])
    return run(memory, wing - scene.place)


def cutter(scene: Scene, memory: Memory) -> str:
    """Runs down the wing, cuts inside at the box and shoots across the goal."""
    if not scene.mine:
        return chase(scene, memory)
    side = 1.0 if scene.place[1] >= 0 else -1.0
    if scene.place[0] < 30.0:
        wing = np.array([scene.place[0] + 12.0, side * 15.0])
        return run(memory, wing - scene.place)
    if np.linalg.norm(to_goal(scene)) < 19.0:
        return "shot"
    return run(memory, np.array([1.0, -side]))


def dribbler(scene: Scene, memory: Memory) -> str:
    """Runs at goal and swerves away from the nearest opponent; shoots from 16 m."""
    if not scene.mine:
        return chase(scene, memory)
    if np.linalg.norm(to_goal(scene)) < 16.0:
        return "shot"
    way = to_goal(scene) / max(float(np.linalg.norm(to_goal(scene))), 1.0)
    for rival in scene.theirs[1:]:
        away = scene.place - rival
        distance = float(np.linalg.norm(away))
        if distance < 8.0 and way @ -away > 0:
            way = way + np.array([-way[1], way[0]]) * np.sign(
                way[0] * away[1] - way[1] * away[0]
            ) * (1.6 - 0.2 * distance)
    return run(memory, way)


def presser(scene: Scene, memory: Memory) -> str:
    """Hunts the ball and slides for it; with the ball, looks for a teammate at once."""
    if not scene.mine:
        return chase(scene, memory, slides=True)
    if np.linalg.norm(to_goal(scene)) < 18.0:
        return "shot"
    mate = best_mate(scene, 0.2)
    if mate and mate[1] > 3.0:
        return aimed(memory, scene.ours[mate[0]] - scene.place, "short_pass")
    return run(memory, to_goal(scene))


def counter(scene: Scene, memory: Memory) -> str:
    """Waits behind the ball; with it, plays one long ball from the own half, then runs."""
    if not scene.mine:
        if scene.our_ball:
            return chase(scene, memory)
        spot = scene.ball + np.array([-9.0, -0.25 * scene.ball[1]])
        return run(memory, spot - scene.place)
    if np.linalg.norm(to_goal(scene)) < 18.0:
        return aimed(memory, to_goal(scene), "shot")
    mate = best_mate(scene, 0.5)
    if scene.place[0] < 0 and mate and scene.step % 5 == 0:
        return aimed(memory, scene.ours[mate[0]] - scene.place, "high_pass")
    return run(memory, to_goal(scene))


def hammerer(scene: Scene, memory: Memory) -> str:
    """Presses a kick in every step: short passes up the pitch, shots near the goal."""
    if np.linalg.norm(to_goal(scene)) < 20.0 and scene.our_ball:
        return "shot"
    if scene.mine and scene.pressed(6.0):
        return "short_pass"
    if not scene.mine:
        return chase(scene, memory)
    return run(memory, to_goal(scene))


AGENTS: dict[str, Policy] = {
    policy.__name__: policy
    for policy in (
        runner,
        long_shooter,
        charger,
        passer,
        builder,
        direct,
        crosser,
        cutter,
        dribbler,
        presser,
        counter,
        hammerer,
    )
}


class Player:
    """Plays a policy with keys, and remembers what it holds."""

    def __init__(self, policy: Policy) -> None:
        self.policy = policy
        self.memory: Memory = {}

    def act(self, scene: Scene) -> int:
        """The action of a step."""
        name = self.policy(scene, self.memory)
        if name in WAYS:
            self.memory["direction"] = name
        elif name in ("sprint", "release_sprint"):
            self.memory["sprint"] = name == "sprint"
        elif name == "release_direction":
            self.memory["direction"] = None
        return ACTION[name]
