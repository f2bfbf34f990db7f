"""Both games with one interface: batches of episodes that show the super mini map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from places import Tracker
from policy import Policy, draw

ENVS_MAX = 8
"""The most games at once in an evaluation."""


@dataclass
class Turn:
    """The result of a step of all games; arrays have a leading axis of games.

    After the last map of an episode the next step starts another one, and ignores its action.
    """

    maps: np.ndarray  # uint8 (envs, 72, 96, 4)
    rewards: np.ndarray  # float32 (envs,)
    terminated: np.ndarray  # bool (envs,)
    truncated: np.ndarray  # bool (envs,)
    ahead: np.ndarray  # int64 (envs,): goals of the left team less those of the right


class Here:
    """Setpiece's vector environment."""

    def __init__(self, scenario: str, envs: int, seed: int, rewards: str | None = None) -> None:
        """Makes `envs` games with the seeds from `seed` upwards."""
        import setpiece

        self.envs, self.seed = envs, seed
        self.vector = setpiece.make_vec(
            scenario, envs, threads=1, observation="smm", rewards=rewards, copy=False
        )

    def reset(self) -> np.ndarray:
        """Returns the first maps."""
        return self.vector.reset(seed=self.seed)[0]

    def step(self, actions: np.ndarray) -> Turn:
        """Plays a step of every game."""
        maps, rewards, terminated, truncated, infos = self.vector.step(actions)
        score = infos["score"]
        return Turn(
            maps, rewards.astype(np.float32), terminated, truncated, score[:, 0] - score[:, 1]
        )

    def close(self) -> None:
        """Releases the games."""
        self.vector.close()


class There:
    """The real game's engine, from EnvPool's wheel."""

    def __init__(self, scenario: str, envs: int, seed: int) -> None:
        """Makes `envs` games with the seeds from `seed` upwards."""
        import envpool

        self.envs = envs
        self.pool = envpool.make_gymnasium(
            f"gfootball/{scenario}-v1", num_envs=envs, num_threads=1, seed=seed
        )

    def reset(self) -> np.ndarray:
        """Returns the first maps."""
        return self.pool.reset()[0]

    def step(self, actions: np.ndarray) -> Turn:
        """Plays a step of every game."""
        maps, rewards, terminated, truncated, infos = self.pool.step(actions.astype(np.int32))
        score = infos["score"].astype(np.int64)
        return Turn(maps, rewards, terminated, truncated, score[:, 0] - score[:, 1])

    def close(self) -> None:
        """Releases the games."""
        self.pool.close()


def there_version() -> str:
    """Names the real game and the package it comes with."""
    from importlib.metadata import version

    return f"EnvPool {version('envpool')}"


def play(policy: Policy, game: Here | There, episodes: int, drawn: bool, seed: int) -> np.ndarray:
    """Plays episodes of a policy; returns the final goal differences, int64.

    It uses the likeliest actions or drawn ones. Every game plays its share of the episodes, because
    taking the first ones to end would favour short episodes.
    """
    rng = np.random.default_rng(seed)
    quota = np.full(game.envs, episodes // game.envs) + (
        np.arange(game.envs) < episodes % game.envs
    )
    tracker, maps, first = Tracker(policy.roster, game.envs), game.reset(), np.ones(game.envs, bool)
    over = np.zeros(game.envs, bool)
    ends: list[int] = []
    while quota.any():
        logits = policy.logits(tracker.see(maps, first))
        turn = game.step(draw(logits, rng) if drawn else logits.argmax(-1))
        maps, first, over = turn.maps, over, turn.terminated | turn.truncated
        counted = over & (quota > 0)
        ends += turn.ahead[counted].tolist()
        quota = quota - counted
    return np.array(ends, np.int64)
