"""The pages of the docs: every block of them is tried, in order, here or by tests of their own."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest
from calls import faults
from console import Page, blocks, cut, matches
from programs import ROOT

import setpiece

DOCS = ROOT / "docs"

TRIED = {
    "docs/README.md": {"pitch": 1, "console": 3, "python": 1},
    "docs/authoring.md": {"pitch": 6, "console": 6},
    "docs/determinism.md": {"console": 2, "python": 2},
    "docs/editors.md": {"console": 2, "lua": 1},
    "docs/examples.md": {"console": 13},
    "docs/game.md": {"console": 1},
    "docs/language.md": {"pitch": 7, "console": 9, "python": 1},
    "docs/language/command.md": {"console": 3},
    "docs/language/import.md": {"pitch": 3},
    "docs/language/level.md": {"pitch": 3, "console": 1, "json": 1},
    "docs/language/script.md": {"pitch": 4, "rhai": 2},
    "docs/see.md": {"console": 2, "python": 2},
    "docs/shaping.md": {"pitch": 6, "console": 4, "python": 1},
    "docs/studio.md": {"console": 1, "python": 1},
    "docs/training.md": {"pitch": 2, "console": 6},
    "docs/transfer.md": {"console": 1},
    "editors/helix/README.md": {"console": 1},
    "editors/neovim/README.md": {"lua": 1},
    "editors/vscode/README.md": {"json": 1},
    "editors/zed/README.md": {"json": 1},
}
"""Pages that are tried here, with the least number of their blocks."""

OWN = {
    # tests/tests/pages.rs and setpiece/tests/tools.rs; a text is what no file brings about.
    r"docs/errors/SP\d{4}\.md": {"pitch", "console", "text"},
    # Written by setpiece/tests/reference.rs.
    r"docs/reference/command\.md": {"text"},
    # The language's reference: tests/tests/texts.rs.
    r"docs/language/\w+\.md": {"pitch"},
    # test_docs_python.py and full/test_docs.py.
    r"docs/python\.md": {"python"},
    # test_python_docs.py.
    r"docs/python-rewards\.md": {"python"},
    # test_gfootball_docs.py.
    r"docs/gfootball\.md": {"python"},
    # test_docs_observations.py.
    r"docs/observations\.md": {"python"},
    # full/test_docs_tools.py.
    r"docs/tools\.md": {"console", "python"},
}
"""Pages with tests of their own, and the languages of the blocks that these tests read."""


def text_of(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def pages() -> list[str]:
    """Every page of the docs and of the editors' plugins."""
    found = [*DOCS.rglob("*.md"), *(ROOT / "editors").glob("*/README.md")]
    return sorted(path.relative_to(ROOT).as_posix() for path in found)


@pytest.fixture
def things(tmp_path: Path) -> None:
    """Writes the texts, recorded episodes and folders that commands of the pages begin with."""
    corner = "scenario corner extends academy_corner { end limit 1s }"
    (tmp_path / "corner.pitch").write_text(corner)
    drill = "scenario drill extends academy_corner { param gap: length = 8m in 3m..15m }"
    (tmp_path / "drill.pitch").write_text(drill)
    env = setpiece.make("academy_corner", seed=7)
    env.reset()
    env.step(setpiece.Action.HIGH_PASS)
    (tmp_path / "runs").mkdir()
    for name in ("runs/academy_corner_7_0.pitchr", "before.pitchr", "after.pitchr"):
        env.save_replay(tmp_path / name)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")


@pytest.mark.parametrize("name", TRIED)
@pytest.mark.usefixtures("things")
def test_every_block_of_a_page_works(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    page = Page(ROOT / name, tmp_path)
    page.try_it()
    least = TRIED[name]
    assert all(page.seen.get(language, 0) >= count for language, count in least.items()), page.seen


@pytest.mark.parametrize("name", pages())
def test_no_block_is_left_out(name: str) -> None:
    text = text_of(name)
    found = list(blocks(text))
    # Every fence opens or closes one of them.
    fences = re.findall(r"^\s*(?:```|~~~).*$", text, re.MULTILINE)
    assert len(fences) == 2 * len(found), fences
    if name in TRIED:
        return
    own = next((own for page, own in OWN.items() if re.fullmatch(page, name)), set())
    # What follows the language may hide a block from a test of its own.
    plain = {block.language if name.startswith("docs/errors/") else block.info for block in found}
    assert plain <= own, f"no test reads these blocks of {name}: a row of TRIED brings them one"


def test_settings_of_editors_are_those_that_the_plugins_know() -> None:
    package = json.loads(text_of("editors/vscode/package.json"))["contributes"]
    (task,) = package["taskDefinitions"]
    (matcher,) = package["problemMatchers"]
    (block,) = blocks(text_of("editors/vscode/README.md"))
    for wanted in json.loads(block.text)["tasks"]:
        assert wanted["type"] == task["type"]
        assert wanted["task"] in task["properties"]["task"]["enum"]
        assert set(wanted) <= {"type", "problemMatcher", *task["properties"]}
        assert wanted.get("problemMatcher", "$setpiece") == f"${matcher['name']}"
    lua = text_of("editors/neovim/lua/setpiece.lua")
    (block,) = blocks(text_of("editors/neovim/README.md"))
    names = re.findall(r"vim\.g\.(\w+)", block.text)
    assert names
    assert all(f"vim.g.{name}" in lua for name in names)
    (block,) = blocks(text_of("editors/zed/README.md"))
    (server,) = json.loads(block.text)["lsp"]
    assert f"[language_servers.{server}]" in text_of("editors/zed/extension.toml")


def test_the_first_text_is_that_of_the_examples() -> None:
    text = (DOCS / "README.md").read_text(encoding="utf-8")
    first = next(block for block in blocks(text) if block.language == "pitch")
    assert first.text == (ROOT / "examples/breakaway.pitch").read_text(encoding="utf-8")


def test_the_picture_is_what_its_command_draws(tmp_path: Path) -> None:
    text = (DOCS / "README.md").read_text(encoding="utf-8")
    page = Page(DOCS / "README.md", tmp_path)
    for block in blocks(text):
        if block.language == "pitch":
            page.write(block)
        elif "render" in block.text:
            page.console(block.text)
    assert not page.faults
    drawn, kept = ((folder / "breakaway.png").read_bytes() for folder in (tmp_path, DOCS))
    assert drawn == kept


def test_a_console_may_leave_lines_out() -> None:
    assert matches(["a", "…", "c"], ["a", "b", "b", "c"])
    assert matches(["…", "c"], ["a", "c"])
    assert not matches(["a", "…", "c"], ["a", "b", "c", "d"])
    assert not matches(["a"], ["a", "b"])
    printed = ["a 1", "b", "c 1", "d", "e"]
    assert cut(["a 0", "…", "e"], printed) == ["a 1", "…", "e"]
    assert cut(["…", "c 0", "…"], printed) == ["…", "c 1", "…"]
    assert cut(["a 0"], printed) == printed


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("pitch\nscenario a { ball at centre }\n", "SP0411"),
        ("pitch\nscenario a  { end limit 1s }\n", "fmt --check"),
        ("pitch error=SP0203\nscenario a { ball at centre }\n", "SP0411"),
        ("console\n$ setpiece explain SP9999\n", "SP9999"),
        ("console\n$ setpiece explain SP0203\nSP0203: something else\n", "no such role"),
        ("console\n$ setpiece studio nowhere.pitch\n", "it ended by itself"),
        ("console\n$ setpiece run nowhere.pitch --watch\n", "it ended by itself"),
        ("console\nsetpiece list\n", "begins with"),
        ("console\n$ make all\n", "knows the program `make`"),
        ("console\n$ cargo xtask nothing\n", "`nothing` isn't there"),
        ("console\n$ cargo xtask transfer --much\n", "`--much` isn't there"),
        ("console\n$ pip install setpiece-of-nobody\n", "`setpiece-of-nobody` isn't there"),
        ("console\n$ python examples/nobody.py\n", "`examples/nobody.py` isn't there"),
        ("console\n$ python examples/train_cleanrl.py \\\n    --much 1\n", "`--much` isn't there"),
        ("console\n$ python examples/train_cleanrl.py --scenario no\n", "`no` isn't there"),
        ("console\n$ python baselines/mappo.py --repeat 2 --much 1\n", "`--much` isn't there"),
        ("console\n$ python baselines/ppo.py --every 5 --scenario no\n", "`no` isn't there"),
        ("console\n$ tensorboard --folder runs\n", "`--folder` isn't there"),
        ("console\n$ code --install-extension target/no.vsix\n", "`target/no.vsix` isn't there"),
        ("console\n$ cp -r target/editors/emacs/. ~/.emacs.d/\n", "`target/editors/emacs/.`"),
        ('json\n{"tasks": [}\n', "Expecting value"),
        ("lua\nvim.g.a = = 1\n", "unexpected symbol"),
        ("\nbare\n", "nobody tries"),
        ("text\n$ setpiece list\n", "nobody tries"),
    ],
)
def test_a_wrong_block_is_reported(tmp_path: Path, block: str, said: str) -> None:
    path = tmp_path / "page.md"
    path.write_text(f"Text.\n\n```{block}```\n")
    with pytest.raises(AssertionError, match=re.escape(said)):
        Page(path, tmp_path).try_it()


def test_a_wrong_figure_is_reported(tmp_path: Path) -> None:
    first = text_of("docs/language.md").partition("## 2.")[0]
    figure = re.search(r"mean score   (\d\.\d\d) : \d\.\d\d", first)
    assert figure
    for score, fits in ((figure[1], True), ("0.99", False)):
        path = tmp_path / "page.md"
        path.write_text(first[: figure.start(1)] + score + first[figure.end(1) :])
        page = Page(path, tmp_path)
        if fits:
            page.try_it()
        else:
            with pytest.raises(AssertionError, match=f"mean score   {re.escape(figure[1])}"):
                page.try_it()


@pytest.mark.parametrize("name", pages())
def test_programs_ask_for_what_there_is(name: str) -> None:
    programs = [block.text for block in blocks(text_of(name)) if block.language == "python"]
    found = [fault for program in programs for fault in faults(program)]
    assert not found


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ("import setpiece.nothing", "no module `setpiece.nothing`"),
        ("from setpiece.torchrl import nothing", "`setpiece.torchrl` has no `nothing`"),
        ("setpiece.nothing()", "no `setpiece.nothing`"),
        ("setpiece.torchrl.nothing()", "no `setpiece.torchrl.nothing`"),
        ('setpiece.torchrl.make("a", 8, nothing=1)', "`setpiece.torchrl.make` takes no `nothing`"),
        ('setpiece.make("a", nothing=1)', "`setpiece.make` takes no `nothing`"),
        ("from setpiece import make\nmake(nothing=1)", "`make` takes no `nothing`"),
    ],
)
def test_a_wrong_program_is_reported(program: str, said: str) -> None:
    assert [*faults(program)] == [said]
