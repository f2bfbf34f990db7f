"""Gathers the site's pages: those of docs/, and a page for every file that they link to."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from layout import ASSETS, ROOT, place

LANGUAGES = {
    ".ipynb": "python",
    ".pitch": "pitch",
    ".py": "python",
    ".rs": "rust",
    ".sh": "bash",
    ".toml": "toml",
}
"""The language of a file's text; others have none."""

ALSO = ("ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md")
"""Pages outside of docs/ that the site has in any case."""

LARGEST = 200_000
"""The most bytes of a file that a page shows."""

FENCE = re.compile(r"^(\s*)(`{3,})\s*(\w*).*$")
LINK = re.compile(
    r"(?P<code>(?P<ticks>`+)(?!`).*?(?<!`)(?P=ticks)(?!`))"
    r"|(?P<head>\]\()(?P<target>[^)\s#]*)(?P<anchor>#[^)\s]*)?(?P<tail>(?:\s+\"[^\"]*\")?\))"
)
ITEM = re.compile(r"^\s*(?:[-*+]|\d+\.)\s")


class Gathering:
    """The pages of the site by the file that each shows."""

    def __init__(self, out: Path) -> None:
        self.out = out
        self.pages: set[Path] = set()
        self.faults: list[str] = []
        self.tracked = self.listed()

    @staticmethod
    def listed() -> set[Path]:
        """Returns the files of the repository that git doesn't ignore."""
        arguments = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
        found = subprocess.run(arguments, cwd=ROOT, check=True, capture_output=True, text=True)
        paths = (ROOT / name for name in found.stdout.split("\0") if name)
        return {path for path in paths if path.exists()}

    def gather(self) -> None:
        """Writes every page and picture of docs/ and site/pages, and what they link to."""
        shutil.rmtree(self.out, ignore_errors=True)
        for path in sorted(self.tracked):
            if path.is_relative_to(ROOT / "docs") or path.is_relative_to(ROOT / "site/pages"):
                self.add(path)
        for name in ALSO:
            self.add(ROOT / name)

    def add(self, path: Path) -> None:
        """Writes a file's page, and those of what it links to."""
        if path in self.pages or path == ROOT / "README.md":
            return
        self.pages.add(path)
        to = self.out / place(path)
        to.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix in ASSETS:
            shutil.copyfile(path, to)
        elif path.is_dir():
            to.write_text(self.folder(path), encoding="utf-8")
        elif path.suffix == ".md":
            to.write_text(self.markdown(path, path.read_text("utf-8")), encoding="utf-8")
        elif path.suffix == ".ipynb":
            to.write_text(self.markdown(path, notebook(path)), encoding="utf-8")
        elif path.stat().st_size > LARGEST:
            self.faults.append(f"{path.relative_to(ROOT)}: too long for a page")
        else:
            text = shown(path, path.read_text("utf-8"), LANGUAGES.get(path.suffix, "text"))
            to.write_text(text, encoding="utf-8")

    def folder(self, folder: Path) -> str:
        """Returns a page that lists a folder's files."""
        name = folder.relative_to(ROOT).as_posix()
        lines = [f"# {name}/", ""]
        for path in sorted(self.tracked):
            if path.is_relative_to(folder):
                link = self.link(folder / "index", path.relative_to(folder).as_posix(), "")
                lines.append(f"- [{path.relative_to(folder).as_posix()}]({link})")
        return "\n".join(lines) + "\n"

    def markdown(self, page: Path, text: str) -> str:
        """Returns a page as the site's generator reads it."""
        return "\n".join(self.lines(page, text.splitlines())) + "\n"

    def lines(self, page: Path, lines: list[str]) -> Iterator[str]:
        """Yields the lines of a page; what GitHub reads in another way is changed."""
        fence, in_list, before = "", False, ""
        for number, line in enumerate(lines, 1):
            opened = FENCE.match(line)
            if fence:
                fence = "" if line.strip() == fence else fence
                yield line
            elif opened:
                fence = opened[2]
                # What follows the language is for tests.
                yield f"{opened[1]}{opened[2]}{opened[3]}"
            elif line.startswith("<!--"):
                yield ""
            else:
                if not line.strip():
                    in_list = False
                elif ITEM.match(line):
                    if not in_list and before.strip():
                        yield ""
                    in_list = True
                yield self.linked(page, number, line)
            before = line

    def linked(self, page: Path, number: int, line: str) -> str:
        """Returns a line with the site's links."""
        is_row = line.startswith("|")

        def change(found: re.Match[str]) -> str:
            if found["code"]:
                return found["code"].replace("\\|", "|") if is_row else found["code"]
            target, anchor = found["target"], found["anchor"] or ""
            if not target or re.match(r"[a-z]+:", target):
                return found[0]
            try:
                link = self.link(page, target, anchor)
            except FileNotFoundError:
                self.faults.append(f"{page.relative_to(ROOT)}:{number}: `{target}` is not there")
                return found[0]
            return f"{found['head']}{link}{found['tail']}"

        return LINK.sub(change, line)

    def link(self, page: Path, target: str, anchor: str) -> str:
        """Returns the link from one page to a file or folder, and adds that one's page."""
        path = (page.parent / target).resolve(strict=True)
        if path.is_dir() and (path / "README.md").exists():
            path = path / "README.md"
        if path.is_dir() and path == ROOT / "docs/errors":
            path = ROOT / "docs/errors.md"
        if not path.is_dir() and path not in self.tracked:
            raise FileNotFoundError(path)
        self.add(path)
        here = place(page.parent) if page.name == "index" else place(page)
        return os.path.relpath(place(path), here.parent).replace(os.sep, "/") + anchor


def shown(path: Path, text: str, language: str) -> str:
    """Returns a page that shows a file."""
    fence = "`" * max(3, *(len(run) + 1 for run in re.findall("`+", text)), 3)
    name = path.relative_to(ROOT).as_posix()
    return f"# {path.name}\n\n`{name}`\n\n{fence}{language}\n{text.rstrip()}\n{fence}\n"


def notebook(path: Path) -> str:
    """Returns a notebook's cells as Markdown, without outputs."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    texts = ("".join(cell["source"]) for cell in cells)
    kinds = (cell["cell_type"] for cell in cells)
    return "\n\n".join(
        text if kind == "markdown" else f"```python\n{text}\n```"
        for kind, text in zip(kinds, texts, strict=True)
    )
