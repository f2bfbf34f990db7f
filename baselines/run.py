"""Runs what `runs.py` lists, and shows what came out.

    python baselines/run.py              what is done, then the rest, one run after the other
    python baselines/run.py --list       only what is done
    python baselines/run.py --table      the tables of docs/training.md

Every run leaves `results/NAME-SEED.json`. One that was interrupted continues from its checkpoint in
`target/baselines/NAME-SEED`.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import statistics
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from runs import ENTRIES

HERE = Path(__file__).parent
RESULTS = HERE / "results"
CHECKPOINTS = HERE.parent / "target" / "baselines"
GOOD = 0.8
"""The score whose first step the tables show."""


@dataclass(frozen=True)
class Run:
    """One run of the ledger."""

    name: str
    table: str
    seed: int
    learner: str
    settings: dict[str, Any]

    @property
    def result(self) -> Path:
        """The file of its result."""
        return RESULTS / f"{self.name}-{self.seed}.json"

    @property
    def out(self) -> Path:
        """The folder of its checkpoint, its policy and its log."""
        return CHECKPOINTS / f"{self.name}-{self.seed}"


def ledger() -> list[Run]:
    """Returns all runs: the first seed of every entry, then the second, and so on."""
    runs = [
        (
            place,
            Run(entry.name, entry.table, seed, entry.learner, {**entry.settings, "seed": seed}),
        )
        for entry in ENTRIES
        for place, seed in enumerate(entry.seeds)
    ]
    return [run for _, run in sorted(runs, key=lambda one: one[0])]


def results(runs: Iterable[Run]) -> dict[str, list[dict[str, Any]]]:
    """Reads the results of the runs that are done, by the name of their entry."""
    found: dict[str, list[dict[str, Any]]] = {}
    for run in runs:
        kept = found.setdefault(run.name, [])
        if run.result.is_file():
            kept.append(json.loads(run.result.read_text(encoding="utf-8")))
    return found


def spread(values: list[float], digits: int = 2, unit: str = "") -> str:
    """Returns the median of some runs, and the least and greatest if there are several."""
    middle, least, most = (
        "never" if value == math.inf else f"{value:.{digits}f}{unit}"
        for value in (statistics.median(values), min(values), max(values))
    )
    return middle if len(values) == 1 else f"{middle} ({least} to {most})"


def reached(found: dict[str, Any], score: float = GOOD) -> float | None:
    """Returns after how many steps the score was first at least `score`.

    It is that of the evaluations while training if there are any, else the training score.
    """
    curve = found.get("checks") or found["curve"]
    points = (point for point in curve if (point["score"] or 0) >= score)
    return next((point["steps"] for point in points), None)


def row(found: list[dict[str, Any]]) -> list[str]:
    """Returns the cells of an entry."""
    settings = found[0]["settings"]
    good = [math.inf if (steps := reached(one)) is None else steps / 1e6 for one in found]
    when = spread(good, 2, " M") if min(good) < math.inf else "never"
    seconds = [
        sum(spent for what, spent in one["seconds"].items() if what != "wall") for one in found
    ]
    return [
        f"`{settings.get('levels') or settings['scenario']}`",
        f"{found[0]['steps'] / 1e6:.1f} M",
        str(len(found)),
        spread([one["drawn"]["mean"] for one in found]),
        spread([one["likeliest"]["mean"] for one in found]),
        when,
        spread([each / 60 for each in seconds], 1),
        f"{statistics.median(one['steps_per_cpu_second'] for one in found):,.0f}",
    ]


HEAD = (
    "scenario",
    "steps",
    "seeds",
    "drawn actions",
    "likeliest actions",
    f"score reaches {GOOD}",
    "CPU minutes",
    "steps per CPU second",
)


def tables(runs: list[Run]) -> dict[str, str]:
    """Returns the tables in Markdown, by name.

    They have a row for each entry that has a result. Those of what was tried have one for each run.
    """
    found, lines = results(runs), {run.table: [HEAD, ("---",) * len(HEAD)] for run in runs}
    for name, table in {run.name: run.table for run in runs}.items():
        if found[name]:
            lines[table].append(tuple(row(found[name])))
    shown = {name: markdown(rows) for name, rows in lines.items()}
    team = [found[name] for name in {run.name: 0 for run in runs if run.table == "team"}]
    shown["team_course"] = course([one for one in team if one])
    chosen_by = ("tried", "tried_team", "tried_curriculum")
    return {**shown, **{name: tried(name) for name in chosen_by}}


def course(entries: list[list[dict[str, Any]]]) -> str:
    """Returns the table of how runs went: the training score after parts of the steps, and time."""
    parts = [part / 6 for part in range(1, 7)]
    head = ("scenario", *(f"{part:.0%} of the steps" for part in parts), "where the time went")
    rows = [head, ("---",) * len(head)]
    for found in entries:
        seconds = {
            what: sum(one["seconds"][what] for one in found)
            for what in ("acting", "environment", "learning")
        }
        cpu = sum(seconds.values())
        rows.append(
            (
                f"`{found[0]['settings']['scenario']}`",
                *(spread([after(one, part) for one in found]) for part in parts),
                ", ".join(f"{what} {spent / cpu:.0%}" for what, spent in seconds.items()),
            )
        )
    return markdown(rows)


def after(found: dict[str, Any], part: float) -> float:
    """Returns the training score once a part of the steps was done."""
    point = min(found["curve"], key=lambda point: abs(point["steps"] - part * found["steps"]))
    return point["score"] or 0.0


def tried(folder: str) -> str:
    """Returns the table of the runs that settings were chosen by, in their order."""
    head = ("scenario", "seed", "steps", "what was different", "drawn actions", "likeliest actions")
    rows = [head, ("---",) * len(head)]
    for path in sorted((RESULTS / folder).glob("*.json")):
        found = json.loads(path.read_text(encoding="utf-8"))
        settings = found["settings"]
        changed = [f"`{name}` {str(value).lower()}" for name, value in found["changed"].items()]
        rows.append(
            (
                f"`{settings['scenario'].removeprefix('academy_').removeprefix('multi_')}`",
                str(settings["seed"]),
                f"{found['steps'] / 1e6:.1f} M",
                "; ".join([*changed, *found["program"]]) or "nothing",
                f"{found['drawn']['mean']:.2f}",
                f"{found['likeliest']['mean']:.2f}",
            )
        )
    return markdown(rows)


def markdown(rows: Iterable[Iterable[str]]) -> str:
    """Returns a table in Markdown."""
    return "".join(f"| {' | '.join(cells)} |\n" for cells in rows)


def play(run: Run, threads: int) -> None:
    """Trains a run, or continues it, and keeps its result."""
    sys.path.insert(0, str(HERE))
    os.chdir(HERE.parent)
    from command import summary, train

    print(f"{run.name}, seed {run.seed}", flush=True)
    learner = import_module(run.learner).Training
    found = train(learner, learner.options(**run.settings), run.out, threads=threads)
    RESULTS.mkdir(exist_ok=True)
    run.result.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(summary(found), flush=True)


def main(argv: list[str] | None = None) -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--list", action="store_true", help="only show what is done")
    parser.add_argument("--table", action="store_true", help="only print the tables")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="only these entries")
    parser.add_argument("--threads", type=int, default=1, help="of the engine and of PyTorch")
    args = parser.parse_args(argv)
    runs = ledger()
    names = sorted({run.name for run in runs})
    if unknown := sorted({*(args.only or ())} - {*names}):
        parser.error(f"no run `{unknown[0]}`; there are {', '.join(names)}")
    if args.only:
        runs = [run for run in runs if run.name in args.only]
    if args.table:
        print("\n".join(f"{name}\n\n{text}" for name, text in tables(runs).items()))
        return
    for run in runs:
        state = "done" if run.result.is_file() else "begun" if run.out.exists() else "to do"
        print(f"{state:6} {run.name} seed {run.seed}")
    if not args.list:
        for run in runs:
            if not run.result.is_file():
                play(run, args.threads)


if __name__ == "__main__":
    main()
