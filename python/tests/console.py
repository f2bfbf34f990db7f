"""Pages whose every block is tried: texts are written, commands run, Python executed, in order."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
GAP = "…"
"""A line of a console for any number of lines that are left out."""


@dataclass
class Block:
    """A fenced block of a page."""

    info: str
    text: str
    start: int
    """Offset of its text in the page."""

    @property
    def language(self) -> str:
        return self.info.split(" ")[0]


def blocks(page: str) -> Iterator[Block]:
    """Yields the blocks of a page in order."""
    for found in re.finditer(r"^```(\S.*)\n((?:.*\n)*?)```$", page, re.MULTILINE):
        yield Block(found[1], found[2], found.start(2))


def matches(wanted: list[str], printed: list[str]) -> bool:
    """Whether lines are those of a console, in which `…` stands for any lines."""
    if GAP not in wanted:
        return wanted == printed
    head = wanted[: wanted.index(GAP)]
    rest = wanted[len(head) + 1 :]
    if printed[: len(head)] != head:
        return False
    return any(matches(rest, printed[at:]) for at in range(len(head), len(printed) + 1))


class Page:
    """A page that is tried in a folder of its own."""

    def __init__(self, path: Path, folder: Path) -> None:
        self.path, self.folder = path, folder
        self.names: dict[str, Any] = {}
        self.seen: dict[str, int] = {}
        self.faults: list[str] = []

    def try_it(self) -> None:
        """Tries every block; SETPIECE_BLESS=1 writes what commands print into the page."""
        text = self.path.read_text(encoding="utf-8")
        changed, behind = "", 0
        for block in blocks(text):
            self.seen[block.language] = self.seen.get(block.language, 0) + 1
            if block.language == "pitch":
                self.write(block)
            elif block.language == "python":
                exec(compile(block.text, str(self.path), "exec"), self.names)
            elif block.language == "console":
                changed += text[behind : block.start] + self.console(block.text)
                behind = block.start + len(block.text)
            else:
                self.faults.append(f"nobody tries a block of `{block.language}`")
        if os.environ.get("SETPIECE_BLESS"):
            self.path.write_text(changed + text[behind:], encoding="utf-8")
        elif self.faults:
            raise AssertionError(f"{self.path.name}:\n" + "\n".join(self.faults))

    def write(self, block: Block) -> None:
        """Writes a text into its file, and checks it and its layout."""
        found = re.fullmatch(r"pitch file=([\w.]+)", block.info)
        name = found[1] if found else "block.pitch"
        (self.folder / name).write_text(block.text, encoding="utf-8")
        for command in ("check", "fmt --check"):
            done = run(f"setpiece {command} {name}", self.folder)
            if done.returncode or "warning" in done.stderr:
                self.faults.append(f"{command}: {done.stdout}{done.stderr}\n{block.text}")

    def console(self, text: str) -> str:
        """Runs the commands of a console; returns it with what they print."""
        parts = re.split(r"^\$ (.*)\n", text, flags=re.MULTILINE)[1:]
        shown = ""
        for command, output in zip(parts[::2], parts[1::2], strict=True):
            shown += f"$ {command}\n"
            if not command.startswith("setpiece "):
                outside(command)
                shown += output
                continue
            done = run(command, self.folder)
            said = [line.rstrip() for line in (done.stdout + done.stderr).splitlines()]
            said = [line for line in said if not line.lstrip().startswith("speed ")]
            wanted = output.splitlines()
            # Of what needs no words, the page shows none.
            if wanted and not matches(wanted, said):
                self.faults.append("\n".join([f"$ {command}", *said]))
                shown += "".join(f"{line}\n" for line in said)
                continue
            if not wanted and done.returncode:
                self.faults.append("\n".join([f"$ {command}", *said]))
            shown += output
        return shown


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs a line with the package's command."""
    words = shlex.split(command)
    return subprocess.run(
        [sys.executable, "-m", *words],
        capture_output=True,
        text=True,
        encoding="utf-8",
        cwd=folder,
        check=False,
        timeout=300,
    )


def outside(command: str) -> None:
    """Checks a command that isn't run here: an installation, or a program of the examples."""
    words = shlex.split(command)
    if words[:2] == ["pip", "install"]:
        project = (ROOT / "python/pyproject.toml").read_text(encoding="utf-8")
        table = project.partition("[project.optional-dependencies]\n")[2].partition("\n\n")[0]
        extras = re.findall(r"^(\w+) = ", table, re.MULTILINE)
        tested = (ROOT / "python/requirements-full.txt").read_text(encoding="utf-8")
        for word in words[2:]:
            found = re.fullmatch(r"\./python(?:\[(\w+)])?", word)
            assert found or re.search(rf"^{word}>=", tested, re.MULTILINE), f"{command}: {word}"
            assert not found or found[1] is None or found[1] in extras, f"{command}: {word}"
        return
    assert words[0] == "python", command
    assert words[1].startswith("examples/"), command
    program = (ROOT / words[1]).read_text(encoding="utf-8")
    for word in words[2:]:
        assert not word.startswith("--") or f'"{word}"' in program, f"{command}: {word}"
        assert not word.startswith("examples/") or (ROOT / word).exists(), f"{command}: {word}"
