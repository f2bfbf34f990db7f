"""The policies in the box, played in the real game: `python box.py [--episodes N]`.

It needs Google Research Football's package `gfootball`, and `onnxruntime`. The scores go to
`recorded/box.json`, with what the policies' cards say of them here.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np

BOX = Path(__file__).resolve().parents[2] / "baselines" / "policies"
STORED = Path(__file__).parent / "recorded" / "box.json"
KINDS = ("likeliest", "drawn")
EPISODES = 60


def play(file: Path, card: dict, episodes: int) -> dict[str, float]:
    """Plays a policy's likeliest and drawn actions; returns the mean goals of an episode."""
    import gfootball.env
    import onnxruntime

    session = onnxruntime.InferenceSession(file)
    [shown, *_] = session.get_inputs()
    repeat = int(session.get_modelmeta().custom_metadata_map["repeat"])
    rng = np.random.default_rng(0)
    game = gfootball.env.create_environment(card["scenario"], representation="simple115v2")
    means = {}
    for kind in KINDS:
        goals = 0.0
        for _ in range(episodes):
            seen, over = game.reset(), False
            while not over:
                rows = np.asarray(seen, np.float32)[None]
                logits = session.run(None, {shown.name: rows})[0][0]
                luck = rng.gumbel(size=logits.shape) if kind == "drawn" else 0.0
                action = int((logits + luck).argmax())
                for _ in range(repeat):
                    seen, _, over, info = game.step(action)
                    goals += info["score_reward"]
                    if over:
                        break
        means[kind] = round(goals / episodes, 3)
    return means


def stored() -> str:
    """Returns the table of the page."""
    lines = ["| policy | here | likeliest, there | drawn, there |", "|---|---|---|---|"]
    for name, row in json.loads(STORED.read_text())["policies"].items():
        there = " | ".join(f"{row[kind]:.2f}" for kind in KINDS)
        lines.append(f"| {name} | {row['here']:.2f} | {there} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Reads the command line, plays, and stores the scores."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=EPISODES, help=f"of each kind; {EPISODES}")
    episodes = parser.parse_args().episodes
    policies = {}
    for file in sorted(BOX.glob("*.onnx")):
        card = json.loads(file.with_suffix(".json").read_text())
        policies[file.stem] = {"here": card["score"]["mean"], **play(file, card, episodes)}
        print(file.stem, policies[file.stem], flush=True)
    STORED.write_text(json.dumps({"episodes": episodes, "policies": policies}, indent=1) + "\n")


if __name__ == "__main__":
    main()
