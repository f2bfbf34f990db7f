"""The cells of examples/tour.ipynb run in order, and it is a valid notebook."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
TOUR = ROOT / "examples" / "tour.ipynb"
NOTEBOOK = json.loads(TOUR.read_text(encoding="utf-8"))
CELLS = NOTEBOOK["cells"]


def source(cell: dict[str, Any]) -> str:
    return "".join(cell["source"])


def test_it_is_a_notebook_without_outputs() -> None:
    assert (NOTEBOOK["nbformat"], NOTEBOOK["nbformat_minor"]) == (4, 5)
    assert set(NOTEBOOK) == {"cells", "metadata", "nbformat", "nbformat_minor"}
    for cell in CELLS:
        keys = {"id", "cell_type", "metadata", "source"}
        if cell["cell_type"] == "code":
            keys |= {"execution_count", "outputs"}
            assert (cell["execution_count"], cell["outputs"]) == (None, [])
        assert set(cell) == keys
        assert cell["cell_type"] in ("code", "markdown")
        assert re.fullmatch(r"[a-zA-Z0-9_-]{1,64}", cell["id"])
        assert cell["source"]
        assert all(isinstance(line, str) for line in cell["source"])
    assert len({cell["id"] for cell in CELLS}) == len(CELLS)


def test_its_links_lead_somewhere() -> None:
    links = [link for cell in CELLS for link in re.findall(r"\]\(([^)]+)\)", source(cell))]
    assert links
    assert [link for link in links if not (TOUR.parent / link).is_file()] == []


def test_its_cells_run_in_order(capsys: pytest.CaptureFixture[str]) -> None:
    names: dict[str, Any] = {}
    printed = {}
    for cell in CELLS:
        if cell["cell_type"] == "code":
            exec(compile(source(cell), f"tour.ipynb: {cell['id']}", "exec"), names)
            printed[cell["id"]] = capsys.readouterr().out
    assert all(printed.values())
    assert "did you mean `CF`?" in printed["slip"]
    assert "shaping/box entry" in printed["rewards"]
    assert len(printed["rewards"].splitlines()) == 11
