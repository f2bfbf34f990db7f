"""Suites in Python: agents and policies on frozen episodes."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece
from setpiece import Action, Policy

TEXT = """
suite mine {
    academy_empty_goal_close for 30 episodes
    each d in [0.1, 0.9] { academy_3_vs_1_with_keeper(difficulty: d) for 70 episodes seed 5 }
}
suite multi { multi_3_vs_1_with_keeper for 5 episodes }
suite duel { 1_vs_1_easy for 2 episodes }
"""
COLUMNS = ("success_rate", "mean_return", "score", "length")


def command(*args: str) -> dict[str, Any]:
    """The JSON that `setpiece run` prints."""
    line = [sys.executable, "-m", "setpiece", "run", *args, "--format", "json"]
    done = subprocess.run(line, capture_output=True, text=True, check=True)
    return dict(json.loads(done.stdout))


@pytest.mark.parametrize("agent", ["run_and_shoot", "random"])
def test_an_agent_has_the_figures_of_the_command(
    pitch_file: Callable[[str], Path], agent: str
) -> None:
    path = pitch_file(TEXT.split("suite multi")[0])
    table = setpiece.suite(path).evaluate(agent)
    shown = command(str(path), "--agent", agent)["entries"]
    assert len(table.rows) == len(shown) == 3
    for row, line in zip(table.rows, shown, strict=True):
        (its,) = line["agents"]
        assert (row.entry, row.episodes, row.seed) == (
            line["entry"],
            line["episodes"],
            line["seed"],
        )
        assert row.digest == its["digest"]
        measured = (row.success_rate, row.mean_return, row.mean_score, row.mean_length_s)
        for one, name in zip(measured, COLUMNS, strict=True):
            assert [one.value, one.low, one.high] == [
                its[name][k] for k in ("value", "low", "high")
            ]
    # Some intervals say something.
    assert any(row.mean_length_s.low < row.mean_length_s.high for row in table.rows)


@pytest.mark.parametrize(
    "policy",
    [
        lambda observation: Action.BUILTIN_AI,  # noqa: ARG005
        Policy(lambda seen: np.full(len(seen), Action.BUILTIN_AI), "raw"),
        Policy(lambda seen: np.full(np.shape(seen)[:-1], Action.BUILTIN_AI), "simple115"),
    ],
)
def test_a_policy_plays_the_same_episodes_as_an_agent(policy: Any) -> None:
    for name in ("mine", "multi"):
        suite = setpiece.suite(TEXT, name)
        bot = suite.evaluate("bot")
        played = suite.evaluate(policy, threads=2)
        assert played.rows == bot.rows
        assert (bot.policy, played.policy) == ("bot", "policy")


def test_both_sides_see_themselves_attack_to_the_right() -> None:
    def runner(observations: Any) -> Any:
        return np.full(len(observations), Action.RIGHT)

    table = setpiece.suite(TEXT, "duel").evaluate(Policy(runner))
    assert table.rows[0].episodes == 2


def test_a_table_is_the_text_of_the_command_and_a_frame() -> None:
    suite = setpiece.suite(TEXT, "mine")
    table = suite.evaluate("idle", rewards="scoring,checkpoints")
    head, *lines = str(table).splitlines()
    assert head.split() == ["entry", "episodes", "success", "return", "score", "length"]
    assert lines[1].startswith("  academy_3_vs_1_with_keeper{difficulty=0.1}")
    assert lines[1].split("70")[1].split()[0] == f"{table.rows[1].success_rate.value:.1%}"[:-1]
    pandas = pytest.importorskip("pandas")
    frame = table.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame["success_rate_high"].tolist() == [row.success_rate.high for row in table.rows]
    assert frame["entry"].tolist() == [entry.entry for entry in suite.entries]


def test_without_pandas_the_error_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    table = setpiece.suite(TEXT, "multi").evaluate("idle")
    with pytest.raises(setpiece.MissingPackageError, match="pandas") as caught:
        table.to_pandas()
    assert caught.value.help is not None


def test_the_library_has_suites_for_one_agent_and_for_many() -> None:
    assert setpiece.suites() == ["academy", "academy_multi", "benchmarks"]
    suite = setpiece.suite("academy_multi")
    assert len(suite.entries) == 6
    for entry in suite.entries:
        env = setpiece.make(entry.entry)
        outfield = [name for name in env.scenario.name.split("_") if name == "corner"]
        assert len(env.agents) == len(set(env.agents)) >= (10 if outfield else 2)
        assert all(agent.startswith("left") and "GK" not in agent for agent in env.agents)
    printed = subprocess.run(
        [sys.executable, "-m", "setpiece", "list"], capture_output=True, text=True, check=True
    ).stdout
    assert all(f"\n{name} " in printed for name in setpiece.suites())


def test_a_vector_trains_on_the_levels_of_a_suite() -> None:
    suite = setpiece.suite(TEXT, "mine")
    envs = setpiece.make_vec("academy_corner", 40, levels=suite.levels)
    envs.reset()
    assert [level.split("{")[0] for level in envs.levels[29:31]] == [
        "academy_empty_goal_close",
        "academy_3_vs_1_with_keeper",
    ]
    assert envs.levels[29].endswith("#0:29")
    assert envs.levels[30].endswith("#5")


def test_a_suite_over_parameters_is_one_of_the_language() -> None:
    params = [{"difficulty": 0.1}, {"difficulty": 0.9}]
    made = setpiece.Suite.over("academy_3_vs_1_with_keeper", params, episodes=70, seed=5)
    assert made.entries == setpiece.suite(TEXT, "mine").entries[1:]
    assert made.evaluate("bot").rows == setpiece.suite(TEXT, "mine").evaluate("bot").rows[1:]
    for wrong in ([{"difficult": 1}], [{"difficulty": 2}], {"difficulty": 1}, [3]):
        with pytest.raises(setpiece.ParameterError):
            setpiece.Suite.over("academy_corner", wrong)  # type: ignore[arg-type]
    with pytest.raises(setpiece.ParameterError):
        setpiece.Suite.over("academy_corner", params, episodes=0)


def test_what_is_wrong_is_said() -> None:
    with pytest.raises(setpiece.ParameterError, match="no suite is called `academi`") as caught:
        setpiece.suite("academi")
    assert caught.value.code == "SP0020"
    assert caught.value.help == "did you mean `academy`?"
    with pytest.raises(setpiece.ParameterError, match="expected one suite, found 3"):
        setpiece.suite(TEXT)
    for load in (setpiece.suite, setpiece.curriculum):
        with pytest.raises(setpiece.ParameterError, match="name of the library"):
            load("learn_3_vs_1", "other")
    suite = setpiece.suite(TEXT, "multi")
    with pytest.raises(setpiece.ParameterError, match="no agent `runandshoot`") as caught:
        suite.evaluate("runandshoot")
    assert caught.value.help == "did you mean `run_and_shoot`?"
    for wrong in (3, None, "mine.rhai", Path("mine.rhai")):
        with pytest.raises(setpiece.ParameterError):
            suite.evaluate(wrong)
    with pytest.raises(setpiece.ParameterError, match="threads"):
        suite.evaluate("bot", threads=0)
    with pytest.raises(setpiece.OpponentError, match="the policy of `left_CM_1`"):
        suite.evaluate(lambda observation: 99)  # noqa: ARG005
    endless = "scenario s { ball at (0, 0) team left { CF at (0, 0) } } suite a { s for 1 episode }"
    for player in ("idle", lambda observation: 0):  # noqa: ARG005
        with pytest.raises(setpiece.SetpieceError, match="no end"):
            setpiece.suite(endless).evaluate(player)
