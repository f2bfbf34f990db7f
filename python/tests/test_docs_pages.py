"""The pages of the docs that have no test of their own: every block of them is tried, in order."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from console import ROOT, Page, blocks, matches

DOCS = ROOT / "docs"


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("README.md", {"pitch": 1, "console": 3, "python": 1}),
        ("authoring.md", {"pitch": 6, "console": 6}),
        ("shaping.md", {"pitch": 6, "console": 4, "python": 1}),
        ("determinism.md", {"console": 2, "python": 2}),
        ("game.md", {"console": 1}),
    ],
)
def test_every_block_of_a_page_works(
    name: str, least: dict[str, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    page = Page(DOCS / name, tmp_path)
    page.try_it()
    assert all(page.seen.get(language, 0) >= count for language, count in least.items()), page.seen


def test_the_first_text_is_that_of_the_examples() -> None:
    text = (DOCS / "README.md").read_text(encoding="utf-8")
    first = next(block for block in blocks(text) if block.language == "pitch")
    assert first.text == (ROOT / "examples/breakaway.pitch").read_text(encoding="utf-8")


def test_the_picture_is_what_its_command_draws(tmp_path: Path) -> None:
    text = (DOCS / "README.md").read_text(encoding="utf-8")
    page = Page(DOCS / "README.md", tmp_path)
    for block in blocks(text):
        if block.language == "pitch":
            page.write(block)
        elif "render" in block.text:
            page.console(block.text)
    assert not page.faults
    drawn, kept = ((folder / "breakaway.png").read_bytes() for folder in (tmp_path, DOCS))
    assert drawn == kept


def test_a_console_may_leave_lines_out() -> None:
    assert matches(["a", "…", "c"], ["a", "b", "b", "c"])
    assert matches(["…", "c"], ["a", "c"])
    assert not matches(["a", "…", "c"], ["a", "b", "c", "d"])
    assert not matches(["a"], ["a", "b"])


def test_a_wrong_page_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    path.write_text(
        "```pitch\nscenario a { ball at centre }\n```\n\n"
        "```console\n$ setpiece explain SP9999\n```\n\n"
        "```console\n$ setpiece explain SP0203\nSP0203: something else\n```\n\n"
        "```lua\nx\n```\n"
    )
    with pytest.raises(AssertionError) as raised:
        Page(path, tmp_path).try_it()
    said = str(raised.value)
    for part in ("SP0411", "SP9999", "no such role", "`lua`"):
        assert re.search(part, said), part
