"""Rule-based agents in both games: plays them here, and compares with recorded runs.

The runs of Google Research Football 2.10.2 are in `recorded/`, one file per scenario, as
`matches.py gfootball` wrote them. The latest runs here are stored with them, under `here`.
"""

from __future__ import annotations

import importlib
import json
from functools import partial
from pathlib import Path

import numpy as np

from agents import AGENTS
from matches import play
from options import is_match

RECORDED = Path(__file__).parent / "recorded"
COLUMNS = (
    "goals",
    "conceded",
    "shots",
    "wide",
    "passes",
    "completed",
    "owned",
    "lost",
    "shot_speed",
)


def ranks(values: list[float]) -> np.ndarray:
    """Ranks with ties shared."""
    values = np.asarray(values)
    return np.array(
        [(values < value).sum() + 0.5 * ((values == value).sum() - 1) for value in values]
    )


def correlation(here: list[float], there: list[float]) -> float:
    """Spearman's rank correlation; NaN if one side has no order."""
    a, b = ranks(here), ranks(there)
    if a.std() == 0 or b.std() == 0:
        return float("nan")
    return float(np.corrcoef(a, b)[0, 1])


def recorded() -> list[Path]:
    """Returns the files of recorded runs."""
    return sorted(RECORDED.glob("*.json"))


def play_here(scenarios: list[str], episodes: int) -> None:
    """Plays the agents here in every recorded scenario.

    Scenes get a quarter of `episodes`, matches a twentieth.
    """
    football = importlib.import_module("setpiece.gfootball.env")
    for file in recorded():
        runs = json.loads(file.read_text())
        scenario = runs["scenario"]
        if scenario not in scenarios:
            continue
        count = max(1, episodes // (20 if is_match(scenario) else 4))
        runs["here"] = {}
        for name in runs["rows"]:
            create = partial(
                football.create_environment,
                env_name=scenario,
                representation="raw",
                rewards="scoring",
            )
            row = play(create, name, count, 3001)
            runs["here"][name] = {key: row[key] for key in (*COLUMNS, "episodes")}
        print(f"{scenario}: {len(runs['here'])} agents by rules, {count} episodes each", flush=True)
        file.write_text(json.dumps(runs, indent=1))


def section(scenario: str, there: dict, here: dict) -> str:
    """The table of a scenario and its summary."""
    names = [name for name in AGENTS if name in there]
    counts = {row["episodes"] for row in there.values()}, {row["episodes"] for row in here.values()}
    lines = [
        f"### {scenario}",
        "",
        f"Episodes of every agent: {max(counts[1])} here, {max(counts[0])} there.",
        "",
        "| agent | " + " | ".join(column.replace("_", " ") for column in COLUMNS) + " |",
        "|---" * (len(COLUMNS) + 1) + "|",
    ]
    for name in names:
        cells = [f"{here[name][column]:.2f} / {there[name][column]:.2f}" for column in COLUMNS]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    total = {
        column: [sum(side[name][column] for name in names) for side in (here, there)]
        for column in COLUMNS
    }
    order = correlation(
        [here[name]["goals"] for name in names], [there[name]["goals"] for name in names]
    )
    shares = [
        f"{column} {total[column][0] / total[column][1]:.2f}"
        for column in COLUMNS
        if total[column][1] > 0
    ]
    lines += [
        "",
        f"Rank correlation of goals: {order:.2f}. All agents together, here over there: {', '.join(shares)}.",
        "",
    ]
    return "\n".join(lines)


def sections() -> str:
    """Returns the tables of all scenarios that have been played here."""
    runs = [json.loads(file.read_text()) for file in recorded()]
    return "\n".join(
        section(run["scenario"], run["rows"], run["here"]) for run in runs if "here" in run
    )
