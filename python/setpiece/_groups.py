"""Stepping like EnvPool: groups of matches that are played while the caller thinks."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from setpiece._actions import array_of
from setpiece._errors import ActionError, ParameterError, SetpieceError, UnavailableError
from setpiece._options import check_count
from setpiece._reset import read_seeds
from setpiece._source import Source
from setpiece._vector import ENVS_MAX, FootballVectorEnv, read_mode
from setpiece._vector_levels import Params

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from setpiece._env_options import VectorArguments

Received = tuple[Any, NDArray[Any], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]


class FootballGroups:
    """`num_envs` matches in groups; one is played while the caller chooses another's actions.

    ```python
    envs = setpiece.make_groups("academy_corner", 64)
    envs.async_reset(seed=1)
    for _ in range(1000):
        observations, rewards, terminations, truncations, infos = envs.recv()
        envs.send(policy(observations))
    ```

    - `recv()` waits for the group whose actions were sent first, and returns what
      `FootballVectorEnv.step` returns for it; `infos["env_id"]` (int64) are the numbers of its
      environments. The order is that of `send`, never that of the clock, so a run can be repeated.
    - `send(actions)` begins a step of the group that was received first and has had no actions
      since, and returns at once. With `env_id` it is the group that was received with these.
    - After `async_reset` `recv` returns the start of each group, with rewards of 0.

    Environment k plays what environment k of a `FootballVectorEnv` plays with the same actions.

    If a step of a group fails, its next `recv` raises the error; `error.environment` is the number
    of the environment. The group then counts as received.
    """

    num_envs: int
    """All environments."""
    num_groups: int
    batch_size: int
    """The environments of a group, and so the rows that `recv` returns."""

    def __init__(
        self,
        scenario: Source,
        num_envs: int = 2,
        *,
        groups: int = 2,
        threads: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        params: Params = None,
        **arguments: Unpack[VectorArguments],
    ) -> None:
        """Makes the environments; see `setpiece.make_groups`."""
        self.num_envs = check_count("num_envs", num_envs, ENVS_MAX)
        self.num_groups = check_count("groups", groups, self.num_envs)
        if self.num_envs % self.num_groups:
            raise ParameterError(
                f"{self.num_envs} environments can't be split into {self.num_groups} equal groups",
                name="groups",
            )
        if arguments.get("levels") is not None:
            raise UnavailableError(
                "groups have no source of levels, because each would have its own",
                name="levels",
                help="make_vec has one for all environments",
            )
        if arguments.get("opponents"):
            raise UnavailableError(
                "groups can't ask opponents of yours, because they are played in threads",
                name="opponents",
                help="play both teams: `left='all', right='all'`",
            )
        autoreset_mode = read_mode(autoreset_mode)
        if autoreset_mode == AutoresetMode.DISABLED:
            raise UnavailableError(
                "groups begin their next episodes themselves", name="autoreset_mode"
            )
        if arguments.get("render_mode") is not None:
            raise UnavailableError("groups can't be watched", name="render_mode")
        self.batch_size = self.num_envs // self.num_groups
        self._ids = np.arange(self.num_envs).reshape(self.num_groups, self.batch_size)
        self._seed = arguments.get("seed")

        def group(at: int) -> FootballVectorEnv:
            mine: Params = params
            if isinstance(params, list | tuple):
                mine = [params[k] for k in self._ids[at].tolist()]
            return FootballVectorEnv(
                scenario,
                self.batch_size,
                threads=threads,
                autoreset_mode=autoreset_mode,
                params=mine,
                **arguments,
            )

        if isinstance(params, list | tuple) and len(params) != self.num_envs:
            raise ParameterError(
                f"expected {self.num_envs} dicts of parameters, found {len(params)}", name="params"
            )
        self._vectors = [group(at) for at in range(self.num_groups)]
        first = self._vectors[0]
        self.agents, self.teams = first.agents, first.teams
        self.scenario, self.autoreset_mode = first.scenario, first.autoreset_mode
        self.single_observation_space = first.single_observation_space
        self.single_action_space = first.single_action_space
        self.observation_space, self.action_space = first.observation_space, first.action_space
        self._workers = [
            ThreadPoolExecutor(1, thread_name_prefix=f"setpiece-group-{at}")
            for at in range(self.num_groups)
        ]
        self._played: deque[tuple[int, Future[Received]]] = deque()
        """Groups that are being played, in the order of `send`."""
        self._waiting: deque[int] = deque()
        """Groups that wait for actions, in the order of `recv`."""
        self.closed = False

    def async_reset(self, seed: int | Sequence[int | None] | None = None) -> None:
        """Begins an episode of every environment, and returns at once.

        - `seed`: an integer s (environment k gets s + k), or one for each; without one the first
          reset uses the `seed` of the environments, and later ones go on counting episodes.

        Steps that have been sent and not received are played and dropped.
        """
        self._check_open()
        if seed is None:
            seed, self._seed = self._seed, None
        seeds = None if seed is None else read_seeds(seed, self.num_envs)
        while self._played:
            self._played.popleft()[1].exception()
        self._waiting.clear()
        for at, vector in enumerate(self._vectors):
            mine = None if seeds is None else [seeds[k] for k in self._ids[at].tolist()]
            self._play(at, lambda vector=vector, mine=mine: _begun(vector, mine))

    def send(self, actions: Any, env_id: NDArray[Any] | Sequence[int] | None = None) -> None:
        """Begins a step of a group, and returns at once.

        Raises `ActionError` for actions of another shape, and `ResetNeeded` if no group waits for
        actions. Other faults of the actions are raised by the group's next `recv`.
        """
        self._check_open()
        if not self._waiting:
            raise gymnasium.error.ResetNeeded(
                "call `async_reset` and `recv` before `send`: no group waits for actions"
            )
        at = self._waiting[0] if env_id is None else self._group(env_id)
        array = array_of(actions)
        if array is None or array.shape != self.action_space.shape:
            found = repr(actions) if array is None else f"shape {array.shape}"
            raise ActionError(f"expected actions of shape {self.action_space.shape}, found {found}")
        # The caller may reuse the array while the group is played.
        array = array.copy()
        self._waiting.remove(at)
        vector = self._vectors[at]
        self._play(at, lambda: vector.step(array))

    def recv(self) -> Received:
        """Waits for the group that was sent first, and returns its step.

        Raises what `FootballVectorEnv.step` does, and `ResetNeeded` if no group is being played.
        """
        self._check_open()
        if not self._played:
            raise gymnasium.error.ResetNeeded(
                "call `async_reset` or `send` before `recv`: no group is being played"
            )
        at, future = self._played[0]
        try:
            observations, rewards, terminations, truncations, infos = future.result()
        except SetpieceError as error:
            if error.environment is not None and future.done():
                error.environment += int(self._ids[at, 0])
            raise
        finally:
            # An interrupted wait has received nothing.
            if future.done():
                self._played.popleft()
                self._waiting.append(at)
        infos["env_id"] = self._ids[at].copy()
        return observations, rewards, terminations, truncations, infos

    def close(self) -> None:
        """Waits for what is being played, and closes the environments."""
        if self.closed:
            return
        self.closed = True
        for worker in self._workers:
            worker.shutdown(wait=True)
        for vector in self._vectors:
            vector.close()

    def __enter__(self) -> FootballGroups:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _play(self, at: int, work: Any) -> None:
        self._played.append((at, self._workers[at].submit(work)))

    def _group(self, env_id: NDArray[Any] | Sequence[int]) -> int:
        ids = np.asarray(env_id)
        for at in self._waiting:
            if np.array_equal(ids, self._ids[at]):
                return at
        raise ParameterError(
            "expected the `env_id` of a group that waits for actions", name="env_id"
        )

    def _check_open(self) -> None:
        if self.closed:
            raise gymnasium.error.ClosedEnvironmentError("the environments are closed: make others")


def _begun(vector: FootballVectorEnv, seeds: list[int | None] | None) -> Received:
    """The start of every match, in the form of a step that paid nothing."""
    observations, infos = vector.reset(seed=seeds)
    n, agents = vector.num_envs, len(vector.agents)
    rewards = np.zeros((n, agents), np.float32) if agents > 1 else np.zeros(n)
    none = np.zeros(n, bool)
    return observations, rewards, none, none.copy(), infos


def make_groups(
    scenario: Source,
    num_envs: int = 2,
    *,
    groups: int = 2,
    threads: int | None = None,
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    params: Params = None,
    **arguments: Unpack[VectorArguments],
) -> FootballGroups:
    """Makes environments in groups, with `send` and `recv`: see `FootballGroups`.

    - `groups`: how many; `num_envs` is a multiple of it. With two, one is played while the policy
      looks at the other.
    - `threads`: threads of each group.
    - `autoreset_mode`: `NEXT_STEP` or `SAME_STEP`.
    - `params` and `arguments`: those of `setpiece.make_vec`, without `levels`, `record`,
      `opponents` and `render_mode`.
    """
    return FootballGroups(
        scenario,
        num_envs,
        groups=groups,
        threads=threads,
        autoreset_mode=autoreset_mode,
        params=params,
        **arguments,
    )
