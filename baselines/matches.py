"""The environments of a learner: they play decisions, and continue from a checkpoint."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import Any

import numpy as np
import setpiece
import torch

from settings import Settings


def environments(settings: Settings, number: int, threads: int, **others: Any) -> Any:
    """Makes environments of what the policy sees and plays."""
    return setpiece.make_vec(
        settings.scenario,
        number,
        threads=threads,
        autoreset_mode="same_step",
        observation=settings.observation,
        stack=settings.stack,
        left=settings.players or None,
        **others,
    )


def rows_of(envs: Any, observation: np.ndarray) -> np.ndarray:
    """Returns observations `(envs, agents, …)`, also of a single agent."""
    shape = envs.single_observation_space.shape
    shape = shape if len(envs.agents) == 1 else shape[1:]
    return observation.reshape(len(observation), len(envs.agents), *shape)


def masks_of(envs: Any, infos: dict[str, Any]) -> np.ndarray:
    """Returns the masks of the actions, int8 `(envs, agents, actions)`."""
    shown: np.ndarray = infos["action_mask"]
    return shown.reshape(len(shown), len(envs.agents), -1)


@dataclass
class Heard:
    """What the environments showed after a decision."""

    rewards: np.ndarray
    """`(envs, agents)`: the sum over the steps of the decision."""
    ended: np.ndarray
    """`(envs,)`: whether an episode ended."""
    cut: dict[int, np.ndarray]
    """The last observations of the episodes that a time limit ended, by environment."""


class Matches:
    """Environments that play decisions, and can continue where a checkpoint left them.

    An episode is a function of its level and its actions. So a checkpoint has those of the running
    episodes, and `load` plays them again.
    """

    def __init__(self, settings: Settings, threads: int) -> None:
        self.settings, number = settings, settings.envs
        self.envs = environments(
            settings,
            number,
            threads,
            rewards=settings.rewards,
            levels=settings.levels or None,
            seed=settings.seed,
            copy=False,
        )
        self.agents = len(self.envs.agents)
        self.observation, self.infos = self.envs.reset(seed=settings.seed)
        self.began = np.zeros(number, int)
        self.acts: list[np.ndarray] = []
        self.sums: dict[str, float] = defaultdict(float)

    @property
    def rows(self) -> np.ndarray:
        """The observations: `(envs, agents, …)`."""
        return rows_of(self.envs, self.observation)

    @property
    def masks(self) -> np.ndarray:
        """The masks of the actions: `(envs, agents, actions)`."""
        return masks_of(self.envs, self.infos)

    def decide(self, actions: np.ndarray) -> Heard:
        """Plays actions `(envs, agents)` for `repeat` steps.

        Where an episode ends before the last of them, the next one begins after the last: it would
        otherwise begin with some idle steps, which make a scenario harder.
        """
        pressed = actions.astype(np.uint8)
        number = len(pressed)
        heard = Heard(np.zeros(pressed.shape, np.float32), np.zeros(number, bool), {})
        for _ in range(self.settings.repeat):
            played = np.where(heard.ended[:, None], 0, pressed).astype(np.uint8)
            rewards, over, cut = self.step(played)
            heard.rewards += np.where(heard.ended[:, None], 0, rewards.reshape(number, -1))
            for at in np.flatnonzero(cut & ~heard.ended):
                heard.cut[int(at)] = self.infos["final_obs"][at]
            late = heard.ended.copy()
            heard.ended |= over
        if late.any():
            self.observation, self.infos = self.envs.reset(options={"reset_mask": late})
            self.began[late] = len(self.acts)
        return heard

    def step(self, played: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Plays a step; returns the rewards, and which episodes ended and which by their limit."""
        self.acts.append(played)
        self.observation, rewards, terminated, truncated, self.infos = self.envs.step(
            played.reshape(self.envs.action_space.shape)
        )
        over = terminated | truncated
        if over.any():
            self.count(self.infos["final_info"], over)
            self.began[over] = len(self.acts)
        return rewards, over, truncated & ~terminated

    def count(self, final: dict[str, Any], over: np.ndarray) -> None:
        """Adds the results of episodes that ended."""
        goals = final["score"][over]
        self.sums["episodes"] += int(over.sum())
        self.sums["score"] += float((goals[:, 0] - goals[:, 1]).sum())
        self.sums["length"] += float(final["setpiece"]["length"][over].sum())
        for name, paid in final["setpiece"]["return"].items():
            self.sums[f"terms/{name}"] += float(
                paid[over].mean(-1).sum() if paid.ndim > 1 else paid[over].sum()
            )

    def means(self) -> dict[str, float]:
        """Returns the means over the episodes that ended since the last call.

        Those are the score, the length, and what each term of the reward paid to an agent.
        """
        ended = self.sums.pop("episodes", 0)
        means = {name: total / ended for name, total in self.sums.items()} if ended else {}
        self.sums.clear()
        return means

    def stage(self) -> dict[str, Any]:
        """Returns the stage of a curriculum, and the value that it adapts."""
        source = self.envs.level_source
        if not isinstance(source, setpiece.Curriculum):
            return {}
        return {"stage": source.stage, "value": source.value}

    def state(self) -> dict[str, Any]:
        """Returns what `load` needs to continue here."""
        first = int(self.began.min())
        self.acts, self.began = self.acts[first:], self.began - first
        shape = (0, self.settings.envs, self.agents)
        acts = np.stack(self.acts) if self.acts else np.zeros(shape, np.uint8)
        source = self.envs.level_source
        return {
            "acts": torch.from_numpy(acts),
            "levels": self.envs.levels,
            "began": self.began.tolist(),
            "sums": dict(self.sums),
            "source": None if source is None else source.state_dict(),
        }

    def load(self, state: dict[str, Any]) -> None:
        """Plays the running episodes of a state again."""
        acts, began = state["acts"].numpy(), np.array(state["began"])
        for at in range(len(acts) + 1):
            if (began == at).any():
                options = {"reset_mask": began == at, "level": state["levels"]}
                self.observation, self.infos = self.envs.reset(options=options)
            if at < len(acts):
                self.step(acts[at])
        if self.envs.level_source is not None:
            self.envs.level_source.load_state_dict(state["source"])
        self.acts, self.began = [*acts], began
        self.sums = defaultdict(float, state["sums"])
