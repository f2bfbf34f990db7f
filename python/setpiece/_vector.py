"""Many matches of a scenario at once, as a Gymnasium vector environment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal

import gymnasium
import numpy as np
from gymnasium.envs.registration import EnvSpec
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from setpiece import _native
from setpiece._actions import array_of
from setpiece._callbacks import Rewards, refuse_functions
from setpiece._casting import scripted_scenario
from setpiece._crowd import Crowd
from setpiece._endings import endings
from setpiece._env_options import (
    RENDER_MODES,
    EnvOptions,
    SharedArguments,
    VectorArguments,
    begun_in,
)
from setpiece._environment import FootballEnv, Mirror
from setpiece._errors import ActionError, ParameterError, ReplayError, UnavailableError
from setpiece._levels import LevelsArgument
from setpiece._native import Scenario
from setpiece._opponents import Opponent, Table
from setpiece._options import ParamValue, check_count, check_threads
from setpiece._reset import read_each_params, read_seeds, read_vector_reset
from setpiece._rows import Picker
from setpiece._seats import Seats
from setpiece._source import Source
from setpiece._spaces import Layout, action_space, observation_layout, observation_space
from setpiece._turn import Turn, one_thread
from setpiece._vector_levels import Params, VectorLevels
from setpiece._window import Window, mosaic, tile_size

if TYPE_CHECKING:
    from typing_extensions import Unpack

ENVS_MAX = 65_536
"""The most environments of a vector."""

TOGETHER = ("threads", "autoreset_mode", "levels")
"""Arguments of a vector that a single environment doesn't have."""


class FootballVectorEnv(VectorEnv[Any, Any, Any]):
    """`num_envs` matches of one scenario, stepped together on a few threads.

    Every array has a leading axis `num_envs`; with several agents in a match a second one follows.
    Observations are written in place: with `copy=False` the same arrays are returned every time.

    - `step(actions)`: actions `(num_envs,)` or `(num_envs, agents)`; returns observations, rewards
      (float64 `(num_envs,)`; with several agents float32 `(num_envs, agents)`, as in a single
      environment), terminations, truncations (bool `(num_envs,)`) and infos.
    - `infos`, in Gymnasium's form, always: `action_mask` (int8), `score` (int64 `(num_envs, 2)`),
      `reward_terms` {"reward/label": float64}. If episodes have ended, also `setpiece`, `outcome`,
      `records` {name: float64, NaN without a value, or objects} and their masks `_setpiece`,
      `_outcome`, `_records`.
    - `metadata["autoreset_mode"]`: `NEXT_STEP` begins the next episode in the step after the last,
      whose action is ignored; `SAME_STEP` begins it at once, with the last observation in
      `infos["final_obs"]` and the last infos in `infos["final_info"]`; `DISABLED` waits for
      `reset(options={"reset_mask": …})`.
    - `reset(seed=s)` gives environment k the seed s + k; a list gives each its own, None keeps an
      environment's seed. Each counts its episodes from there, so a vector plays the same as
      `num_envs` single environments.
    """

    metadata = {
        "render_modes": [*RENDER_MODES],
        "render_fps": 10,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    closed = True
    """Until it is made: what is refused has nothing to close."""

    def __init__(
        self,
        scenario: Source,
        num_envs: int = 1,
        *,
        threads: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        record: str | PathLike[str] | None = None,
        levels: LevelsArgument | None = None,
        params: Params = None,
        **arguments: Unpack[VectorArguments],
    ) -> None:
        """Makes the environments; the arguments are those of `setpiece.make_vec`."""
        each = isinstance(params, list | tuple)
        shared = {} if each else {"params": params}
        options = EnvOptions.read({**arguments, **shared}, SharedArguments)
        scenario, level, options = begun_in(scenario, options)
        if level is not None and (levels is not None or each):
            other = "levels" if levels is not None else "params"
            raise ParameterError(f"a level and `{other}` exclude each other", name=other)
        self.source = scenario
        self.mirrors: list[Mirror] = []
        self._acts: list[Any] | None = None
        refuse_functions(options.reward_functions)
        if record is not None:
            raise UnavailableError(
                "a vector can't record replays",
                name="record",
                help="play the episode of its `seed` and `index` with `setpiece.make(…, record=…)`",
            )
        self.render_mode = options.render_mode
        self._window: Window | None = None
        self.num_envs = check_count("num_envs", num_envs, ENVS_MAX)
        threads = check_threads(threads, self.num_envs)
        self.autoreset_mode = read_mode(autoreset_mode)
        self.metadata = {**self.metadata, "autoreset_mode": self.autoreset_mode}
        self._options = options
        self.scenario = scripted_scenario(scenario, options, options.params).with_params(
            **options.params
        )
        if level is not None:
            # A path may have stood for the name.
            levels, params = [replace(level, scenario=self.scenario.name)], None
        self._levels = VectorLevels(levels, params, scenario, self.scenario, options)
        self.level_source = self._levels.source
        self._batch = _native.Batch(
            self.scenario,
            self.num_envs,
            options,
            threads=threads,
            next_step=self.autoreset_mode == AutoresetMode.NEXT_STEP,
            levels=self._levels.native,
        )
        if each:
            self._batch.bind(read_each_params(params, self.num_envs) or [])
        agents, self._n_actions = self._batch.agents, _native.ACTION_SETS[options.action_set]
        mine = [*range(len(agents))]
        self._crowd = None
        if options.opponents is not None:
            table = Table(agents, options.opponents, self._n_actions, self.scenario)
            self._crowd, mine = Crowd(table, self.num_envs), table.mine
            for kind in table.observations:
                self._batch.look(*kind)
            if not mine:
                raise ParameterError("the opponents leave the caller no agent", name="opponents")
        # The caller's only agent has no axis of its own; a contiguous range of agents needs no
        # copy.
        run = bool(mine) and mine == [*range(mine[0], mine[-1] + 1)]
        self._pick: Any = (
            mine[0] if len(mine) == 1 else slice(mine[0], mine[-1] + 1) if run else mine
        )
        self._part = Picker(len(agents), mine[0] if len(mine) == 1 else mine)
        self.agents = tuple(agents[at].id for at in mine)
        self.teams = tuple(agents[at].team for at in mine)
        self.single_observation_space = observation_space(
            self._batch, options.observation, [agents[at] for at in mine]
        )
        self.single_action_space = action_space(len(mine), options.action_set)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._arrays = self._batch.arrays()
        self._view = self._of_agents(self._arrays.observations)
        self._turn = Turn()
        self._begun = False
        self._over = np.ones(self.num_envs, bool)
        self._marks = np.ones(self.num_envs, bool)
        self._marks.flags.writeable = False
        self._terms = self._batch.terms
        self.closed = False

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Draws new starts and returns their observations and infos.

        - `seed`: an integer s (environment k gets s + k), or one for each environment.
        - `options`: `{"reset_mask": bool array}` begins only the episodes that it marks;
          `{"params": {…}}` binds parameters of all environments, from their next episodes on;
          `{"episode": n}` sets the index. `{"level": …}` begins the episode of a level in every
          environment that begins, or `{"level": [...]}` one for each environment: see
          `FootballEnv.reset`.

        Raises `ParameterError` for other options and `LevelError` for a level of another scenario,
        and the episodes continue; `DrawError` if no start meets the scenario's requirements. With
        `levels` also what they raise: `CallbackError` for a function that fails, `LevelError` or
        `ParameterError` for a level that it returns and that can't be played.
        """
        with self._turn:
            wanted = read_vector_reset(seed, options, self.num_envs, levels=self._levels.chosen)
            mask, seeds = wanted.mask, wanted.seeds
            if not self._begun and not mask.all():
                raise ParameterError(
                    "the first `reset` begins an episode of every environment", name="reset_mask"
                )
            if wanted.levels is not None:
                self._batch.assign(self._levels.given(wanted.levels, self._batch.scenarios))
            is_open = self._levels.chosen or wanted.levels is None
            if seed is None and is_open and self._levels.lacks_seed(self._begun):
                seed = self._options.seed
                if seed is None:
                    seed = int(self.np_random.integers(2**62))
                seeds = read_seeds(seed, self.num_envs)
            super().reset(seed=seed if isinstance(seed, int) and seed < 2**63 else None)
            if self._levels.chosen and seeds is not None:
                # The source numbers all levels under one seed.
                if self.level_source is not None:
                    self.level_source.reseed(seeds[0] or 0)
                seeds = None
            with one_thread:
                if wanted.params is not None:
                    self._batch.bind(wanted.params)
                self._batch.reset(
                    self._arrays,
                    mask.tolist(),
                    [None] * self.num_envs if seeds is None else seeds,
                    [wanted.episode] * self.num_envs,
                    False,
                )
            self._begun = True
            self._over &= ~mask
            if mask[0]:
                self._watch()
            begun = self._shown(), self._infos()
        if self.render_mode == "human":
            self.render()
        return begun

    def step(
        self, actions: Any
    ) -> tuple[Any, Any, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Plays 100 ms of every match.

        Raises `ActionError` for actions of another shape or number and `OpponentError` if an
        opponent fails; nothing has been played then. Raises `ScriptError` if a script of the
        scenario fails: its episode has ended, and the others have been played. With `levels` a step
        that begins episodes raises what `reset` does.
        """
        with self._turn:
            if not self._begun:
                raise gymnasium.error.ResetNeeded(
                    "call `reset` before `step`: no episode is being played"
                )
            if self._over.any() and self.autoreset_mode == AutoresetMode.DISABLED:
                at = int(np.flatnonzero(self._over)[0])
                raise gymnasium.error.ResetNeeded(
                    f"the episode of environment {at} has ended: call `reset(options={{'reset_mask': …}})`"
                )
            actions = self._read(actions)
            with one_thread:
                self._batch.step(self._arrays, actions)
            self._keep(actions)
            over = self._arrays.terminated | self._arrays.truncated
            infos = self._infos()
            if over.any():
                self._tell(infos, over)
                if self.autoreset_mode == AutoresetMode.SAME_STEP:
                    infos = self._begin_again(infos, over)
                    over = np.zeros_like(over)
            self._over = over
            played = self._shown(), *self._outcomes(), infos
        if self.render_mode == "human":
            self.render()
        return played

    def close_extras(self, **kwargs: Any) -> None:
        """Closes the environments; `reset` and `step` then raise `ClosedEnvironmentError`."""
        self._turn.closed = True
        if self._window is not None:
            self._window.close()
        super().close_extras(**kwargs)

    @property
    def sight(self) -> tuple[str, bool]:
        """The kind of observation of the caller's agents, and whether it is scaled."""
        return self._options.observation, self._options.scale

    @property
    def observation_layout(self) -> Layout:
        """The layout of one agent's observation: the blocks of its last axis."""
        with one_thread:
            return observation_layout(self._batch, self._options.observation, self._options.stack)

    @property
    def levels(self) -> list[str]:
        """The level that each environment plays, as text.

        Raises `ResetNeeded` before the first `reset`.
        """
        if not self._begun:
            raise gymnasium.error.ResetNeeded("call `reset` first: no level is being played")
        with one_thread:
            return self._batch.levels

    def action_masks(self) -> NDArray[np.int8]:
        """Returns the current `infos["action_mask"]`."""
        masks: NDArray[np.int8] = self._of_agents(self._arrays.masks)[..., : self._n_actions].copy()
        return masks

    def render(self) -> tuple[str, ...] | tuple[NDArray[np.uint8], ...] | None:
        """Returns a drawing of each environment: texts, or pictures of the `render_size`.

        `"human"` shows all pictures as a mosaic, smaller so that they fit into one window of that
        size. None without a render mode.
        """
        mode = self.render_mode
        if mode is None:
            return None
        with one_thread:
            if mode == "ansi":
                return tuple(self._batch.drawing(at) for at in range(self.num_envs))
            size, camera = self._options.render_size, self._options.camera
            if mode == "human":
                size = tile_size(size, self.num_envs)
            frames = tuple(self._batch.frame(at, size, camera) for at in range(self.num_envs))
        if mode == "rgb_array":
            return frames
        if self._window is None:
            self._window = Window(self.scenario.name, self.metadata["render_fps"])
        self._window.show(mosaic([*frames]))
        return None

    def _read(self, given: Any) -> NDArray[Any]:
        """Everyone's actions: the caller's and the opponents'; the batch reads the numbers."""
        if self._crowd is not None:
            arrays, steps = self._arrays, self._batch.steps
            return self._crowd.actions(given, arrays.observations, self._look, arrays.masks, steps)
        actions = array_of(given)
        if actions is None:
            raise ActionError(
                f"expected actions of shape {self.action_space.shape}, found `{given!r}`"
            )
        return actions

    def _look(self, observation: str, scale: bool) -> list[Any]:
        """Observes each match in another kind of observation."""
        with one_thread:
            return self._batch.look(observation, scale)

    def _begin_again(self, infos: dict[str, Any], over: NDArray[np.bool_]) -> dict[str, Any]:
        """Begins the next episode where one has ended; the end of the last is in `final_obs`."""
        final = {
            key: value.copy() if isinstance(value, np.ndarray) else value
            for key, value in infos.items()
        }
        final["reward_terms"] = {name: paid.copy() for name, paid in infos["reward_terms"].items()}
        last = np.full(self.num_envs, None, dtype=object)
        for at in np.flatnonzero(over):
            last[at] = self._of_agents(self._arrays.observations)[at].copy()
        with one_thread:
            none = [None] * self.num_envs
            self._batch.reset(self._arrays, over.tolist(), none, none, True)
        if over[0]:
            self._watch()
        fresh = self._infos()
        fresh.update(
            {
                "final_obs": last,
                "_final_obs": over.copy(),
                "final_info": final,
                "_final_info": over.copy(),
            }
        )
        return fresh

    def _tell(self, infos: dict[str, Any], over: NDArray[np.bool_]) -> None:
        """Adds how episodes have ended."""
        ended = endings(self._batch, over, self._part, self._n_actions)
        for key, value in ended.items():
            infos[key], infos[f"_{key}"] = value, over.copy()
        if over[0] and self.mirrors:
            acts = self._acts
            seed, index = ended["setpiece"]["seed"][0], ended["setpiece"]["index"][0]
            played = self._batch.played(0)
            for mirror in self.mirrors:
                mirror(lambda: self._replay(acts, played, seed, index))

    def _watch(self) -> None:
        """Begins an episode of the first environment, for those who watch it."""
        self._acts = [] if self.mirrors else None

    def _keep(self, actions: Any) -> None:
        """Keeps the actions of the first environment while somebody watches it."""
        if not self.mirrors:
            # Whoever comes later has not seen the beginning.
            self._acts = None
        elif self._over[0]:
            # This step has begun the next episode.
            self._watch()
        elif self._acts is not None:
            self._acts.append(np.asarray(actions)[0].copy())

    def _replay(
        self,
        acts: list[Any] | None,
        played: tuple[Scenario, dict[str, ParamValue]] | None,
        seed: int,
        index: int,
    ) -> bytes:
        """Plays an episode of the first environment again; returns its replay.

        Raises `ReplayError` if its beginning has not been seen.
        """
        if acts is None or played is None:
            raise ReplayError("the episode began before it was watched")
        scenario, params = played
        native = _native.Environment(scenario, self._options)
        with one_thread:
            native.reset(int(seed), int(index), params, None)
            for action in acts:
                native.step(action)
            return native.replay()

    def _infos(self) -> dict[str, Any]:
        marks = self._marks
        terms = {
            name: self._of_agents(self._arrays.terms)[..., at].copy()
            for at, name in enumerate(self._terms)
        }
        return {
            "score": self._arrays.score.copy(),
            "_score": marks,
            "reward_terms": terms,
            "_reward_terms": marks,
            "action_mask": self.action_masks(),
            "_action_mask": marks,
        }

    def _shown(self) -> Any:
        shown = (
            self._of_agents(self._arrays.observations)
            if isinstance(self._pick, list)
            else self._view
        )
        return shown.copy() if self._options.copy else shown

    def _outcomes(self) -> tuple[Any, NDArray[np.bool_], NDArray[np.bool_]]:
        arrays = self._arrays
        return (
            self._of_agents(arrays.rewards).copy(),
            arrays.terminated.copy(),
            arrays.truncated.copy(),
        )

    def _of_agents(self, array: NDArray[Any]) -> NDArray[Any]:
        """The part of the caller's agents, without their axis if there is one agent."""
        return array[:, self._pick]


def make_vec(
    scenario: Source,
    num_envs: int = 1,
    *,
    threads: int | None = None,
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    observation: str = "simple115v2",
    rewards: Rewards = None,
    params: Params = None,
    levels: LevelsArgument | None = None,
    seed: int | None = None,
    copy: bool = True,
    action_set: str = "default",
    stack: int = 1,
    size: tuple[int, int] = (96, 72),
    scale: bool = False,
    left: Seats = None,
    right: Seats = None,
    opponents: Mapping[str, Opponent] | None = None,
    switching: Literal["auto", "fixed"] | None = None,
    render_mode: str | None = None,
    render_size: tuple[int, int] = (1280, 720),
    camera: str = "broadcast",
    record: str | PathLike[str] | None = None,
    allow_outside: bool = False,
) -> FootballVectorEnv:
    """Makes `num_envs` environments of a scenario that are stepped together.

    - `threads`: the number of threads; None: one per core. Results don't depend on it.
    - `autoreset_mode`: when the next episode begins after one has ended: see `FootballVectorEnv`.
    - `copy`: False returns the same array of observations every time, overwritten by the next
      `step`.
    - `record`: only for single environments; here it raises `UnavailableError`.
    - `params`: as in `setpiece.make`, or a list with those of each environment.
    - `levels`: what chooses the scenario, the parameters and the seed of every episode. An
      environment that begins takes the next level; which environment has which doesn't depend on
      the threads. `levels` of the vector names those that are played.
      - a curriculum or a suite: its name in the scenario's file or in the library, the path of a
        file, `setpiece.curriculum(…)` or `setpiece.suite(…)`;
      - a sampler of `setpiece.samplers`;
      - a level (a `Level`, its text or a dict), or a list of levels, which begins again after its
        end. A level of a list may lack its seed: then it is another episode every time, under the
        seed of the vector. So a list may also hold names of scenarios (of the scenario's file, or
        of the library), loaded scenarios, and parameters: `{"params": {…}}`;
      - a function from the `LevelResult` of an environment's last level, None before the first, to
        its next level.

      `level_source` is the curriculum or the sampler, with `state_dict`. All scenarios must have the
      same spaces (`LevelError`); their reward terms are listed together. An integer `reset(seed=s)`
      seeds the source, which keeps what it has measured; `seed` is for a source that has none.
    - `opponents`: called once for all environments: a policy with batches sees `num_envs` rows for
      each of its agents.
    - The rest is as in `setpiece.make`. Raw observations, and rewards and endings in Python, are
      only for single environments.

    `gymnasium.make_vec(envs.spec, num_envs=n)` makes another such vector, `envs.spec.make()` a
    single environment.

    >>> import numpy, setpiece
    >>> envs = setpiece.make_vec("academy_3_vs_1_with_keeper", 4, seed=7)
    >>> observations, infos = envs.reset()
    >>> observations, rewards, *_ = envs.step(numpy.full(4, setpiece.Action.SHORT_PASS))
    >>> observations.shape, rewards.shape, infos["action_mask"].shape
    ((4, 115), (4,), (4, 19))
    """
    # Before any other name is bound, so that these are the caller's arguments, without the number,
    # which Gymnasium passes again.
    arguments: dict[str, Any] = {**locals()}
    del arguments["num_envs"]
    envs = FootballVectorEnv(num_envs=num_envs, **arguments)
    envs.spec = EnvSpec(
        id=f"setpiece/{envs.scenario.name}-v0",
        entry_point="setpiece._vector:one_of",
        vector_entry_point="setpiece._vector:FootballVectorEnv",
        kwargs=arguments,
    )
    return envs


def one_of(**kwargs: Any) -> FootballEnv:
    """Makes a single environment from a vector's arguments, without vector-only ones.

    `envs.spec.make()` calls it.
    """
    arguments = {name: value for name, value in kwargs.items() if name not in TOGETHER}
    if isinstance(arguments.get("params"), list | tuple):
        arguments["params"] = arguments["params"][0]
    return FootballEnv(**arguments)


def read_mode(mode: object) -> AutoresetMode:
    for known in AutoresetMode:
        if mode is known or (
            isinstance(mode, str) and mode.lower() in (known.name.lower(), known.value.lower())
        ):
            return known
    names = "`, `".join(known.name for known in AutoresetMode)
    raise ParameterError(f"no autoreset mode `{mode}`; there are `{names}`", name="autoreset_mode")
