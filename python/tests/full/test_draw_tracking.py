"""The examples that read a replay's data with kloppy and draw it with mplsoccer."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import setpiece

pytest.importorskip("kloppy", reason="kloppy isn't installed")
pytest.importorskip("mplsoccer", reason="mplsoccer isn't installed")

EXAMPLES = Path(__file__).parents[3] / "examples"
EXAMPLE = EXAMPLES / "draw_tracking.py"


@pytest.mark.parametrize("form", ["cdf", "csv"])
def test_the_example_draws_a_replay(tmp_path: Path, form: str) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    env = setpiece.make("academy_empty_goal_close", bot_action=True)
    _, info = env.reset(seed=1)
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step(info["bot_action"])
        over = terminated or truncated
    env.save_replay(tmp_path / "goal.pitchr")
    setpiece.Replay(tmp_path / "goal.pitchr").export(tmp_path / "data", form)
    picture = tmp_path / "goal.png"
    subprocess.run([sys.executable, EXAMPLE, tmp_path / "data", picture], check=True)
    pixels = pyplot.imread(picture)
    assert pixels.shape[1] > 1200
    red = abs(pixels[..., :3] - [0xE2 / 255, 0x57 / 255, 0x4C / 255]).sum(-1) < 0.05
    middle = pixels.shape[1] // 2
    # The players' ways on the left, the shot and its star on the right.
    assert red[:, :middle].sum() > 100
    assert red[:, middle:].sum() > 100


def test_the_notebook_draws_a_recorded_episode(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    mpl = pytest.importorskip("matplotlib")
    mpl.use("Agg")
    monkeypatch.chdir(tmp_path)
    notebook = json.loads((EXAMPLES / "tracking.ipynb").read_text(encoding="utf-8"))
    names: dict[str, Any] = {}
    printed = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            assert (cell["execution_count"], cell["outputs"]) == (None, [])
            exec(compile("".join(cell["source"]), f"tracking.ipynb: {cell['id']}", "exec"), names)
            printed[cell["id"]] = capsys.readouterr().out
    assert printed["record"].split()[1] == "after"
    assert int(printed["read"].split()[0]) > 20
    assert int(printed["draw"].split()[0]) > 1
    # The pitch, the ball's way, and an arrow for each pass and shot.
    drawn = names["axes"].get_children()
    assert sum(type(it).__name__ == "Quiver" for it in drawn) == len(names["kicks"])
