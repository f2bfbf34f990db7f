"""An `EnvRunner` for RLlib that steps many matches at once and hands over episodes in bulk."""

from __future__ import annotations

from itertools import pairwise
from typing import Any
from uuid import uuid4

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import ParameterError, UnavailableError
from setpiece._optional import need
from setpiece._rllib_players import Players

need("ray.rllib", "rllib", "`setpiece.rllib`")
import torch  # noqa: E402
from ray.rllib.core.columns import Columns  # noqa: E402
from ray.rllib.env.single_agent_env_runner import SingleAgentEnvRunner  # noqa: E402
from ray.rllib.env.single_agent_episode import SingleAgentEpisode  # noqa: E402
from ray.rllib.utils.metrics import WEIGHTS_SEQ_NO  # noqa: E402

CURVES = "football"
"""Where the means of score, length and reward terms stand in the metrics of a runner."""

Rows = NDArray[Any]
"""An array with a row for every player of every match."""


class FootballEnvRunner(SingleAgentEnvRunner):
    """Plays `num_envs_per_env_runner` matches as one native batch.

    ```python
    config.env_runners(env_runner_cls=setpiece.rllib.FootballEnvRunner, num_envs_per_env_runner=64)
    ```

    `env_config` holds the arguments of `setpiece.make_vec`, at least `scenario`; `threads` is 1
    without it. Every player of the policy's is an agent of their own, with episodes of their own:
    so several players share the weights of one module. Steps are counted by player.

    Observations go to the module as they are, bytes of pictures too, and its actions to the
    matches: connectors of the runner's own and modules with a state are refused. Of the callbacks,
    `on_sample_end` is called; no callback sees single steps or episodes.

    `result["env_runners"]["football"]` has the means over the last 100 episodes: `score`, `length`,
    and `terms:REWARD:TERM` for what a player was paid.
    """

    env: Any

    def make_env(self) -> None:
        """Makes the matches."""
        if self.env is not None:
            self.env.close()
        config = dict(self.config.env_config)
        if "scenario" not in config:
            raise ParameterError(
                "`env_config` names no scenario",
                name="env_config",
                help='env_config={"scenario": "academy_corner"}',
            )
        self.env = Players(config, self.config.num_envs_per_env_runner)
        self.num_envs = self.env.num_envs
        self._needs_initial_reset = True
        self._next_seed = self._seed
        if self._next_seed is not None:
            # RLlib's seeds of the runners follow each other, and so do those of a runner's matches.
            self._next_seed += (self.worker_index or 0) * (self.env.matches - 1)
        self._ids = [uuid4().hex for _ in range(self.num_envs)]
        self._played = np.zeros(self.num_envs, np.int64)
        self._returns = np.zeros(self.num_envs)

    def make_module(self) -> None:
        """Makes the module; raises `UnavailableError` for one with a state, and for connectors."""
        super().make_module()
        for name in ("env_to_module_connector", "module_to_env_connector"):
            if getattr(self.config, f"_{name}", None) is not None:
                raise UnavailableError(f"FootballEnvRunner has no `{name}`", name=name)
        if self.module is not None and self.module.is_stateful():
            raise UnavailableError(
                "FootballEnvRunner plays no module with a state",
                name="rl_module",
                help="show several observations at once instead: `stack` in `env_config`",
            )

    def _sample(
        self,
        *,
        num_timesteps: int | None = None,
        num_episodes: int | None = None,
        explore: bool,
        random_actions: bool = False,
        force_reset: bool = False,
    ) -> list[SingleAgentEpisode]:
        if force_reset or num_episodes is not None or self._needs_initial_reset:
            self._begin()
        self._needs_initial_reset = num_episodes is not None
        episodes: list[SingleAgentEpisode] = []
        ended = steps = 0
        if num_timesteps is not None:
            count = -(-num_timesteps // self.num_envs)
            episodes = self._play(count, explore, random_actions)
            ended, steps = sum(one.is_done for one in episodes), count * self.num_envs
        # Whole episodes: the chunks of those that ended first are joined.
        chunks: dict[str, SingleAgentEpisode] = {}
        while num_episodes is not None and ended < num_episodes:
            for one in self._play(64, explore, random_actions):
                chunks[one.id_] = joined(chunks.get(one.id_), one)
                steps += len(one)
                ended += one.is_done
        if num_episodes is not None:
            episodes = [one for one in chunks.values() if one.is_done][:num_episodes]
        self._increase_sampled_metrics(steps, ended)
        return episodes

    def get_metrics(self) -> Any:
        """Returns what has been measured since the last call."""
        return self.metrics.reduce()

    def _begin(self) -> None:
        """Begins an episode of every player."""
        # Later ones go on counting the episodes of the first.
        seed, self._next_seed = self._next_seed, None
        self._shown, _ = self._try_env_reset(seed=seed)
        self._ids = [uuid4().hex for _ in range(self.num_envs)]
        self._played[:] = 0
        self._returns[:] = 0

    def _play(self, count: int, explore: bool, random_actions: bool) -> list[SingleAgentEpisode]:
        """Plays some steps of all matches; returns the episodes, or the parts of them."""
        rows = self.num_envs
        seen = np.empty((count + 1, *self._shown.shape), self._shown.dtype)
        seen[0] = self._shown
        rewards = np.empty((count, rows), np.float32)
        terminated, truncated = (np.zeros((count, rows), bool) for _ in range(2))
        lasts: dict[tuple[int, int], Rows] = {}
        chosen: list[dict[str, Rows]] = []
        for at in range(count):
            chosen.append(self._choose(seen[at], explore, random_actions))
            seen[at + 1], rewards[at], terminated[at], truncated[at], infos = self.env.step(
                chosen[at][Columns.ACTIONS]
            )
            over = terminated[at] | truncated[at]
            if over.any():
                self._log_curves(infos)
                for row in np.flatnonzero(over).tolist():
                    lasts[at, row] = infos["final_obs"][row]
        self._shown = seen[count].copy()
        outputs = {name: np.stack([one[name] for one in chosen]) for name in chosen[0]}
        actions = outputs.pop(Columns.ACTIONS)
        outputs[WEIGHTS_SEQ_NO] = np.full((count, rows), self._weights_seq_no)
        episodes = []
        for row in range(rows):
            ends = np.flatnonzero(terminated[:, row] | truncated[:, row]).tolist()
            bounds = [0, *(end + 1 for end in ends)]
            if bounds[-1] < count:
                bounds.append(count)
            for first, after in pairwise(bounds):
                # A copy of its own: a view would keep everything that was played alive.
                shown = seen[first : after + 1, row].copy()
                last = lasts.get((after - 1, row))
                if last is not None:
                    shown[-1] = last
                part = slice(first, after), row
                paid = rewards[part].copy()
                one = SingleAgentEpisode(
                    self._ids[row],
                    observations=shown,
                    actions=actions[part].copy(),
                    rewards=paid,
                    extra_model_outputs={name: put[part].copy() for name, put in outputs.items()},
                    infos=[{}] * (after - first + 1),
                    observation_space=self.env.single_observation_space,
                    action_space=self.env.single_action_space,
                    terminated=bool(terminated[after - 1, row]),
                    truncated=bool(truncated[after - 1, row]),
                    t_started=int(self._played[row]),
                    len_lookback_buffer=0,
                )
                episodes.append(one)
                self._played[row] += after - first
                self._returns[row] += paid.sum()
                if last is not None:
                    self._log_episode_metrics(int(self._played[row]), self._returns[row], 0.0)
                    self._ids[row] = uuid4().hex
                    self._played[row], self._returns[row] = 0, 0.0
        return episodes

    def _choose(self, seen: Rows, explore: bool, random_actions: bool) -> dict[str, Rows]:
        """Returns actions, and what the module says of them."""
        if random_actions or self.module is None:
            return {Columns.ACTIONS: self.env.action_space.sample()}
        module = self.module
        with torch.no_grad():
            batch = {Columns.OBS: torch.from_numpy(seen).to(self._device)}
            if explore:
                out = module.forward_exploration(batch, t=self.num_env_steps_sampled_lifetime)
            else:
                out = module.forward_inference(batch)
            if Columns.ACTIONS not in out:
                of = module.get_exploration_action_dist_cls if explore else None
                of = of or module.get_inference_action_dist_cls
                rated = of().from_logits(out[Columns.ACTION_DIST_INPUTS])
                if not explore:
                    rated = rated.to_deterministic()
                out[Columns.ACTIONS] = rated.sample()
                if explore:
                    out[Columns.ACTION_LOGP] = rated.logp(out[Columns.ACTIONS])
        return {name: value.cpu().numpy() for name, value in out.items()}

    def _log_curves(self, infos: dict[str, Any]) -> None:
        """Logs how matches ended."""
        final, over = infos["final_info"], infos["_final_info"]
        ended = final["setpiece"]
        score = final["score"][over]
        curves = {"score": score[:, 0] - score[:, 1], "length": ended["length"][over]}
        for name, paid in ended["return"].items():
            # A metric's name is a path, so `/` would add a level.
            mine = paid[over]
            curves[f"terms:{name.replace('/', ':')}"] = mine.reshape(len(mine), -1).mean(-1)
        for name, values in curves.items():
            for value in values.tolist():
                self.metrics.log_value((CURVES, name), value, reduce="mean", window=100)


def joined(before: SingleAgentEpisode | None, more: SingleAgentEpisode) -> SingleAgentEpisode:
    """Returns an episode and its next part as one."""
    if before is None:
        return more
    before.concat_episode(more)
    return before
