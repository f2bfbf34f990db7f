"""Where a file of the repository is on the site."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
"""The repository."""

MOVED = {
    # The reference has the address `language/`.
    "docs/language.md": "tutorial.md",
    # Readers of the repository begin there.
    "README.md": "index.md",
}
"""Pages that are elsewhere than their path says."""

ASSETS = {".css", ".gif", ".json", ".mp4", ".onnx", ".png", ".svg"}
"""Endings of files that are copied as they are; every other file becomes a page."""


def place(path: Path) -> PurePosixPath:
    """Returns the place on the site of a file or folder of the repository.

    A page of `docs/` or `site/pages/` keeps its path. Everything else is under `files/`: a page in
    Markdown, or a page that shows the file.
    """
    inside = PurePosixPath(path.relative_to(ROOT).as_posix())
    if str(inside) in MOVED:
        return PurePosixPath(MOVED[str(inside)])
    for folder in ("docs", "site/pages"):
        if inside.is_relative_to(folder):
            inside = inside.relative_to(folder)
            break
    else:
        inside = "files" / inside
    if path.is_dir():
        return inside / "index.md"
    if inside.name == "README.md":
        return inside.with_name("index.md")
    if inside.suffix in ASSETS or inside.suffix == ".md":
        return inside
    return inside.with_name(inside.name + ".md")
