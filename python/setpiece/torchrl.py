"""Scenarios for TorchRL: a batch of matches as one `EnvBase`.

```python
import setpiece.torchrl

env = setpiece.torchrl.make("academy_3_vs_1_with_keeper", 8, rewards="scoring,checkpoints")
env.set_seed(1)
rollout = env.rollout(100, break_when_any_done=False)
```
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from setpiece._errors import ParameterError
from setpiece._levels import LevelsArgument
from setpiece._optional import need
from setpiece._options import check_flag
from setpiece._source import Source
from setpiece._spaces import action_of_one_agent, box_of_one_agent
from setpiece._vector import FootballVectorEnv
from setpiece._vector_levels import Params

need("torchrl", "torchrl", "`setpiece.torchrl`")
import torch  # noqa: E402
from tensordict import TensorDict, TensorDictBase  # noqa: E402
from torchrl.data import Binary, Bounded, Categorical, Composite, Unbounded  # noqa: E402
from torchrl.envs import EnvBase  # noqa: E402

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from setpiece._env_options import VectorArguments

__all__ = ["FootballTensorEnv", "make"]

TEAMS = ("left", "right")
"""The names of groups."""


class FootballTensorEnv(EnvBase):
    """`num_envs` matches of one scenario as a batch-locked environment of TorchRL.

    Entries have the leading axis `num_envs`; `n` is the number of actions.

    - `observation`: float32 or uint8, as `make_vec` gives it; `action_mask`: bool `(n,)`;
      `success`: bool `(1,)`, whether the episode has just ended with success.
    - `action`: int64, or float32 `(4,)` with continuous actions; `reward`: float32 `(1,)`.
    - `done`, `terminated` and `truncated`: bool `(1,)`, of the whole match.

    With groups, each team with agents is one, named `"left"` or `"right"`: its entries
    `(group, "observation")`, `(group, "action_mask")`, `(group, "action")` and
    `(group, "reward")` have an axis of its agents, whose ids `group_map` lists.

    An episode that has ended waits for `reset` with a `_reset` entry; rollouts and collectors do
    that.
    """

    def __init__(
        self, vector: FootballVectorEnv, *, groups: bool | None = None, device: Any = None
    ) -> None:
        """Takes a vector over; see `make`."""
        if vector.autoreset_mode != AutoresetMode.DISABLED:
            raise ParameterError(
                "TorchRL resets the episodes that have ended itself",
                name="vector",
                help="make the vector with `autoreset_mode=AutoresetMode.DISABLED`",
            )
        many = len(vector.agents) > 1
        if groups is False and many:
            raise ParameterError(
                f"{len(vector.agents)} agents need groups", name="groups", help="leave it out"
            )
        super().__init__(device=device, batch_size=torch.Size([vector.num_envs]))
        self.vector = vector
        self._many = many
        self._begun = False
        self._next_seed: int | None = None
        self._rows: dict[str, list[int]] = {}
        """The agents of each group; empty without groups."""
        if groups or (groups is None and many):
            for at, team in enumerate(vector.teams):
                self._rows.setdefault(TEAMS[team], []).append(at)
        self.group_map = {
            group: [vector.agents[at] for at in rows] for group, rows in self._rows.items()
        }
        self._make_specs()

    def _make_specs(self) -> None:
        n = self.vector.num_envs
        alone = {"success": Binary(1, shape=(n, 1), dtype=torch.bool, device=self.device)}
        if self._rows:
            sizes = {group: (n, len(rows)) for group, rows in self._rows.items()}
            each = {group: self._of_agents(size) for group, size in sizes.items()}
            sights = {
                group: Composite(seen, shape=sizes[group], device=self.device)
                for group, (seen, _, _) in each.items()
            }
            acts = {
                group: Composite({"action": act}, shape=sizes[group], device=self.device)
                for group, (_, act, _) in each.items()
            }
            paid = {
                group: Composite({"reward": pay}, shape=sizes[group], device=self.device)
                for group, (_, _, pay) in each.items()
            }
        else:
            sights, act, pay = self._of_agents((n,))
            acts, paid = {"action": act}, {"reward": pay}
        flag = Categorical(2, shape=(n, 1), dtype=torch.bool, device=self.device)
        flags = {name: flag.clone() for name in ("done", "terminated", "truncated")}
        self.observation_spec = Composite({**sights, **alone}, shape=(n,), device=self.device)
        self.action_spec = Composite(acts, shape=(n,), device=self.device)
        self.reward_spec = Composite(paid, shape=(n,), device=self.device)
        self.done_spec = Composite(flags, shape=(n,), device=self.device)

    def _of_agents(self, size: tuple[int, ...]) -> tuple[dict[str, Any], Any, Any]:
        """The specs of what agents see, do and are paid, with these leading axes."""
        vector, device = self.vector, self.device
        box = box_of_one_agent(vector)
        low, high = box.low, box.high
        shape = (*size, *low.shape)
        dtype = torch.uint8 if low.dtype == np.uint8 else torch.float32
        if np.isfinite(low).all() and np.isfinite(high).all():
            bounds = [torch.as_tensor(one).expand(shape).clone() for one in (low, high)]
            seen: Any = Bounded(*bounds, shape=shape, dtype=dtype, device=device)
        else:
            seen = Unbounded(shape=shape, dtype=dtype, device=device)
        n_actions = vector.action_masks().shape[-1]
        mask = Binary(n_actions, shape=(*size, n_actions), dtype=torch.bool, device=device)
        space = action_of_one_agent(vector)
        if isinstance(space, spaces.Box):
            every = (*size, *space.low.shape)
            ends = [torch.as_tensor(one).expand(every).clone() for one in (space.low, space.high)]
            act: Any = Bounded(*ends, shape=every, dtype=torch.float32, device=device)
        else:
            act = Categorical(n_actions, shape=size, dtype=torch.int64, device=device)
        pay = Unbounded(shape=(*size, 1), dtype=torch.float32, device=device)
        return {"observation": seen, "action_mask": mask}, act, pay

    def _reset(self, tensordict: TensorDictBase | None, **_: Any) -> TensorDictBase:
        options: dict[str, Any] = {}
        wanted = None if tensordict is None else tensordict.get("_reset", None)
        if wanted is not None:
            mask = wanted.reshape(self.batch_size).cpu().numpy()
            if not mask.all():
                options["reset_mask"] = mask
        seed = None
        if not options:
            seed, self._next_seed = self._next_seed, None
        observed, infos = self.vector.reset(seed=seed, options=options or None)
        entries = self._seen(observed, infos)
        none = torch.zeros((*self.batch_size, 1), dtype=torch.bool, device=self.device)
        for name in ("done", "terminated", "truncated"):
            entries[name] = none.clone()
        return TensorDict(entries, batch_size=self.batch_size, device=self.device)

    def _step(self, tensordict: TensorDictBase) -> TensorDictBase:
        if self._rows:
            acts = [tensordict[group, "action"] for group in self._rows]
            actions = torch.cat(acts, dim=1).cpu().numpy()
            order = [at for rows in self._rows.values() for at in rows]
            actions = actions[:, np.argsort(order)]
            if not self._many:
                actions = actions[:, 0]
        else:
            actions = tensordict["action"].cpu().numpy()
        observed, rewards, terminated, truncated, infos = self.vector.step(actions)
        entries = self._seen(observed, infos)
        if not self._many and self._rows:
            rewards = rewards[:, None]
        paid = self._tensor(np.asarray(rewards, np.float32)[..., None])
        if self._rows:
            for group, rows in self._rows.items():
                entries[group]["reward"] = paid[:, rows]
        else:
            entries["reward"] = paid
        entries["terminated"] = self._tensor(terminated[:, None])
        entries["truncated"] = self._tensor(truncated[:, None])
        entries["done"] = entries["terminated"] | entries["truncated"]
        return TensorDict(entries, batch_size=self.batch_size, device=self.device)

    def _seen(self, observed: NDArray[Any], infos: dict[str, Any]) -> dict[str, Any]:
        """The entries of an observation."""
        mask = infos["action_mask"].astype(bool)
        success = np.zeros((*self.batch_size, 1), bool)
        if "setpiece" in infos:
            success[:, 0] = infos["setpiece"]["success"] & infos["_setpiece"]
        entries: dict[str, Any] = {"success": self._tensor(success)}
        if not self._rows:
            seen = {"observation": self._tensor(observed), "action_mask": self._tensor(mask)}
            return {**entries, **seen}
        if not self._many:
            observed, mask = observed[:, None], mask[:, None]
        sight, masks = self._tensor(observed), self._tensor(mask)
        for group, rows in self._rows.items():
            size = (*self.batch_size, len(rows))
            seen = {"observation": sight[:, rows], "action_mask": masks[:, rows]}
            entries[group] = TensorDict(seen, batch_size=size, device=self.device)
        return entries

    def _tensor(self, array: NDArray[Any]) -> torch.Tensor:
        tensor = torch.from_numpy(np.ascontiguousarray(array))
        return tensor if self.device is None else tensor.to(self.device)

    def _set_seed(self, seed: int | None) -> None:
        self._next_seed = seed

    def close(self, **kwargs: Any) -> None:
        """Closes the matches."""
        self.vector.close()
        super().close(**kwargs)


def make(
    scenario: Source,
    num_envs: int = 1,
    *,
    groups: bool | None = None,
    device: Any = None,
    threads: int | None = None,
    levels: LevelsArgument | None = None,
    params: Params = None,
    **arguments: Unpack[VectorArguments],
) -> FootballTensorEnv:
    """Makes a batch of matches for TorchRL.

    - `groups`: whether entries of agents are nested by team; None: where there are several agents.
    - `device`: where the tensors are; the matches are played by the processor.
    - `threads`, `levels`, `params` and `arguments`: those of `setpiece.make_vec`.

    `env.set_seed(s)` gives match k the seed s + k from the next reset of all matches on.
    """
    if groups is not None:
        check_flag("groups", groups)
    if arguments.get("copy") is False:
        raise ParameterError(
            "tensors keep the arrays, so `copy=False` would change them", name="copy"
        )
    vector = FootballVectorEnv(
        scenario,
        num_envs,
        threads=threads,
        autoreset_mode=AutoresetMode.DISABLED,
        levels=levels,
        params=params,
        **arguments,
    )
    return FootballTensorEnv(vector, groups=groups, device=device)
