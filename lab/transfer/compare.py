"""Agents by rules in both games: `python compare.py` plays them here, beside the recorded runs there.

The runs of Google Research Football 2.10.2 lie in `recorded/`, one file a scenario, as
`matches.py gfootball` wrote them.
Writes `docs/transfer.md`.
"""

from __future__ import annotations

import argparse
import importlib
import json
from pathlib import Path

import numpy as np
from agents import AGENTS
from matches import play

HERE = Path(__file__).parent
PAGE = HERE.parent.parent / "docs" / "transfer.md"
COLUMNS = ("goals", "conceded", "shots", "wide", "passes", "completed", "owned", "lost", "shot_speed")
HEAD = """# Transfer

What agents that play by rules come to here and in Google Research Football 2.10.2: twelve agents, the same keys for the
same places, raw observations, the left team against the built-in bots. `python lab/transfer/compare.py` plays them here
and writes this page; the runs there are recorded in `lab/transfer/recorded/` (`matches.py` makes them where the package
is installed). Every figure is a mean over episodes: here / there.
"""


def ranks(values: list[float]) -> np.ndarray:
    """Ranks with ties shared."""
    values = np.asarray(values)
    return np.array([(values < value).sum() + 0.5 * ((values == value).sum() - 1) for value in values])


def correlation(here: list[float], there: list[float]) -> float:
    """Spearman's rank correlation; NaN where one side has no order."""
    a, b = ranks(here), ranks(there)
    if a.std() == 0 or b.std() == 0:
        return float("nan")
    return float(np.corrcoef(a, b)[0, 1])


def section(scenario: str, there: dict, here: dict) -> str:
    """The table of a scenario and what it comes to."""
    names = [name for name in AGENTS if name in there]
    counts = {row["episodes"] for row in there.values()}, {row["episodes"] for row in here.values()}
    lines = [
        f"## {scenario}",
        "",
        f"Episodes of every agent: {max(counts[1])} here, {max(counts[0])} there.",
        "",
        "| agent | " + " | ".join(column.replace("_", " ") for column in COLUMNS) + " |",
        "|---" * (len(COLUMNS) + 1) + "|",
    ]
    for name in names:
        cells = [f"{here[name][column]:.2f} / {there[name][column]:.2f}" for column in COLUMNS]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    total = {column: [sum(side[name][column] for name in names) for side in (here, there)] for column in COLUMNS}
    order = correlation([here[name]["goals"] for name in names], [there[name]["goals"] for name in names])
    shares = [f"{column} {total[column][0] / total[column][1]:.2f}" for column in COLUMNS if total[column][1] > 0]
    lines += [
        "",
        f"Rank correlation of goals: {order:.2f}. All agents together, here over there: {', '.join(shares)}.",
        "",
    ]
    return "\n".join(lines)


def main() -> None:
    """Plays every recorded scenario and writes the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--episodes", type=int, default=20, help="of every agent in a whole match; scenes get five times as many"
    )
    options = parser.parse_args()
    football = importlib.import_module("setpiece.gfootball.env")
    page = [HEAD]
    for file in sorted((HERE / "recorded").glob("*.json")):
        there = json.loads(file.read_text())
        scenario, here = there["scenario"], {}
        episodes = options.episodes * (1 if scenario.startswith("11_vs_11") else 5)
        for name in there["rows"]:
            env = football.create_environment(env_name=scenario, representation="raw", rewards="scoring")
            here[name] = play(env, name, episodes, 3001)
            env.close()
        page.append(section(scenario, there["rows"], here))
        print(page[-1], flush=True)
    PAGE.write_text("\n".join(page))


if __name__ == "__main__":
    main()
