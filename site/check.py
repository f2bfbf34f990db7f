"""Checks a built site: every link and anchor, the search, and the way to a newcomer's answers."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SEARCHED = ("success_rate", "SP0201", "own_goal", "make_vec", "--message-format")
"""Words that the search must find."""


@dataclass
class Page:
    """What a page of the site has."""

    anchors: set[str] = field(default_factory=set)
    links: list[str] = field(default_factory=list)
    """Every link, picture, script and style."""
    own: list[str] = field(default_factory=list)
    """The links in its text, without those of the frame around it."""
    text: str = ""


class Reader(HTMLParser):
    """Reads a page."""

    def __init__(self) -> None:
        super().__init__()
        self.page = Page()
        self.inside = 0

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Notes anchors and links."""
        has = {name: value or "" for name, value in attributes}
        self.inside += tag == "article"
        self.page.anchors.update(has[name] for name in ("id", "name") if has.get(name))
        for name in ("href", "src"):
            if has.get(name):
                self.page.links.append(has[name])
                if self.inside and tag == "a" and "headerlink" not in has.get("class", ""):
                    self.page.own.append(has[name])

    def handle_endtag(self, tag: str) -> None:
        """Notes the end of the text."""
        self.inside -= tag == "article"

    def handle_data(self, data: str) -> None:
        """Notes the text."""
        if self.inside:
            self.page.text += data


class Site:
    """The pages of a built site."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.pages: dict[str, Page] = {}
        for path in sorted(folder.rglob("*.html")):
            reader = Reader()
            reader.feed(path.read_text("utf-8"))
            self.pages[path.relative_to(folder).as_posix()] = reader.page

    def target(self, page: str, link: str) -> tuple[str, str] | None:
        """Returns the file and the anchor that a link leads to; None if it leads elsewhere."""
        parts = urlsplit(html.unescape(link))
        if parts.scheme or parts.netloc:
            return None
        path = unquote(parts.path)
        if not path:
            return page, unquote(parts.fragment)
        base = self.folder if path.startswith("/") else (self.folder / page).parent
        file = (base / path.lstrip("/")).resolve()
        if file.is_dir():
            file = file / "index.html"
        if not file.is_relative_to(self.folder):
            return path, ""
        return file.relative_to(self.folder).as_posix(), unquote(parts.fragment)

    def broken(self) -> list[str]:
        """Returns the links to what isn't there."""
        faults = []
        for name, page in self.pages.items():
            # What is shown for a wrong address may be anywhere.
            if name == "404.html":
                continue
            for link in page.links:
                found = self.target(name, link)
                if found is None:
                    continue
                file, anchor = found
                if not (self.folder / file).is_file():
                    faults.append(f"{name}: {link} leads nowhere")
                elif anchor and file in self.pages and anchor not in self.pages[file].anchors:
                    faults.append(f"{name}: {link} has no such anchor")
        return faults

    def missing(self, addresses: Iterable[str]) -> list[str]:
        """Returns the addresses without a page; reports and editors link to those of codes."""
        return [f"no page at {it}" for it in addresses if f"{it}index.html" not in self.pages]

    def unsearchable(self, words: Iterable[str] = SEARCHED) -> list[str]:
        """Returns the words that the search's index lacks."""
        items = json.loads((self.folder / "search.json").read_text("utf-8"))["items"]
        text = html.unescape(
            re.sub(r"<[^>]*>", "", " ".join(f"{it['title']} {it['text']}" for it in items))
        )
        return [f"the search doesn't find `{word}`" for word in words if word not in text]

    def clicks(self, most: int, start: str = "index.html") -> dict[str, int]:
        """Returns the pages within some clicks on links in the text of pages."""
        reached, edge = {start: 0}, [start]
        for click in range(1, most + 1):
            following = []
            for page in edge:
                for link in self.pages[page].own:
                    found = self.target(page, link)
                    if found and found[0] in self.pages and found[0] not in reached:
                        reached[found[0]] = click
                        following.append(found[0])
            edge = following
        return reached

    def far(self, questions: Iterable[dict[str, str]], most: int = 2) -> list[str]:
        """Returns the questions whose answer isn't within some clicks of the start."""
        near, faults = self.clicks(most), []
        for question in questions:
            page = question["page"]
            if page not in near:
                faults.append(f"more than {most} clicks: {question['question']}")
            elif " ".join(question["answer"].split()) not in " ".join(
                self.pages[page].text.split()
            ):
                faults.append(f"{page} doesn't say `{question['answer']}`: {question['question']}")
        return faults
