"""The examples of docs/python-rewards.md run unchanged, in order; its lists are complete."""

import re
from dataclasses import fields
from pathlib import Path
from typing import Any

import setpiece

PAGE = (Path(__file__).parents[2] / "docs" / "python-rewards.md").read_text(encoding="utf-8")


def words(heading: str) -> list[str]:
    """The words in the first column of a table."""
    rows = PAGE.split(f"| {heading} |", 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    return re.findall(r"`(\w+)`", " ".join(row.split("|")[1] for row in rows))


def test_every_example_runs() -> None:
    examples = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    assert examples
    names: dict[str, Any] = {}
    for example in examples:
        exec(compile(example, "python-rewards.md", "exec"), names)


def test_every_field_and_key_is_documented() -> None:
    assert words("of a `Step`") == [field.name for field in fields(setpiece.Step)]
    assert sorted(words("key")) == sorted(setpiece.ScenarioDict.__annotations__)
