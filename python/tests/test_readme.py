"""The Python examples of the README run as they stand."""

import pathlib
import re

README = pathlib.Path(__file__).parents[2] / "README.md"


def test_every_python_example_runs() -> None:
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, str(README), "exec"), {})
