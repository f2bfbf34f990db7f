"""Trains a policy by PPO, in one file, with the same settings for every scenario.

    python baselines/ppo.py --scenario academy_3_vs_1_with_keeper --out runs/three

The policy plays one player, or with `--players 3` three of them with shared weights. It sees
`simple115v2` through two layers; with `--observation smm --stack 4` it sees stacked mini maps
through convolutions. It decides in every fourth step (`--repeat`) and the key stays pressed
until then. Steps are those of the environments everywhere.

`--out` gets `policy.pt`, `policy.onnx`, `result.json` (score, curve and where the time went), the
TensorBoard log if `tensorboard` is installed, and `checkpoint.pt`. The same command continues from
the checkpoint: on a CPU, in one thread, the result is bit for bit that of an uninterrupted run.
With `--levels` the episodes that were interrupted don't count for the curriculum.

It needs `torch`, and `onnx` for `policy.onnx`.
"""

from __future__ import annotations

import argparse
import json
import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np
import setpiece
import torch
from torch import Tensor, nn

EVALUATION_SEED = 1_000_000
"""The seed of the first episode of an evaluation; the others have the following ones."""

POINTS = 50
"""So many points a curve has at most."""

CHECKED = 200
"""Episodes of an evaluation while training."""


def setting(default: Any, about: str) -> Any:
    """A setting with its default value and its line of `--help`."""
    return field(default=default, metadata={"about": about})


@dataclass(frozen=True)
class Settings:
    """What a run depends on. Each is an option of the command line."""

    scenario: str = setting("academy_empty_goal_close", "a name of the library or a file")
    levels: str = setting("", "a curriculum that is trained on instead: a name or a file")
    rewards: str = setting("scoring,checkpoints", "reward terms, separated by commas")
    seed: int = setting(0, "of the policy and of the first environment")
    steps: int = setting(2_000_000, "of all environments together")
    players: int = setting(1, "of the left team that the policy plays")
    observation: str = setting("simple115v2", "numbers or pictures that the policy sees")
    stack: int = setting(1, "observations that are seen at once")
    masks: bool = setting(False, "draw only actions that can change something")
    repeat: int = setting(4, "steps that a decision lasts")
    envs: int = setting(128, "environments")
    decisions: int = setting(32, "of an environment between two updates")
    width: int = setting(128, "units of a layer")
    epochs: int = setting(4, "passes over the decisions in an update")
    minibatch: int = setting(1_024, "decisions in a gradient step")
    gamma: float = setting(0.99, "what a reward after the next decision is worth")
    smoothing: float = setting(0.95, "lambda of generalised advantage estimation")
    clip: float = setting(0.2, "how far an update may change the odds of an action")
    entropy: float = setting(0.03, "weight of the entropy; it falls to 0")
    gradient: float = setting(0.5, "greatest norm of a gradient")
    rate: float = setting(7e-4, "learning rate; it falls to 0")
    check: int = setting(0, "evaluate the scenario whenever so many steps are done; 0: never")

    def __post_init__(self) -> None:
        """Raises `ValueError` for a count that isn't one."""
        for one in fields(self):
            if one.name == "seed" or type(one.default) is not int:
                continue
            value, least = getattr(self, one.name), min(1, one.default)
            if value < least:
                raise ValueError(f"--{one.name} is {value}; expected at least {least}")


class Running(nn.Module):
    """Mean and variance of all numbers that it has taken so far."""

    mean: Tensor
    variance: Tensor
    taken: Tensor

    def __init__(self, inputs: int, least: float) -> None:
        """`least` is the least standard deviation that numbers are divided by."""
        super().__init__()
        self.register_buffer("mean", torch.zeros(inputs))
        self.register_buffer("variance", torch.ones(inputs))
        self.register_buffer("taken", torch.zeros((), dtype=torch.float64))
        self.least = least

    @property
    def deviation(self) -> Tensor:
        """The standard deviation, which is never close to 0."""
        return self.variance.sqrt().clamp(min=self.least)

    def forward(self, numbers: Tensor) -> Tensor:
        """Standardises numbers, none further from 0 than 10."""
        return ((numbers - self.mean) / self.deviation).clamp(-10, 10)

    def take(self, numbers: Tensor, memory: float = float("inf")) -> None:
        """Takes a batch; of earlier numbers at most `memory` count."""
        variance, mean = torch.var_mean(numbers, 0, correction=0)
        before = min(float(self.taken), memory)
        share, away = len(numbers) / (before + len(numbers)), mean - self.mean
        self.mean += share * away
        self.variance += share * (variance - self.variance + (1 - share) * away.square())
        self.taken.fill_(before + len(numbers))


def layer(inputs: int, outputs: int, gain: float = 2**0.5) -> nn.Linear:
    """A layer with orthogonal weights."""
    made = nn.Linear(inputs, outputs)
    nn.init.orthogonal_(made.weight, gain)
    nn.init.zeros_(made.bias)
    return made


def body(inputs: int, width: int) -> list[nn.Module]:
    """Two layers of `width` units."""
    return [layer(inputs, width), nn.Tanh(), layer(width, width), nn.Tanh()]


class Eye(nn.Module):
    """Turns pictures, uint8 `(batch, height, width, channels)`, into `width` features."""

    def __init__(self, shape: tuple[int, ...], width: int) -> None:
        super().__init__()
        self.filters = nn.Sequential(
            nn.Conv2d(shape[2], 16, 8, stride=4),
            nn.ReLU(),
            nn.Conv2d(16, 32, 4, stride=2),
            nn.ReLU(),
            nn.Flatten(),
        )
        found = self.filters(torch.zeros(1, shape[2], *shape[:2])).shape[1]
        self.features = nn.Sequential(layer(found, width), nn.ReLU())

    def forward(self, pictures: Tensor) -> Tensor:
        """Returns the features."""
        seen: Tensor = self.features(self.filters(pictures.permute(0, 3, 1, 2).float() / 255))
        return seen


class Policy(nn.Module):
    """Two networks: one rates the actions, the other predicts the standardised return.

    Both see what `sight` makes of an observation: standardised numbers, or features of a picture.
    """

    def __init__(self, shape: tuple[int, ...], actions: int, width: int) -> None:
        super().__init__()
        pictures = len(shape) == 3
        inputs = width if pictures else shape[0]
        self.sight = Eye(shape, width) if pictures else Running(inputs, least=0.0003)
        self.actor = nn.Sequential(*body(inputs, width), layer(width, actions, 0.01))
        self.critic = nn.Sequential(*body(inputs, width), layer(width, 1, 1.0))
        self.returns = Running(1, least=0.01)

    def forward(self, observations: Tensor) -> Tensor:
        """Returns the logits of the actions."""
        logits: Tensor = self.actor(self.sight(observations))
        return logits

    def values(self, observations: Tensor) -> Tensor:
        """Predicts the returns, in parts that fit the cache."""
        foreseen = torch.cat([self.critic(self.sight(part)) for part in observations.split(4096)])
        return (foreseen * self.returns.deviation + self.returns.mean).squeeze(-1)

    def learned(self, observations: Tensor) -> Tensor:
        """Prepares observations of an update: what doesn't learn is done once."""
        return self.sight(observations) if isinstance(self.sight, Running) else observations

    def judge(self, prepared: Tensor) -> tuple[Tensor, Tensor]:
        """Returns the logits and the standardised returns for prepared observations."""
        seen = prepared if isinstance(self.sight, Running) else self.sight(prepared)
        return self.actor(seen), self.critic(seen).squeeze(-1)

    def export(self, path: Path, observations: np.ndarray, repeat: int) -> None:
        """Writes an ONNX file: from observations to the logits of the actions.

        Its metadata says how many steps a decision lasts.
        """
        import onnx

        torch.onnx.export(
            self.cpu().eval(),
            (torch.from_numpy(observations),),
            path,
            input_names=["observation"],
            output_names=["logits"],
            dynamic_axes={"observation": {0: "batch"}, "logits": {0: "batch"}},
            dynamo=False,
        )
        model = onnx.load(path)
        onnx.helper.set_model_props(model, {"repeat": str(repeat)})
        onnx.save(model, path)


def log_odds(logits: Tensor, masks: Tensor | None) -> Tensor:
    """Returns the logarithms of the actions' probabilities; masked actions have none."""
    return (logits if masks is None else logits.masked_fill(~masks, -1e9)).log_softmax(-1)


def environments(settings: Settings, number: int, threads: int, **others: Any) -> Any:
    """Makes environments of what the policy sees and plays."""
    return setpiece.make_vec(
        settings.scenario,
        number,
        threads=threads,
        autoreset_mode="same_step",
        observation=settings.observation,
        stack=settings.stack,
        left=None if settings.players == 1 else settings.players,
        **others,
    )


@dataclass
class Heard:
    """What the environments showed after a decision; rows are agents of all environments."""

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
        self.observation, self.infos = self.envs.reset(seed=settings.seed)
        self.began = np.zeros(number, int)
        self.acts: list[np.ndarray] = []
        self.sums: dict[str, float] = defaultdict(float)

    @property
    def rows(self) -> np.ndarray:
        """The observations: `(envs * agents, …)`."""
        shape = self.envs.single_observation_space.shape
        shape = shape if self.settings.players == 1 else shape[1:]
        return self.observation.reshape(-1, *shape)

    @property
    def masks(self) -> np.ndarray:
        """The masks of the actions: `(envs * agents, actions)`."""
        masks: np.ndarray = self.infos["action_mask"]
        return masks.reshape(-1, masks.shape[-1])

    def decide(self, actions: np.ndarray) -> Heard:
        """Plays actions `(envs * agents,)` for `repeat` steps.

        Where an episode ends before the last of them, the next one begins after the last: it would
        otherwise begin with some idle steps, which make a scenario harder.
        """
        number = self.settings.envs
        pressed = actions.reshape(number, -1).astype(np.uint8)
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
            played.squeeze(1) if self.settings.players == 1 else played
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
        """Returns the means over the episodes that ended since the last call."""
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
        shape = (0, self.settings.envs, self.settings.players)
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


class Clock:
    """Seconds of the CPU by what they were spent on, and seconds on the wall."""

    def __init__(self, spent: dict[str, float] | None = None) -> None:
        self.spent: dict[str, float] = defaultdict(float, spent or {})

    @contextmanager
    def on(self, what: str) -> Iterator[None]:
        """Counts what happens inside."""
        cpu, wall = time.process_time(), time.perf_counter()
        yield
        self.spent[what] += time.process_time() - cpu
        self.spent["wall"] += time.perf_counter() - wall

    @property
    def cpu(self) -> float:
        """All seconds of the CPU."""
        return sum(seconds for what, seconds in self.spent.items() if what != "wall")


class Training:
    """A run: the policy, its optimizer, the environments, and what was measured so far."""

    def __init__(self, settings: Settings, *, threads: int = 1, device: str = "cpu") -> None:
        self.settings, self.threads, self.device = settings, threads, torch.device(device)
        torch.set_num_threads(threads)
        torch.manual_seed(settings.seed)
        self.matches = Matches(settings, threads)
        rows = self.matches.rows
        self.actions = self.matches.masks.shape[-1]
        self.policy = Policy(rows.shape[1:], self.actions, settings.width).to(self.device)
        self.optimizer = torch.optim.Adam(self.policy.parameters(), lr=settings.rate, eps=1e-5)
        self.random = torch.Generator(self.device).manual_seed(settings.seed)
        self.update, self.clock = 0, Clock()
        self.curve: list[dict[str, Any]] = []
        self.checks: list[dict[str, Any]] = []
        steps = settings.decisions * settings.envs * settings.repeat
        self.steps_of_update, self.updates = steps, max(1, settings.steps // steps)
        many = (settings.decisions, len(rows))
        kind = torch.uint8 if rows.dtype == np.uint8 else torch.float32
        self.seen = torch.zeros(*many, *rows.shape[1:], dtype=kind, device=self.device)
        self.masks = torch.ones(*many, self.actions, dtype=torch.bool, device=self.device)
        self.did = torch.zeros(many, dtype=torch.int64, device=self.device)
        self.odds, self.rewards, self.ended, self.rest = (
            torch.zeros(many, device=self.device) for _ in range(4)
        )

    def run(self, out: Path | None = None, *, until: int | None = None) -> None:
        """Trains up to the end, or up to an update, with a checkpoint at least every minute."""
        writer, saved, settings = tensorboard(out), time.monotonic(), self.settings
        every = max(1, self.updates // POINTS)
        while self.update < (self.updates if until is None else until):
            left = 1 - self.update / self.updates
            after = self.collect()
            with self.clock.on("learning"):
                measured = self.learn(after, left)
            self.update += 1
            step = self.update * self.steps_of_update
            if settings.check and step % settings.check < self.steps_of_update:
                score = float(self.evaluate(CHECKED, drawn=True).mean())
                self.checks.append({"steps": step, "score": score, **self.matches.stage()})
            if self.update % every == 0 or self.update == self.updates:
                means = self.matches.means()
                self.curve.append({"steps": step, "score": means.get("score"), **measured})
                if writer is not None:
                    for name, mean in {**means, **measured}.items():
                        writer.add_scalar(name, mean, step)
            if out is not None and (time.monotonic() - saved > 60 or self.update == self.updates):
                self.save(out / "checkpoint.pt")
                saved = time.monotonic()
        if writer is not None:
            writer.close()

    @torch.no_grad()
    def collect(self) -> Tensor:
        """Plays the decisions of an update; returns the predicted returns after the last."""
        agents = self.settings.players
        for at in range(self.settings.decisions):
            with self.clock.on("acting"):
                self.seen[at] = torch.from_numpy(self.matches.rows)
                if self.settings.masks:
                    self.masks[at] = torch.from_numpy(self.matches.masks)
                odds = log_odds(
                    self.policy(self.seen[at]), self.masks[at] if self.settings.masks else None
                )
                self.did[at] = torch.multinomial(odds.exp(), 1, generator=self.random)[:, 0]
                self.odds[at] = odds.gather(1, self.did[at, :, None])[:, 0]
                chosen = self.did[at].cpu().numpy()
            with self.clock.on("environment"):
                heard = self.matches.decide(chosen)
            with self.clock.on("acting"):
                self.rewards[at] = torch.from_numpy(heard.rewards.reshape(-1))
                self.ended[at] = torch.from_numpy(np.repeat(heard.ended, agents))
                # A time limit doesn't end the play: the rest is worth what the critic predicts for
                # the last observation.
                self.rest[at] = 0
                if heard.cut:
                    last = np.stack([*heard.cut.values()]).reshape(-1, *self.seen.shape[2:])
                    rows = np.array([*heard.cut])[:, None] * agents + np.arange(agents)
                    cut = self.policy.values(torch.from_numpy(last).to(self.device))
                    self.rest[at, torch.from_numpy(rows.reshape(-1)).to(self.device)] = cut
        with self.clock.on("acting"):
            return self.policy.values(torch.from_numpy(self.matches.rows).to(self.device))

    def learn(self, after: Tensor, left: float) -> dict[str, float]:
        """Updates the policy on the collected decisions; `left` is the share of the run ahead."""
        settings, policy = self.settings, self.policy
        self.optimizer.param_groups[0]["lr"] = settings.rate * left
        observations = self.seen.flatten(0, 1)
        with torch.no_grad():
            values = policy.values(observations).view_as(self.rewards)
            gained = self.advantages(values, after)
            returns = (gained + values).flatten()
            policy.returns.take(returns[:, None], memory=20 * len(returns))
            targets = policy.returns(returns[:, None]).squeeze(-1)
            gained = gained.flatten()
            gained = (gained - gained.mean()) / (gained.std() + 1e-8)
            prepared = policy.learned(observations)
        masks = self.masks.flatten(0, 1) if settings.masks else None
        did, odds = self.did.flatten(), self.odds.flatten()
        spread, misses, parts = 0.0, 0.0, 0
        for _ in range(settings.epochs):
            order = torch.randperm(len(did), generator=self.random, device=self.device)
            for rows in order.split(settings.minibatch):
                logits, foreseen = policy.judge(prepared[rows])
                now = log_odds(logits, None if masks is None else masks[rows])
                change = (now.gather(1, did[rows, None])[:, 0] - odds[rows]).exp()
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
            policy.sight.take(observations)
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
        self.clock = Clock(state["clock"])

    @torch.no_grad()
    def evaluate(self, episodes: int, *, drawn: bool) -> np.ndarray:
        """Returns the score of each of some episodes, which were not trained on.

        Actions are drawn as in training, or the likeliest are taken. Every environment plays one
        episode: to take the first that end would favour short ones.
        """
        settings = self.settings
        envs = environments(settings, episodes, self.threads, copy=False)
        observation, infos = envs.reset(seed=EVALUATION_SEED)
        random = torch.Generator(self.device).manual_seed(EVALUATION_SEED)
        scores, over = np.zeros(episodes, int), np.zeros(episodes, bool)
        while not over.all():
            rows = torch.from_numpy(observation).reshape(-1, *self.seen.shape[2:])
            masks = torch.from_numpy(infos["action_mask"]).reshape(-1, self.actions).bool()
            odds = log_odds(
                self.policy(rows.to(self.device)),
                masks.to(self.device) if settings.masks else None,
            )
            actions = (
                torch.multinomial(odds.exp(), 1, generator=random) if drawn else odds.argmax(-1)
            )
            pressed = actions.view(envs.action_space.shape).cpu().numpy()
            for _ in range(settings.repeat):
                observation, _, terminated, truncated, infos = envs.step(pressed)
                now = (terminated | truncated) & ~over
                if now.any():
                    goals = infos["final_info"]["score"][now]
                    scores[now] = goals[:, 0] - goals[:, 1]
                over |= now
        envs.close()
        return scores


def tensorboard(out: Path | None) -> Any:
    """Returns a writer of TensorBoard's log, or None without a folder or without TensorBoard."""
    if out is None:
        return None
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        return None
    return SummaryWriter(out)


def estimate(scores: np.ndarray) -> dict[str, float]:
    """Returns the mean of scores with its 95 % interval.

    Of goals that are all 0 or 1 it is Wilson's, otherwise that of the normal distribution.
    """
    mean, n, z = float(scores.mean()), len(scores), 1.959964
    if set(np.unique(scores)) <= {0, 1}:
        half = z * (mean * (1 - mean) / n + z * z / (4 * n * n)) ** 0.5
        low, high = ((mean + z * z / (2 * n) + by) / (1 + z * z / n) for by in (-half, half))
    else:
        half = z * float(scores.std()) / n**0.5
        low, high = mean - half, mean + half
    return {"mean": mean, "low": round(min(low, mean), 4), "high": round(max(high, mean), 4)}


def result(training: Training, episodes: int) -> dict[str, Any]:
    """Evaluates a run; returns all that is to be kept of it."""
    spent, steps = training.clock.spent, training.update * training.steps_of_update
    return {
        "settings": asdict(training.settings),
        "steps": steps,
        "episodes": episodes,
        "drawn": estimate(training.evaluate(episodes, drawn=True)),
        "likeliest": estimate(training.evaluate(episodes, drawn=False)),
        "seconds": {name: round(spent[name], 3) for name in sorted(spent)},
        "steps_per_cpu_second": round(steps / training.clock.cpu),
        "threads": training.threads,
        "device": training.device.type,
        "versions": {"setpiece": setpiece.__version__, "torch": torch.__version__},
        "curve": [
            {name: None if value is None else round(value, 4) for name, value in point.items()}
            for point in training.curve
        ],
        "checks": training.checks,
    }


def train(
    settings: Settings, out: Path, *, threads: int = 1, device: str = "cpu", episodes: int = 500
) -> dict[str, Any]:
    """Trains, or continues what `out` has of it, evaluates, and writes all files into `out`."""
    training = Training(settings, threads=threads, device=device)
    checkpoint = out / "checkpoint.pt"
    if checkpoint.is_file():
        training.load(checkpoint)
    out.mkdir(parents=True, exist_ok=True)
    training.run(out)
    found = result(training, episodes)
    (out / "result.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    torch.save(training.policy.state_dict(), out / "policy.pt")
    try:
        training.policy.export(out / "policy.onnx", training.matches.rows, settings.repeat)
    except ImportError as error:
        print(f"no policy.onnx: {error}")
    return found


def summary(found: dict[str, Any]) -> str:
    """Returns lines on a result for a person."""
    shown = {
        name: "{mean:.3f} ({low:.3f} to {high:.3f})".format(**found[name])
        for name in ("drawn", "likeliest")
    }
    spent = found["seconds"]
    cpu = sum(seconds for name, seconds in spent.items() if name != "wall")
    shares = ", ".join(
        f"{name} {spent[name] / cpu:.0%}" for name in ("acting", "environment", "learning")
    )
    return (
        f"score of {found['episodes']} episodes with drawn actions: {shown['drawn']}\n"
        f"score of {found['episodes']} episodes with the likeliest: {shown['likeliest']}\n"
        f"{found['steps']} steps in {cpu:.0f} s of the CPU, {spent['wall']:.0f} s on the wall:"
        f" {found['steps_per_cpu_second']} steps per CPU second ({shares})"
    )


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Reads the command line and trains."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    for one in fields(Settings):
        about = f"{one.metadata['about']} (default: {one.default})"
        if isinstance(one.default, bool):
            parser.add_argument(
                f"--{one.name}",
                action=argparse.BooleanOptionalAction,
                default=one.default,
                help=one.metadata["about"],
            )
        else:
            parser.add_argument(
                f"--{one.name}", type=type(one.default), default=one.default, help=about
            )
    parser.add_argument("--threads", type=int, default=1, help="of the engine and of PyTorch")
    parser.add_argument("--device", default="cpu", help="of PyTorch: cpu, cuda")
    parser.add_argument("--episodes", type=int, default=500, help="of an evaluation")
    parser.add_argument("--out", type=Path, default=Path("runs/ppo"), help="a folder")
    args = parser.parse_args(argv)
    try:
        settings = Settings(**{one.name: getattr(args, one.name) for one in fields(Settings)})
        found = train(
            settings, args.out, threads=args.threads, device=args.device, episodes=args.episodes
        )
    except (setpiece.SetpieceError, ValueError) as error:
        parser.error(str(error))
    print(summary(found))
    return found


if __name__ == "__main__":
    main()
