"""How the docs site is gathered and checked. `cargo xtask docs` builds it."""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Any

import pytest
from programs import ROOT


def module(name: str) -> Any:
    """Imports a module of the folder `site`."""
    sys.path.insert(0, str(ROOT / "site"))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(ROOT / "site"))


@pytest.fixture
def gathering(tmp_path: Path) -> Any:
    return module("gather").Gathering(tmp_path / "source")


def test_every_file_has_one_place() -> None:
    places = {
        "docs/README.md": "index.md",
        "docs/language.md": "tutorial.md",
        "docs/language/README.md": "language/index.md",
        "docs/errors/SP0201.md": "errors/SP0201.md",
        "site/pages/api/setpiece.md": "api/setpiece.md",
        "docs/training.png": "training.png",
        "examples/rondo.pitch": "files/examples/rondo.pitch.md",
        "examples": "files/examples/index.md",
        "engine/README.md": "files/engine/index.md",
        "CONTRIBUTING.md": "files/CONTRIBUTING.md",
    }
    place = module("layout").place
    assert {name: str(place(ROOT / name)) for name in places} == places


def test_links_lead_to_the_same_on_the_site(gathering: Any) -> None:
    page = ROOT / "docs" / "examples.md"
    text = "See [it](../examples/rondo.pitch), `[not](x)`, [there](language.md#3-parameters-draws-requirements).\n"
    assert gathering.markdown(page, text) == (
        "See [it](files/examples/rondo.pitch.md), `[not](x)`, "
        "[there](tutorial.md#3-parameters-draws-requirements).\n"
    )
    shown = (gathering.out / "files/examples/rondo.pitch.md").read_text(encoding="utf-8")
    assert "```pitch\n" in shown
    assert "scenario rondo" in shown
    assert not gathering.faults
    gathering.markdown(page, "One.\n\n[nowhere](nowhere.md)\n")
    assert gathering.faults == ["docs/examples.md:3: `nowhere.md` is not there"]


def test_what_only_github_reads_is_changed(gathering: Any) -> None:
    text = (
        "Text:\n- one\n- two\n\n<!-- table x -->\n| a | b |\n|---|---|\n| `x \\| y` | z \\| w |\n\n"
        "```pitch error=SP0203\n- [kept](as it is)\n```\n"
    )
    assert gathering.markdown(ROOT / "docs" / "see.md", text) == (
        "Text:\n\n- one\n- two\n\n\n| a | b |\n|---|---|\n| `x | y` | z \\| w |\n\n"
        "```pitch\n- [kept](as it is)\n```\n"
    )


def test_what_is_broken_is_found(tmp_path: Path) -> None:
    def write(name: str, text: str) -> None:
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"<nav><a href='far/'>x</a></nav><article>{text}</article>")

    write(
        "index.html", "<h1 id='top'>A</h1><a href='near/#there'>x</a><a href='https://a.b/'>x</a>"
    )
    write("near/index.html", "<p id='there'></p><a href='../far/'>x</a><a href='../#top'>x</a>")
    write("far/index.html", "The <b>answer</b>\n is 42.<a href='../index.html#no'>x</a>")
    items = [{"title": "<code>success_rate</code>", "text": "a &lt; b"}]
    (tmp_path / "search.json").write_text(json.dumps({"items": items}))
    site = module("check").Site(tmp_path)
    assert site.broken() == [
        "far/index.html: far/ leads nowhere",
        "far/index.html: ../index.html#no has no such anchor",
        "near/index.html: far/ leads nowhere",
    ]
    assert site.missing(["near/", "nowhere/"]) == ["no page at nowhere/"]
    assert site.unsearchable(["success_rate", "a < b"]) == []
    assert site.unsearchable(["code"]) == ["the search doesn't find `code`"]
    assert site.clicks(2) == {"index.html": 0, "near/index.html": 1, "far/index.html": 2}
    asked = {"question": "What?", "page": "far/index.html", "answer": "The answer is 42"}
    assert site.far([asked]) == []
    assert site.far([asked], most=1) == ["more than 1 clicks: What?"]
    assert len(site.far([{**asked, "answer": "is 43"}])) == 1
