"""The pages of docs/: their Python examples and generated tables."""

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
HEAVY = re.compile(r"\b(stable_baselines3|sb3_contrib|ray|syllabus[.]curricula)\b")
"""Imports of examples that only the tests in `full` have."""


def examples(page: str, *, heavy: bool = False) -> list[str]:
    """Returns the Python examples of a page, those that need heavy packages or the others."""
    blocks = re.findall(
        r"```python\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL
    )
    return [block for block in blocks if bool(HEAVY.search(block)) == heavy]


def table(head: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    """Returns a table in Markdown."""
    head = list(head)
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines)


def hold_tables(page: str, tables: Mapping[str, str]) -> None:
    """Compares the tables after `<!-- table NAME -->` with the wanted ones.

    SETPIECE_BLESS=1 rewrites them.
    """
    path = DOCS / page
    text = path.read_text(encoding="utf-8")
    pattern = re.compile(r"(<!-- table (\w+) -->\n)((?:\|.*\n)*)")
    assert sorted(found[1] for found in pattern.findall(text)) == sorted(tables)
    wanted = pattern.sub(lambda found: found[1] + tables[found[2]], text)
    if os.environ.get("SETPIECE_BLESS"):
        path.write_text(wanted, encoding="utf-8")
    assert path.read_text(encoding="utf-8") == wanted, (
        f"{page} shows other tables: SETPIECE_BLESS=1 rewrites them"
    )
