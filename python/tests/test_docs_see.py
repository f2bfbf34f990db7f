"""Every example of docs/see.md runs: the commands, and the Python code in order."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

from pages import DOCS

import setpiece

TEXT = (DOCS / "see.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)


def test_every_command_writes_its_file(tmp_path: Path) -> None:
    corner = "scenario corner extends academy_corner { end limit 1s }"
    (tmp_path / "corner.pitch").write_text(corner)
    env = setpiece.make("academy_corner", record=tmp_path / "runs", seed=7)
    env.reset()
    env.step(setpiece.Action.HIGH_PASS)
    env.save_replay(tmp_path / "runs" / "academy_corner_7_0.pitchr")
    seen = 0
    for line in "".join(blocks("text")).splitlines():
        words = shlex.split(line)
        assert words[0] == "setpiece"
        if "--live" in words:
            words[2] = "corner.pitch"
            words += ["-n", "1"]
        done = subprocess.run(
            [sys.executable, "-m", *words],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            check=False,
        )
        assert done.returncode == 0, f"{line}\n{done.stderr}"
        written = [word for word in words if word.endswith((".mp4", ".gif", ".png", ".svg"))]
        assert all((tmp_path / name).stat().st_size > 1_000 for name in written)
        seen += 1
    assert seen >= 8


def test_every_example_runs() -> None:
    names: dict[str, object] = {}
    for block in blocks("python"):
        exec(compile(block, "see.md", "exec"), names)
    assert names["frame"].shape == (720, 1280, 3)  # type: ignore[attr-defined]
