"""`setpiece.make`: a scenario's environment, with all options."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from typing import Any, Literal

from gymnasium.envs.registration import EnvSpec

from setpiece._callbacks import Ends, Rewards
from setpiece._environment import FootballEnv
from setpiece._opponents import Opponent
from setpiece._options import ParamValue
from setpiece._record import When
from setpiece._reload import Reload
from setpiece._seats import Seats
from setpiece._source import Source


def make(
    scenario: Source,
    *,
    left: Seats = None,
    right: Seats = None,
    opponents: Mapping[str, Opponent] | None = None,
    observation: str = "simple115v2",
    rewards: Rewards = None,
    ends: Ends = None,
    params: Mapping[str, ParamValue] | None = None,
    seed: int | None = None,
    events: bool = False,
    copy: bool = True,
    render_mode: str | None = None,
    render_size: tuple[int, int] = (1280, 720),
    camera: str = "broadcast",
    watch: bool | Literal["now"] = False,
    on_reload: Callable[[Reload], object] | None = None,
    action_set: str = "default",
    bot_action: bool = False,
    stack: int = 1,
    size: tuple[int, int] = (96, 72),
    scale: bool = False,
    switching: Literal["auto", "fixed"] | None = None,
    record: str | PathLike[str] | None = None,
    record_when: When = "always",
    record_quality: str | None = None,
    allow_outside: bool = False,
) -> FootballEnv:
    """Makes an environment of a scenario.

    - `scenario`: a name of the library, the path of a `.pitch` or `.pitchc` file, a `Scenario`, a
      text (a string with a `{`), or a dict: see `ScenarioDict`. `setpiece.load` chooses one of
      several in a file. A level, as a `Level` or its text, is one episode, which every `reset`
      begins again that gets neither a seed nor options.
    - `left`, `right`: how many agents play on each side: a count, `"all"`, a list of players'
      names; None: as the scenario says.
    - `opponents`: what plays some of these agents instead of the caller: by side (`"left"`,
      `"right"`) or by agent, which takes precedence over its side:
      - `"bot"`: the built-in bot, or the player's own `ai` if the scenario has one;
      - a behaviour of the scenario, written as after `ai:` (`"marker(3m)"`, `"lazy"`). For a side
        it plays all players without an agent of the caller's and without an `ai` of their own; for
        an agent, the player that the agent keeps;
      - a script: the path of a `.rhai` file with an `act` hook, used like a behaviour;
      - a function from one agent's observation to its action, called agent by agent;
      - a `Policy`: with its own observation, for one agent or a batch of them;
      - an object with the `predict` of Stable-Baselines3, called with a batch;
      - the path of an `.onnx` file: see `setpiece.onnx_policy`;
      - `"baseline"`: the policy of the library's scenario with the same players and start, if it
        has one.

      Every agent sees itself attacking towards +x. An opponent that fails raises `OpponentError`.
    - `observation`: what an agent sees; `env.observation_layout` describes its layout.
      - `"simple115v2"` or its predecessor `"simple115"`: float32 `(115,)`;
      - `"simple115v2+sticky"`: float32 `(125,)`, `simple115v2` and the held keys, which masks
        depend on;
      - `"egocentric"`: float32 `(n,)`, what the player sees from their own place, for any number of
        players;
      - `"vector"`: float32 `(n,)`, what the scenario's `observe vector` declares;
      - `"smm"` (GRF's `extracted`): uint8 `(72, 96, 4)`;
      - `"pixels"`: uint8 `(72, 96, 3)`, a picture from the stand that follows the ball, without
        display or GPU; only the agent's own player is ringed;
      - `"pixels_gray"`: uint8 `(72, 96, 1)`, the same in gray;
      - `"raw"`: a dict.
    - `stack`: how many observations are shown at once, on the last axis, the oldest first. The
      first one of an episode, or after `restore`, fills the whole stack.
    - `size`: width and height of `"smm"` (at most 1024 each) and of pixels (at most 4096).
    - `scale`: whether the numbers of `"simple115v2"`, `"simple115v2+sticky"` and `"egocentric"` are
      in units that suit learning: lengths in 50 m, heights in 10 m, velocities in 10 m/s; missing
      players are 0. Flags and shares stay 0..1. Raises `ParameterError` with other observations.
    - `switching`: whether the agents of a count change players (`"auto"`) or keep them (`"fixed"`);
      None: as the scenario says.
    - `rewards`: names that replace the scenario's own choice: `"scoring,checkpoints"` or a list.
      Functions in the list add to them, or to the scenario's own choice if there are no names.
      `"none"` is no reward of the scenario. A function gets a `Step` of one agent and returns a
      finite number. It is called for each of the caller's agents, and its term is its name. An
      object with `__call__` may have a `reset()`, called when an episode begins.
    - `ends`: functions that end episodes, called after the scenario's endings and before its limit.
      They get the `Step` of the first of the caller's agents and return False or None, True (the
      outcome is the function's name) or the outcome as a string; `"success"` counts as one. A
      function that fails raises `CallbackError`.
    - `params`: parameters to bind: SI units, or strings as the language writes them.
    - `seed`: the seed of the first `reset` that gets none.
    - `events`: whether `info["events"]` lists what happened in each step.
    - `copy`: False returns the same array from every `reset` and `step`, overwritten by the next
      one; several agents with opponents always get copies.
    - `render_mode`: what `render` returns. None: nothing; `"ansi"`: a drawing in text;
      `"rgb_array"`: a picture, uint8 `(height, width, 3)`; `"human"`: every `reset` and `step` shows
      the picture in a window (needs `setpiece[human]`).
    - `render_size`: width and height of these pictures, each at most 4096.
    - `camera`: `"broadcast"`, from the stand, or `"above"`, a plan.
    - `watch`: whether every `reset` reloads the scenario's file, its imports and scripts if they
      have changed; with `"now"` every `step` reloads changed scripts, but nothing else. A change of
      the last 50 ms or so may wait for the next `reset` or `step`. A broken file leaves the last
      good scenario in place, and one that would change the spaces is held back. A file that is gone
      is a warning, as is its return.
    - `on_reload`: called with the `Reload` of every change, in the `reset` or `step` that found it,
      which raises `CallbackError` if the call fails; see also `env.unwrapped.last_reload`. Without
      it a change that can't be applied is a warning.
    - `action_set`: `"default"` (19 actions), `"v2"` (20: `Action.BUILTIN_AI` hands the step over to
      the bot), `"full"` (33: also orders to teammates) or `"continuous"`, a `Box` of float32
      `(4,)`: x and y of the direction to run, whose length is the pace; what to do with the ball,
      six kinds in equal parts of -1..1: nothing, short, long, high pass, shot, slide; and the power
      of a kick, 0..1, which sets how hard a shot is and how far a pass goes (0: like a key).
    - `record`: a folder for replays of episodes, `{scenario}_{seed}_{index}.pitchr` (with `_2` and
      so on appended if a file of the same draw exists): of all, of those with a goal
      (`record_when="goal"`), or of the first and each n-th after it (`record_when=n`). If one can't
      be written, for example because the disk is full, its last `step` raises `FileError`, and no
      more are recorded; no partial file is ever left. The last `info["setpiece"]` has `replay`, the
      path or None. `setpiece replay FILE` plays one again, and so does `setpiece.Replay`.
    - `record_quality`: `"low"`, `"medium"` or `"high"`: a video of each recorded episode is written
      beside its replay, which takes about a second for three of the match at 640 x 360 (`"low"`)
      and as long as the match at 1280 x 720. The last `info["setpiece"]` then has `video`.
    - `allow_outside`: whether imports and scripts of a scenario that is given as a path, a text or
      a dict may lie outside its folder, as in `setpiece.load`.
    - `bot_action`: whether `info["bot_action"]` shows, after `reset` and each `step`, what the bot
      would press now.

    Raises `UnknownScenarioError`, `FileError`, `CompileError`, `FormatError`, `RewardError` or
    `ParameterError`.

    >>> import setpiece
    >>> env = setpiece.make("academy_3_vs_1_with_keeper", rewards="scoring,checkpoints", seed=7)
    >>> observation, info = env.reset()
    >>> observation, reward, terminated, truncated, info = env.step(setpiece.Action.SHORT_PASS)
    >>> sorted(info)
    ['action_mask', 'reward_terms', 'score']
    """
    # Before any other name is bound, so that these are the caller's arguments.
    arguments: dict[str, Any] = {**locals()}
    env = FootballEnv(**arguments)
    # So that `env.spec.make()` makes another one, like environments that Gymnasium made.
    env.spec = EnvSpec(
        id=f"setpiece/{env.scenario.name}-v0",
        entry_point="setpiece._environment:FootballEnv",
        kwargs=arguments,
    )
    return env
