"""Rewards and endings in Python."""

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from conftest import Counter, Locked, Tracker, play, same
from gymnasium.utils.env_checker import check_env

import setpiece
from setpiece import Action, Step

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"
TEN = """
scenario ten {
    ball at (0.1, 0)
    team left { CF at (0, 0) CF at (0, 0.2) }
    team right { CF at (0.5, 0.3) }
    reward time { give 0.5 as "step" }
    end limit 10 steps
}
"""


def forward(step: Step) -> float:
    """How far the agent's player came towards +x."""
    active = step.now["active"]
    return float(step.now["left_team"][active][0] - step.before["left_team"][active][0])


def kept(_step: Step) -> float:
    return 0.25


def deep(step: Step) -> bool:
    return bool(step.now["ball"][0] > 0.8)


def never(_step: Step) -> None:
    return None


def right() -> Action:
    return Action.RIGHT


def test_a_function_pays_beside_the_file_and_is_a_term_of_its_own() -> None:
    trajectory = play(setpiece.make(TEN, rewards=[kept, forward]), 1, right)
    plain = play(setpiece.make(TEN), 1, right)
    paid = [step[4]["reward_terms"] for step in trajectory]
    assert paid[0] == {"time/step": 0.0, "kept": 0.0, "forward": 0.0}
    assert all(terms["time/step"] == 0.5 and terms["kept"] == 0.25 for terms in paid[1:])
    assert sum(terms["forward"] for terms in paid) > 0.01
    for step, terms, other in zip(trajectory[1:], paid[1:], plain[1:], strict=True):
        assert step[1] == sum(terms.values())
        assert same(step[0], other[0])
    total = trajectory[-1][4]["setpiece"]["return"]
    assert total == {name: sum(terms[name] for terms in paid) for name in paid[0]}


def test_names_choose_the_scenarios_rewards_and_functions_pay_beside_them() -> None:
    def terms(rewards: Any) -> list[str]:
        return list(setpiece.make(THREE, rewards=rewards).reset(seed=1)[1]["reward_terms"])

    own = ["scoring/goal", "scoring/conceded"]
    assert terms(kept) == [*own, "kept"]
    assert terms([kept]) == [*own, "kept"]
    assert terms(["checkpoints", kept]) == ["checkpoints/carried", "checkpoints/goal", "kept"]
    assert terms(["none", kept]) == ["kept"]
    assert terms("none") == terms([]) == []


def test_a_function_sees_the_step_as_its_agent_does() -> None:
    seen: list[Step] = []
    env = setpiece.make(THREE, left=2, right=1, rewards=lambda step: seen.append(step) or 0.0)
    env.reset(seed=1)
    before = env.look("raw")
    actions = [Action.RIGHT, Action.SPRINT, Action.TOP]
    info = env.step(actions)[4]
    now = env.look("raw")
    assert "events" not in info
    assert [step.agent for step in seen] == list(env.agents)
    assert [step.team for step in seen] == ["left", "left", "right"]
    assert [step.action for step in seen] == actions
    assert same([step.before for step in seen], list(before))
    assert same([step.now for step in seen], list(now))


def test_a_function_sees_events_and_the_outcome() -> None:
    kinds: list[str] = []
    outcomes: list[str | None] = []

    def watch(step: Step) -> float:
        kinds.extend(event["kind"] for event in step.events)
        outcomes.append(step.outcome)
        return 0.0

    env = setpiece.make(CLOSE, rewards=watch, events=True)
    trajectory = play(env, 0, lambda: Action.SHOT if len(outcomes) > 3 else Action.RIGHT)
    assert trajectory[-1][4]["outcome"] == "scored"
    assert kinds == [event["kind"] for step in trajectory for event in step[4]["events"]]
    assert "goal" in kinds
    assert outcomes == [None] * (len(trajectory) - 2) + ["scored"]


def test_every_agent_is_paid_for_itself() -> None:
    env = setpiece.make(TEN, left=2, switching="fixed", rewards=["time", forward])
    env.reset(seed=1)
    for _ in range(5):
        _, reward, _, _, info = env.step([Action.RIGHT, Action.LEFT])
    assert reward.dtype == np.float32
    ahead, back = info["reward_terms"]["forward"]
    assert ahead > 0 > back
    assert reward == pytest.approx([0.5 + ahead, 0.5 + back])


def test_beside_opponents_the_callers_agents_are_paid() -> None:
    names: list[str] = []
    env = setpiece.make(
        THREE,
        left=3,
        right=1,
        opponents={"right": "bot"},
        rewards=lambda step: names.append(step.agent) or 1.0,
    )
    env.reset(seed=1)
    reward = env.step([Action.RIGHT] * 3)[1]
    assert reward.shape == (3,)
    assert names == list(env.agents)


@pytest.mark.parametrize(
    ("verdict", "outcome", "success"),
    [
        (True, "judge", False),
        (np.True_, "judge", False),
        ("tired", "tired", False),
        ("success", "success", True),
    ],
)
def test_an_ending_terminates_the_episode_with_its_label(
    verdict: Any, outcome: str, success: bool
) -> None:
    asked = 0

    def judge(_step: Step) -> Any:
        nonlocal asked
        asked += 1
        return verdict if asked == 4 else [None, False, ""][asked - 1]

    env = setpiece.make(TEN, rewards=["time", kept], ends=judge)
    trajectory = play(env, 7, right)
    _, _, terminated, truncated, info = trajectory[-1]
    assert (len(trajectory) - 1, terminated, truncated) == (4, True, False)
    assert info["outcome"] == outcome
    assert info["records"] == {}
    assert info["setpiece"] == {
        "return": {"time/step": 2.0, "kept": 1.0},
        "digest": info["setpiece"]["digest"],
        "faults": 0,
        "observation_faults": {},
        "length": 4,
        "seed": 7,
        "index": 0,
        "level": "ten#7",
        "success": success,
        "scenario": env.scenario.digest,
    }
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(Action.RIGHT)
    asked = 0
    assert play(env, None, right)[-1][4]["setpiece"]["index"] == 1


def test_an_episode_that_python_ended_is_reported_and_replayed_like_any_other(
    tmp_path: Path,
) -> None:
    text = TEN.replace("reward time", "record way = ball.x\n    reward time")
    env = setpiece.make(
        text, ends=lambda step: "far" if step.now["steps_left"] == 4 else None, record=tmp_path
    )
    info = play(env, 2, right)[-1][4]
    summary = info["setpiece"]
    assert info["records"].keys() == {"way"}
    assert summary["digest"] == env.unwrapped._native.digest
    replay = setpiece.Replay(summary["replay"])
    assert (replay.outcome, replay.digest, replay.length) == ("far", summary["digest"], 6)
    assert [*replay][-1].info["setpiece"]["return"] == summary["return"]
    restored = setpiece.make(text)
    last = restored.restore(env.snapshot())[1]
    assert last["outcome"] == "far"


def test_a_reward_sees_how_an_ending_in_python_ended() -> None:
    env = setpiece.make(
        TEN,
        rewards=["none", lambda step: float(step.outcome == "at_once")],
        ends=[lambda _: "at_once"],
    )
    env.reset(seed=1)
    assert env.step(Action.IDLE)[1] == 1.0


def test_the_files_endings_come_first_and_its_limit_last() -> None:
    asked: list[int] = []
    scored = setpiece.make(CLOSE, ends=lambda step: asked.append(1) or bool(sum(step.now["score"])))
    trajectory = play(scored, 0, lambda: Action.SHOT if len(asked) > 3 else Action.RIGHT)
    assert trajectory[-1][4]["outcome"] == "scored"
    assert len(asked) == len(trajectory) - 2, "the last step is the file's"
    last = play(
        setpiece.make(TEN, ends=lambda step: step.now["steps_left"] == 0 and "full"), 1, right
    )[-1]
    assert last[2:4] == (True, False)
    assert last[4]["outcome"] == "full"
    assert last[4]["setpiece"]["length"] == 10


def test_an_object_is_called_when_an_episode_begins() -> None:
    env = setpiece.make(TEN, rewards=["none", Counter()])
    for _ in range(2):
        assert [step[1] for step in play(env, None, right)][1:] == [float(n) for n in range(1, 11)]


def failing(_step: Step) -> float:
    raise KeyError("no such thing")


@pytest.mark.parametrize(
    ("options", "name", "message"),
    [
        ({"rewards": failing}, "failing", "KeyError"),
        ({"ends": failing}, "failing", "KeyError"),
        ({"rewards": [kept, lambda _: "much"]}, "<lambda>", "'much'; expected a finite number"),
        ({"rewards": lambda _: None}, "<lambda>", "None; expected a finite number"),
        ({"rewards": lambda _: float("nan")}, "<lambda>", "nan; expected a finite number"),
        ({"rewards": lambda _: np.zeros(2)}, "<lambda>", "expected a finite number"),
        ({"ends": lambda _: 3}, "<lambda>", "3; expected a bool or a label"),
    ],
)
def test_a_function_that_fails_is_named_and_the_next_episode_plays(
    options: dict[str, Any], name: str, message: str
) -> None:
    env = setpiece.make(TEN, **options)
    for _ in range(2):
        env.reset(seed=1)
        with pytest.raises(setpiece.CallbackError, match=message) as failed:
            env.step(Action.IDLE)
        assert (failed.value.function, failed.value.agent) == (name, "left_0")
        assert name in str(failed.value)
        with pytest.raises(gymnasium.error.ResetNeeded):
            env.step(Action.IDLE)


def test_a_reset_of_a_function_that_fails_is_named() -> None:
    counter = Counter()
    env = setpiece.make(TEN, rewards=counter)
    counter.reset = failing  # type: ignore[assignment,method-assign]
    with pytest.raises(setpiece.CallbackError, match="`Counter` failed: TypeError") as failed:
        env.reset(seed=1)
    assert failed.value.agent is None
    del counter.reset
    assert len(play(env, 1, right)) == 11


def test_options_that_are_no_functions_are_named() -> None:
    for rewards in (3, [kept, 3], {"kept": kept}):
        with pytest.raises(setpiece.ParameterError, match="names or functions"):
            setpiece.make(TEN, rewards=rewards)  # type: ignore[arg-type]
    for ends in ("goal", [deep, "goal"], 3):
        with pytest.raises(setpiece.ParameterError, match="`ends` as functions"):
            setpiece.make(TEN, ends=ends)  # type: ignore[arg-type]
    with pytest.raises(setpiece.ParameterError, match="two rewards are named `<lambda>`"):
        setpiece.make(TEN, rewards=[lambda _: 1.0, lambda _: 2.0])
    taken = Counter()
    taken.__name__ = "time/step"  # type: ignore[attr-defined]
    with pytest.raises(
        setpiece.ParameterError, match="`time/step` is a reward of the scenario too"
    ):
        setpiece.make(TEN, rewards=taken).reset()
    with pytest.raises(setpiece.ParameterError, match="there is none"):
        setpiece.make(TEN, left=0, ends=deep)
    with pytest.raises(setpiece.ParameterError, match="`kept` can't pay here"):
        setpiece.make_vec(TEN, 2, rewards=[kept])  # type: ignore[list-item]


def test_clones_and_pickles_go_on_with_their_functions() -> None:
    env = setpiece.make(TEN, rewards=["none", kept, forward], ends=[never])
    env.reset(seed=1)
    env.step(Action.RIGHT)
    copies = [env.clone(), pickle.loads(pickle.dumps(env)), env]
    ends = []
    for copy in copies:
        done = False
        while not done:
            *rest, done, info = copy.step(Action.RIGHT)
        ends.append((rest, info))
    assert same(ends[0], ends[2])
    assert same(ends[1], ends[2])
    assert ends[0][1]["setpiece"]["return"]["kept"] == 2.5


@pytest.mark.parametrize(
    "copied", [setpiece.FootballEnv.clone, lambda env: pickle.loads(pickle.dumps(env))]
)
@pytest.mark.parametrize("began", [False, True])
@pytest.mark.parametrize(
    ("options", "terms"),
    [
        ({"ends": never}, ["time/step"]),
        ({"ends": never, "rewards": "none"}, []),
        ({"ends": never, "rewards": [kept]}, ["time/step", "kept"]),
        ({"rewards": [kept]}, ["time/step", "kept"]),
        ({"rewards": ["none", kept]}, ["kept"]),
    ],
)
def test_a_copy_is_paid_by_the_same_rewards(
    options: dict[str, Any], terms: list[str], began: bool, copied: Callable[[Any], Any]
) -> None:
    env = setpiece.make(TEN, **options)
    if began:
        env.reset(seed=1)
    copy = copied(env)
    if not began:
        copy.reset(seed=1)
    assert list(copy.step(Action.RIGHT)[4]["reward_terms"]) == terms


def test_what_rewards_and_endings_share_their_copies_share() -> None:
    tracker = Tracker()
    env = setpiece.make(TEN, rewards=tracker.paid, ends=tracker.tired)
    for each in (env.clone(), pickle.loads(pickle.dumps(env)), env):
        assert [step[4].get("outcome") for step in play(each, 1, right)] == [
            None,
            None,
            None,
            None,
            "tired",
        ]


def test_a_function_that_can_not_be_copied_is_named() -> None:
    env = setpiece.make(TEN, rewards=Locked())
    with pytest.raises(
        setpiece.CallbackError, match="`Locked` can't be copied: TypeError: cannot pickle"
    ) as failed:
        env.clone()
    assert (failed.value.function, failed.value.agent) == ("Locked", None)


def test_a_restored_episode_is_paid_from_there() -> None:
    env = setpiece.make(TEN, rewards=["none", forward])
    env.reset(seed=1)
    env.step(Action.RIGHT)
    snapshot = env.snapshot()
    straight = env.step(Action.RIGHT)
    env.step(Action.LEFT)
    assert env.restore(snapshot)[1]["reward_terms"] == {"forward": 0.0}
    assert same(env.step(Action.RIGHT), straight)


def test_a_recorded_episode_with_an_ending_in_python_is_written(tmp_path: Path) -> None:
    env = setpiece.make(TEN, ends=lambda step: step.now["steps_left"] == 5, record=tmp_path)
    path = play(env, 1, right)[-1][4]["setpiece"]["replay"]
    assert Path(path).exists()


def test_passes_the_checker_of_gymnasium() -> None:
    check_env(setpiece.make(THREE, rewards=[forward], ends=[deep]))
    envs = gymnasium.make_vec(
        f"setpiece/{THREE}-v0", 2, vectorization_mode="sync", rewards=[forward], ends=[deep]
    )
    envs.reset(seed=1)
    assert envs.step(np.full(2, Action.RIGHT))[4]["reward_terms"]["forward"].shape == (2,)


def test_continuous_actions_are_shown_as_they_are() -> None:
    seen: list[Any] = []
    env = setpiece.make(
        TEN, action_set="continuous", rewards=lambda step: seen.append(step.action) or 0.0
    )
    env.reset(seed=1)
    env.step(np.array([1.0, 0.0, -1.0, 0.0], np.float32))
    assert same(seen, [np.array([1.0, 0.0, -1.0, 0.0], np.float32)])


def test_each_agent_of_a_parallel_environment_is_paid_and_all_end() -> None:
    pytest.importorskip("pettingzoo")
    asked: list[str] = []

    def third(step: Step) -> bool:
        asked.append(step.agent)
        return len(asked) == 3

    env = setpiece.parallel_env(TEN, left=2, rewards=["time", forward], ends=third)
    env.reset(seed=1)
    first, second = env.possible_agents
    for _ in range(3):
        _, rewards, terminations, truncations, infos = env.step(
            {first: Action.RIGHT, second: Action.LEFT}
        )
    assert terminations == {first: True, second: True}
    assert not any(truncations.values())
    assert env.agents == []
    assert asked == [first] * 3
    for agent in (first, second):
        terms = infos[agent]["reward_terms"]
        assert rewards[agent] == pytest.approx(0.5 + terms["forward"])
        assert infos[agent]["outcome"] == "third"
        assert infos[agent]["setpiece"]["return"]["time/step"] == 1.5
    assert infos[first]["reward_terms"]["forward"] > infos[second]["reward_terms"]["forward"]


def test_kaggles_agents_are_paid_by_functions_too(pitch_file: Callable[..., Path]) -> None:
    played = setpiece.play(pitch_file(TEN), "bot", "bot", rewards=["none", kept])
    assert played.rewards == (2.5, 2.5)


class Meddler:
    """Plays the environment that asks it."""

    env: Any = None

    def __init__(self, call: str) -> None:
        self.call = call

    def __call__(self, _seen: Any) -> int:
        if self.env is not None:
            getattr(self.env, self.call)(*{"step": (0,), "restore": (b"",)}.get(self.call, ()))
        return 0


class AtReset(Meddler):
    def reset(self) -> None:
        self(None)

    def __call__(self, seen: Any) -> int:
        return 0 if seen is not None else super().__call__(seen)


@pytest.mark.parametrize("what", [AtReset, Meddler])
def test_who_judges_a_step_can_close_the_environment(what: type[Meddler]) -> None:
    meddler = what("close")
    env = setpiece.make(TEN, rewards=meddler)
    env.reset(seed=1)
    meddler.env = env
    with pytest.raises(gymnasium.error.ClosedEnvironmentError):
        play(env, 1, right)


@pytest.mark.parametrize("call", ["reset", "step", "restore"])
@pytest.mark.parametrize("what", ["reward", "reward's reset", "ending", "opponent"])
def test_who_judges_a_step_can_not_play_it(what: str, call: str) -> None:
    meddler = (AtReset if "reset" in what else Meddler)(call)
    ending: Callable[[Step], bool] = lambda step: bool(meddler(step))  # noqa: E731
    kwargs: dict[str, Any] = {
        "ending": {"ends": [ending]},
        "opponent": {"right": 1, "opponents": {"right": meddler}},
    }
    env = setpiece.make("1_vs_1_easy", **kwargs.get(what, {"rewards": [meddler]}))
    env.reset(seed=1)
    meddler.env = env
    with pytest.raises((setpiece.CallbackError, setpiece.OpponentError), match="InUseError"):
        play(env, 1, lambda: 0)
    meddler.env = None
    env.reset(seed=1)
    env.step(0)


def test_flags_are_flags() -> None:
    for wrong in ({"copy": "x"}, {"events": "no"}, {"bot_action": 1}):
        with pytest.raises(setpiece.ParameterError, match="expected True or False"):
            setpiece.make(CLOSE, **wrong)
    with pytest.raises(setpiece.ParameterError, match="needs a folder"):
        setpiece.make(CLOSE, record_when="goal")
