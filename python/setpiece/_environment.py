"""A scenario as a Gymnasium environment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from copy import deepcopy
from dataclasses import replace
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal

import gymnasium
import numpy as np
from numpy.typing import NDArray

from setpiece import _native
from setpiece._casting import scripted_scenario
from setpiece._env_options import CAMERAS, RENDER_MODES, EnvArguments, EnvOptions, begun_in
from setpiece._errors import CallbackError, DrawError, OpponentError, ParameterError, ScriptError
from setpiece._match import Match, match_of
from setpiece._native import Moment, Scenario
from setpiece._opponents import Table
from setpiece._options import (
    NUMBER_MAX,
    ParamValue,
    check_flag,
    check_number,
    check_path,
    check_snapshot,
)
from setpiece._record import When, read_record, write
from setpiece._reload import Reload, Watcher, check_watch
from setpiece._reset import ResetOptions, read_reset_options
from setpiece._source import Source
from setpiece._spaces import (
    PICTURE_MAX,
    Layout,
    check_observation,
    check_scale,
    check_size,
    observation_layout,
)
from setpiece._taken_seats import TakenSeats
from setpiece._turn import Turn, one_thread
from setpiece._window import Window
from setpiece._words import check_word

if TYPE_CHECKING:
    from typing_extensions import Unpack

Mirror = Callable[[Callable[[], bytes]], object]
"""Takes an episode that has ended: a function that returns its replay."""

COPIED = ("spec", "_np_random", "_np_random_seed", "_playing", "_same_agents", "_level")
"""Attributes that a copy or pickle keeps unchanged."""


class FootballEnv(gymnasium.Env[Any, Any]):
    """One match of a scenario, judged by the scenario's own rewards and endings.

    Actions are `Action` numbers, 0..18. Observations are in the agent's own frame: it always
    attacks towards +x.

    - One agent: action `Discrete(19)`, reward a float, observation without an agent axis.
    - n agents: action `MultiDiscrete([19] * n)`, reward float32 `(n,)`, observation with a leading
      axis n (a tuple of n dicts for `"raw"`), left team's agents first.
    - No agents (`agents { left: 0 }`): like n agents with n = 0. The bots play, `step([])` advances
      the match, and `info`, `played` and `render` show it.

    With `action_set="v2"` there is a 20th action, `Action.BUILTIN_AI`: the bot (or the behaviour of
    the scenario's player) plays this step, and the agent's held keys are released.

    In every step `info` has `score` [left, right], `reward_terms` {"reward/label": paid in this
    step} and `action_mask` (int8 `(19,)`, or `(n, 19)`; 20 with `v2`, 33 with `full`, the 6 kinds
    with `continuous`). With `events=True` it also has `events`. With `bot_action=True` it also has
    `bot_action`: what the bot would press in the observed state (an int, or int64 `(n,)`), relative
    to what the agent holds. In the last step it also has:

    - `outcome`: the ending's name; `records`: the scenario's own records.
    - `setpiece`: a dict with `return` by term, `length` in steps, `seed`, `index`, `level` (the
      text with which `reset` begins the episode again), `digest` of the final state, `success`:
      whether the ending is one that the scenario calls a success, whoever plays, `faults`: payments
      that were impossible (a division by zero) and dropped, and `scenario`: the scenario's digest.

    With `opponents`, others play some of the scenario's agents. The caller has the remaining ones,
    and everything above refers to those.

    `rewards` and `ends` may be functions; their terms and labels appear among those of the
    scenario: see `make`. `reset` may switch to another scenario.

    With `watch=True` every `reset` checks whether the scenario's file, an import or a script has
    changed, and begins the episode with the new scenario; its `info` has `scenario`, the digest of
    the scenario in use. With `watch="now"` every `step` checks too: if only scripts have changed,
    they are replaced at once and keep their memory. A change of the last 50 ms or so may wait for
    the next check.
    """

    metadata = {"render_modes": [*RENDER_MODES], "render_fps": 10}

    scenario: Scenario
    """The scenario, with the parameters it was made with."""
    agents: tuple[str, ...]
    """The caller's agents in order: a player's name, `left_CM_1`, or `left_0` if it can switch."""
    source: Source
    """What it was made of; for a copy its scenario."""
    mirrors: list[Mirror]
    """Called with a way to the replay of each episode that ends: see `setpiece.studio`."""

    def __init__(
        self,
        scenario: Source,
        *,
        watch: bool | Literal["now"] = False,
        on_reload: Callable[[Reload], object] | None = None,
        record: str | PathLike[str] | None = None,
        record_when: When = "always",
        record_quality: str | None = None,
        **arguments: Unpack[EnvArguments],
    ) -> None:
        """Makes an environment; the arguments are those of `setpiece.make`."""
        options = EnvOptions.read(arguments)
        check_watch(watch)
        if watch and options.scripted:
            raise ParameterError(
                "a watched file says itself who plays: write it there", name="watch"
            )
        self._record = read_record(record, record_when, record_quality)
        scenario, self._level, options = begun_in(scenario, options)
        self.source = scenario
        self._watcher = (
            Watcher(scenario, watch, on_reload, allow_outside=options.allow_outside)
            if watch
            else None
        )
        found = (
            self._watcher.scenario
            if self._watcher
            else scripted_scenario(scenario, options, options.params)
        )
        if self._level is not None:
            # A path may have stood for the name.
            self._level = replace(self._level, scenario=found.name)
            self._level.check(found)
        self._set_up(found, options)

    def _set_up(self, scenario: Scenario, options: EnvOptions) -> None:
        """Sets up everything except files, before the first episode."""
        self.mirrors = []
        self._options, self.render_mode = options, options.render_mode
        self._callbacks = options.callbacks()
        self._window: Window | None = None
        # Whether another scenario must have the same agents, by name: PettingZoo's agents are
        # fixed.
        self._same_agents = False
        self._enter(self._ready(scenario))
        self.action_space, self.observation_space = (
            self._match.action_space,
            self._match.observation_space,
        )
        if self._callbacks is not None and not self.agents:
            raise ParameterError(
                "rewards and endings in Python judge an agent's step, and there is none",
                name="left",
            )
        self._seed: int | None = None
        self._index = 0
        self._params: dict[str, ParamValue] = {}
        self._playing = False
        self._turn = Turn()

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Draws a new start and returns its observation and `info`.

        - `seed`: 0..2**64-1; starts a new series of episodes at index 0. Without it the index
          continues. The start and the play are a function of seed, index, parameters and actions.
        - `options`:
          - `{"params": {…}}` binds parameters for this and the following episodes, until other
            `params` are given;
          - `{"scenario": …}` switches to another scenario, in any form that `setpiece.make`
            accepts, with its own parameters and the given `params`. From then on the environment is
            like one made with these two and otherwise the same arguments. The spaces must stay;
          - `{"episode": n}` sets the index;
          - `{"level": …}` begins the episode of a level: a `Level`, its text as in an earlier
            `info["setpiece"]["level"]`, or a dict with the keys of its JSON (`scenario`, `params`,
            `seed`, `episode`, `digest`). It stands for `seed`, `params` and `episode`, and is of
            the environment's scenario, or of the `scenario` given with it;
          - `{"snapshot": bytes}` begins this episode in the state of a snapshot of this scenario,
            or of another with the same players and agents. Places, ball, everything under way,
            score, cards, fatigue and clock are the snapshot's; rules, difficulty and limit are the
            scenario's; rewards, records and random numbers start as at any reset.

        An environment that was made of a level begins it again if neither is given.

        Raises `LevelError` for a level of another scenario, `ParameterError` for unknown options or
        parameters and for a scenario that would change the spaces, what `setpiece.make` does for
        one that can't be read, `SnapshotError` for a snapshot that doesn't fit, `DrawError` if no
        start meets the scenario's requirements, `CallbackError` if a reward or ending in Python or
        `on_reload` fails. The environment then keeps its scenario, but a changed watched file has
        still been reloaded. A `reset` that is rejected because of its arguments doesn't change a
        running episode. One that fails with `DrawError` or `CallbackError`, or that has reloaded a
        change, ends it.
        """
        with self._turn:
            if self._level is not None and seed is None and not options:
                options = {"level": self._level}
            begun = self._begun(read_reset_options(seed, options))
        if self.render_mode == "human":
            self.render()
        return begun

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Plays 100 ms and returns observation, reward, terminated, truncated and `info`.

        - `action`: an integer 0..18 (0..19 with `action_set="v2"`, 0..32 with `"full"`), or for n
          agents n of them; with `"continuous"` four numbers, or `(n, 4)`.

        `terminated` is an ending of the scenario (a goal, the ball lost), `truncated` its time
        limit. Raises `ActionError` for another action, `ScriptError` if a script of the scenario
        fails, `OpponentError` if an opponent fails, `CallbackError` if a reward or ending in Python
        or `on_reload` fails. After the last three only `reset` can continue, with the change that
        `on_reload` was called for.
        """
        with self._turn:
            if not self._playing:
                raise gymnasium.error.ResetNeeded(
                    "call `reset` before `step`: no episode is being played"
                )
            try:
                if self._watcher is not None and self._watcher.at_once:
                    self._take_over(
                        self._watcher, *self._watcher.at_step(self._match, self._options.params)
                    )
                match, table, given = self._match, self._match.table, action
                if table is not None:
                    native = match.native
                    action = table.actions(action, self.look, native.action_mask, native.steps)
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
        if self.render_mode == "human":
            self.render()
        return observation, reward, terminated, truncated, info

    def close(self) -> None:
        """Closes the environment; `reset` and `step` then raise `ClosedEnvironmentError`."""
        self._playing, self._turn.closed = False, True
        if self._window is not None:
            self._window.close()
        super().close()

    def save_replay(self, path: str | PathLike[str]) -> None:
        """Writes the episode as far as it has been played.

        `setpiece replay FILE` plays it again, bit for bit. Raises `ReplayError` before the first
        episode, after `restore`, and if scripts have changed during the episode; `FileError` if it
        can't be written; `ParameterError` if `path` isn't a path.
        """
        with one_thread:
            write(check_path("path", path), self._native.replay())

    def snapshot(self) -> bytes:
        """Returns the whole current episode as bytes, a few kilobytes: see `restore`.

        The bytes hold the match at any moment, rewards, records, scripts' memory and random
        streams. They are the same on every machine, and valid for this version of the scenario.
        Raises `SnapshotError` if a script keeps a function in its memory.
        """
        with one_thread:
            return self._native.snapshot()

    def restore(self, snapshot: bytes) -> tuple[Any, dict[str, Any]]:
        """Continues from a snapshot of any environment with this scenario, rewards and agents.

        Returns the observation and `info` of the step after which it was taken. Later steps equal
        those of the original run, except for the memory of opponents and of rewards and endings in
        Python. Behaviours and scripts among the `opponents` make another scenario: its snapshots
        are for environments with the same ones. Raises `SnapshotError` for anything else, without
        any change; `ClosedEnvironmentError` for a closed environment.
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
        """The result of the last change of the scenario's files; None before the first."""
        return None if self._watcher is None else self._watcher.last

    @property
    def level(self) -> str:
        """The level that is played, as text.

        Raises `ResetNeeded` before the first `reset`.
        """
        with one_thread:
            level = self._native.level
        if level is None:
            raise gymnasium.error.ResetNeeded("call `reset` first: no level is being played")
        return level

    @property
    def slots(self) -> list[_native.AgentInfo]:
        """All agents of the scenario in order, including the opponents'.

        `id`, `team` (0 left, 1 right) and `place`: the index in its team of the player it keeps,
        None if it changes players.
        """
        with one_thread:
            return self._native.agents

    @property
    def observation(self) -> str:
        """The kind of observation of the caller's agents: a name of `setpiece.make`."""
        return self._options.observation

    @property
    def sight(self) -> tuple[str, bool]:
        """The kind of observation of the caller's agents, and whether it is scaled."""
        return self._options.observation, self._options.scale

    @property
    def observation_layout(self) -> Layout:
        """The layout of one agent's observation: an array's blocks, or a dict's keys.

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
        """Returns what all of `slots` see now, in any kind of observation.

        `scale` is that of `setpiece.make`. Looking changes nothing. Raises `ResetNeeded` before the
        first episode.

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
                raise gymnasium.error.ResetNeeded(
                    "call `reset` before `look`: there is nothing to be seen yet"
                )
            return self._native.look(kind, scale)

    def clone(self) -> FootballEnv:
        """Returns an independent environment in the same state, with the same opponents.

        It doesn't watch or record. Raises `CallbackError` for a reward or ending in Python that
        can't be copied, otherwise like `snapshot`.

        >>> import setpiece
        >>> env = setpiece.make("academy_corner")
        >>> _ = env.reset(seed=1)
        >>> other = env.clone()
        >>> env.step(setpiece.Action.SHOT)[1] == other.step(setpiece.Action.SHOT)[1]
        True
        """
        return deepcopy(self)

    def __getstate__(self) -> dict[str, Any]:
        """Returns the state for copies and pickles: options, scenario and a snapshot.

        A copy doesn't watch or record.
        """
        begun = self._native.episode is not None
        return {
            # The scenario is already bound; another one passed to `reset` has its own parameters.
            "options": replace(self._options, params={}),
            "scenario": self.scenario,
            "snapshot": self.snapshot() if begun else None,
            # The snapshot contains neither a stack of frames nor what opponents were shown and press.
            "frames": self._native.frames() if begun else None,
            "seen": None if self._table is None else self._table.seen,
            "held": None if self._table is None else self._table.held,
            "tally": None if self._callbacks is None else self._callbacks.tally,
            "closed": self._turn.closed,
            "attributes": {name: getattr(self, name) for name in COPIED},
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restores the environment of a copy or pickle."""
        self._record, self._watcher = None, None
        self._set_up(state["scenario"], state["options"])
        self.source = state["scenario"]
        if state["snapshot"] is not None:
            self.restore(state["snapshot"])
            self._native.set_frames(state["frames"])
        if self._table is not None:
            self._table.seen, self._table.held = state["seen"], state["held"]
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
        """Switches to a match."""
        self._match = match
        self.scenario, self.agents = match.scenario, match.agents

    def _ready(self, scenario: Scenario, params: Mapping[str, ParamValue] | None = None) -> Match:
        """Prepares a scenario with parameters; None: those that the environment was made with."""
        bound = self._options.params if params is None else params
        return match_of(scenario.with_params(**bound), self._options)

    def _begun(self, wanted: ResetOptions) -> tuple[Any, dict[str, Any]]:
        """Begins an episode: see `reset`."""
        seed = wanted.seed
        switched = (
            None if wanted.scenario is None else self._switched(wanted.scenario, wanted.params)
        )
        if seed is None and self._seed is None and self._options.seed is not None:
            seed = check_number("seed", self._options.seed)
        number, at = (self._seed, self._index) if seed is None else (seed, 0)
        if number is None:
            number = int(self.np_random.integers(2**63))
        at = at if wanted.episode is None else wanted.episode
        params = self._params if wanted.params is None else wanted.params
        if switched is not None:
            # Its parameters are already bound, like those of `make`.
            params = {}
        if self._watcher is not None:
            before, running = self._match, self._playing
            self._playing = False
            self._take_over(self._watcher, *self._watcher.at_reset(before, self._ready))
            self._playing = running and self._match is before
        match = self._match if switched is None else switched
        if wanted.level is not None:
            wanted.level.check(match.scenario)
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
        # A failed reset leaves no trace, except that no episode is running.
        if switched is not None:
            self._enter(switched)
            self._level = None
        self._seed, self._index, self._params = number, (at + 1) & NUMBER_MAX, params
        if self._watcher is not None:
            info["scenario"] = self._match.digest
        # A reward's `reset` may have closed it.
        self._playing = not self._turn.closed
        return observation, info

    def _rehearse(
        self,
        switched: Match | None,
        seed: int,
        episode: int,
        params: dict[str, ParamValue],
        snapshot: bytes | None,
    ) -> None:
        """Raises what a `reset` is rejected for, before it affects the running episode.

        A native `reset` that fails has already dropped the running episode, and may have bound the
        parameters.
        """
        native = (
            _native.Environment(self.scenario, self._options)
            if switched is None
            else switched.native
        )
        # These aren't rejections: they would be raised again, and end the episode.
        with one_thread, suppress(DrawError, ScriptError):
            _, info = native.reset(seed, episode, params, snapshot)
            if self._callbacks is not None:
                self._callbacks.check(info)

    def _take_over(self, watcher: Watcher, match: Match, reload: Reload | None) -> None:
        """Switches to another match, and reports the change that caused it."""
        self._enter(match)
        if reload is not None:
            watcher.tell(reload)

    def _switched(self, source: Source, params: Mapping[str, ParamValue] | None) -> Match:
        """Prepares another scenario that can be played in this environment."""
        if self._watcher is not None:
            raise ParameterError(
                "an environment that watches its scenario's file can't switch to another",
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
            if self._record.quality is not None:
                summary["video"] = self._record.video
        for mirror in self.mirrors:
            mirror(self._native.replay)

    def action_masks(self) -> NDArray[np.int8]:
        """Returns the current `info["action_mask"]`: 1 for actions with an effect, else 0."""
        with one_thread:
            mask = self._native.action_mask()
        return mask if self._table is None else self._table.mask(mask)

    def played(self) -> dict[str, int]:
        """Returns what every player pressed in the last step, by their name.

        The values are `Action` numbers in the player's own frame. An agent's player has the agent's
        action. A scripted player has the behaviour's action (19 if it hands over to the bot).
        Everyone else has the bot's play expressed as actions: a stream over the steps, in which
        each press is relative to the earlier ones. Players that nobody plays are left out.

        >>> import setpiece
        >>> env = setpiece.make("academy_empty_goal", action_set="v2")
        >>> _ = env.reset(seed=1)
        >>> _ = env.step(setpiece.Action.BUILTIN_AI)
        >>> env.played()["left_CB_1"] == setpiece.Action.RIGHT
        True
        """
        with one_thread:
            return self._native.played()

    def render(self) -> str | NDArray[np.uint8] | None:
        """Returns what `render_mode` says: text, a picture, or None.

        `"human"` shows the picture in its window. Raises `ResetNeeded` for a picture before the
        first episode.
        """
        mode = self.render_mode
        if mode is None:
            return None
        if mode == "ansi":
            with one_thread:
                return self._native.drawing()
        frame = self.picture()
        if mode == "rgb_array":
            return frame
        if self._window is None:
            self._window = Window(self.scenario.name, self.metadata["render_fps"])
        self._window.show(frame)
        return None

    def moments(self) -> list[Moment]:
        """Returns what the last step led to, for the drop-in's videos; for this package alone."""
        with one_thread:
            return self._native.moments()

    def picture(
        self,
        size: tuple[int, int] | None = None,
        camera: str | None = None,
        *,
        news: bool = True,
    ) -> NDArray[np.uint8]:
        """Returns a picture of the match for people, uint8 `(height, width, 3)`.

        - `size`: width and height, each at most 4096; None: the `render_size`.
        - `camera`: `"broadcast"` or `"above"`; None: the environment's `camera`.
        - `news`: whether a banner shows what has just happened (a goal, a card). Without it the
          picture depends on the state alone: a restored snapshot gives the same one.

        It needs no `render_mode`. Raises `ResetNeeded` before the first episode.

        >>> import setpiece
        >>> env = setpiece.make("academy_corner")
        >>> _ = env.reset(seed=1)
        >>> env.picture((640, 360)).shape
        (360, 640, 3)
        """
        options = self._options
        size = options.render_size if size is None else check_size(size, PICTURE_MAX)
        camera = options.camera if camera is None else check_word("camera", camera, CAMERAS)
        with one_thread:
            if self._native.episode is None:
                raise gymnasium.error.ResetNeeded(
                    "call `reset` before `render`: there is nothing to be seen yet"
                )
            return self._native.frame(size, camera, check_flag("news", news))

    def __repr__(self) -> str:
        agents = ", ".join(self.agents)
        return f"FootballEnv({self.scenario.name}, observation={self._options.observation}, agents={agents})"

    def __str__(self) -> str:
        return repr(self)

    def seats(self) -> TakenSeats:
        """Returns what `ParallelFootballEnv` needs of this environment, for this package alone.

        From now on `reset` goes over only to scenarios with the same agents and as many players.
        """
        self._same_agents = True
        return TakenSeats(self)
