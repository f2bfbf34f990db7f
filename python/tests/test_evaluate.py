"""`setpiece.evaluate`: a policy on a suite or a scenario."""

import csv
import io
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

SCENARIO = "scenario mine extends academy_3_vs_1_with_keeper { param far: bool = false }"
SUITE = """
suite drills {
    academy_empty_goal_close for 30 episodes
    each d in [0.1, 0.9] { academy_3_vs_1_with_keeper(difficulty: d) for 40 episodes seed 5 }
}
"""
NAMES = {
    "success_rate": "success_rate",
    "mean_score": "score",
    "mean_return": "mean_return",
    "mean_length_s": "length",
}
"""The measures of a row, with what the command calls them."""


def command(*args: str) -> str:
    """What `setpiece run` prints."""
    line = [sys.executable, "-m", "setpiece", "run", *args]
    return subprocess.run(line, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("agent", ["bot", "random", "run_and_shoot"])
def test_an_agent_has_the_figures_of_the_command_on_a_suite(
    pitch_file: Callable[[str], Path], agent: str
) -> None:
    path = pitch_file(SUITE)
    table = setpiece.evaluate(agent, path)
    shown = json.loads(command(str(path), "--agent", agent, "--format", "json"))
    assert table.suite == shown["suite"]
    for row, entry in zip(table.to_dicts(), shown["entries"], strict=True):
        (its,) = entry["agents"]
        assert [row[name] for name in ("entry", "episodes", "seed", "policy")] == [
            entry["entry"],
            entry["episodes"],
            entry["seed"],
            agent,
        ]
        assert row["digest"] == its["digest"]
        for mine, name in NAMES.items():
            wanted = [its[name][end] for end in ("value", "low", "high")]
            assert [row[mine], row[f"{mine}_low"], row[f"{mine}_high"]] == wanted
    printed = command(str(path), "--agent", agent).splitlines()
    assert str(table).splitlines() == [line for line in printed[2:] if line]


def test_a_scenario_is_a_table_of_one_row_as_in_the_command() -> None:
    scenario = "academy_run_to_score"
    options = ("--episodes", "30", "--seed", "4", "--set", "difficulty=0.9")
    (its,) = csv.DictReader(
        io.StringIO(command(scenario, "--agent", "random", "--format", "csv", *options))
    )
    table = setpiece.evaluate(
        "random", scenario, episodes=30, seed=4, params={"difficulty": 0.9}, threads=1
    )
    (row,) = csv.DictReader(io.StringIO(table.to_csv()))
    assert (row["entry"], row["seed"], row["episodes"]) == (its["entry"], "4", "30")
    assert row["digest"] == its["digest"]
    for mine, name in NAMES.items():
        for end in ("", "_low", "_high"):
            assert float(row[mine + end]) == float(its[name + end])
    assert float(row["mean_length_s_low"]) < float(row["mean_length_s_high"])
    # Without `episodes` and `seed` it plays those of the command.
    (its,) = csv.DictReader(io.StringIO(command(scenario, "--format", "csv", "--agent", "idle")))
    (plain,) = setpiece.evaluate("idle", scenario).to_dicts()
    assert [str(plain[name]) for name in ("episodes", "seed", "digest")] == [
        its["episodes"],
        its["seed"],
        its["digest"],
    ]


def test_a_policy_and_an_agent_that_press_the_same_have_the_same_rows() -> None:
    def bot(observations: Any) -> Any:
        return np.full(len(observations), Action.BUILTIN_AI)

    played = setpiece.evaluate(Policy(bot), SUITE, threads=2)
    assert played.rows == setpiece.evaluate("bot", setpiece.suite(SUITE)).rows
    assert len({row.mean_score for row in played.rows}) > 1


def test_dicts_have_the_ends_of_every_interval() -> None:
    table = setpiece.evaluate("random", SUITE)
    for line, row in zip(table.to_dicts(), table.rows, strict=True):
        assert line["mean_score_low"] == row.mean_score.low
        assert line["success_rate_low"] <= line["success_rate"] <= line["success_rate_high"]
    head = table.to_csv().splitlines()[0].split(",")
    assert head == [*table.to_dicts()[0]]


def test_the_scenario_of_a_file_comes_before_its_suite(
    pitch_file: Callable[[str], Path],
) -> None:
    both = pitch_file(SCENARIO + SUITE)
    assert [row.entry for row in setpiece.evaluate("idle", both, episodes=2).rows] == ["mine"]
    assert setpiece.evaluate("idle", both, "drills").suite == "drills"
    assert (
        setpiece.evaluate("idle", SCENARIO, "mine", episodes=1, params={"far": True})
        .rows[0]
        .entry.startswith("mine{")
    )
    assert setpiece.evaluate("idle", "academy", threads=1).suite == "academy"


def test_what_is_wrong_is_said() -> None:
    for option, value in (("episodes", 3), ("seed", 1), ("params", {})):
        for suite in ("academy", SUITE, setpiece.suite(SUITE)):
            with pytest.raises(setpiece.ParameterError, match=f"`{option}` has no effect"):
                setpiece.evaluate("idle", suite, **{option: value})  # type: ignore[arg-type]
    with pytest.raises(setpiece.ParameterError, match="a level is one episode"):
        setpiece.evaluate("idle", "academy_corner#3:1")
    with pytest.raises(setpiece.UnknownScenarioError, match="academy_cornr"):
        setpiece.evaluate("idle", "academy_cornr")
    with pytest.raises(setpiece.CompileError, match="no scenario is called `academy_cornr`"):
        setpiece.evaluate("idle", "suite s { academy_cornr for 1 episode }")
    with pytest.raises(setpiece.CompileError, match="has no scenario `other`"):
        setpiece.evaluate("idle", SCENARIO + SUITE, "other")
    with pytest.raises(setpiece.ParameterError, match="no agent `bott`"):
        setpiece.evaluate("bott", "academy_corner")
    with pytest.raises(setpiece.ParameterError, match="difficult"):
        setpiece.evaluate("bot", "academy_corner", params={"difficult": 1})
    with pytest.raises(setpiece.ParameterError, match="episodes"):
        setpiece.evaluate("bot", "academy_corner", episodes=0)
    with pytest.raises(setpiece.FileError):
        setpiece.evaluate("bot", "none.pitch")


def test_entries_without_a_baseline_are_reported_before_anything_is_played() -> None:
    with pytest.raises(setpiece.ParameterError, match="6 of 11 entries have no baseline") as caught:
        setpiece.evaluate("baseline", "academy")
    assert caught.value.code == "SP0024"
    assert "`academy_empty_goal_close`" in str(caught.value.help)
    # The first entry would be played for hours.
    suite = "suite s { academy_empty_goal_close for 1000000 episodes academy_corner for 1 episode }"
    with pytest.raises(setpiece.ParameterError, match="1 of 2 entries has no baseline"):
        setpiece.evaluate("baseline", suite)


def test_the_baseline_is_that_of_the_players_and_the_start() -> None:
    name = "academy_empty_goal_close"
    (usual,) = setpiece.evaluate("baseline", name, episodes=5).rows
    mine = f"scenario mine extends {name} {{ reward fast {{ give -0.01 }} }}"
    (row,) = setpiece.evaluate("baseline", mine, episodes=5).rows
    assert row.digest == usual.digest
    other = f"scenario {name} extends academy {{ ball at (0.5, 0) team left {{ CM at (0.4, 0) }} }}"
    with pytest.raises(setpiece.ParameterError, match="isn't the library's of this name"):
        setpiece.evaluate("baseline", other, episodes=5)
