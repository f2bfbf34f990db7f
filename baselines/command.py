"""The command line of a learner: trains, evaluates, and keeps what is left of a run."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import setpiece
import torch

from measure import estimate
from watch import Watch

if TYPE_CHECKING:
    from ppo import Training
    from settings import Settings


def train(
    learner: type[Training],
    settings: Settings,
    out: Path,
    *,
    threads: int = 1,
    device: str = "cpu",
    episodes: int = 500,
    watch: Watch | None = None,
) -> dict[str, Any]:
    """Trains, or continues what `out` has of it, evaluates, and writes all files into `out`."""
    training = learner(settings, threads=threads, device=device)
    checkpoint = out / "checkpoint.pt"
    if checkpoint.is_file():
        training.load(checkpoint)
    out.mkdir(parents=True, exist_ok=True)
    training.run(out, watch=watch)
    found = result(training, episodes)
    (out / "result.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    torch.save(training.policy.state_dict(), out / "policy.pt")
    try:
        matches = training.matches
        masks = matches.masks[:, 0] if settings.masks else None
        training.policy.export(out / "policy.onnx", matches.rows[:, 0], masks, settings)
    except ImportError as error:
        print(f"no policy.onnx: {error}")
    return found


def result(training: Training, episodes: int) -> dict[str, Any]:
    """Evaluates a run; returns all that is to be kept of it."""
    spent = training.clock.spent
    return {
        "settings": asdict(training.settings),
        "agents": training.agents,
        "steps": training.steps,
        "episodes": episodes,
        "drawn": estimate(training.evaluate(episodes, drawn=True)),
        "likeliest": estimate(training.evaluate(episodes, drawn=False)),
        "seconds": {name: round(spent[name], 3) for name in sorted(spent)},
        "steps_per_cpu_second": round(training.steps / training.clock.cpu),
        "threads": training.threads,
        "device": training.device.type,
        "versions": {"setpiece": setpiece.__version__, "torch": torch.__version__},
        "curve": [
            {name: None if value is None else round(value, 4) for name, value in point.items()}
            for point in training.curve
        ],
        "checks": training.checks,
    }


def summary(found: dict[str, Any]) -> str:
    """Returns lines on a result for a person."""
    shown = {
        name: "{mean:.3f} ({low:.3f} to {high:.3f})".format(**found[name])
        for name in ("drawn", "likeliest")
    }
    spent = found["seconds"]
    cpu = sum(seconds for name, seconds in spent.items() if name != "wall")
    shares = ", ".join(
        f"{name} {spent[name] / cpu:.0%}" for name in ("acting", "environment", "learning")
    )
    return (
        f"score of {found['episodes']} episodes with drawn actions: {shown['drawn']}\n"
        f"score of {found['episodes']} episodes with the likeliest: {shown['likeliest']}\n"
        f"{found['steps']} steps in {cpu:.0f} s of the CPU, {spent['wall']:.0f} s on the wall:"
        f" {found['steps_per_cpu_second']} steps per CPU second ({shares})"
    )


def command(
    about: str | None, learner: type[Training], argv: list[str] | None = None
) -> dict[str, Any]:
    """Reads the command line of a learner and trains."""
    known = fields(learner.options)
    parser = argparse.ArgumentParser(
        description=about, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    for one in known:
        said = f"{one.metadata['about']} (default: {one.default})"
        if isinstance(one.default, bool):
            parser.add_argument(
                f"--{one.name}",
                action=argparse.BooleanOptionalAction,
                default=one.default,
                help=one.metadata["about"],
            )
        else:
            parser.add_argument(
                f"--{one.name}", type=type(one.default), default=one.default, help=said
            )
    parser.add_argument("--threads", type=int, default=1, help="of the engine and of PyTorch")
    parser.add_argument("--device", default="cpu", help="of PyTorch: cpu, cuda")
    parser.add_argument("--episodes", type=int, default=500, help="of the evaluation at the end")
    parser.add_argument("--evaluate", default="", metavar="SUITE", help="play it while training")
    parser.add_argument("--every", type=int, default=50, help="updates between two such plays")
    parser.add_argument(
        "--video-every", type=int, default=0, help="updates between two videos; 0: none"
    )
    parser.add_argument("--out", type=Path, default=Path("runs/baseline"), help="a folder")
    args = parser.parse_args(argv)
    try:
        settings = learner.options(**{one.name: getattr(args, one.name) for one in known})
        watch = Watch(
            settings,
            args.out,
            suite=args.evaluate,
            every=args.every,
            video_every=args.video_every,
        )
        found = train(
            learner,
            settings,
            args.out,
            threads=args.threads,
            device=args.device,
            episodes=args.episodes,
            watch=watch,
        )
    except (setpiece.SetpieceError, ValueError) as error:
        parser.error(str(error))
    print(summary(found))
    return found
