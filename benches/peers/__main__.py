"""Compares Setpiece's speed with its peers, in one run: writes a page of figures.

Install `benches/peers/requirements.txt` and this project's wheel into a separate environment, then
run `python benches/peers -o docs/performance.md`: see `benches/README.md`.

All run on one thread, in turn, each in its own process, so that other load on the machine affects
all equally. The unit is work per second of CPU time. The page shows the median of the rounds; a
ratio is the median of the rounds' ratios. Microseconds and scaling come from `setpiece bench`, in
wall time.
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

from contests import Contest, bench
from gfootball import GFOOTBALL
from scenic_sampler import SCENIC_SAMPLER
from vmas_football import VMAS, pitch

Figures = dict[str, float]

CONTESTS = {"gfootball": GFOOTBALL, "vmas": VMAS, "scenic": SCENIC_SAMPLER}
SCENARIOS = GFOOTBALL.cases
MATCHES = (1, 4, 16, 64, 256, 1024)
SIDES = (1, 2, 3, 5, 7, 9, 11)


def measured(contest: str, player: str, case: str, seconds: float) -> float:
    """Measures one of them, in a separate process."""
    command = [
        sys.executable,
        str(Path(__file__).parent),
        "--one",
        contest,
        player,
        case,
        "--seconds",
        str(seconds),
    ]
    output = subprocess.run(command, check=True, capture_output=True, text=True)
    return float(output.stdout.splitlines()[-1])


def contest_section(
    name: str, contest: Contest, rounds: int, seconds: float, figures_of: Figures
) -> list[str]:
    """Runs a contest in turn; returns its section of the page and records the medians."""
    figures: dict[str, dict[str, list[float]]] = {
        case: {player: [] for player in contest.players} for case in contest.cases
    }
    for _ in range(rounds):
        for case, by_player in figures.items():
            for player, rates in by_player.items():
                rates.append(measured(name, player, case, seconds))
                print(f"{case}, {player}: {rates[-1]:,.0f}", file=sys.stderr)
    peer = next(iter(contest.players))
    versions = ", ".join(f"{package} {version(package)}" for package in contest.packages)
    lines = [
        f"## {contest.title}",
        "",
        contest.text,
        f"{versions}; {rounds} rounds of {seconds:g} s.",
        "",
    ]
    lines += [f"| | player | {contest.unit} | against {peer} |", "| --- | --- | ---: | ---: |"]
    for case, by_player in figures.items():
        for player, rates in by_player.items():
            ratios = [mine / theirs for mine, theirs in zip(rates, by_player[peer], strict=True)]
            case_word = f"`{case}`" if "_" in case else case
            ratio = statistics.median(ratios)
            ratio_word = f"{ratio:,.0f}" if ratio >= 10 else f"{ratio:.2g}"
            lines.append(
                f"| {case_word} | {player} | {statistics.median(rates):,.0f} | {ratio_word} |"
            )
            figures_of[f"{case}, {player}"] = statistics.median(rates)
            figures_of[f"{case}, {player}, ratio"] = ratio
    return [*lines, ""]


def alone_section(seconds: float, figures_of: Figures) -> list[str]:
    """The results of `setpiece bench`: the time of each phase, and one-time costs."""
    rows = {scenario: bench(scenario, seconds, "--threads", "1")[0] for scenario in SCENARIOS}
    phases = ("draw", "bots", "reach", "movement", "play", "physics", "referee", "judge", "observe")
    lines = [
        "## Where the time goes",
        "",
        "Microseconds a step, `simple115v2` written after every step.",
        "",
    ]
    lines += ["| | " + " | ".join(phases) + " |", "| --- |" + " ---: |" * len(phases)]
    for scenario, row in rows.items():
        lines.append(
            f"| `{scenario}` | "
            + " | ".join(f"{row['microseconds'][name]:.2f}" for name in phases)
            + " |"
        )
    names = {
        "create": "create, first reset",
        "reset": "later reset",
        "memory": "copy in memory and back",
        "to_bytes": "snapshot to bytes",
        "from_bytes": "restore from bytes",
        "simple115v2": "`simple115v2`",
        "smm": "SMM 72 x 96 x 4",
    }
    lines += ["", "Microseconds each time.", "", "| | " + " | ".join(names.values()) + " |"]
    lines.append("| --- |" + " ---: |" * len(names))
    for scenario, row in rows.items():
        times = " | ".join(f"{row['once_microseconds'][name]:.2f}" for name in names)
        lines.append(f"| `{scenario}` | {times} |")
        for once, took in row["once_microseconds"].items():
            figures_of[once] = max(took, figures_of.get(once, 0.0))
    return [*lines, ""]


def curve_sections(seconds: float, figures_of: Figures) -> list[str]:
    """Cost over threads, matches and players."""
    cores = os.cpu_count() or 1
    lines = ["## Threads, matches, players", ""]
    if cores > 1:
        lines += [
            f"{cores} threads against one, 256 matches, as a share of what a loop of bare arithmetic gains:"
        ]
        shares = []
        for scenario in SCENARIOS:
            (row,) = bench(scenario, 4 * seconds, "--threads", str(cores), "--matches", "256")
            shares.append(f"{row['scaling']:.2f} for `{scenario}`")
            figures_of["scaling"] = min(row["scaling"], figures_of.get("scaling", 9.9))
        lines += [", ".join(shares) + ".", ""]
    rows = bench(SCENARIOS[0], seconds, "--threads", "1", "--matches", ",".join(map(str, MATCHES)))
    costs = [1e6 / row["steps_per_cpu_second"] for row in rows]
    apart = max(costs) / min(costs) - 1
    lines += [
        f"`{SCENARIOS[0]}`, one thread, floats, CPU time: a step costs the same among any number, within {apart:.0%}.",
        "",
    ]
    lines += ["| matches at once | µs a step of one | µs a step of all |", "| ---: | ---: | ---: |"]
    for row, each in zip(rows, costs, strict=True):
        lines.append(f"| {row['matches']:,} | {each:.1f} | {each * row['matches']:,.0f} |")
    table = ["| players a side | µs a step | of which for each player |", "| ---: | ---: | ---: |"]
    costs = []
    with tempfile.TemporaryDirectory() as folder:
        for n in SIDES:
            path = Path(folder) / f"{n}.pitch"
            path.write_text(pitch(n).replace("left: all", "left: 1"), encoding="utf-8")
            (row,) = bench(str(path), seconds, "--threads", "1")
            each = 1e6 / row["steps_per_cpu_second"]
            table.append(f"| {n} | {each:.1f} | {each / (2 * n):.2f} |")
            costs.append(each)
    more = (costs[-1] - costs[0]) / (2 * (SIDES[-1] - SIDES[0]))
    text = f"So many a side in VMAS football's scenario, one agent: each player more costs about {more:.1f} µs a step."
    return [*lines, "", text, "", *table, ""]


BARS: tuple[tuple[str, str, str, float], ...] = (
    (
        "11_vs_11_stochastic, setpiece, floats, ratio",
        "`11_vs_11_stochastic`, floats, times EnvPool's GRF",
        ">=",
        200,
    ),
    ("11_vs_11_stochastic, setpiece, ratio", "the same, super mini map", ">=", 180),
    ("11_vs_11_stochastic, setpiece.make_vec, ratio", "the same by `setpiece.make_vec`", ">=", 180),
    (
        "academy_3_vs_1_with_keeper, setpiece, floats, ratio",
        "`academy_3_vs_1_with_keeper`, times EnvPool's",
        ">=",
        200,
    ),
    (
        "academy_3_vs_1_with_keeper, setpiece, floats",
        "the same, steps per CPU-second",
        ">=",
        80_000,
    ),
    (
        "academy_empty_goal_close, setpiece, floats",
        "`academy_empty_goal_close`, steps per CPU-second",
        ">=",
        150_000,
    ),
    ("scaling", "all cores against one, share of bare arithmetic's gain, the least", ">=", 0.93),
    ("create", "create and first reset, µs", "<=", 300),
    ("reset", "later reset, µs", "<=", 20),
    ("memory", "copy in memory and back, µs", "<=", 1),
    ("to_bytes", "snapshot to bytes, µs", "<=", 10),
    ("from_bytes", "restore from bytes, µs", "<=", 10),
    ("simple115v2", "`simple115v2`, µs", "<=", 0.3),
    ("smm", "super mini map, µs", "<=", 2),
)


def bars_section(figures_of: Figures) -> list[str]:
    """The targets, and whether this run reached them."""
    lines = [
        "## Bars",
        "",
        "What the game is held to, and what this run found; the worst of the scenarios where they differ.",
        "",
    ]
    lines += ["| | bar | here | |", "| --- | ---: | ---: | --- |"]
    for key, words, sign, bar in BARS:
        if key in figures_of:
            here = figures_of[key]
            met = here >= bar if sign == ">=" else here <= bar
            here_word = f"{here:,.0f}" if here >= 100 else f"{here:.2f}"
            lines.append(
                f"| {words} | {'≥' if sign == '>=' else '≤'} {bar:,} | {here_word} | {'met' if met else 'missed'} |"
            )
    lines += [
        "",
        "Absolute figures hang on the machine and its hour; ratios are of one run. Tests hold two more: a further",
        "match in a batch takes at most 32 KiB, and after warm-up a match's step allocates nothing but in rapier,",
        "where the ball meets something hard (`tests/tests/allocation.rs`).",
        "",
    ]
    return lines


def revision() -> str:
    """The commit that the page is made from, if known."""
    command = ["git", "-C", str(Path(__file__).parent), "rev-parse", "--short", "HEAD"]
    try:
        output = subprocess.run(command, check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return "of no known commit"
    return f"at {output.stdout.strip()}"


def processor() -> str:
    """The processor's name."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    return next(
        (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")),
        platform.processor(),
    )


def page(rounds: int, seconds: float) -> str:
    """The page."""
    system = f"{platform.system()}, Python {platform.python_version()}, NumPy {version('numpy')}"
    machine = f"{processor()}, {os.cpu_count()} cores; {system}"
    lines = [
        "# Performance",
        "",
        "Written by `python benches/peers`, which says how it measures: one thread unless said.",
        f"{machine}; setpiece {version('setpiece')} {revision()}.",
        "",
    ]
    figures_of: Figures = {}
    sections: list[str] = []
    for name, contest in CONTESTS.items():
        sections += contest_section(name, contest, rounds, seconds, figures_of)
    sections += alone_section(seconds, figures_of) + curve_sections(seconds, figures_of)
    return "\n".join(lines + bars_section(figures_of) + sections)


def main() -> None:
    """Measures in turn and writes the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "-o", "--output", type=Path, help="where the page goes; standard output without it"
    )
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument(
        "--seconds", type=float, default=5.0, help="how long each is measured in a round"
    )
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.one:
        contest, player, case = args.one
        print(CONTESTS[contest].players[player](case, args.seconds))
        return
    text = page(args.rounds, args.seconds)
    if args.output:
        args.output.write_text(text, encoding="utf-8")
    else:
        print(text)


if __name__ == "__main__":
    main()
