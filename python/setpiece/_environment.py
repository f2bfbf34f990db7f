"""A scenario as a Gymnasium environment."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from copy import deepcopy
from operator import index
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium.envs.registration import EnvSpec
from numpy.typing import NDArray

from setpiece import _native
from setpiece._errors import InUseError, OpponentError, ParameterError, ScriptError, SetpieceError
from setpiece._native import Live, Scenario
from setpiece._opponents import Opponent, Table, behaviors, revivable
from setpiece._record import Record, When, write
from setpiece._reload import Reload
from setpiece._seats import Seats, scripted_scenario
from setpiece._spaces import (
    Layout,
    action_space,
    check_action_set,
    check_observation,
    check_size,
    check_stack,
    observation_layout,
    observation_space,
)

ParamValue = bool | int | float | str
"""A parameter's value: SI units, or a string as the language writes it (`"12m"`, `"60%"`, `"left"`)."""

RESET_OPTIONS = ("episode", "params", "snapshot")
NUMBER_MAX = 2**64 - 1


class FootballEnv(gymnasium.Env[Any, Any]):
    """One match of a scenario, judged by the scenario's own rewards and endings.

    Actions are `Action` numbers, 0..18; observations are in the agent's own frame: it always attacks towards +x.

    - One agent: action `Discrete(19)`, reward a float, observation without an agent axis.
    - n agents: action `MultiDiscrete([19] * n)`, reward float32 `(n,)`, observation with a leading axis n (a tuple of n
      dicts for `"raw"`), left team's agents first.
    - No agents (`agents { left: 0 }`): as n agents with n = 0. The bots play, and `step([])` goes on; what is left to
      look at is `info`, `played` and `render`.

    With `action_set="v2"` there is a 20th action, `Action.BUILTIN_AI`: the bot (or the behaviour of the scenario's
    player) plays this step, and what the agent held is released.

    `info` has in every step `score` [left, right], `reward_terms` {"reward/label": paid in this step} and `action_mask`
    (int8 `(19,)`, or `(n, 19)`; 20 with `v2`, 33 with `full`, the 6 kinds with `continuous`); with `events=True` also
    `events`; with `bot_action=True` also `bot_action`: what the bot would press in the state that is observed (an int,
    or int64 `(n,)`), going on from what
    the agent holds. In the last step it has also:

    - `outcome`: the ending's name; `records`: the scenario's own records.
    - `setpiece`: `return` by term, `length` in steps, `seed`, `index`, `digest` of the final state, `success` of the
      side with agents, `faults`: payments that were impossible (a division by zero) and left out, and `scenario`: the
      scenario's digest.

    With `opponents` some of the scenario's agents are played by others; the caller's are what is left, and all that is
    said above is said of those. (`success` is still told from the left side where both sides have agents.)

    With `watch=True` every `reset` looks whether the scenario's file, an import or a script has changed, and begins the
    episode under the new scenario; its `info` has `scenario`, the digest of what is played. With `watch="now"` every
    `step` looks too, and where nothing but scripts has changed it goes on with them at once, and with their memory.
    """

    metadata = {"render_modes": ["ansi"], "render_fps": 10}

    scenario: Scenario
    """The scenario, with the parameters it was made with."""
    agents: tuple[str, ...]
    """The caller's agents in order: a player's name, `left_CM_1`, or `left_0` for one that changes players."""
    last_reload: Reload | None
    """What became of the last change of the scenario's files; None before the first."""

    def __init__(
        self,
        scenario: Scenario | str | PathLike[str],
        *,
        left: Seats = None,
        right: Seats = None,
        opponents: Mapping[str, Opponent] | None = None,
        observation: str = "simple115v2",
        rewards: str | Sequence[str] | None = None,
        params: Mapping[str, ParamValue] | None = None,
        seed: int | None = None,
        events: bool = False,
        copy: bool = True,
        render_mode: str | None = None,
        watch: bool | Literal["now"] = False,
        on_reload: Callable[[Reload], object] | None = None,
        action_set: str = "default",
        bot_action: bool = False,
        stack: int = 1,
        size: tuple[int, int] = (96, 72),
        switching: Literal["auto", "fixed"] | None = None,
        record: str | PathLike[str] | None = None,
        record_when: When = "always",
    ) -> None:
        """Makes an environment; the arguments are those of `setpiece.make`."""
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise ParameterError(f"no render mode `{render_mode}`; there is `ansi`", name="render_mode")
        self.render_mode = render_mode
        if watch not in (False, True, "now"):
            raise ParameterError(f"`watch` is {watch!r}; it can be False, True or 'now'", name="watch")
        self._record = None if record is None else Record(record, record_when)
        self._live: Live | None = None
        self._table: Table | None = None
        self._at_once = watch == "now"
        self._waiting: Scenario | None = None
        scripted = behaviors(opponents)
        self._opponents = revivable(opponents)
        if watch:
            if isinstance(scenario, Scenario):
                raise ParameterError("a `Scenario` has no file to watch: give its path", name="watch")
            if scripted:
                raise ParameterError("a watched file says itself who plays: write it there", name="watch")
            self._live = Live(fspath(scenario))
            scenario = self._live.scenario
        else:
            scenario = scripted_scenario(scenario, scripted)
        self._on_reload = on_reload
        self.last_reload = None
        self._bound = dict(params or {})
        self._observation = check_observation(observation)
        self._options: dict[str, Any] = {
            "observation": self._observation,
            "rewards": _reward_names(rewards),
            "events": events,
            "copy": copy,
            "action_set": check_action_set(action_set),
            "bot_action": bool(bot_action),
            "stack": check_stack(stack, self._observation),
            "size": check_size(size),
            "left": left,
            "right": right,
            "switching": switching,
        }
        self.scenario = scenario.with_params(**self._bound)
        self._native = self._environment(self.scenario)
        self._digest = self.scenario.digest
        agents = self._native.agents
        if self._opponents is not None:
            if self.action_set == "continuous":
                raise ParameterError(
                    "beside opponents the caller presses keys: continuous actions are for all agents", name="action_set"
                )
            n_actions = _native.ACTION_SETS[self.action_set]
            self._table = Table(agents, self._opponents, self._observation, n_actions)
            agents = [agents[at] for at in self._table.mine]
            for kind in self._table.observations:
                self._native.look(kind)
        self.agents = tuple(agent.id for agent in agents)
        self.action_space = action_space(len(agents), self.action_set)
        self.observation_space = observation_space(self._native, self._observation, agents)
        self._first_seed = None if seed is None else _check_number("seed", seed)
        self._seed: int | None = None
        self._index = 0
        self._params: dict[str, ParamValue] = {}
        self._playing = False

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Draws a new start and returns its observation and `info`.

        - `seed`: 0..2**64-1; begins a new series of episodes at index 0. Without it the index counts on. The start and
          the play are a function of seed, index, parameters and actions.
        - `options`: `{"params": {…}}` binds parameters for this and the following episodes, until other `params` are
          given; `{"episode": n}` sets the index; `{"snapshot": bytes}` begins this episode in the state that a snapshot
          was taken in, of this scenario or of another with the same players and agents: places, ball, whatever goes on,
          score, cards, fatigue and clock are the snapshot's, rules, difficulty and limit the scenario's; rewards,
          records and random numbers begin anew.

        Raises `ParameterError` for options or parameters that are not there, `SnapshotError` for a snapshot that does
        not fit, `DrawError` where no start meets the scenario's requirements.
        """
        episode, params, snapshot = _read_options(options)
        if seed is None and self._seed is None:
            seed = self._first_seed
        if seed is not None:
            seed = _check_number("seed", seed)
        super().reset(seed=seed)
        number, at = (self._seed, self._index) if seed is None else (seed, 0)
        if number is None:
            number = int(self.np_random.integers(2**63))
        at = at if episode is None else episode
        params = self._params if params is None else params
        self._playing = False
        if self._live is not None:
            self._follow(self._live)
        with _one_thread():
            observation, info = self._native.reset(number, at, params, snapshot)
        if self._table is not None:
            observation, info = self._table.shown(observation, info)
        if self._live is not None:
            info["scenario"] = self._digest
        # A reset that fails leaves no trace but that nothing is being played.
        self._seed, self._index, self._params = number, (at + 1) & NUMBER_MAX, params
        self._playing = True
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Plays 100 ms and returns observation, reward, terminated, truncated and `info`.

        - `action`: an integer 0..18 (0..19 with `action_set="v2"`, 0..32 with `"full"`), or for n agents n of
          them; with `"continuous"` four numbers, or `(n, 4)`.

        `terminated` is an ending of the scenario (a goal, the ball lost), `truncated` its time limit. Raises
        `ActionError` for another action, `ScriptError` where a script of the scenario fails, `OpponentError` where an
        opponent does; after these two a `reset` begins anew.
        """
        if not self._playing:
            raise gymnasium.error.ResetNeeded("call `reset` before `step`: no episode is being played")
        if self._at_once and self._live is not None:
            self._follow_scripts(self._live)
        try:
            if self._table is not None:
                action = self._table.actions(action, self.look)
            result = self._native.step(action)
        except (ScriptError, OpponentError):
            self._playing = False
            raise
        except RuntimeError as error:
            # The binding's word for a second thread.
            if "borrowed" not in str(error):
                raise
            raise InUseError("another thread is using this environment: make one for each thread") from None
        self._playing = not (result[2] or result[3])
        if not self._playing:
            result[4]["setpiece"]["scenario"] = self._digest
            if self._record is not None:
                result[4]["setpiece"]["replay"] = self._record.end(self._native, self.scenario.name, result[4]["score"])
        if self._table is not None:
            observation, reward, terminated, truncated, info = result
            observation, info = self._table.shown(observation, info)
            return observation, self._table.paid(reward), terminated, truncated, info
        return result

    def save_replay(self, path: str | PathLike[str]) -> None:
        """Writes the episode as far as it has been played: `setpiece replay FILE` plays it again, bit for bit.

        Raises `ReplayError` before the first episode and after `restore`, `FileError` where it can't be written.
        """
        with _one_thread():
            write(Path(path), self._native.replay())

    def snapshot(self) -> bytes:
        """Returns the whole episode as it stands, in some kilobytes: see `restore`.

        The bytes hold the match in the middle of whatever goes on, rewards, records, scripts' memory and the streams of
        random numbers; they are the same on every machine, and good for this version of the scenario. Raises
        `SnapshotError` where a script keeps a function in its memory.
        """
        with _one_thread():
            return self._native.snapshot()

    def restore(self, snapshot: bytes) -> tuple[Any, dict[str, Any]]:
        """Goes on where a snapshot was taken, by whichever environment of this scenario, rewards and agents.

        Returns the observation and `info` of the step after which it was taken; every later step is that of the
        straight run, but for what opponents remember. Raises `SnapshotError` for anything else, and nothing has changed
        then.
        """
        snapshot = _check_snapshot(snapshot)
        with _one_thread():
            observation, info = self._native.restore(snapshot)
        episode = self._native.episode
        if episode is not None:
            self._seed, self._index = episode[0], (episode[1] + 1) & NUMBER_MAX
            self._params = self._native.params
        self._playing = self._native.running
        if "setpiece" in info:
            info["setpiece"]["scenario"] = self._digest
        return (observation, info) if self._table is None else self._table.shown(observation, info)

    @property
    def slots(self) -> list[_native.AgentInfo]:
        """All agents of the scenario in order, the opponents' too: `id` and `team` (0 left, 1 right)."""
        return self._native.agents

    @property
    def observation(self) -> str:
        """What the caller's agents see: a name of `setpiece.make`."""
        return self._observation

    @property
    def observation_layout(self) -> Layout:
        """How one agent's observation lies: the blocks of an array's last axis, or the keys of a dict.

        >>> import setpiece
        >>> setpiece.make("academy_corner").observation_layout[4]
        Block(start=88, length=3, meaning='ball x, y, z', unit='normalised; z in metres')
        """
        return observation_layout(self._native, self._observation, self._options["stack"])

    @property
    def action_set(self) -> str:
        """The caller's actions: `"default"`, `"v2"`, `"full"` or `"continuous"`."""
        action_set: str = self._options["action_set"]
        return action_set

    def look(self, observation: str) -> Any:
        """Returns what all of `slots` see now in an observation of any kind, whatever the environment's own.

        Looking changes nothing. Raises `ResetNeeded` before the first episode.

        >>> import setpiece
        >>> env = setpiece.make("academy_corner")
        >>> _ = env.reset(seed=1)
        >>> env.look("raw")["steps_left"].item()
        400
        """
        if self._native.episode is None:
            raise gymnasium.error.ResetNeeded("call `reset` before `look`: there is nothing to be seen yet")
        with _one_thread():
            return self._native.look(check_observation(observation))

    def clone(self) -> FootballEnv:
        """Returns an independent environment in the same state; it watches no files, and its opponents are the same.

        >>> import setpiece
        >>> env = setpiece.make("academy_corner")
        >>> _ = env.reset(seed=1)
        >>> other = env.clone()
        >>> env.step(setpiece.Action.SHOT)[1] == other.step(setpiece.Action.SHOT)[1]
        True
        """
        return deepcopy(self)

    def __reduce__(self) -> tuple[Any, ...]:
        """Makes copies and pickles of the scenario and a snapshot."""
        kwargs = {
            **self._options,
            "scenario": self.scenario,
            "seed": self._first_seed,
            "render_mode": self.render_mode,
            "opponents": self._opponents,
        }
        snapshot = None if self._native.episode is None else (self.snapshot(), self._native.frames())
        return _revived, (kwargs, snapshot, self.spec, self._np_random, self._np_random_seed)

    def __deepcopy__(self, memo: dict[int, Any]) -> FootballEnv:
        """A copy shares its opponents: they may be large, or hold what can't be copied."""
        kwargs, snapshot, spec, random, random_seed = self.__reduce__()[1]
        return _revived(kwargs, snapshot, spec, deepcopy(random, memo), random_seed)

    def _environment(self, scenario: Scenario) -> _native.Environment:
        """The match of all agents; opponents may hand a step over to the bot, whatever the caller may."""
        narrow = self._opponents is not None and self.action_set == "default"
        opposed = {"action_set": "v2"} if narrow else {}
        return _native.Environment(scenario, **{**self._options, **opposed})

    def _follow(self, live: Live) -> None:
        """Takes over what has changed in the scenario's files since the last reset."""
        fresh = self._changed(live)
        if fresh is None:
            return
        self._waiting = None
        try:
            scenario = fresh.with_params(**self._bound)
            native = self._environment(scenario)
        except SetpieceError as error:
            self._tell(Reload("held back", fresh, error, f"no environment can be made of it: {error}"))
            return
        before = self._native
        if _agents(native) != _agents(before):
            why = f"the agents would change from {', '.join(_agents(before))} to {', '.join(_agents(native))}"
            self._tell(Reload("held back", fresh, None, why))
        elif observation_space(native, self._observation) != observation_space(before, self._observation):
            self._tell(Reload("held back", fresh, None, "the observation space would change"))
        else:
            self.scenario, self._native, self._digest = scenario, native, scenario.digest
            self._tell(Reload("applied", fresh, None, f"`{scenario.name}` is played from this episode on"))

    def _follow_scripts(self, live: Live) -> None:
        """Takes over changed scripts at once; any other change waits for the next reset."""
        fresh = self._changed(live)
        if fresh is None or fresh is self._waiting:
            return
        try:
            scenario = fresh.with_params(**self._bound)
            adopted = self._native.adopt_scripts(scenario)
        except SetpieceError:
            adopted = False
        if adopted:
            self.scenario, self._digest = scenario, scenario.digest
            self._tell(Reload("applied", fresh, None, f"the scripts of `{scenario.name}` are run from this step on"))
        else:
            self._waiting = fresh

    def _changed(self, live: Live) -> Scenario | None:
        """The scenario of files that have changed, or one that is still waiting."""
        try:
            return live.poll() or self._waiting
        except SetpieceError as error:
            self._tell(Reload("broken", None, error, "the scenario's files have errors"))
            return None

    def _tell(self, reload: Reload) -> None:
        self.last_reload = reload
        if self._on_reload is not None:
            self._on_reload(reload)

    def action_masks(self) -> NDArray[np.int8]:
        """Returns what `info["action_mask"]` shows now: 1 where an action can change something, else 0."""
        mask = self._native.action_mask()
        return mask if self._table is None else self._table.mask(mask)

    def played(self) -> dict[str, int]:
        """Returns what every player pressed in the last step, by his name: `Action` numbers in his own frame.

        An agent's player has its action, a scripted one that of his behaviour (19 where it hands over to the bot), and
        everyone else what the bot did with him, told as an action: step by step a stream, each press going on from
        those before. Who is played by nobody is left out.

        >>> import setpiece
        >>> env = setpiece.make("academy_empty_goal", action_set="v2")
        >>> _ = env.reset(seed=1)
        >>> _ = env.step(setpiece.Action.BUILTIN_AI)
        >>> env.played()["left_CB_1"] == setpiece.Action.RIGHT
        True
        """
        return self._native.played()

    def render(self) -> str | None:
        """Returns a drawing of the pitch in text, for `render_mode="ansi"`; None without a render mode."""
        return self._native.drawing() if self.render_mode == "ansi" else None

    def __repr__(self) -> str:
        return f"FootballEnv({self.scenario.name}, observation={self._observation}, agents={', '.join(self.agents)})"

    def __str__(self) -> str:
        return repr(self)


def make(
    scenario: Scenario | str | PathLike[str],
    *,
    left: Seats = None,
    right: Seats = None,
    opponents: Mapping[str, Opponent] | None = None,
    observation: str = "simple115v2",
    rewards: str | Sequence[str] | None = None,
    params: Mapping[str, ParamValue] | None = None,
    seed: int | None = None,
    events: bool = False,
    copy: bool = True,
    render_mode: str | None = None,
    watch: bool | Literal["now"] = False,
    on_reload: Callable[[Reload], object] | None = None,
    action_set: str = "default",
    bot_action: bool = False,
    stack: int = 1,
    size: tuple[int, int] = (96, 72),
    switching: Literal["auto", "fixed"] | None = None,
    record: str | PathLike[str] | None = None,
    record_when: When = "always",
) -> FootballEnv:
    """Makes an environment of a scenario.

    - `scenario`: a name of the library, the path of a `.pitch` or `.pitchc` file, or a `Scenario`.
    - `left`, `right`: how many agents play on each side: a count, `"all"`, a list of players' names; None: as the
      scenario says.
    - `opponents`: who plays some of these agents instead of the caller: by side (`"left"`, `"right"`) or by agent,
      who wins over his side:
      - `"bot"`: the built-in bot, or the player's own `ai` where the scenario gives him one;
      - a behaviour of the scenario, as `ai:` says it (`"marker(3m)"`, `"lazy"`), for a side: it plays all players of
        the side that have no agent of the caller's and no `ai` of their own;
      - a function of one agent's observation that returns its action, called agent by agent;
      - a `Policy`: with its own observation, over one agent or a batch of them;
      - an object with the `predict` of Stable-Baselines3, called with a batch;
      - the path of an `.onnx` file: see `setpiece.onnx_policy`.

      Everyone sees himself attack towards +x. An opponent that fails raises `OpponentError`.
    - `observation`: `"simple115v2"` or its forerunner `"simple115"` (float32 `(115,)`), `"smm"` (GRF's `extracted`;
      uint8 `(72, 96, 4)`), `"raw"` (a dict), `"egocentric"` (float32 `(n,)`: what the player sees from where he is, for
      any number of players) or `"vector"` (float32 `(n,)`: what the scenario's `observe vector` declares).
      `env.observation_layout` tells what stands where.
    - `stack`: how many observations are shown at once, on the last axis, the oldest first; the first one of an episode,
      or after `restore`, is shown so many times.
    - `size`: width and height of `"smm"`.
    - `switching`: whether the agents of a count change players (`"auto"`) or keep them (`"fixed"`); None: as the
      scenario says.
    - `rewards`: names that replace the scenario's own choice: `"scoring,checkpoints"` or a list.
    - `params`: parameters to bind: SI units, or strings as the language writes them.
    - `seed`: the seed of the first `reset` that gets none.
    - `events`: whether `info["events"]` lists what happened in each step.
    - `copy`: False returns the same array from every `reset` and `step`, overwritten by the next one; several agents
      beside opponents get copies.
    - `render_mode`: None or `"ansi"`.
    - `watch`: whether every `reset` takes over changes of the scenario's file, its imports and scripts; with `"now"`
      every `step` takes over those of scripts alone. A broken file leaves the last good scenario in place, and one
      that would change the spaces is held back.
    - `on_reload`: called with the `Reload` of every change; see also `env.unwrapped.last_reload`.
    - `action_set`: `"default"` (19 actions), `"v2"` (20: `Action.BUILTIN_AI` hands the step over to the bot), `"full"`
      (33: orders to team mates too) or `"continuous"` (a `Box` of float32 `(4,)`: x and y of the way to run, whose
      length is the pace; what to do with the ball, six kinds in equal parts of -1..1: nothing, short, long, high pass,
      shot, slide; and the power of a kick, 0..1: how hard a shot is and how far a pass goes, 0 as a key's).
    - `record`: a folder for replays of episodes, `{scenario}_{seed}_{index}.pitchr`: of all, of those with a goal
      (`record_when="goal"`), or of the first and each n-th after it (`record_when=n`). The last `info["setpiece"]` has
      `replay`, the path or None; `setpiece replay FILE` plays one again, and so does `setpiece.Replay`.
    - `bot_action`: whether `info["bot_action"]` tells, after `reset` and each `step`, what the bot would press now.

    Raises `UnknownScenarioError`, `FileError`, `CompileError`, `FormatError`, `RewardError` or `ParameterError`.

    >>> import setpiece
    >>> env = setpiece.make("academy_3_vs_1_with_keeper", rewards="scoring,checkpoints", seed=7)
    >>> observation, info = env.reset()
    >>> observation, reward, terminated, truncated, info = env.step(setpiece.Action.SHORT_PASS)
    >>> sorted(info)
    ['action_mask', 'reward_terms', 'score']
    """
    kwargs: dict[str, Any] = {
        "scenario": scenario,
        "left": left,
        "right": right,
        "opponents": opponents,
        "observation": observation,
        "rewards": rewards,
        "params": params,
        "seed": seed,
        "events": events,
        "copy": copy,
        "watch": watch,
        "on_reload": on_reload,
        "action_set": action_set,
        "bot_action": bot_action,
        "stack": stack,
        "size": size,
        "switching": switching,
        "record": record,
        "record_when": record_when,
    }
    env = FootballEnv(**kwargs, render_mode=render_mode)
    # So that `env.spec.make()` gives another one, as for environments that Gymnasium made.
    env.spec = EnvSpec(
        id=f"setpiece/{env.scenario.name}-v0",
        entry_point="setpiece._environment:FootballEnv",
        kwargs={**kwargs, "render_mode": render_mode},
    )
    return env


def _revived(
    kwargs: dict[str, Any],
    snapshot: tuple[bytes, bytes] | None,
    spec: EnvSpec | None,
    random: Any,
    random_seed: int | None,
) -> FootballEnv:
    """Returns the environment of a copy or pickle."""
    env = FootballEnv(**kwargs)
    if snapshot is not None:
        env.restore(snapshot[0])
        env._native.set_frames(snapshot[1])
    env.spec = spec
    env._np_random, env._np_random_seed = random, random_seed
    return env


@contextmanager
def _one_thread() -> Iterator[None]:
    try:
        yield
    except RuntimeError as error:
        # The binding's word for a second thread.
        if "borrowed" not in str(error):
            raise
        raise InUseError("another thread is using this environment: make one for each thread") from None


def _agents(native: _native.Environment) -> tuple[str, ...]:
    return tuple(agent.id for agent in native.agents)


def _reward_names(rewards: str | Sequence[str] | None) -> list[str] | None:
    if rewards is None:
        return None
    names = rewards.split(",") if isinstance(rewards, str) else rewards
    if not isinstance(names, Sequence) or not all(isinstance(name, str) for name in names):
        raise ParameterError(f"expected `rewards` as names, found `{rewards!r}`", name="rewards")
    return [name.strip() for name in names]


def _check_number(name: str, value: object) -> int:
    try:
        if isinstance(value, bool):
            raise TypeError
        number = index(value)  # type: ignore[arg-type]
    except TypeError:
        raise ParameterError(f"expected an integer as `{name}`, found `{value!r}`", name=name) from None
    if not 0 <= number <= NUMBER_MAX:
        raise ParameterError(f"`{name}` is {number}, outside 0..2**64-1", name=name)
    return number


def _check_snapshot(snapshot: object) -> bytes:
    if isinstance(snapshot, bytes | bytearray | memoryview):
        return bytes(snapshot)
    raise ParameterError(f"expected a snapshot as bytes, found `{type(snapshot).__name__}`", name="snapshot")


def _read_options(
    options: Mapping[str, Any] | None,
) -> tuple[int | None, dict[str, ParamValue] | None, bytes | None]:
    options = {} if options is None else options
    if not isinstance(options, Mapping):
        raise ParameterError(f"expected `options` as a mapping, found `{options!r}`", name="options")
    for key in options:
        if key not in RESET_OPTIONS:
            raise ParameterError(f"no reset option `{key}`; there are `{'`, `'.join(RESET_OPTIONS)}`", name=str(key))
    params = options.get("params")
    if params is not None and not isinstance(params, Mapping):
        raise ParameterError(f"expected `params` as a mapping, found `{params!r}`", name="params")
    episode = options.get("episode")
    if episode is not None:
        episode = _check_number("episode", episode)
    snapshot = options.get("snapshot")
    if snapshot is not None:
        snapshot = _check_snapshot(snapshot)
    return episode, None if params is None else dict(params), snapshot
