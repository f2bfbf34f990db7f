"""What is looked at while a policy trains: a suite, and videos. It changes nothing of a run."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import setpiece

from measure import EVALUATION_SEED

if TYPE_CHECKING:
    from ppo import Training
    from settings import Settings


class Watch:
    """Plays a suite after every `every` updates, and films after every `video_every`.

    Both also happen after the last update. The policy takes its likeliest actions.

    - `suites.csv` has a row for each entry of the suite and each time, with 95 % intervals.
      TensorBoard gets the scores and the success rates.
    - `videos/STEPS.mp4` is always the first episode of the evaluations, beside its replay.
    """

    def __init__(
        self,
        settings: Settings,
        out: Path,
        *,
        suite: str = "",
        every: int = 50,
        video_every: int = 0,
    ) -> None:
        """Raises `ValueError` for a wrong count, and what `setpiece.suite` does."""
        for name, count, least in (("every", every, 1), ("video-every", video_every, 0)):
            if count < least:
                raise ValueError(f"--{name} is {count}; expected at least {least}")
        self.settings, self.out = settings, out
        self.every, self.video_every = every, video_every
        self.suite = setpiece.suite(suite) if suite else None

    def after(self, training: Training, writer: Any = None) -> None:
        """Looks at a policy after an update."""
        last = training.update == training.updates
        if self.suite is not None and (last or training.update % self.every == 0):
            self.evaluate(training, writer)
        if self.video_every and (last or training.update % self.video_every == 0):
            film(training, self.out / "videos" / f"{training.steps:09}.mp4")

    def evaluate(self, training: Training, writer: Any) -> None:
        """Plays the suite."""
        settings = self.settings
        policy = setpiece.Policy(training.choose, repeat=settings.repeat, masks=settings.masks)
        table = setpiece.evaluate(
            policy,
            self.suite,
            observation=settings.observation,
            stack=settings.stack,
            threads=training.threads,
        )
        training.tables += [{"steps": training.steps, **row} for row in table.to_dicts()]
        if writer is not None:
            for row in table.rows:
                for name in ("mean_score", "success_rate"):
                    value = getattr(row, name).value
                    writer.add_scalar(f"suite/{row.entry}/{name}", value, training.steps)
        self.out.mkdir(parents=True, exist_ok=True)
        with (self.out / "suites.csv").open("w", newline="", encoding="utf-8") as file:
            lines = csv.DictWriter(file, [*training.tables[0]], lineterminator="\n")
            lines.writeheader()
            lines.writerows(training.tables)


def film(training: Training, path: Path) -> None:
    """Writes the video of an episode, and its replay."""
    settings = training.settings
    env = setpiece.make(
        settings.scenario,
        observation=settings.observation,
        stack=settings.stack,
        left=settings.players or None,
    )
    observation, info = env.reset(seed=EVALUATION_SEED)
    while "outcome" not in info:
        masks = info["action_mask"].reshape(training.agents, -1)
        pressed = training.choose(
            np.reshape(observation, (training.agents, *training.shape)),
            masks if settings.masks else None,
        )
        for _ in range(settings.repeat):
            observation, *_, info = env.step(pressed)
            if "outcome" in info:
                break
    replay = path.with_suffix(".pitchr")
    env.save_replay(replay)
    setpiece.Replay(replay).video(path, quality="low")
