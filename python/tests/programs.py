"""Commands of the pages that no test runs: what they name has to be there."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path

import setpiece

ROOT = Path(__file__).parents[2]


def outside(command: str, folder: Path) -> str | None:
    """Checks a command that isn't run here; returns what is wrong with it.

    It may be an installation, a program of ours, or one of another project.
    """
    program, *words = shlex.split(command, comments=True)
    if check := PROGRAMS.get(program):
        try:
            check(words, folder)
        except MissingError as why:
            return str(why)
        return None
    return f"nobody knows the program `{program}`"


class MissingError(Exception):
    """Something that a command names isn't there."""


def need(condition: object, what: str) -> None:
    if not condition:
        raise MissingError(f"`{what}` isn't there")


def text(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def pip(words: list[str], _folder: Path) -> None:
    """Installs this package with extras that it has, and packages that are tested with it."""
    need(words[0] == "install", words[0])
    table = text("python/pyproject.toml").partition("[project.optional-dependencies]\n")[2]
    extras = re.findall(r"^(\w+) = ", table.partition("\n\n")[0], re.MULTILINE)
    tested = text("python/requirements-full.txt")
    for word in words[1:]:
        if own := re.fullmatch(r"\./python(?:\[(\w+)])?", word):
            need(own[1] is None or own[1] in extras, word)
        else:
            need(re.search(rf"^{re.escape(word)}>=", tested, re.MULTILINE), word)


def python(words: list[str], folder: Path) -> None:
    """Runs a program of the examples or baselines: its options, and the files and names in them."""
    program, *rest = words
    is_ours = program.startswith(("examples/", "baselines/"))
    need(is_ours and (ROOT / program).exists(), program)
    known = options(program)
    for option, word in zip(["", *rest], rest, strict=False):
        if word.startswith("--"):
            need(word in known, word)
        elif word.endswith(".pitch"):
            need((folder / word).exists() or (ROOT / word).exists(), word)
        elif option == "--scenario":
            need(word in setpiece.list(), word)


def options(program: str) -> set[str]:
    """Returns the options of a program; those of a learner are also its settings."""
    if program.startswith("baselines/") and "from command import command" in text(program):
        settings = re.findall(
            r"^    (\w+): \w+ = setting\(", text("baselines/settings.py"), re.MULTILINE
        )
        return {f"--{name}" for name in settings} | options("baselines/command.py")
    return {*re.findall(r'"(--[\w-]+)"', text(program))}


def cargo(words: list[str], _folder: Path) -> None:
    """Installs the command, or runs a chore with options that it knows."""
    if words[0] == "install":
        need(words[1:] == ["--path", "setpiece"], " ".join(words))
        return
    need(words[0] == "xtask", words[0])
    chore = words[1]
    need(f'("{chore}", ' in text("xtask/src/main.rs"), chore)
    if chore == "transfer":
        source = text("lab/transfer/options.py")
        for word in words[2:]:
            need(not word.startswith("--") or f'"{word}"' in source, word)
    else:
        need(len(words) == 2, " ".join(words[2:]))


def tensorboard(words: list[str], _folder: Path) -> None:
    """Shows the logs of a folder."""
    need(
        re.search(r"^tensorboard>=", text("python/requirements-full.txt"), re.MULTILINE),
        "tensorboard",
    )
    need(words[0] == "--logdir" and len(words) == 2, words[0])


def code(words: list[str], _folder: Path) -> None:
    """Installs what a chore has packed into Visual Studio Code."""
    need(words[0] == "--install-extension" and len(words) == 2, words[0])
    need(Path(words[1]).name in text("xtask/src/vscode.rs"), words[1])


def copy(words: list[str], _folder: Path) -> None:
    """Copies a plugin that a chore has put together."""
    found = re.fullmatch(r"target/editors/(\w+)/\.", words[1])
    need(words[0] == "-r" and len(words) == 3, words[0])
    need(found and (ROOT / "editors" / found[1]).is_dir(), words[1])
    need("target/editors" in text("xtask/src/editors.rs"), words[1])


PROGRAMS: dict[str, Callable[[list[str], Path], None]] = {
    "cargo": cargo,
    "code": code,
    "cp": copy,
    "pip": pip,
    "python": python,
    "tensorboard": tensorboard,
}
