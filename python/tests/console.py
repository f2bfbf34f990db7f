"""Pages whose every block is tried: texts are written, commands run, Python executed, in order."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from lupa.luajit21 import LuaRuntime, LuaSyntaxError
from programs import outside

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
    for found in re.finditer(r"^ *```(.*)\n((?:.*\n)*?) *```$", page, re.MULTILINE):
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


def cut(wanted: list[str], printed: list[str]) -> list[str]:
    """Returns what is printed, left out where a console leaves it out with `…`.

    The first part is as long as before, and so is the last. A part between them begins with the
    line whose first words are those of the first line before.
    """
    if GAP not in wanted:
        return printed
    shown, at = [], 0
    parts = [part.strip("\n").splitlines() for part in "\n".join(wanted).split(GAP)]
    words = [re.findall(r"[a-z]+", line)[:2] for line in printed]
    for number, part in enumerate(parts):
        if number == len(parts) - 1:
            at = max(at, len(printed) - len(part))
        elif number and part:
            begins = range(at, len(printed))
            wanted_words = re.findall(r"[a-z]+", part[0])[:2]
            at = next((n for n in begins if words[n] == wanted_words), at)
        shown += [*([GAP] if number else []), *printed[at : at + len(part)]]
        at += len(part)
    return shown


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
        tries: dict[str, Callable[[Block], None]] = {
            "json": self.json,
            "lua": self.lua,
            "pitch": self.write,
            "python": self.python,
            "rhai": self.keep,
        }
        changed, behind = "", 0
        for block in blocks(text):
            self.seen[block.language] = self.seen.get(block.language, 0) + 1
            if block.language == "console":
                changed += text[behind : block.start] + self.console(block.text)
                behind = block.start + len(block.text)
            elif block.language in tries:
                tries[block.language](block)
            else:
                self.faults.append(f"nobody tries a block of `{block.language}`:\n{block.text}")
        if os.environ.get("SETPIECE_BLESS"):
            self.path.write_text(changed + text[behind:], encoding="utf-8")
        elif self.faults:
            raise AssertionError(f"{self.path.name}:\n" + "\n".join(self.faults))

    def python(self, block: Block) -> None:
        """Runs a program, with the names of those before it."""
        exec(compile(block.text, str(self.path), "exec"), self.names)

    def json(self, block: Block) -> None:
        """Reads an object."""
        try:
            json.loads(block.text)
        except ValueError as why:
            self.faults.append(f"{why}:\n{block.text}")

    def lua(self, block: Block) -> None:
        """Compiles a program for Neovim."""
        try:
            LuaRuntime().compile(block.text)
        except LuaSyntaxError as why:
            self.faults.append(f"{why}:\n{block.text}")

    def keep(self, block: Block) -> str:
        """Writes a text into its file; returns the file's name."""
        found = re.search(r" file=([\w.]+)", block.info)
        name = found[1] if found else f"block.{block.language}"
        (self.folder / name).write_text(block.text, encoding="utf-8")
        return name

    def write(self, block: Block) -> None:
        """Writes a text into its file, and checks it and its layout.

        A block with `error=CODE,…` has to earn these codes, and its layout is its own.
        """
        name = self.keep(block)
        if found := re.search(r" error=([\w,]+)", block.info):
            done = run(f"setpiece check {name}", self.folder)
            codes = re.findall(r"^SP\d{4}$", done.stdout, re.MULTILINE)
            if codes != found[1].split(","):
                self.faults.append(f"check: {codes} instead of {found[1]}\n{block.text}")
            return
        for command in ("check", "fmt --check"):
            done = run(f"setpiece {command} {name}", self.folder)
            if done.returncode or re.search(r"^SP\d{4}", done.stdout, re.MULTILINE):
                self.faults.append(f"{command}: {done.stdout}\n{block.text}")

    def console(self, text: str) -> str:
        """Runs the commands of a console; returns it with what they print."""
        before, *parts = re.split(r"^\$ ((?:.*\\\n)*.*)\n", text, flags=re.MULTILINE)
        if before or not parts:
            self.faults.append(f"a console begins with `$ ` and a command:\n{text}")
        shown = before
        for command, output in zip(parts[::2], parts[1::2], strict=True):
            shown += f"$ {command}\n"
            if not command.startswith("setpiece "):
                if fault := outside(command, self.folder):
                    self.faults.append(f"$ {command}\n{fault}")
                shown += output
                continue
            if ready := stays(command):
                if fault := started(command, self.folder, ready):
                    self.faults.append(f"$ {command}\n{fault}")
                shown += output
                continue
            done = run(command, self.folder)
            said = [line.rstrip() for line in done.stdout.splitlines()]
            said = [line for line in said if not line.lstrip().startswith("speed ")]
            wanted = output.splitlines()
            # Of what needs no words, the page shows none.
            if wanted and not matches(wanted, said):
                self.faults.append("\n".join([f"$ {command}", *said]))
                shown += "".join(f"{line}\n" for line in cut(wanted, said))
                continue
            if not wanted and done.returncode:
                self.faults.append("\n".join([f"$ {command}", *said]))
            shown += output
            self.written(command)
        return shown

    def written(self, command: str) -> None:
        """Checks that what a command writes is there."""
        for option, word in pairwise(shlex.split(command)):
            path = self.folder / word
            there = path.is_dir() or (path.is_file() and path.stat().st_size > 0)
            if option in OUTPUTS and not there:
                self.faults.append(f"$ {command}\n`{word}` is not written")


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs a line with the package's command; what it prints is in the order of a terminal."""
    return subprocess.run(
        [sys.executable, "-m", *shlex.split(command)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        cwd=folder,
        check=False,
        timeout=300,
    )


OUTPUTS = ("-o", "--output", "-p", "--picture", "--plot")
"""Options whose value is what a command writes."""

READY = {"studio": "Ctrl-C ends", "--watch": "Ctrl-C ends", "--live": "┌"}
"""What a command that goes on has printed once it has begun, by the word that makes it go on."""


def stays(command: str) -> str | None:
    """Returns what a command prints when it has begun, if it then goes on."""
    return next((said for word, said in READY.items() if word in shlex.split(command)), None)


def started(command: str, folder: Path, ready: str) -> str | None:
    """Starts a command that goes on, and ends it when it has begun; returns what is wrong.

    The studio takes any free port.
    """
    words = shlex.split(command)
    for at, word in enumerate(words):
        if word == "--port":
            words[at + 1] = "0"
    process = subprocess.Popen(
        [sys.executable, "-m", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        cwd=folder,
    )
    said = ""
    assert process.stdout
    with process, process.stdout:
        for line in process.stdout:
            said += line
            if ready in line:
                process.kill()
                return None
    return f"it ended by itself:\n{said}"
