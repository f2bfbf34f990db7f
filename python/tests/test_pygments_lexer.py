"""The lexer for Pygments, over every `.pitch` text of the repository."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pygments = pytest.importorskip("pygments")

from pygments.lexers import get_lexer_by_name, get_lexer_for_filename  # noqa: E402
from pygments.token import Token  # noqa: E402

ROOT = Path(__file__).parents[2]
FOREIGN = {*"#'`^!%±üöß\xa0", *"\u2018\u2019\u201c\u201d\u2212\u2013"}
"""Characters that the language doesn't have; the specification shows what is reported of them."""


def tokens(text: str) -> list[tuple[Any, str]]:
    """Returns the tokens of a text, without spaces."""
    found = get_lexer_by_name("pitch").get_tokens(text)
    return [(kind, part) for kind, part in found if part.strip()]


def texts() -> Iterator[tuple[Path, str]]:
    for folder in ("stdlib-scenarios", "examples", "dsl/tests", "tests/spec"):
        for path in sorted((ROOT / folder).rglob("*.pitch")):
            yield path, path.read_text(encoding="utf-8")


def test_pygments_finds_it() -> None:
    assert get_lexer_for_filename("corner.pitch").name == "Setpiece"
    assert get_lexer_by_name("setpiece").name == "Setpiece"


def test_every_text_of_the_repository_has_its_colours() -> None:
    seen = 0
    for path, text in texts():
        lexed = list(get_lexer_by_name("pitch", stripnl=False, ensurenl=False).get_tokens(text))
        assert "".join(part for _, part in lexed) == text, path
        wrong = {part for kind, part in lexed if kind is Token.Error}
        # Only the specification has broken texts.
        assert wrong <= (FOREIGN if "spec" in path.parts else set()), (path, wrong)
        seen += len(lexed)
    assert seen > 100_000


def test_every_block_of_the_pages_has_its_colours() -> None:
    seen = 0
    for path in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        for block in path.read_text(encoding="utf-8").split("\n```pitch")[1:]:
            text = block.partition("\n")[2].partition("\n```")[0]
            broken = "error=" in block.partition("\n")[0]
            assert broken or all(kind is not Token.Error for kind, _ in tokens(text)), path
            seen += 1
    assert seen > 100


def test_words_are_what_the_language_takes_them_for() -> None:
    found = tokens(
        "/// Pays.\n"
        "reward near(value: number = 0.5 in 0..1) {\n"
        '    give value when distance(me, ball) < 3m   as "near" // hm\n'
        "    give 1 on pass completed by us\n"
        "}\n"
        "scenario drill extends academy { team left { wing: RM at (0.5, 0) } end limit 40 steps }\n"
    )
    kinds = {part: kind for kind, part in found}
    wanted = {
        "/// Pays.": Token.Literal.String.Doc,
        "reward": Token.Keyword.Declaration,
        "near": Token.Name.Function,
        "number": Token.Keyword.Type,
        "0.5": Token.Literal.Number,
        "give": Token.Keyword,
        "distance": Token.Name.Builtin,
        "me": Token.Name.Builtin.Pseudo,
        "<": Token.Operator,
        "m": Token.Keyword.Type,
        "// hm": Token.Comment.Single,
        "pass": Token.Name.Constant,
        "completed": Token.Name.Constant,
        "drill": Token.Name.Function,
        "academy": Token.Name.Function,
        "RM": Token.Name.Class,
        "wing": Token.Name.Attribute,
        "steps": Token.Keyword.Type,
        "{": Token.Punctuation,
    }
    assert {part: kinds.get(part) for part in wanted} == wanted
    strings = [part for kind, part in found if kind is Token.Literal.String.Double]
    assert "".join(strings) == '"near"'


def test_comments_and_strings_over_lines_end_where_they_end() -> None:
    found = tokens('/* a\nscenario */ reward script rhai """\nfn f() { 1 }\n""" let x = "a\\"b"\n')
    parts = {part: kind for kind, part in found}
    assert parts["reward"] is Token.Keyword.Declaration
    assert parts["let"] is Token.Keyword.Declaration
    assert parts["script"] is Token.Keyword
    assert parts["x"] is Token.Name.Function
    assert parts['\\"'] is Token.Literal.String.Escape
    comment = "".join(part for kind, part in found if kind in Token.Comment)
    assert comment.replace(" ", "") == "/*ascenario*/"


def test_without_pygments_only_the_lexer_is_missing() -> None:
    text = (
        "import sys; sys.modules['pygments'] = sys.modules['pygments.lexer'] = None\n"
        "import setpiece\n"
        "try: import setpiece.pygments_lexer\n"
        "except setpiece.MissingPackageError as error: print(error.help)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", text], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.stdout == "pip install 'setpiece[pygments]'\n", done.stderr
