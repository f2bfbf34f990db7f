r"""Finds the starts where a policy fails, by MAP-Elites over the parameters of a scenario.

    python examples/find_failures.py --scenario academy_run_to_score_with_keeper \
        --policy run_and_shoot

`--policy` is an agent of the command, or an `.onnx` file, which `train_cleanrl.py` writes too. The
archive has a cell for every pair of values of two parameters (`--over`), and keeps in each the
other parameters with which the policy scores least. The worst of them are played again from seeds
that the search has not seen, because the least of many noisy means is too low; so are random
starts, for the mean. Each is printed as a level with the command that shows it.

It needs `ribs` and `matplotlib`. The experiment is that of MADRID (Samvelyan et al. 2024), in one
file.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from ribs.archives import GridArchive
from ribs.emitters import GaussianEmitter
from ribs.schedulers import Scheduler

import setpiece

SEARCHED = 0
"""The seed of the search."""
CONFIRMED = 1_000_000
"""The seed of the episodes that confirm what it has found."""
AGAIN = 50
"""Episodes of a start that is played again."""


@dataclass(frozen=True)
class Failure:
    """A start where the policy scores little."""

    level: str
    score: setpiece.Estimate


@dataclass(frozen=True)
class Found:
    """What a search has found: the policy's mean score over random starts, and the worst starts."""

    mean: float
    failures: list[Failure]
    archive: GridArchive

    @property
    def is_failure(self) -> bool:
        """Whether the policy scores somewhere, and somewhere else less than half its mean."""
        return self.mean > 0 and any(it.score.value < self.mean / 2 for it in self.failures)


def scores(
    args: argparse.Namespace, vectors: NDArray[Any], episodes: int, seed: int
) -> list[setpiece.SuiteRow]:
    """Plays episodes with the parameters of each vector."""
    scenario = setpiece.load(args.scenario)
    space = scenario.parameter_space
    params = [space.from_vector(vector) for vector in vectors]
    suite = setpiece.Suite.over(scenario, params, episodes=episodes, seed=seed)
    return list(suite.evaluate(args.policy, observation=args.observation).rows)


def search(args: argparse.Namespace) -> Found:
    """Searches, and plays the worst starts again."""
    names = list(setpiece.load(args.scenario).parameter_space.spaces)
    axes = [names.index(name) for name in args.over] if args.over else [0, 1]
    size, cells = len(names), (args.cells, args.cells)
    archive = GridArchive(solution_dim=size, dims=cells, ranges=[(0, 1)] * 2, seed=args.seed)
    emitter = GaussianEmitter(
        archive,
        sigma=0.15,
        x0=np.full(size, 0.5),
        bounds=[(0.0, 1.0)] * size,
        batch_size=args.batch,
        seed=args.seed,
    )
    scheduler = Scheduler(archive, [emitter])
    rng = np.random.default_rng(args.seed)
    random = rng.random((4 * args.batch, size))
    rows = scores(args, random, args.episodes, SEARCHED)
    archive.add(random, [-row.mean_score.value for row in rows], random[:, axes])
    for _ in range(args.rounds):
        asked = scheduler.ask()
        rows = scores(args, asked, args.episodes, SEARCHED)
        scheduler.tell([-row.mean_score.value for row in rows], asked[:, axes])
    kept = archive.data(["solution", "objective"])
    worst = kept["solution"][np.argsort(-kept["objective"], kind="stable")[: args.worst]]
    again = scores(args, random, AGAIN, CONFIRMED)
    mean = float(np.mean([row.mean_score.value for row in again]))
    rows = scores(args, worst, AGAIN, CONFIRMED)
    failures = [Failure(f"{row.entry}#{row.seed}", row.mean_score) for row in rows]
    return Found(mean, sorted(failures, key=lambda it: it.score.value), archive)


def draw(found: Found, over: Sequence[str], path: Path) -> None:
    """Writes a picture of the archive: the mean score in every cell."""
    import matplotlib.pyplot as plt

    kept, (columns, rows) = found.archive.data(["index", "objective"]), found.archive.dims
    cells = np.full(columns * rows, np.nan)
    cells[kept["index"]] = -kept["objective"]
    figure, axes = plt.subplots(figsize=(6, 5))
    shown = axes.imshow(
        cells.reshape(columns, rows).T, origin="lower", extent=(0, 1, 0, 1), cmap="viridis"
    )
    axes.set_xlabel(f"{over[0]} (share of its range)")
    axes.set_ylabel(f"{over[1]} (share of its range)")
    figure.colorbar(shown, label="mean score of the worst start")
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main(argv: list[str] | None = None) -> Found:
    """Reads the command line, searches and prints."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenario", required=True, help="a name or a file")
    parser.add_argument("--policy", default="bot", help="an `.onnx` file, or an agent's name")
    parser.add_argument("--observation", default="simple115v2", help="what the `.onnx` file sees")
    parser.add_argument(
        "--over", nargs=2, metavar="PARAM", help="the archive's parameters [default: the first two]"
    )
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--batch", type=int, default=32, help="starts of a round")
    parser.add_argument("--episodes", type=int, default=10, help="of each start")
    parser.add_argument("--cells", type=int, default=12, help="of the archive on each side")
    parser.add_argument("--worst", type=int, default=10, help="starts that are printed")
    parser.add_argument("--seed", type=int, default=0, help="of the search")
    parser.add_argument("--out", type=Path, help="a picture of the archive: FILE.png")
    args = parser.parse_args(argv)
    names = list(setpiece.load(args.scenario).parameter_space.spaces)
    if len(names) < 2:
        parser.error(f"`{args.scenario}` has {len(names)} parameters with a range; it needs two")
    for name in args.over or []:
        if name not in names:
            parser.error(f"no parameter `{name}` with a range; there are {', '.join(names)}")
    found = search(args)
    cells = found.archive.stats.num_elites
    print(
        f"mean score {found.mean:.2f} over random starts; {cells} cells of the archive are filled"
    )
    print(f"the worst starts, each with {AGAIN} episodes that the search has not seen:")
    for failure in found.failures:
        score = failure.score
        print(f"  {score.value:5.2f} [{score.low:.2f}, {score.high:.2f}]  {failure.level}")
        print(f"        setpiece render {args.scenario} --level '{failure.level}' -o worst.mp4")
    below = "below" if found.is_failure else "not below"
    print(f"the worst is {below} half the mean")
    if args.out is not None:
        draw(found, args.over or names[:2], args.out)
    return found


if __name__ == "__main__":
    main()
