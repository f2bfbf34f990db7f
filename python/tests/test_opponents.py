import pickle
import sys
import time
from collections.abc import Callable
from itertools import cycle
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import play, same
from gymnasium.utils.env_checker import check_env

import setpiece
from setpiece import Action, Policy, parallel_env

THREE = "academy_3_vs_1_with_keeper"
DUEL = "1_vs_1_easy"
PitchFile = Callable[..., Path]

MARKED = """
/// Runs at the ball, whatever happens.
behavior chaser(pace: length = 1m in 0m..5m) { repeat { do move_to(ball) } }

scenario marked extends academy {
    agents { left: [anna] right: [carla, dora] }
    ball at (-0.2, 0)
    team left { anna: CF at (-0.5, 0) bea: CM at (-0.6, 0.2) }
    team right { carla: CB at (0.3, 0) dora: CB at (0.3, 0.2) { ai: hold } }
    remove end possession
    end limit 40 steps
}
"""


def forward(_observation: Any) -> int:
    return Action.RIGHT


class Recorder:
    """An opponent that remembers what it sees."""

    def __init__(self, action: int = Action.IDLE) -> None:
        self.seen: list[Any] = []
        self.action = action

    def __call__(self, observation: Any) -> Any:
        self.seen.append(observation)
        if isinstance(observation, dict) or observation.ndim in (1, 3):
            return self.action
        return np.full(len(observation), self.action)


def last(env: Any, seed: int = 1, action: int = Action.IDLE) -> dict[str, Any]:
    """Plays to the end and returns the last info."""
    info: dict[str, Any] = play(env, seed, lambda: action)[-1][4]
    return info


def test_the_caller_has_what_the_opponents_leave() -> None:
    env = setpiece.make(
        THREE, left="all", right="all", opponents={"right": forward, "left_GK_1": "bot"}
    )
    assert env.agents == ("left_CM_1", "left_CM_2", "left_CM_3")
    assert env.slots[0].id == "left_GK_1"
    assert env.action_space == gymnasium.spaces.MultiDiscrete([19] * 3)
    observation, info = env.reset(seed=1)
    assert observation.shape == (3, 115)
    assert info["action_mask"].shape == env.action_masks().shape == (3, 19)
    observation, reward, _, _, info = env.step([0, 0, 0])
    assert reward.shape == (3,)
    assert reward.dtype == np.float32
    assert info["reward_terms"]["scoring/goal"].shape == (3,)


@pytest.mark.parametrize("observation", ["simple115v2", "smm", "raw"])
@pytest.mark.parametrize("opponents", [{"right": forward}, {"right": "bot"}])
def test_passes_the_checker_of_gymnasium(opponents: dict[str, Any], observation: str) -> None:
    check_env(
        setpiece.make(DUEL, right=1, opponents=opponents, observation=observation, bot_action=True)
    )


def test_one_agent_left_is_a_single_agent() -> None:
    env = setpiece.make(
        DUEL, right=1, opponents={"right": forward}, observation="raw", bot_action=True
    )
    observation, info = env.reset(seed=1)
    assert isinstance(observation, dict)
    assert isinstance(info["bot_action"], int)
    _, reward, _, _, info = env.step(Action.RIGHT)
    assert type(reward) is float
    assert type(info["reward_terms"]["scoring/goal"]) is float
    for wrong in (19, [0, 0], 1.5, None):
        with pytest.raises(setpiece.ActionError, match=r"expected an integer in 0\.\.18"):
            env.step(wrong)
    env.step(np.int64(3))


def test_nobody_left_plays_by_itself() -> None:
    env = setpiece.make(DUEL, right=1, opponents={"left": "bot", "right": forward})
    assert env.agents == ()
    assert last(env, action=[])["setpiece"]["length"] > 0  # type: ignore[arg-type]


def test_a_match_is_that_of_a_caller_who_presses_the_same() -> None:
    """Who presses doesn't matter for the match."""
    alone = setpiece.make(DUEL, right=1)
    opposed = setpiece.make(DUEL, right=1, opponents={"right": forward})
    assert (
        last(alone, action=[Action.RIGHT] * 2)["setpiece"]["digest"]
        == (  # type: ignore[arg-type]
            last(opposed, action=Action.RIGHT)["setpiece"]["digest"]
        )
    )


def test_the_bot_is_the_builtin_ai() -> None:
    alone = setpiece.make(DUEL, right=1, action_set="v2")
    opposed = setpiece.make(DUEL, right=1, opponents={"right": "bot"})
    pressed = [int(Action.RIGHT), int(Action.BUILTIN_AI)]
    assert (
        last(alone, action=pressed)["setpiece"]["digest"]
        == (  # type: ignore[arg-type]
            last(opposed, action=Action.RIGHT)["setpiece"]["digest"]
        )
    )


@pytest.mark.parametrize(
    "kind",
    ["simple115v2", "simple115v2+sticky", "simple115", "egocentric", "smm", "extracted", "raw"],
)
def test_opponents_see_themselves_from_the_left_in_their_own_observation(kind: str) -> None:
    """An opponent sees exactly what a caller in its place would."""
    recorder = Recorder(Action.RIGHT)
    opposed = setpiece.make(
        DUEL, right=1, opponents={"right": Policy(recorder, observation=kind, batched=False)}
    )
    caller = setpiece.make(DUEL, right=1, observation=kind)
    opposed.reset(seed=2, options={"params": {"difficulty": 0.3}})
    expected = [caller.reset(seed=2, options={"params": {"difficulty": 0.3}})[0][1]]
    for _ in range(40):
        opposed.step(Action.RIGHT)
        expected.append(caller.step([Action.RIGHT, Action.RIGHT])[0][1])
    assert same(recorder.seen, expected[:-1])


def test_a_function_sees_one_agent_and_a_policy_a_batch() -> None:
    function, policy = Recorder(), Recorder()
    env = setpiece.make(
        THREE, left="all", right="all", opponents={"right": function, "left": Policy(policy)}
    )
    env.reset(seed=1)
    env.step([])
    assert [seen.shape for seen in function.seen] == [(115,), (115,)]
    assert [seen.shape for seen in policy.seen] == [(4, 115)]


def test_a_named_agent_wins_over_its_side() -> None:
    side, keeper = Recorder(), Recorder()
    env = setpiece.make(THREE, right="all", opponents={"right": side, "right_GK_1": keeper})
    env.reset(seed=1)
    env.step(0)
    assert (len(side.seen), len(keeper.seen)) == (1, 1)
    assert not same(side.seen, keeper.seen)


class Counter:
    """An opponent that counts its decisions and presses another key in each."""

    def __init__(self) -> None:
        self.rows: list[int] = []

    def __call__(self, observations: Any) -> Any:
        self.rows.append(len(observations))
        keys = (Action.LEFT, Action.TOP, Action.RIGHT, Action.BOTTOM)
        return np.full(len(observations), keys[len(self.rows) % 4])


def test_a_decision_lasts_several_steps() -> None:
    counter = Counter()
    opponents = {"right": Policy(counter, repeat=4)}
    env = setpiece.make(DUEL, right=1, opponents=opponents)
    env.reset(seed=1)
    pressed = []
    for _ in range(10):
        env.step(Action.IDLE)
        pressed.append(env.played()["right_GK_1"])
    assert pressed == [Action.TOP] * 4 + [Action.RIGHT] * 4 + [Action.BOTTOM] * 2
    # Every episode begins with a decision, and a copy presses what its original does.
    env.reset(seed=2)
    env.step(Action.IDLE)
    assert env.played()["right_GK_1"] == Action.LEFT
    twin = env.clone()
    twin.step(Action.IDLE)
    assert twin.played()["right_GK_1"] == Action.LEFT
    assert len(counter.rows) == 4


def test_the_matches_of_a_vector_decide_at_their_own_times() -> None:
    counter = Counter()
    scenario = MARKED.replace("end limit 40 steps", "end limit 6 steps")
    opponents = {"right": Policy(counter, repeat=4)}
    envs = setpiece.make_vec(
        scenario, 3, left=1, right=["carla", "dora"], opponents=opponents, autoreset_mode="disabled"
    )
    envs.reset(seed=1)
    envs.step([Action.IDLE] * 3)
    envs.reset(options={"reset_mask": np.array([False, True, False])})
    for _ in range(5):
        envs.step([Action.IDLE] * 3)
    # All six decide at once, then the two of the match that has begun again, then the other four,
    # then those two.
    assert counter.rows == [6, 2, 4, 2]


@pytest.mark.parametrize("repeat", [0, -1, 1.5, "often"])
def test_a_decision_lasts_at_least_a_step(repeat: Any) -> None:
    with pytest.raises(setpiece.ParameterError, match="repeat"):
        setpiece.make(DUEL, right=1, opponents={"right": Policy(Counter(), repeat=repeat)})


def test_what_stable_baselines_predicts() -> None:
    class Model:
        def predict(self, observation: Any, deterministic: bool = False) -> tuple[Any, None]:
            assert deterministic
            return np.full(len(observation), Action.RIGHT), None

    digests = {
        last(setpiece.make(DUEL, right=1, opponents={"right": one}), action=Action.RIGHT)[
            "setpiece"
        ]["digest"]
        for one in (Model(), Policy(Model()), forward)
    }
    assert len(digests) == 1


def test_behaviours_play_a_side(pitch_file: PitchFile) -> None:
    path = pitch_file(MARKED)
    env = setpiece.make(path, opponents={"right": "chaser(2m)"}, observation="raw")
    assert env.agents == ("anna",)
    first, _ = env.reset(seed=1)
    for _ in range(20):
        after, *_ = env.step(Action.IDLE)
    moved = np.hypot(*(after["right_team"] - first["right_team"]).T)
    assert moved[0] > 0.05, "carla chases the ball"
    assert moved[1] < 0.01, "dora has an `ai` of her own"
    lazy = setpiece.make(path, right=0, opponents={"right": "lazy", "left": "bot"})
    assert lazy.agents == ()
    with pytest.raises(setpiece.ParameterError, match="can't be played with `chase`") as caught:
        setpiece.make(path, opponents={"right": "chase"})
    assert caught.value.help
    with pytest.raises(
        setpiece.ParameterError, match="a compiled scenario keeps who plays its players"
    ):
        setpiece.make(setpiece.load(path), opponents={"right": "chaser"})


def test_a_behaviour_that_is_not_there_is_named_before_what_the_text_is_warned_of() -> None:
    warned = MARKED.replace("extends academy {", "extends academy {\n    param unused = 3 in 1..5")
    warnings = setpiece.load(warned).warnings
    with pytest.raises(
        setpiece.ParameterError, match="can't be played with `chase`: no player's `ai` is"
    ) as caught:
        setpiece.make(warned, opponents={"right": "chase"})
    assert warnings
    assert caught.value.code not in [warning.code for warning in warnings]


def test_a_text_with_errors_of_its_own_tells_of_these() -> None:
    with pytest.raises(setpiece.CompileError, match="CFF"):
        setpiece.make(MARKED.replace("dora: CB", "dora: CFF"), opponents={"right": "chaser"})


def moved(env: Any, side: str = "right_team", steps: int = 20) -> list[bool]:
    """The players of a side that run while the caller idles."""
    first, _ = env.reset(seed=1)
    for _ in range(steps):
        after, *_ = env.step(
            [Action.IDLE] * len(env.agents) if len(env.agents) != 1 else Action.IDLE
        )
    after, first = (one[0] if isinstance(one, tuple) else one for one in (after, first))
    return [bool(way > 0.03) for way in np.hypot(*(after[side] - first[side]).T)]


def test_a_behaviour_plays_one_agent(pitch_file: PitchFile) -> None:
    """An agent's behaviour plays only its player, and takes precedence over the player's own `ai`."""
    path = pitch_file(MARKED)
    for opponents, expected in [
        ({"carla": "chaser", "dora": "lazy"}, [True, False]),
        ({"carla": "lazy", "dora": "chaser(2m)"}, [False, True]),
        ({"right": "chaser", "carla": "lazy"}, [False, False]),
        ({"right": "lazy", "dora": "chaser"}, [False, True]),
        ({"right": "lazy", "carla": "bot"}, [True, False]),
        ({"right": "hold", "carla": lambda _: Action.LEFT}, [True, False]),
    ]:
        env = setpiece.make(path, opponents=opponents, observation="raw")
        assert env.agents == ("anna",)
        assert moved(env) == expected, opponents


def test_a_behaviour_plays_an_agent_without_a_name_in_the_file() -> None:
    env = setpiece.make(
        THREE, left="all", opponents={"left_CM_2": "lazy", "left_GK_1": "lazy"}, observation="raw"
    )
    assert env.agents == ("left_CM_1", "left_CM_3")
    env.reset(seed=1)
    env.step([Action.RIGHT] * 2)
    assert "left_CM_2" not in env.played(), "nobody plays who is lazy"
    twin = setpiece.make(THREE, left="all", observation="raw")
    assert env.scenario.name == twin.scenario.name
    vec = setpiece.make_vec(
        THREE, 2, left="all", opponents={"left_CM_2": "lazy", "left_GK_1": "lazy"}
    )
    assert vec.agents == env.agents
    assert vec.scenario.digest == env.scenario.digest


def test_a_behaviour_follows_its_agent_to_another_scenario(pitch_file: PitchFile) -> None:
    env = setpiece.make(
        pitch_file(MARKED), opponents={"carla": "chaser", "dora": "lazy"}, observation="raw"
    )
    other = MARKED.replace("dora: CB", "dora: LB").replace(
        "carla: CB at (0.3, 0)", "carla: CB at (0.35, 0)"
    )
    env.reset(seed=1)
    for copy in (env, env.clone(), pickle.loads(pickle.dumps(env))):
        copy.reset(seed=1, options={"scenario": other})
        for _ in range(20):
            observation, *_ = copy.step(Action.IDLE)
        assert observation["right_team"][0, 0] < 0.32, "carla chases the ball"
        assert observation["right_team"][1, 0] > 0.28, "dora doesn't"


def test_a_behaviour_needs_an_agent_that_keeps_its_player() -> None:
    with pytest.raises(
        setpiece.ParameterError, match="`lazy` can't play `right_0`, which changes players"
    ) as caught:
        setpiece.make("5_vs_5", right=1, opponents={"right_0": "lazy"})
    assert "switching='fixed'" in str(caught.value.help)
    env = setpiece.make("5_vs_5", right=1, switching="fixed", opponents={"right_RM_1": "lazy"})
    assert env.agents == ("left_RM_1",)


def test_a_behaviour_from_outside_is_one_word() -> None:
    for wrong in (
        "lazy } } } scenario x { ball at centre",
        "",
        "lazy, difficulty: 1",
        "3",
        "marker(",
    ):
        with pytest.raises(setpiece.ParameterError, match="can't be played with"):
            setpiece.make(MARKED, opponents={"carla": wrong})


CLIMBER = """
fn act(ctx, me, now) { if now.ball.x > me.x { "top" } else { "bottom" } }
"""


def test_a_script_plays_a_side(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script = tmp_path / "climber.rhai"
    script.write_text(CLIMBER, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    drill = {
        "ball": (0, 0),
        "left": [("CF", -0.5, 0)],
        "right": [("CF", 0.5, 0, {"name": "carla"})],
        "limit": 9,
    }
    for path in ("climber.rhai", str(script), script):
        for scenario, agents in ((drill, 0), (drill, 1), (MARKED, ["carla"])):
            env = setpiece.make(scenario, left=1, right=agents, opponents={"right": path})
            env.reset(seed=1)
            env.step(Action.IDLE)
            assert env.played()["carla"] == Action.TOP, "the ball lies ahead of her"


def test_a_script_that_is_not_one_is_named(tmp_path: Path) -> None:
    broken = tmp_path / "broken.rhai"
    broken.write_text("fn act(ctx, me, now) { ", encoding="utf-8")
    with pytest.raises(setpiece.ParameterError, match="can't be played with"):
        setpiece.make(DUEL, opponents={"right": broken})
    with pytest.raises(setpiece.ParameterError, match=r"missing\.rhai"):
        setpiece.make(DUEL, opponents={"right": "missing.rhai"})
    with pytest.raises(setpiece.ParameterError, match=r"missing\.rhai"):
        setpiece.make(DUEL, right="all", opponents={"right_GK_1": "missing.rhai"})


def test_an_opponent_that_fails_is_named_and_the_next_episode_plays() -> None:
    failing = True

    def moody(_observation: Any) -> Any:
        if failing:
            raise ZeroDivisionError("no idea")
        return Action.RIGHT

    env = setpiece.make(DUEL, right=1, opponents={"right": moody})
    env.reset(seed=1)
    with pytest.raises(
        setpiece.OpponentError, match="of `right_GK_1` failed: ZeroDivisionError: no idea"
    ) as caught:
        env.step(0)
    assert caught.value.slots == ("right_GK_1",)
    assert caught.value.side == "right"
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    failing = False
    env.reset(seed=1)
    env.step(0)


@pytest.mark.parametrize("given", [20, -1, 1.5, None, "right", [3], np.array([1, 2])])
def test_an_opponent_must_give_an_action(given: Any) -> None:
    env = setpiece.make(DUEL, right=1, opponents={"right": lambda _: given})
    env.reset(seed=1)
    with pytest.raises(
        setpiece.OpponentError, match=r"gave no action: expected an integer in 0\.\.19"
    ):
        env.step(0)


def test_a_function_that_fails_for_one_agent_of_several_names_the_agent() -> None:
    calls = 0

    def third_time(_observation: Any) -> Any:
        nonlocal calls
        calls += 1
        return given if calls % 3 == 0 else 5

    for make in (setpiece.make, lambda *args, **kwargs: setpiece.make_vec(*args, 2, **kwargs)):
        env = make(THREE, left=1, right="all", opponents={"right": third_time})
        for given in (99, "left", [3, 4]):
            calls = 1
            env.reset(seed=1)
            with pytest.raises(setpiece.OpponentError) as caught:
                env.step(np.zeros(env.action_space.shape, int))
            assert (
                f"of `right_CB_1` gave no action: expected an integer in 0..19, found `{given!r}`"
                in str(caught.value)
            )
            assert caught.value.slots == ("right_GK_1", "right_CB_1")


def test_integers_of_different_types_are_actions() -> None:
    answers = cycle([np.uint64(5), np.int64(5)])
    env = setpiece.make(THREE, right="all", opponents={"right": lambda _: next(answers)})
    env.reset(seed=1)
    env.step(0)


@pytest.mark.parametrize("right", [0, 1])
def test_the_shapes_of_actions_are_the_same_beside_opponents(right: int) -> None:
    opponents = {"right": "bot"} if right else None
    env = setpiece.make(DUEL, right=right, opponents=opponents)
    env.reset(seed=1)
    for action in (3, [3], np.array(3), np.array([3]), Action.LEFT):
        env.step(action)
    for wrong in ([[3]], [3, 3], [], np.zeros((1, 1), int), [3.0]):
        with pytest.raises(setpiece.ActionError):
            env.step(wrong)
    for left, shapes in ((1, [(2,), (2, 1), (1, 2)]), (2, [(2, 2), (4,), (2, 2, 1)])):
        envs = setpiece.make_vec(THREE, 2, left=left, right=right, opponents=opponents)
        envs.reset(seed=1)
        for shape in shapes:
            envs.step(np.full(shape, 3))
            envs.step(np.full(shape, 3).tolist())
        for wrong in (np.zeros(shapes[0]), np.zeros(3, int), 3):
            with pytest.raises(setpiece.ActionError):
                envs.step(wrong)


@pytest.mark.parametrize("given", [[20], [1.5], [[1]], [1, 2], None, 3, {"right_GK_1": 3}])
def test_a_policy_must_give_as_many_actions(given: Any) -> None:
    env = setpiece.make(DUEL, right=1, opponents={"right": Policy(lambda _: given)})
    env.reset(seed=1)
    with pytest.raises(
        setpiece.OpponentError, match=r"gave no action: expected 1 actions, integers in 0\.\.19"
    ):
        env.step(0)


def test_opponents_that_are_not_there() -> None:
    for kwargs, message in [
        ({"opponents": {"rigth": "bot"}}, "did you mean `right`"),
        ({"opponents": {"right_GK_1": forward}}, "no agent `right_GK_1`"),
        (
            {"opponents": {"right": forward}},
            "the right side has no agent that an opponent could play",
        ),
        ({"right": 1, "opponents": {"right": 7}}, r"`opponents\['right'\]` is 7"),
        ({"right": 1, "opponents": {"right": "bott"}}, "can't be played with"),
        (
            {"right": 1, "opponents": {"right": Policy(forward, observation="sm")}},
            "did you mean `smm`",
        ),
        (
            {"right": 1, "opponents": {"right": Policy(forward, observation="vector")}},
            "declares no observation",
        ),
        ({"right": 1, "opponents": {"right": Policy(7)}}, "a policy can't be played by 7"),
        ({"right": 1, "opponents": ["bot"]}, "expected `opponents` as a mapping"),
    ]:
        with pytest.raises(setpiece.ParameterError, match=message):
            setpiece.make(DUEL, **kwargs)
    for missing in ("nowhere.onnx", Path("nowhere.onnx")):
        with pytest.raises((setpiece.FileError, setpiece.MissingPackageError)):
            setpiece.make(DUEL, right=1, opponents={"right": missing})


def test_without_onnxruntime_the_error_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    with pytest.raises(setpiece.MissingPackageError, match=r"pip install 'setpiece\[onnx\]'"):
        setpiece.make(DUEL, right=1, opponents={"right": "policy.onnx"})


def test_copies_snapshots_and_pickles_keep_their_opponents(pitch_file: PitchFile) -> None:
    opponents = {"right": "chaser", "dora": forward}
    env = setpiece.make(pitch_file(MARKED), opponents=opponents)
    env.reset(seed=3)
    env.step(Action.RIGHT)
    others = [
        env.clone(),
        pickle.loads(pickle.dumps(env)),
        setpiece.make(pitch_file(MARKED), opponents=opponents),
    ]
    others[2].restore(env.snapshot())
    expected = [env.step(Action.RIGHT) for _ in range(10)]
    for other in others:
        assert other.agents == ("anna",)
        assert same([other.step(Action.RIGHT) for _ in range(10)], expected)


def test_a_clone_has_the_same_opponents() -> None:
    class Handle:
        def __call__(self, _observation: Any) -> int:
            return Action.RIGHT

        def __deepcopy__(self, memo: Any) -> Any:
            raise TypeError("there is only one of it")

    env = setpiece.make(DUEL, right=1, opponents={"right": Handle()})
    env.reset(seed=1)
    assert same(env.clone().step(0), env.step(0))


def test_the_same_opponents_of_many_agents() -> None:
    """`parallel_env` and `make` seat the same opponents in the same way."""
    recorder = Recorder()
    env = parallel_env(
        THREE, left=3, right="all", opponents={"right": recorder, "left_CM_2": "bot"}
    )
    assert env.possible_agents == ["left_CM_1", "left_CM_3"]
    env.reset(seed=1)
    observations, rewards, *_, infos = env.step({"left_CM_1": 0, "left_CM_3": 5})
    assert list(observations) == list(rewards) == list(infos) == env.agents
    assert len(recorder.seen) == 2
    assert infos["left_CM_1"]["action_mask"].shape == (19,)
    single = setpiece.make(
        THREE,
        left=3,
        right="all",
        switching="fixed",
        opponents={"right": recorder, "left_CM_2": "bot"},
    )
    single.reset(seed=1)
    joint = single.step([0, 5])[0]
    assert same([observations["left_CM_1"], observations["left_CM_3"]], list(joint))


def test_watched_files_say_who_plays(pitch_file: PitchFile) -> None:
    path = pitch_file(MARKED)
    env = setpiece.make(path, watch=True, opponents={"right": forward})
    env.reset(seed=1)
    env.step(0)
    path.write_text(MARKED.replace("40 steps", "3 steps"))
    end = time.monotonic() + 20
    while env.last_reload is None and time.monotonic() < end:
        env.reset(seed=1)
        time.sleep(0.02)
    assert env.last_reload is not None
    assert env.last_reload.state == "applied"
    assert last(env)["setpiece"]["length"] == 3
    with pytest.raises(setpiece.ParameterError, match="a watched file says itself who plays"):
        setpiece.make(path, watch=True, opponents={"right": "lazy"})


STICKY = "simple115v2+sticky"
KEYS = [*range(1, 9), int(Action.SPRINT), int(Action.DRIBBLE)]
"""The keys that can be held."""


def keys_held(masks: np.ndarray) -> np.ndarray:
    """How many keys are held: a held key can't be pressed."""
    return (1 - masks[..., KEYS]).sum(-1)


class Masked:
    """A policy that draws what its mask allows, and keeps what it was shown and what it did."""

    def __init__(self) -> None:
        self.seen: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
        self.random = np.random.default_rng(1)

    def __call__(self, seen: np.ndarray, masks: np.ndarray) -> np.ndarray:
        # Not 19, which hands the step over to the bot.
        allowed = masks[..., :19] * self.random.random((len(seen), 19))
        actions = np.asarray(allowed.argmax(-1))
        self.seen.append((seen.copy(), masks.copy(), actions))
        return actions


def test_a_policy_sees_the_masks_of_its_agents() -> None:
    """Those that the caller would see in its place."""
    kwargs: dict[str, Any] = {"left": 1, "right": 1, "action_set": "v2"}
    player = Masked()
    opposed = setpiece.make(
        "1_vs_1_easy", **kwargs, opponents={"right": Policy(player, masks=True)}
    )
    both = setpiece.make("1_vs_1_easy", **kwargs)
    opposed.reset(seed=2)
    _, info = both.reset(seed=2)
    differ = set()
    for _ in range(40):
        wanted = info["action_mask"][1]
        opposed.step(Action.RIGHT)
        _, masks, (did,) = player.seen[-1]
        assert masks.dtype == np.int8
        assert np.array_equal(masks, wanted[None])
        differ.add(masks.tobytes())
        _, _, terminated, truncated, info = both.step([Action.RIGHT, did])
        if terminated or truncated:
            break
    assert len(differ) > 2


def test_masks_in_a_vector_and_in_a_suite_fit_what_is_seen() -> None:
    player = Masked()
    envs = setpiece.make_vec(
        "5_vs_5",
        3,
        left=1,
        right="all",
        observation=STICKY,
        opponents={"right": Policy(player, masks=True)},
    )
    envs.reset(seed=1)
    for _ in range(20):
        envs.step(np.full(3, Action.RIGHT))
    suite = "suite s { multi_3_vs_1_with_keeper for 4 episodes }"
    setpiece.evaluate(Policy(player, masks=True, repeat=3), suite, observation=STICKY)
    assert len({len(seen) for seen, *_ in player.seen}) > 1
    for seen, masks, _ in player.seen:
        assert masks.shape == (len(seen), 20)
        assert np.array_equal(keys_held(masks), seen[:, 115:125].sum(-1))
    assert any((keys_held(masks) > 1).any() for _, masks, _ in player.seen)


def test_a_policy_asked_agent_by_agent_gets_its_mask() -> None:
    shapes = set()

    def act(seen: Any, mask: Any) -> int:
        shapes.add((seen.shape, mask.shape))
        return int(mask.argmax())

    policy = Policy(act, batched=False, masks=True)
    played = setpiece.play("1_vs_1_easy", policy, "bot", seed=1)
    assert shapes == {((115,), (20,))}
    assert played.length > 0
    for wrong in (1, "yes"):
        with pytest.raises(setpiece.ParameterError, match="expected True or False as `masks`"):
            setpiece.make("1_vs_1_easy", right=1, opponents={"right": Policy(act, masks=wrong)})  # type: ignore[arg-type]
