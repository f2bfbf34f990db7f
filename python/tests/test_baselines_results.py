"""The tables of docs/training.md show what the files in baselines/results say."""

import json
import sys
from collections.abc import Iterator
from importlib import import_module
from typing import Any

import pytest
from pages import DOCS, hold_tables

import setpiece

BASELINES = DOCS.parent / "baselines"


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    monkeypatch.syspath_prepend(str(BASELINES))
    yield import_module("run")
    for name in ("run", "runs"):
        sys.modules.pop(name, None)


@pytest.fixture
def policies(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    monkeypatch.syspath_prepend(str(BASELINES))
    yield import_module("policies")
    sys.modules.pop("policies", None)


def test_the_tables_are_computed_from_the_results(run: Any) -> None:
    hold_tables("training.md", run.tables(run.ledger()))


def test_every_result_is_of_a_run_of_the_ledger(run: Any) -> None:
    runs = {one.result.name: one for one in run.ledger()}
    files = sorted((BASELINES / "results").glob("*.json"))
    assert files
    assert {path.name for path in files} <= {*runs}
    for name, found in run.results(run.ledger()).items():
        for one in found:
            settings = one["settings"]
            wanted = runs[f"{name}-{settings['seed']}.json"].settings
            assert wanted.items() <= settings.items(), name
            assert one["steps"] <= settings["steps"]
            assert one["episodes"] == 500
            for kind in ("drawn", "likeliest"):
                assert one[kind]["low"] <= one[kind]["mean"] <= one[kind]["high"]
            assert one["curve"][-1]["steps"] == one["steps"]


def test_runs_of_an_entry_differ_in_their_seed_only(run: Any) -> None:
    for name, found in run.results(run.ledger()).items():
        others = [{**one["settings"], "seed": 0} for one in found]
        assert all(one == others[0] for one in others), name


def test_names_are_those_of_the_library(run: Any) -> None:
    runs = run.ledger()
    assert len({one.result for one in runs}) == len(runs)
    assert {one.settings["scenario"] for one in runs} <= {*setpiece.list()}
    first = [one.seed for one in runs[: len({one.name for one in runs})]]
    assert first == [1] * len(first), "the first seed of everything comes first"


def found(scores: list[float], seconds: float = 60) -> dict[str, Any]:
    """A result with a training score after each million steps."""
    return {
        "settings": {"scenario": "mine"},
        "steps": len(scores) * 1_000_000,
        "drawn": {"mean": scores[-1]},
        "likeliest": {"mean": scores[-1] + 0.01},
        "seconds": {"acting": seconds / 2, "environment": seconds / 2, "wall": 1000},
        "steps_per_cpu_second": 1_000,
        "curve": [{"steps": (at + 1) * 10**6, "score": one} for at, one in enumerate(scores)],
    }


def test_a_row_has_the_median_the_least_and_the_greatest(run: Any) -> None:
    one, two, three = found([0.2, 0.85, 0.9]), found([0.1, 0.2, 0.8], 120), found([0.0, 0.1, 0.3])
    assert run.row([one, two, three]) == [
        "`mine`",
        "3.0 M",
        "3",
        "0.80 (0.30 to 0.90)",
        "0.81 (0.31 to 0.91)",
        "3.00 M (2.00 M to never)",
        "1.0 (1.0 to 2.0)",
        "1,000",
    ]
    assert run.row([one, two])[5] == "2.50 M (2.00 M to 3.00 M)"
    assert run.row([three])[3:6] == ["0.30", "0.31", "never"]


def test_evaluations_while_training_say_when_a_score_is_reached(run: Any) -> None:
    checked = {
        **found([0.9, 0.9]),
        "checks": [{"steps": s, "score": s / 1e6} for s in (700_000, 900_000)],
    }
    checked["settings"] = {"scenario": "mine", "levels": "examples/course.pitch"}
    assert run.row([checked])[0] == "`examples/course.pitch`"
    assert run.row([checked])[5] == "0.90 M"


def test_an_unknown_run_is_named(run: Any, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        run.main(["--only", "3_vs_1"])
    assert "no run `3_vs_1`; there are " in capsys.readouterr().err


def test_the_list_says_what_is_done(run: Any, capsys: pytest.CaptureFixture[str]) -> None:
    run.main(["--list"])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(run.ledger())
    done = [line for line in lines if line.startswith("done")]
    assert len(done) == len([*(BASELINES / "results").glob("*.json")])


def test_the_words_of_a_card_are_drawn_from_figures(policies: Any) -> None:
    """What a policy does and its weaknesses, of four episodes that are known."""
    figures = {
        "episodes": 4,
        "length_s": {"value": 5.25},
        "actions": {"idle": 20, "shot": 60, "right": 80},
        "ends": [
            {"name": "possession", "verdict": None, "count": 1},
            {"name": "scored", "verdict": "success", "count": 3},
        ],
        "touches": [[40.0, -20.0], [45.0, 0.0], [45.0, 1.0], [46.0, 20.0]],
        "passes": [{"from": [40.0, 0.0], "to": [45.0, 0.0], "completed": False}],
        "shots": [
            {"at": [42.5, 0.0], "outcome": "successful"},
            {"at": [32.5, 0.0], "outcome": "saved"},
            {"at": [40.5, 0.0], "outcome": "successful"},
        ],
        "pitch": {"length": 105.0, "width": 68.0},
    }
    said = policies.words(figures, 4)
    assert said["does"] == (
        "It succeeds in 75.0% of 4 episodes, which last 5.2 s on average. It decides 10.0 times an "
        "episode; the actions are mostly `right` 50%, `shot` 38%, `idle` 12%. Its players touch "
        "the ball 1.0 times an episode, pass 0.25 times and shoot 0.75 times. Of its touches, "
        "25% are on the left, 50% are in the middle, 25% are on the right. Half of its shots come "
        "from within 12 m of the goal, the farthest from 20 m."
    )
    assert said["weaknesses"] == (
        "Other episodes end with `possession` 25.0%. 1 of 3 shots are no goals (saved 1). "
        "1 of 1 passes reach no teammate."
    )


def test_every_card_has_words(policies: Any) -> None:
    cards = sorted((BASELINES / "policies").glob("*.json"))
    assert [card.stem for card in cards] == sorted(one.scenario for one in policies.BOX)
    for card in cards:
        written = json.loads(card.read_text(encoding="utf-8"))["words"]
        assert written["does"].startswith("It succeeds in ")
        assert written["weaknesses"]
