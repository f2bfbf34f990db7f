"""The examples of docs/tools.md run, each where its library is installed."""

import re
import shlex
from importlib import import_module
from pathlib import Path

import pytest
from pages import DOCS

import setpiece
from setpiece._replay_command import main

pytestmark = pytest.mark.filterwarnings("default")

PAGE = (DOCS / "tools.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
NEEDS = ("kloppy", "benchmarl", "torchrl", "pufferlib")


def need_of(block: str) -> str | None:
    """The library that an example needs."""
    return next((name for name in NEEDS if re.search(rf"\b{name}\b", block)), None)


def test_each_section_has_an_example() -> None:
    assert [need_of(block) for block in BLOCKS] == [
        "kloppy",
        "torchrl",
        "benchmarl",
        None,
        "pufferlib",
    ]


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: need_of(block) or "groups")
def test_an_example_runs(block: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    if name := need_of(block):
        try:
            import_module(name)
        except ImportError:
            pytest.skip(f"{name} isn't installed")
    exec(compile(block, "tools.md", "exec"), {})


def test_the_commands_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    env = setpiece.make("academy_corner")
    env.reset(seed=1)
    env.step(0)
    env.save_replay("corner.pitchr")
    (commands,) = re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    for command in commands.splitlines():
        sign, program, word, *arguments = shlex.split(command)
        assert (sign, program, word) == ("$", "setpiece", "replay")
        assert main(arguments) == 0
    assert (tmp_path / "corner" / "event.jsonl").is_file()
    assert (tmp_path / "tables" / "events.csv").is_file()


def test_examples_and_anchors_of_the_page_exist() -> None:
    for path in re.findall(r"\]\((\.\./examples/[^)#]+)", PAGE):
        assert (DOCS / path).is_file()
    heads = {
        re.sub(r"[^a-z0-9 -]", "", head.lower()).replace(" ", "-")
        for head in re.findall(r"^#+ (.+)$", PAGE, re.MULTILINE)
    }
    assert set(re.findall(r"\]\(#([^)]+)\)", PAGE)) <= heads
