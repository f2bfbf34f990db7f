"""Every example of docs/gfootball.md runs, and its lists are complete."""

import re
from importlib.util import find_spec
from pathlib import Path

import pytest

from setpiece.gfootball.env.config import BUGS

PAGE = (Path(__file__).parents[2] / "docs" / "gfootball.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize("example", EXAMPLES)
def test_every_example_runs(example: str, nothing_installed: None) -> None:  # noqa: ARG001
    exec(compile(example, "gfootball.md", "exec"), {})


def test_every_bug_is_listed() -> None:
    assert tuple(re.findall(r"^\| `(\w+)` \|", PAGE, re.MULTILINE)) == BUGS


def test_modules_that_are_not_here_are_not() -> None:
    listed = PAGE.split("Of GRF's modules these are not here:", 1)[1].split("\n\n")[1]
    names = re.findall(r"`([a-z_.]+)`", listed)
    assert "eval_server" in names
    for name in names:
        assert find_spec(f"setpiece.gfootball.{name}") is None, name
