"""Draws the mean score of training runs against their steps, from the examples' logs.

    python examples/plot_training.py runs/close runs/empty --out docs/training.png

It needs `matplotlib` and `tensorboard`. A curve has the name of its folder, or the name before a
`=`: `"empty goal=runs/empty"`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np
from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

mpl.use("Agg")
from matplotlib import pyplot as plt

WINDOW = 10  # log entries


def curve(folder: str, tag: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns the steps and values of a log; values are means over the last `WINDOW` entries."""
    log = EventAccumulator(folder, size_guidance={"scalars": 0}).Reload().Scalars(tag)
    values = np.array([entry.value for entry in log])
    means = [values[max(0, at - WINDOW + 1) : at + 1].mean() for at in range(len(values))]
    return np.array([entry.step for entry in log]), np.array(means)


def main(argv: list[str] | None = None) -> None:
    """Reads the command line and draws."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("runs", nargs="+", help="folders of logs, `NAME=FOLDER` or `FOLDER`")
    parser.add_argument("--tag", default="episode/score")
    parser.add_argument("--out", type=Path, default=Path("docs/training.png"))
    args = parser.parse_args(argv)
    figure, axes = plt.subplots(figsize=(8, 4.5))
    for run in args.runs:
        name, _, folder = run.rpartition("=")
        steps, values = curve(folder, args.tag)
        axes.plot(steps, values, label=name or Path(folder).name)
    axes.set_xlabel("steps of all environments together")
    axes.set_ylabel("mean score" if args.tag == "episode/score" else args.tag)
    axes.xaxis.set_major_formatter(lambda step, _: f"{step / 1000:.0f}k")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(args.out, dpi=100)


if __name__ == "__main__":
    main()
