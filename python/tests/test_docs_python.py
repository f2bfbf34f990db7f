"""Every example of docs/python.md runs, in order, and its tables are complete."""

import re
from pathlib import Path
from typing import Any

import pytest
from gymnasium.vector import AutoresetMode
from pages import DOCS, examples, hold_tables, table

import setpiece

PAGE = "python.md"


def test_every_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for example in examples(PAGE):
        exec(compile(example, PAGE, "exec"), names)
    assert len(list((tmp_path / "replays").iterdir())) == 2


def test_every_error_is_documented() -> None:
    errors = [getattr(setpiece, name) for name in setpiece.__all__]
    errors = [
        error
        for error in errors
        if isinstance(error, type) and issubclass(error, setpiece.SetpieceError)
    ]
    rows = []
    for error in errors:
        others = [
            base.__name__
            for base in error.__bases__
            if base not in (setpiece.SetpieceError, Exception)
        ]
        assert error.__doc__
        rows.append(
            (
                f"`{error.__name__}`",
                ", ".join(others),
                error.__doc__.splitlines()[0].removesuffix("."),
            )
        )
    hold_tables(PAGE, {"errors": table(("error", "is also a", "says that"), rows)})


def test_all_infos_are_documented() -> None:
    env = setpiece.make("academy_empty_goal_close", seed=1)
    _, info = env.reset()
    while "outcome" not in info:
        *_, info = env.step(setpiece.Action.SHOT)
    text = (DOCS / PAGE).read_text(encoding="utf-8")
    section = text[text.index("`info` has in every step") : text.index("`reset(seed=s)`")]
    assert set(re.findall(r"`(\w+)`", section)) == {"info", *info, *info["setpiece"]}


def test_every_action_set_and_mode_is_documented() -> None:
    text = (DOCS / PAGE).read_text(encoding="utf-8")
    sets = re.findall(r'^\| `"(\w+)"` \|.* \| `\((\d+),\)`', text, re.MULTILINE)
    assert {name: int(length) for name, length in sets} == setpiece._native.ACTION_SETS
    modes = re.findall(r"^\| `([A-Z_]+)`", text, re.MULTILINE)
    assert sorted(modes) == sorted(mode.name for mode in AutoresetMode)
