"""A scenario as a Gymnasium environment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from copy import deepcopy
from dataclasses import replace
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal, NoReturn

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from setpiece import _native
from setpiece._casting import scripted_scenario
from setpiece._env_options import RENDER_MODES, EnvArguments, EnvOptions
from setpiece._errors import CallbackError, DrawError, OpponentError, ParameterError, ScriptError
from setpiece._match import Match, match_of
from setpiece._native import Scenario
from setpiece._opponents import Table
from setpiece._options import (
    NUMBER_MAX,
    ParamValue,
    ResetOptions,
    check_number,
    check_path,
    check_snapshot,
    read_reset_options,
)
from setpiece._record import Record, When, read_record, write
from setpiece._reload import Reload, Watcher, check_watch
from setpiece._source import Source
from setpiece._spaces import Layout, check_observation, check_scale, observation_layout, observation_space
from setpiece._state import state_space
from setpiece._turn import Turn, one_thread

if TYPE_CHECKING:
    from typing_extensions import Unpack

COPIED = ("spec", "_np_random", "_np_random_seed", "_playing", "_same_agents")
"""Attributes that a copy or pickle has as they are."""


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
    or int64 `(n,)`), going on from what the agent holds. In the last step it has also:

    - `outcome`: the ending's name; `records`: the scenario's own records.
    - `setpiece`: `return` by term, `length` in steps, `seed`, `index`, `digest` of the final state, `success`: whether
      the ending is one that the scenario calls a success, whoever plays, `faults`: payments that were impossible (a
      division by zero) and left out, and `scenario`: the scenario's digest.

    With `opponents` some of the scenario's agents are played by others; the caller's are what is left, and all that is
    said above is said of those.

    `rewards` and `ends` may be functions, whose terms and labels stand among those of the scenario: see `make`. `reset`
    may go over to another scenario.

    With `watch=True` every `reset` looks whether the scenario's file, an import or a script has changed, and begins the
    episode under the new scenario; its `info` has `scenario`, the digest of what is played. With `watch="now"` every
    `step` looks too, and where nothing but scripts has changed it goes on with them at once, and with their memory. A
    change of the last 50 ms or so may wait for the next look.
    """

    metadata = {"render_modes": [*RENDER_MODES], "render_fps": 10}

    scenario: Scenario
    """The scenario, with the parameters it was made with."""
    agents: tuple[str, ...]
    """The caller's agents in order: a player's name, `left_CM_1`, or `left_0` for one that changes players."""

    def __init__(
        self,
        scenario: Source,
        *,
        watch: bool | Literal["now"] = False,
        on_reload: Callable[[Reload], object] | None = None,
        record: str | PathLike[str] | None = None,
        record_when: When = "always",
        **arguments: Unpack[EnvArguments],
    ) -> None:
        """Makes an environment; the arguments are those of `setpiece.make`."""
        options = EnvOptions.read(arguments)
        check_watch(watch)
        if watch and options.scripted:
            raise ParameterError("a watched file says itself who plays: write it there", name="watch")
        self._record = read_record(record, record_when)
        self._watcher = Watcher(scenario, watch, on_reload, allow_outside=options.allow_outside) if watch else None
        found = self._watcher.scenario if self._watcher else scripted_scenario(scenario, options, options.params)
        self._set_up(found, options)

    def _set_up(self, scenario: Scenario, options: EnvOptions) -> None:
        """Makes everything that isn't about files, before the first episode."""
        self._options, self.render_mode = options, options.render_mode
        self._callbacks = options.callbacks()
        # Whether another scenario must have the same agents, by name: PettingZoo's keep theirs.
        self._same_agents = False
        self._enter(self._ready(scenario))
        self.action_space, self.observation_space = self._match.action_space, self._match.observation_space
        if self._callbacks is not None and not self.agents:
            raise ParameterError("rewards and endings in Python judge an agent's step, and there is none", name="left")
        self._seed: int | None = None
        self._index = 0
        self._params: dict[str, ParamValue] = {}
        self._playing = False
        self._turn = Turn()

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Draws a new start and returns its observation and `info`.

        - `seed`: 0..2**64-1; begins a new series of episodes at index 0. Without it the index counts on. The start and
          the play are a function of seed, index, parameters and actions.
        - `options`:
          - `{"params": {…}}` binds parameters for this and the following episodes, until other `params` are given;
          - `{"scenario": …}` goes over to another scenario, given as to `setpiece.make`, under its own parameters and
            the `params` beside it: from here on the environment is one made with these two and the same arguments
            otherwise. The spaces must stay;
          - `{"episode": n}` sets the index;
          - `{"snapshot": bytes}` begins this episode in the state that a snapshot was taken in, of this scenario or of
            another with the same players and agents: places, ball, whatever goes on, score, cards, fatigue and clock
            are the snapshot's, rules, difficulty and limit the scenario's; rewards, records and random numbers begin
            anew.

        Raises `ParameterError` for options or parameters that are not there and for a scenario that would change the
        spaces, what `setpiece.make` does for one that can't be read, `SnapshotError` for a snapshot that does not fit,
        `DrawError` where no start meets the scenario's requirements, `CallbackError` where a reward or ending in Python
        or `on_reload` fails. The environment keeps its scenario then; a change of a watched file has been taken over
        all the same. A `reset` that is refused for what it was given leaves a running episode as it is; one that fails
        with `DrawError` or `CallbackError`, or that has taken over a change, ends it.
        """
        with self._turn:
            return self._begun(seed, read_reset_options(options))

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Plays 100 ms and returns observation, reward, terminated, truncated and `info`.

        - `action`: an integer 0..18 (0..19 with `action_set="v2"`, 0..32 with `"full"`), or for n agents n of
          them; with `"continuous"` four numbers, or `(n, 4)`.

        `terminated` is an ending of the scenario (a goal, the ball lost), `truncated` its time limit. Raises
        `ActionError` for another action, `ScriptError` where a script of the scenario fails, `OpponentError` where an
        opponent does, `CallbackError` where a reward or ending in Python or `on_reload` does; after these three a
        `reset` begins anew, with whatever change `on_reload` was to be told of.
        """
        with self._turn:
            if not self._playing:
                raise gymnasium.error.ResetNeeded("call `reset` before `step`: no episode is being played")
            try:
                if self._watcher is not None and self._watcher.at_once:
                    self._take_over(self._watcher, *self._watcher.at_step(self._match, self._options.params))
                match, table, given = self._match, self._match.table, action
                if table is not None:
                    action = table.actions(action, self.look)
                with one_thread:
                    observation, reward, terminated, truncated, info = match.native.step(action)
                observation, info = match.shown(observation, info)
                if table is not None:
                    reward = table.paid(reward)
                if self._callbacks is not None:
                    result = reward, terminated, truncated, info
                    reward, terminated, truncated, info = self._callbacks.judge(
                        match.slots, given, match.views(), result, match.end
                    )
            except (ScriptError, OpponentError, CallbackError):
                self._playing = False
                raise
            self._playing = not (terminated or truncated or self._turn.closed)
            if terminated or truncated:
                self._sum_up(info)
            return observation, reward, terminated, truncated, info

    def close(self) -> None:
        """Ends it: `reset` and `step` then raise Gymnasium's `ClosedEnvironmentError`."""
        self._playing, self._turn.closed = False, True
        super().close()

    def save_replay(self, path: str | PathLike[str]) -> None:
        """Writes the episode as far as it has been played: `setpiece replay FILE` plays it again, bit for bit.

        Raises `ReplayError` before the first episode, after `restore` and with scripts that have changed in its middle,
        `FileError` where it can't be written, `ParameterError` where `path` is no path.
        """
        with one_thread:
            write(check_path("path", path), self._native.replay())

    def snapshot(self) -> bytes:
        """Returns the whole episode as it stands, in some kilobytes: see `restore`.

        The bytes hold the match in the middle of whatever goes on, rewards, records, scripts' memory and the streams of
        random numbers; they are the same on every machine, and good for this version of the scenario. Raises
        `SnapshotError` where a script keeps a function in its memory.
        """
        with one_thread:
            return self._native.snapshot()

    def restore(self, snapshot: bytes) -> tuple[Any, dict[str, Any]]:
        """Goes on where a snapshot was taken, by whichever environment of this scenario, rewards and agents.

        Returns the observation and `info` of the step after which it was taken; every later step is that of the
        straight run, but for what opponents, and rewards and endings in Python, remember. Behaviours and scripts among
        the `opponents` make another scenario: its snapshots are for environments with the same ones. Raises
        `SnapshotError` for anything else, and nothing has changed then; `ClosedEnvironmentError` for a closed
        environment.
        """
        snapshot = check_snapshot(snapshot)
        with self._turn:
            with one_thread:
                observation, info = self._native.restore(snapshot)
                views = self._match.views() if self._callbacks is not None else []
            episode = self._native.episode
            if episode is not None:
                self._seed, self._index = episode.seed, (episode.index + 1) & NUMBER_MAX
                self._params = self._native.params
            self._playing = self._native.running
            if "setpiece" in info:
                info["setpiece"]["scenario"] = self._match.digest
            observation, info = self._match.shown(observation, info)
            if self._callbacks is not None:
                self._callbacks.go_on(views, info)
            return observation, info

    @property
    def last_reload(self) -> Reload | None:
        """What became of the last change of the scenario's files; None before the first."""
        return None if self._watcher is None else self._watcher.last

    @property
    def slots(self) -> list[_native.AgentInfo]:
        """All agents of the scenario in order, the opponents' too.

        `id`, `team` (0 left, 1 right) and `place`: the place in its team of the player it keeps, None where it changes
        players.
        """
        with one_thread:
            return self._native.agents

    @property
    def observation(self) -> str:
        """What the caller's agents see: a name of `setpiece.make`."""
        return self._options.observation

    @property
    def observation_layout(self) -> Layout:
        """How one agent's observation lies: the blocks of an array's last axis, or the keys of a dict.

        >>> import setpiece
        >>> setpiece.make("academy_corner").observation_layout[4]
        Block(start=88, length=3, meaning='ball x, y, z', unit='normalised; z in metres')
        """
        with one_thread:
            return observation_layout(self._native, self._options.observation, self._options.stack)

    @property
    def action_set(self) -> str:
        """The caller's actions: `"default"`, `"v2"`, `"full"` or `"continuous"`."""
        return self._options.action_set

    def look(self, observation: str, scale: bool = False) -> Any:
        """Returns what all of `slots` see now in an observation of any kind, whatever the environment's own.

        `scale` is that of `setpiece.make`. Looking changes nothing. Raises `ResetNeeded` before the first episode.

        >>> import setpiece
        >>> env = setpiece.make("academy_corner")
        >>> _ = env.reset(seed=1)
        >>> env.look("raw")["steps_left"].item()
        400
        """
        kind = check_observation(observation)
        scale = check_scale(scale, kind)
        with one_thread:
            if self._native.episode is None:
                raise gymnasium.error.ResetNeeded("call `reset` before `look`: there is nothing to be seen yet")
            return self._native.look(kind, scale)

    def clone(self) -> FootballEnv:
        """Returns an independent environment in the same state, with the same opponents; it doesn't watch or record.

        Raises `CallbackError` for a reward or ending in Python that can't be copied, else what `snapshot` does.

        >>> import setpiece
        >>> env = setpiece.make("academy_corner")
        >>> _ = env.reset(seed=1)
        >>> other = env.clone()
        >>> env.step(setpiece.Action.SHOT)[1] == other.step(setpiece.Action.SHOT)[1]
        True
        """
        return deepcopy(self)

    def __getstate__(self) -> dict[str, Any]:
        """Returns what copies and pickles are made of: the options, the scenario and a snapshot of the episode.

        A copy doesn't watch or record.
        """
        begun = self._native.episode is not None
        return {
            # The scenario is bound already; another one that a `reset` gives has its own parameters.
            "options": replace(self._options, params={}),
            "scenario": self.scenario,
            "snapshot": self.snapshot() if begun else None,
            # Neither a stack of frames nor what opponents were shown follows from the snapshot.
            "frames": self._native.frames() if begun else None,
            "seen": None if self._table is None else self._table.seen,
            "tally": None if self._callbacks is None else self._callbacks.tally,
            "closed": self._turn.closed,
            "attributes": {name: getattr(self, name) for name in COPIED},
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Makes the environment of a copy or pickle."""
        self._record, self._watcher = None, None
        self._set_up(state["scenario"], state["options"])
        if state["snapshot"] is not None:
            self.restore(state["snapshot"])
            self._native.set_frames(state["frames"])
        if self._table is not None:
            self._table.seen = state["seen"]
        if self._callbacks is not None:
            self._callbacks.tally = state["tally"]
        for name, value in state["attributes"].items():
            setattr(self, name, value)
        self._turn.closed = state["closed"]

    def __deepcopy__(self, memo: dict[int, Any]) -> FootballEnv:
        """A copy shares its opponents: they may be large, or hold what can't be copied."""
        state = self.__getstate__()
        options = state.pop("options").copied(memo)
        spec = state["attributes"].pop("spec")
        copy = type(self).__new__(type(self))
        copy.__setstate__({**deepcopy(state, memo), "options": options})
        copy.spec = spec
        return copy

    @property
    def _native(self) -> _native.Environment:
        return self._match.native

    @property
    def _table(self) -> Table | None:
        return self._match.table

    def _enter(self, match: Match) -> None:
        """Goes over to a match."""
        self._match = match
        self.scenario, self.agents = match.scenario, match.agents

    def _ready(self, scenario: Scenario, params: Mapping[str, ParamValue] | None = None) -> Match:
        """Makes a scenario ready under parameters; None: those that the environment was made with."""
        bound = self._options.params if params is None else params
        return match_of(scenario.with_params(**bound), self._options)

    def _begun(self, seed: int | None, wanted: ResetOptions) -> tuple[Any, dict[str, Any]]:
        """Begins an episode: see `reset`."""
        switched = None if wanted.scenario is None else self._switched(wanted.scenario, wanted.params)
        if seed is None and self._seed is None:
            seed = self._options.seed
        if seed is not None:
            seed = check_number("seed", seed)
        number, at = (self._seed, self._index) if seed is None else (seed, 0)
        if number is None:
            number = int(self.np_random.integers(2**63))
        at = at if wanted.episode is None else wanted.episode
        params = self._params if wanted.params is None else wanted.params
        if switched is not None:
            # Its parameters are bound already, as those of `make` are.
            params = {}
        if self._watcher is not None:
            before, running = self._match, self._playing
            self._playing = False
            self._take_over(self._watcher, *self._watcher.at_reset(before, self._ready))
            self._playing = running and self._match is before
        match = self._match if switched is None else switched
        if self._playing and (switched, wanted.params, wanted.snapshot) != (None, None, None):
            self._rehearse(switched, number, at, params, wanted.snapshot)
        self._playing = False
        super().reset(seed=seed)
        with one_thread:
            observation, info = match.native.reset(number, at, params, wanted.snapshot)
            views = match.views() if self._callbacks is not None else []
        observation, info = match.shown(observation, info)
        if self._callbacks is not None:
            self._callbacks.begin(views, info)
        # A reset that fails leaves no trace, but that nothing may be played any more.
        if switched is not None:
            self._enter(switched)
        self._seed, self._index, self._params = number, (at + 1) & NUMBER_MAX, params
        if self._watcher is not None:
            info["scenario"] = self._match.digest
        # A reward's `reset` may have closed it.
        self._playing = not self._turn.closed
        return observation, info

    def _rehearse(
        self, switched: Match | None, seed: int, episode: int, params: dict[str, ParamValue], snapshot: bytes | None
    ) -> None:
        """Raises what a `reset` is refused for, before it touches the running episode.

        A native `reset` that refuses has forgotten what was played, and maybe bound the parameters.
        """
        native = _native.Environment(self.scenario, self._options) if switched is None else switched.native
        # No refusals: those come again, and end the episode.
        with one_thread, suppress(DrawError, ScriptError):
            _, info = native.reset(seed, episode, params, snapshot)
            if self._callbacks is not None:
                self._callbacks.check(info)

    def _take_over(self, watcher: Watcher, match: Match, reload: Reload | None) -> None:
        """Plays another match from here on, and tells of the change that brought it."""
        self._enter(match)
        if reload is not None:
            watcher.tell(reload)

    def _switched(self, source: Source, params: Mapping[str, ParamValue] | None) -> Match:
        """Makes another scenario ready that can be played in this environment."""
        if self._watcher is not None:
            raise ParameterError(
                "an environment that watches its scenario's file plays no other",
                name="scenario",
                help="leave out `watch`",
            )
        match = self._ready(scripted_scenario(source, self._options, params or {}), params or {})
        change = match.change(self._match, agents=self._same_agents, players=self._same_agents)
        if change is not None:
            raise ParameterError(
                f"`{match.scenario.name}` can't be played in this environment: {change}",
                name="scenario",
                help="make another environment for it",
            )
        return match

    def _sum_up(self, info: dict[str, Any]) -> None:
        """Completes the summary of an episode that has ended."""
        summary = info["setpiece"]
        summary["scenario"] = self._match.digest
        if self._record is not None:
            summary["replay"] = self._record.end(self._native, self.scenario.name, info["score"])

    def action_masks(self) -> NDArray[np.int8]:
        """Returns what `info["action_mask"]` shows now: 1 where an action can change something, else 0."""
        with one_thread:
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
        with one_thread:
            return self._native.played()

    def render(self) -> str | None:
        """Returns a drawing of the pitch in text, for `render_mode="ansi"`; None without a render mode."""
        if self.render_mode is None:
            return None
        with one_thread:
            return self._native.drawing()

    def __repr__(self) -> str:
        agents = ", ".join(self.agents)
        return f"FootballEnv({self.scenario.name}, observation={self._options.observation}, agents={agents})"

    def __str__(self) -> str:
        return repr(self)

    def seats(self) -> Seats:
        """Returns what `ParallelFootballEnv` needs of this environment, for this package alone.

        From now on `reset` goes over only to scenarios with the same agents and as many players.
        """
        self._same_agents = True
        return Seats(self)


class Seats:
    """The agents of an environment one by one: what its public methods don't say."""

    def __init__(self, env: FootballEnv) -> None:
        self._env = env
        slots = env.slots
        self.spaces: dict[str, spaces.Space[Any]] = {
            slot.id: observation_space(env._native, env.observation, [slot]) for slot in slots
        }
        self.state_space = state_space(env._native.players)

    @property
    def playing(self) -> bool:
        """Whether an episode is being played, so that `step` may be called."""
        return self._env._playing

    def sent_off(self) -> set[str]:
        """Returns the ids of the agents whose players have been sent off."""
        native = self._env._native
        return {agent.id for agent, gone in zip(native.agents, native.gone, strict=True) if gone}

    def refuse(self, why: str) -> NoReturn:
        """Raises Gymnasium's `ResetNeeded`; of a closed environment, or in the middle of a step, the error for that."""
        with self._env._turn:
            raise gymnasium.error.ResetNeeded(why)

    def truncate(self, label: str, info: dict[str, Any]) -> None:
        """Ends the episode by a limit of the caller's, and adds the outcome to the `info` of its last step."""
        env = self._env
        info.update(env._match.end(label, truncated=True))
        if env._callbacks is not None:
            info["setpiece"]["return"].update(env._callbacks.tally)
        env._playing = False
        env._sum_up(info)

    def record(self, record: Record, info: dict[str, Any]) -> str | None:
        """Records the episode that has ended; returns where, if it is written."""
        return record.end(self._env._native, self._env.scenario.name, info["score"])
