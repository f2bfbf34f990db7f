"""Scenarios for Stable-Baselines3.

```python
import setpiece.sb3
from stable_baselines3 import PPO

envs = setpiece.sb3.make_vec("academy_3_vs_1_with_keeper", 8, rewards="scoring,checkpoints")
PPO("MlpPolicy", envs).learn(100_000)
```
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv
from numpy.typing import NDArray

from setpiece._callbacks import copied, read_rewards
from setpiece._casting import behaviors
from setpiece._environment import FootballEnv
from setpiece._errors import ParameterError
from setpiece._make import make
from setpiece._native import Scenario
from setpiece._optional import need
from setpiece._options import check_flag, check_number
from setpiece._source import Source, load
from setpiece._vector import make_vec as make_batch

need("stable_baselines3", "sb3", "`setpiece.sb3`")
from stable_baselines3.common.vec_env import VecEnv  # noqa: E402

__all__ = ["Sb3VecEnv", "make_vec"]

FINAL = ("final_info", "final_obs")

ALONE = (
    *("ends", "events", "bot_action", "watch", "on_reload"),
    *("record", "record_when", "record_quality"),
)
"""Arguments of `setpiece.make` that a batch doesn't have."""

Indices = int | Iterable[int] | None


class Sb3VecEnv(VecEnv):
    """A Gymnasium vector environment as a `VecEnv` of Stable-Baselines3.

    It takes any `gymnasium.vector.VectorEnv` that resets an environment in the step in which its
    episode ends (`AutoresetMode.SAME_STEP`). Infos of such a step are those of the last step, with
    `terminal_observation` and `TimeLimit.truncated`; the infos of the reset are in `reset_infos`.
    `env_method("action_masks")` returns the masks for `MaskablePPO` of sb3-contrib.
    """

    def __init__(self, envs: VectorEnv[Any, Any, Any]) -> None:
        """Takes the vector environment over."""
        if envs.metadata.get("autoreset_mode") != AutoresetMode.SAME_STEP:
            raise ParameterError(
                "Stable-Baselines3 resets in the step in which an episode ends",
                name="envs",
                help="make the vector environment with `autoreset_mode=AutoresetMode.SAME_STEP`",
            )
        self.envs = envs
        self._masks: NDArray[np.int8] | None = None
        self._actions: Any = None
        super().__init__(envs.num_envs, envs.single_observation_space, envs.single_action_space)

    def reset(self) -> Any:
        """Begins an episode in every environment, with the seeds and options that were set."""
        options = self._options[0]
        if any(other != options for other in self._options):
            raise ParameterError(
                "environments of one batch share their reset options", name="options"
            )
        # One after the other, like the seeds of `seed` and of vector environments.
        observation, infos = self.envs.reset(seed=self._seeds[0], options=options or None)
        self._reset_seeds()
        self._reset_options()
        self._masks = infos.get("action_mask")
        self.reset_infos = _listed(infos, self.num_envs)
        return observation

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        """Sets the seeds of the next `reset`, consecutive from `seed`, and returns them.

        Raises `ParameterError` for anything that isn't a seed; None takes a random one.
        """
        seeds: Sequence[int | None] = super().seed(
            None if seed is None else check_number("seed", seed)
        )
        return seeds

    def step_async(self, actions: Any) -> None:
        """Stores everyone's actions."""
        self._actions = actions

    def step_wait(self) -> tuple[Any, NDArray[np.float32], NDArray[np.bool_], list[dict[str, Any]]]:
        """Plays 100 ms; returns observations, rewards, dones and infos.

        Rewards are float32 `(n,)`, dones bool `(n,)`, infos a list of n.
        """
        observation, rewards, terminations, truncations, infos = self.envs.step(self._actions)
        self._masks = infos.get("action_mask")
        dones = terminations | truncations
        listed = _listed({key: infos[key] for key in infos if key not in FINAL}, self.num_envs)
        for at in np.flatnonzero(dones).tolist():
            self.reset_infos[at] = listed[at]
            listed[at] = _one(infos["final_info"], at)
            listed[at]["terminal_observation"] = _at(infos["final_obs"], at)
        for at, info in enumerate(listed):
            info["TimeLimit.truncated"] = bool(truncations[at] and not terminations[at])
        return observation, np.asarray(rewards, np.float32), dones, listed

    def close(self) -> None:
        """Closes the vector environment."""
        self.envs.close()

    def get_attr(self, attr_name: str, indices: Indices = None) -> list[Any]:
        """Returns an attribute of each environment; a batch has one value for all."""
        if attr_name == "action_masks" and self._masks is not None:
            return [lambda at=at: self._mask(at) for at in self._get_indices(indices)]
        if isinstance(self.envs, SyncVectorEnv):
            return [
                self.envs.envs[at].get_wrapper_attr(attr_name) for at in self._get_indices(indices)
            ]
        return [getattr(self.envs, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name: str, value: Any, indices: Indices = None) -> None:
        """Sets an attribute of environments; a batch's can only be set for all at once."""
        at = list(self._get_indices(indices))
        if isinstance(self.envs, SyncVectorEnv):
            for one in at:
                self.envs.envs[one].set_wrapper_attr(attr_name, value)
        elif len(at) == self.num_envs:
            setattr(self.envs, attr_name, value)
        else:
            raise ParameterError(
                f"`{attr_name}` of a batch can only be set for all environments", name="indices"
            )

    def env_method(
        self, method_name: str, *args: Any, indices: Indices = None, **kwargs: Any
    ) -> list[Any]:
        """Calls a method of each environment; those of a batch only have `action_masks`."""
        if method_name != "action_masks" and not isinstance(self.envs, SyncVectorEnv):
            raise AttributeError(
                f"the environments are one batch: none of them has `{method_name}` alone"
            )
        return [method(*args, **kwargs) for method in self.get_attr(method_name, indices)]

    def env_is_wrapped(
        self, wrapper_class: type[gymnasium.Wrapper[Any, Any, Any, Any]], indices: Indices = None
    ) -> list[bool]:
        """Whether each environment has this wrapper; those of a batch have none."""
        at = list(self._get_indices(indices))
        if not isinstance(self.envs, SyncVectorEnv):
            return [False] * len(at)
        return [_is_wrapped(self.envs.envs[one], wrapper_class) for one in at]

    def get_images(self) -> Sequence[Any]:
        """Returns what each environment renders."""
        images = self.envs.render()
        return [None] * self.num_envs if images is None else list(images)

    def action_masks(self) -> NDArray[np.int8]:
        """Returns which actions have an effect now: int8 `(num_envs, 19)`, 20 with `"v2"`."""
        if self._masks is None:
            raise gymnasium.error.ResetNeeded("call `reset` before `action_masks`")
        return self._masks

    def _mask(self, at: int) -> NDArray[np.int8]:
        mask: NDArray[np.int8] = self.action_masks()[at]
        return mask


def make_vec(
    scenario: Source,
    num_envs: int,
    *,
    seed: int | None = None,
    threads: int | None = None,
    **kwargs: Any,
) -> Sb3VecEnv:
    """Makes a `VecEnv` of n environments; `kwargs` are those of `setpiece.make`, and `levels`.

    - `seed`: the seed of the first environment's first episode; the others have consecutive ones.
      With `levels` it seeds the source, which numbers all levels under it.
    - `threads`: the number of threads; None: one per core. Results don't depend on it.

    The environments are one batch (`setpiece.make_vec`). What a batch can't do (`events`,
    `bot_action`, `watch`, `record`, rewards and endings in Python, raw observations) is played by
    single environments, one after the other; each has its own copies of rewards and endings.

    Wrap it in `VecMonitor` for the mean return and length in its log. Stable-Baselines3 trains one
    agent. Raises `ParameterError` for a scenario that gives the caller no agent or several,
    `CallbackError` for a reward or ending that can't be copied, and otherwise what `setpiece.make`
    does.
    """
    if isinstance(num_envs, bool) or not isinstance(num_envs, int) or num_envs < 1:
        raise ParameterError(
            f"`num_envs` is {num_envs!r}; expected a count of at least 1", name="num_envs"
        )
    envs: VectorEnv[Any, Any, Any]
    # A file that is watched, played by behaviours, or asked for a curriculum must stay a file.
    levels = kwargs.get("levels")
    if not kwargs.get("watch") and not behaviors(kwargs.get("opponents")) and levels is None:
        scenario = load(
            scenario, allow_outside=check_flag("allow_outside", kwargs.get("allow_outside", False))
        )
    alone = any(kwargs.get(name) for name in ALONE) or bool(read_rewards(kwargs.get("rewards"))[1])
    if kwargs.get("observation") == "raw" or alone:
        if levels is not None:
            raise ParameterError(
                "only a batch takes `levels`, and single environments are needed", name="levels"
            )
        envs = SyncVectorEnv(
            [lambda: _alone(scenario, kwargs)] * num_envs, autoreset_mode=AutoresetMode.SAME_STEP
        )
    else:
        kwargs = {name: value for name, value in kwargs.items() if name not in ALONE}
        envs = make_batch(
            scenario, num_envs, threads=threads, autoreset_mode=AutoresetMode.SAME_STEP, **kwargs
        )
        _check_one(envs.agents, envs.scenario)
    vec = Sb3VecEnv(envs)
    if seed is not None:
        vec.seed(seed)
    return vec


def _alone(scenario: Source, kwargs: dict[str, Any]) -> FootballEnv:
    # Each environment needs its own memory of rewards and endings.
    memo: dict[int, Any] = {}
    own = {name: copied(kwargs[name], memo) for name in ("rewards", "ends") if name in kwargs}
    env = make(scenario, **(kwargs | own))
    _check_one(env.agents, env.scenario)
    return env


def _check_one(agents: Sequence[str], scenario: Scenario) -> None:
    if len(agents) != 1:
        raise ParameterError(
            f"Stable-Baselines3 trains one agent, `{scenario.name}` has {len(agents)} for it",
            name="scenario",
            help="seat one with `left=1`, or let `opponents` play the others",
        )


def _listed(infos: dict[str, Any], n: int) -> list[dict[str, Any]]:
    """Splits the infos of a vector environment into one dict per environment."""
    return [_one(infos, at) for at in range(n)]


def _one(infos: dict[str, Any], at: int) -> dict[str, Any]:
    """The infos of one environment: a key `k` applies if `_k` says so."""
    return {
        key: _at(value, at)
        for key, value in infos.items()
        if not key.startswith("_") and (f"_{key}" not in infos or infos[f"_{key}"][at])
    }


def _at(value: Any, at: int) -> Any:
    return _one(value, at) if isinstance(value, dict) else value[at]


def _is_wrapped(
    env: gymnasium.Env[Any, Any], wrapper_class: type[gymnasium.Wrapper[Any, Any, Any, Any]]
) -> bool:
    while isinstance(env, gymnasium.Wrapper):
        if isinstance(env, wrapper_class):
            return True
        env = env.env
    return False
