"""Trains a policy by PPO, with the same settings for every scenario.

    python baselines/ppo.py --scenario academy_3_vs_1_with_keeper --out runs/three

The policy plays one player, or with `--players 3` three of them with shared weights. It sees
`simple115v2` through two layers; with `--observation smm --stack 4` it sees stacked mini maps
through convolutions. It decides in every fourth step (`--repeat`) and the key stays pressed
until then. Steps are those of the environments everywhere.

`--out` gets `policy.pt`, `policy.onnx`, `result.json` (score, curve and where the time went), the
TensorBoard log if `tensorboard` is installed, and `checkpoint.pt`. The same command continues from
the checkpoint: on a CPU, in one thread, the result is bit for bit that of an uninterrupted run.
With `--levels` the episodes that were interrupted don't count for the curriculum.

`--evaluate academy --every 50` plays a suite after every 50 updates, and `--video-every 50` writes
a video of an episode. They change nothing of what is learned.

It needs `torch`, and `onnx` for `policy.onnx`.
"""

from __future__ import annotations

import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from command import command
from matches import Matches, environments, masks_of, rows_of
from measure import EVALUATION_SEED, Clock, tensorboard
from networks import Eye, Running, body, draw, layer, log_odds
from settings import Settings
from watch import Watch

POINTS = 50
"""So many points a curve has at most."""

CHECKED = 200
"""Episodes of an evaluation while training."""


class Policy(nn.Module):
    """Two networks: one rates the actions, the other predicts the standardised return.

    Both see what `sight` makes of an observation: standardised numbers, or features of a picture.
    """

    def __init__(self, shape: tuple[int, ...], actions: int, width: int, agents: int) -> None:
        super().__init__()
        pictures = len(shape) == 3
        inputs = width if pictures else shape[0]
        self.sight = Eye(shape, width) if pictures else Running(inputs, least=0.0003)
        self.actor = nn.Sequential(*body(inputs, width), layer(width, actions, 0.01))
        self.critic = self.valuer(inputs, width, agents)
        self.returns = Running(1, least=0.01)

    def valuer(self, inputs: int, width: int, agents: int) -> nn.Module:  # noqa: ARG002
        """Makes the network that predicts returns: here from what a player sees themselves."""
        return nn.Sequential(*body(inputs, width), layer(width, 1, 1.0))

    def foresee(self, seen: Tensor) -> Tensor:
        """Predicts the standardised returns `(matches, agents)` from `(matches, agents, n)`."""
        foreseen: Tensor = self.critic(seen).squeeze(-1)
        return foreseen

    def forward(self, observations: Tensor) -> Tensor:
        """Returns the logits of the actions."""
        logits: Tensor = self.actor(self.sight(observations))
        return logits

    def values(self, observations: Tensor) -> Tensor:
        """Predicts the returns `(matches, agents)`, in parts that fit the cache."""
        parts = observations.split(max(1, 4096 // observations.shape[1]))
        foreseen = torch.cat([self.foresee(self.sight(part)) for part in parts])
        return foreseen * self.returns.deviation + self.returns.mean

    def prepared(self, observations: Tensor) -> Tensor:
        """Prepares observations of an update: what doesn't learn is done once."""
        return self.sight(observations) if isinstance(self.sight, Running) else observations

    def judge(self, prepared: Tensor) -> tuple[Tensor, Tensor]:
        """Returns the logits and the standardised returns for prepared observations."""
        seen = prepared if isinstance(self.sight, Running) else self.sight(prepared)
        return self.actor(seen), self.foresee(seen)

    def export(
        self, path: Path, shown: np.ndarray, masks: np.ndarray | None, settings: Settings
    ) -> None:
        """Writes an ONNX file: from observations, and masks if it needs them, to logits.

        Its metadata says what it sees, and how many steps a decision lasts.
        """
        import onnx

        given = {"observation": torch.from_numpy(shown)}
        if masks is not None:
            given["mask"] = torch.from_numpy(masks.astype(bool))
        torch.onnx.export(
            Masked(self.cpu().eval()),
            tuple(given.values()),
            path,
            input_names=[*given],
            output_names=["logits"],
            dynamic_axes={name: {0: "batch"} for name in [*given, "logits"]},
            dynamo=False,
        )
        model = onnx.load(path)
        said = {name: str(getattr(settings, name)) for name in ("observation", "stack", "repeat")}
        onnx.helper.set_model_props(model, said)
        onnx.save(model, path)


class Masked(nn.Module):
    """A policy that rates masked actions as impossible, for its file."""

    def __init__(self, policy: Policy) -> None:
        super().__init__()
        self.policy = policy

    def forward(self, observations: Tensor, masks: Tensor | None = None) -> Tensor:
        """Returns the logits."""
        logits = self.policy(observations)
        return logits if masks is None else log_odds(logits, masks)


class Training:
    """A run: the policy, its optimizer, the environments, and what was measured so far."""

    network: type[Policy] = Policy
    options: type[Settings] = Settings

    def __init__(self, settings: Settings, *, threads: int = 1, device: str = "cpu") -> None:
        self.settings, self.threads, self.device = settings, threads, torch.device(device)
        torch.set_num_threads(threads)
        torch.manual_seed(settings.seed)
        self.matches = Matches(settings, threads)
        shown = self.matches.rows
        self.agents, self.shape = self.matches.agents, shown.shape[2:]
        self.actions = self.matches.masks.shape[-1]
        self.policy = self.network(self.shape, self.actions, settings.width, self.agents).to(
            self.device
        )
        self.optimizer = torch.optim.Adam(self.policy.parameters(), lr=settings.rate, eps=1e-5)
        self.random = torch.Generator(self.device).manual_seed(settings.seed)
        self.update, self.clock = 0, Clock()
        self.curve: list[dict[str, Any]] = []
        self.checks: list[dict[str, Any]] = []
        self.tables: list[dict[str, Any]] = []
        steps = settings.decisions * settings.envs * settings.repeat
        self.steps_of_update, self.updates = steps, max(1, settings.steps // steps)
        many = (settings.decisions, settings.envs, self.agents)
        kind = torch.uint8 if shown.dtype == np.uint8 else torch.float32
        self.seen = torch.zeros(*many, *self.shape, dtype=kind, device=self.device)
        self.masks = torch.ones(*many, self.actions, dtype=torch.bool, device=self.device)
        self.did = torch.zeros(many, dtype=torch.int64, device=self.device)
        self.odds, self.rewards, self.ended, self.rest = (
            torch.zeros(many, device=self.device) for _ in range(4)
        )

    @property
    def steps(self) -> int:
        """The steps so far, of all environments together."""
        return self.update * self.steps_of_update

    def run(
        self, out: Path | None = None, *, until: int | None = None, watch: Watch | None = None
    ) -> None:
        """Trains up to the end, or up to an update, with a checkpoint at least every minute."""
        writer, saved, settings = tensorboard(out), time.monotonic(), self.settings
        every = max(1, self.updates // POINTS)
        while self.update < (self.updates if until is None else until):
            left = 1 - self.update / self.updates
            after = self.collect()
            with self.clock.on("learning"):
                measured = self.learn(after, left)
            self.update += 1
            if settings.check and self.steps % settings.check < self.steps_of_update:
                score = float(self.evaluate(CHECKED, drawn=True).mean())
                self.checks.append({"steps": self.steps, "score": score, **self.matches.stage()})
            if self.update % every == 0 or self.update == self.updates:
                means = self.matches.means()
                self.curve.append({"steps": self.steps, "score": means.get("score"), **measured})
                if writer is not None:
                    for name, mean in {**means, **measured}.items():
                        writer.add_scalar(name, mean, self.steps)
            if watch is not None:
                watch.after(self, writer)
            if out is not None and (time.monotonic() - saved > 60 or self.update == self.updates):
                self.save(out / "checkpoint.pt")
                saved = time.monotonic()
        if writer is not None:
            writer.close()

    @torch.no_grad()
    def collect(self) -> Tensor:
        """Plays the decisions of an update; returns the predicted returns after the last."""
        for at in range(self.settings.decisions):
            with self.clock.on("acting"):
                self.seen[at] = torch.from_numpy(self.matches.rows)
                if self.settings.masks:
                    self.masks[at] = torch.from_numpy(self.matches.masks)
                odds = log_odds(
                    self.policy(self.seen[at]), self.masks[at] if self.settings.masks else None
                )
                self.did[at] = draw(odds, self.random)
                self.odds[at] = odds.gather(-1, self.did[at, ..., None])[..., 0]
                chosen = self.did[at].cpu().numpy()
            with self.clock.on("environment"):
                heard = self.matches.decide(chosen)
            with self.clock.on("acting"):
                self.rewards[at] = torch.from_numpy(heard.rewards)
                self.ended[at] = torch.from_numpy(heard.ended)[:, None]
                # A time limit doesn't end the play: the rest is worth what the critic predicts for
                # the last observation.
                self.rest[at] = 0
                if heard.cut:
                    last = np.stack([*heard.cut.values()]).reshape(-1, self.agents, *self.shape)
                    worth = self.policy.values(torch.from_numpy(last).to(self.device))
                    self.rest[at, [*heard.cut]] = worth
        with self.clock.on("acting"):
            return self.policy.values(torch.from_numpy(self.matches.rows).to(self.device))

    def learn(self, after: Tensor, left: float) -> dict[str, float]:
        """Updates the policy on the collected decisions; `left` is the share of the run ahead.

        A minibatch has whole matches: of each moment the decisions of all its players.
        """
        settings, policy = self.settings, self.policy
        self.optimizer.param_groups[0]["lr"] = settings.rate * left
        observations = self.seen.flatten(0, 1)
        with torch.no_grad():
            values = policy.values(observations).view_as(self.rewards)
            gained = self.advantages(values, after)
            returns = (gained + values).flatten(0, 1)
            policy.returns.take(returns.view(-1, 1), memory=20 * returns.numel())
            targets = policy.returns(returns)
            gained = gained.flatten(0, 1)
            gained = (gained - gained.mean()) / (gained.std() + 1e-8)
            prepared = policy.prepared(observations)
        masks = self.masks.flatten(0, 1) if settings.masks else None
        did, odds = self.did.flatten(0, 1), self.odds.flatten(0, 1)
        spread, misses, parts = 0.0, 0.0, 0
        for _ in range(settings.epochs):
            order = torch.randperm(len(did), generator=self.random, device=self.device)
            for rows in order.split(max(1, settings.minibatch // self.agents)):
                logits, foreseen = policy.judge(prepared[rows])
                now = log_odds(logits, None if masks is None else masks[rows])
                change = (now.gather(-1, did[rows, ..., None])[..., 0] - odds[rows]).exp()
                gain, least, most = gained[rows], 1 - settings.clip, 1 + settings.clip
                entropy = -(now.exp() * now).sum(-1).mean()
                miss = (foreseen - targets[rows]).square().mean()
                loss = -torch.min(change * gain, change.clamp(least, most) * gain).mean()
                loss = loss + 0.25 * miss - settings.entropy * left * entropy
                self.optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(policy.parameters(), settings.gradient)
                self.optimizer.step()
                spread, misses, parts = spread + entropy.item(), misses + miss.item(), parts + 1
        if isinstance(policy.sight, Running):
            policy.sight.take(observations.flatten(0, 1))
        return {"entropy": spread / parts, "value_loss": misses / parts}

    def advantages(self, values: Tensor, after: Tensor) -> Tensor:
        """Returns how much better than predicted each decision turned out (GAE)."""
        gamma, gained = self.settings.gamma, torch.zeros_like(values)
        on, ahead = 1 - self.ended, torch.cat([values[1:], after[None]])
        better = self.rewards + gamma * (on * ahead + self.rest) - values
        later = torch.zeros_like(after)
        for at in reversed(range(len(values))):
            later = better[at] + gamma * self.settings.smoothing * on[at] * later
            gained[at] = later
        return gained

    def save(self, path: Path) -> None:
        """Writes a checkpoint; one that is interrupted leaves the last one."""
        path.parent.mkdir(parents=True, exist_ok=True)
        state = {
            "settings": asdict(self.settings),
            "update": self.update,
            "policy": self.policy.state_dict(),
            "optimizer": self.optimizer.state_dict(),
            "random": self.random.get_state(),
            "matches": self.matches.state(),
            "clock": dict(self.clock.spent),
            "curve": self.curve,
            "checks": self.checks,
            "tables": self.tables,
        }
        torch.save(state, path.with_suffix(".part"))
        path.with_suffix(".part").replace(path)

    def load(self, path: Path) -> None:
        """Continues from a checkpoint. Raises `ValueError` if it is of a run with other settings."""
        state = torch.load(path, map_location=self.device, weights_only=True)
        mine = asdict(self.settings)
        other = [name for name in mine if state["settings"].get(name) != mine[name]]
        if other:
            was = ", ".join(f"{name} {state['settings'].get(name)}" for name in other)
            raise ValueError(
                f"{path} is of a run with other settings ({was}): choose another --out"
            )
        self.policy.load_state_dict(state["policy"])
        self.optimizer.load_state_dict(state["optimizer"])
        self.random.set_state(state["random"].cpu())
        self.matches.load(state["matches"])
        self.update, self.curve, self.checks = state["update"], state["curve"], state["checks"]
        self.tables, self.clock = state["tables"], Clock(state["clock"])

    @torch.no_grad()
    def choose(
        self,
        seen: np.ndarray,
        masks: np.ndarray | None = None,
        random: torch.Generator | None = None,
    ) -> np.ndarray:
        """Returns the likeliest actions `(…,)` for observations `(…, *shape)`, or draws them.

        `masks` are `(…, actions)`, or more.
        """
        if masks is not None:
            masks = masks[..., : self.actions].astype(bool)
        odds = log_odds(
            self.policy(torch.from_numpy(seen).to(self.device)),
            None if masks is None else torch.from_numpy(masks).to(self.device),
        )
        chosen = odds.argmax(-1) if random is None else draw(odds, random)
        actions: np.ndarray = chosen.cpu().numpy()
        return actions

    def evaluate(self, episodes: int, *, drawn: bool) -> np.ndarray:
        """Returns the score of each of some episodes, which were not trained on.

        Actions are drawn as in training, or the likeliest are taken. Every environment plays one
        episode: to take the first that end would favour short ones.
        """
        settings = self.settings
        envs = environments(settings, episodes, self.threads, copy=False)
        observation, infos = envs.reset(seed=EVALUATION_SEED)
        random = torch.Generator(self.device).manual_seed(EVALUATION_SEED) if drawn else None
        scores, over = np.zeros(episodes, int), np.zeros(episodes, bool)
        while not over.all():
            shown = masks_of(envs, infos) if settings.masks else None
            pressed = self.choose(rows_of(envs, observation), shown, random)
            for _ in range(settings.repeat):
                observation, _, terminated, truncated, infos = envs.step(
                    pressed.reshape(envs.action_space.shape)
                )
                now = (terminated | truncated) & ~over
                if now.any():
                    goals = infos["final_info"]["score"][now]
                    scores[now] = goals[:, 0] - goals[:, 1]
                over |= now
        envs.close()
        return scores


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Reads the command line and trains."""
    return command(__doc__, Training, argv)


if __name__ == "__main__":
    main()
