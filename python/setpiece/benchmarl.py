"""Scenarios as tasks of BenchMARL: teams are groups, every player of a group is an agent.

```python
import setpiece.benchmarl

task = setpiece.benchmarl.task("academy_3_vs_1_with_keeper", left="all")
```
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from setpiece._errors import ParameterError
from setpiece._optional import need
from setpiece._options import check_count
from setpiece._source import Source, load
from setpiece._vector_levels import Params
from setpiece.torchrl import make

need("benchmarl", "benchmarl", "`setpiece.benchmarl`")
from benchmarl.environments.common import TaskClass  # noqa: E402

if TYPE_CHECKING:
    from tensordict import TensorDictBase
    from torchrl.data import Composite
    from torchrl.envs import EnvBase
    from typing_extensions import Unpack

    from setpiece._env_options import VectorArguments

__all__ = ["FootballTask", "task"]

STEPS_MAX = 1_000_000


class FootballTask(TaskClass):
    """A scenario as a task; `config` has the arguments of `task`."""

    def get_env_fun(
        self, num_envs: int, continuous_actions: bool, seed: int | None, device: Any
    ) -> Callable[[], EnvBase]:
        """Returns what makes `num_envs` matches as one environment."""
        arguments = {key: value for key, value in self.config.items() if key != "max_steps"}
        if continuous_actions:
            arguments["action_set"] = "continuous"
        if seed is not None:
            arguments["seed"] = seed
        return lambda: make(num_envs=num_envs, groups=True, device=device, **arguments)

    def supports_continuous_actions(self) -> bool:
        """Every scenario has them, unless the task names the keys."""
        return bool(self.config.get("action_set", "continuous") == "continuous")

    def supports_discrete_actions(self) -> bool:
        """Every scenario has keys."""
        return bool(self.config.get("action_set") != "continuous")

    def max_steps(self, env: EnvBase) -> int:  # noqa: ARG002
        """The most steps of an evaluation's episode."""
        return int(self.config["max_steps"])

    def has_render(self, env: EnvBase) -> bool:  # noqa: ARG002
        """Nothing is drawn: record episodes instead, and draw them later."""
        return False

    def group_map(self, env: EnvBase) -> dict[str, list[str]]:
        """The agents of each team."""
        # Transforms around the environment pass it on.
        groups: dict[str, list[str]] = env.group_map
        return groups

    def observation_spec(self, env: EnvBase) -> Composite:
        """What agents see."""
        return self._only(env, "observation")

    def action_mask_spec(self, env: EnvBase) -> Composite:
        """Which keys have an effect."""
        return self._only(env, "action_mask")

    def action_spec(self, env: EnvBase) -> Composite:
        """What agents do."""
        return env.full_action_spec_unbatched

    def state_spec(self, env: EnvBase) -> Composite | None:  # noqa: ARG002
        """There is none: each agent's observation has the whole match."""
        return None

    def info_spec(self, env: EnvBase) -> Composite | None:  # noqa: ARG002
        """There is none."""
        return None

    @staticmethod
    def env_name() -> str:
        """The name in logs."""
        return "setpiece"

    @staticmethod
    def log_info(batch: TensorDictBase) -> dict[str, float]:
        """The share of the batch's ended episodes that succeeded, if any have ended."""
        done = batch["next", "done"]
        if not done.any():
            return {}
        return {"collection/success": batch["next", "success"][done].float().mean().item()}

    def _only(self, env: EnvBase, key: str) -> Composite:
        spec = env.full_observation_spec_unbatched.clone()
        groups = self.group_map(env)
        for name in [*spec.keys()]:
            if name not in groups:
                del spec[name]
                continue
            for entry in [*spec[name].keys()]:
                if entry != key:
                    del spec[name][entry]
        return spec


def task(
    scenario: Source,
    *,
    max_steps: int = 400,
    threads: int | None = None,
    params: Params = None,
    **arguments: Unpack[VectorArguments],
) -> FootballTask:
    """Makes a task, for `benchmarl.experiment.Experiment`.

    - `max_steps`: the most steps of an episode of an evaluation.
    - `left`, `right` and the other arguments: those of `setpiece.torchrl.make`. Without
      `action_set` BenchMARL chooses between keys and continuous actions.
    """
    if not arguments.get("left") and not arguments.get("right"):
        raise ParameterError(
            "a task of several agents says whom they play",
            name="left",
            help="for example `left='all'`",
        )
    config = {"scenario": scenario, "threads": threads, "params": params, **arguments}
    config["max_steps"] = check_count("max_steps", max_steps, STEPS_MAX)
    return FootballTask(load(scenario).name.upper(), config)
