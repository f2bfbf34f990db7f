"""The Python examples of the READMEs run unchanged, in order."""

import pathlib
import re

import pytest

import setpiece

ROOT = pathlib.Path(__file__).parents[2]


@pytest.mark.parametrize(
    "readme", [ROOT / "README.md", ROOT / "python" / "README.md"], ids=["project", "package"]
)
def test_every_python_example_runs(readme: pathlib.Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", readme.read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    names = {"setpiece": setpiece}
    for block in blocks:
        exec(compile(block, str(readme), "exec"), names)
