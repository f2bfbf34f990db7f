"""What a scenario may read: its own folder and below, and the library."""

from __future__ import annotations

from pathlib import Path
from typing import Any

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


MAKERS = {
    "make": setpiece.make,
    "make_vec": setpiece.make_vec,
    "parallel_env": setpiece.parallel_env,
}


@pytest.mark.parametrize("maker", MAKERS)
@pytest.mark.parametrize("opponents", [None, {"left": "lazy"}], ids=["plain", "with a behavior"])
def test_environments_take_it_as_load_does(
    maker: str, opponents: dict[str, str] | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make: Any = MAKERS[maker]
    inner = tmp_path / "inner"
    inner.mkdir()
    (tmp_path / "fine.pitch").write_text("const fine = 0.1\n")
    root = inner / "root.pitch"
    text = SCENARIO.format(path="../fine.pitch")
    text = text.replace(
        "require", "team right { CM at (0.2, 0) } agents { left: 0 right: 1 } require"
    )
    root.write_text(text)
    monkeypatch.chdir(inner)
    for source in (root, text):
        with pytest.raises(setpiece.CompileError, match="lies outside of"):
            make(source, opponents=opponents)
        env = make(source, opponents=opponents, allow_outside=True)
        env.reset(seed=1)
        env.close()
    with pytest.raises(setpiece.ParameterError, match="`allow_outside`"):
        make(root, allow_outside=1)


def test_a_watched_scenario_and_one_of_a_reset_may_lie_outside(tmp_path: Path) -> None:
    inner = tmp_path / "inner"
    inner.mkdir()
    (tmp_path / "fine.pitch").write_text("const fine = 0.1\n")
    root = inner / "root.pitch"
    root.write_text(SCENARIO.format(path="../fine.pitch"))
    with pytest.raises(setpiece.CompileError, match="lies outside of"):
        setpiece.make(root, watch=True)
    assert setpiece.make(root, watch=True, allow_outside=True).scenario.name == "s"
    env = setpiece.make("academy_empty_goal", allow_outside=True)
    env.reset(seed=1, options={"scenario": root})
    assert env.scenario.name == "s"
    env = setpiece.make("academy_empty_goal")
    with pytest.raises(setpiece.CompileError, match="lies outside of"):
        env.reset(seed=1, options={"scenario": root})
