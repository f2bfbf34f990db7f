"""What a scenario may read: its own folder and below, and the library."""

from __future__ import annotations

from pathlib import Path

import pytest

import setpiece

SCENARIO = """
import "{path}"
scenario s extends academy {{ ball at (0, 0) team left {{ CM at (0.1, 0) }} require fine < 1 }}
"""


def test_imports_stay_below_the_root_unless_outside_is_allowed(tmp_path: Path) -> None:
    inner = tmp_path / "inner"
    inner.mkdir()
    (tmp_path / "fine.pitch").write_text("const fine = 0.1\n")
    (inner / "fine.pitch").write_text("const fine = 0.1\n")
    root = inner / "root.pitch"
    root.write_text(SCENARIO.format(path="fine.pitch"))
    assert setpiece.load(root).name == "s"
    root.write_text(SCENARIO.format(path="../fine.pitch"))
    with pytest.raises(setpiece.CompileError, match="lies outside of"):
        setpiece.load(root)
    assert setpiece.load(root, allow_outside=True).name == "s"


def test_a_text_has_the_working_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "fine.pitch").write_text("const fine = 0.1\n")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    text = SCENARIO.format(path=tmp_path / "fine.pitch")
    monkeypatch.chdir(tmp_path)
    assert setpiece.compile(text).name == "s"
    monkeypatch.chdir(elsewhere)
    with pytest.raises(setpiece.CompileError, match="lies outside of"):
        setpiece.compile(text)
    assert setpiece.compile(text, allow_outside=True).name == "s"
    assert setpiece.load(text, allow_outside=True).name == "s"
