"""Builds the docs site into target/site and checks it: `cargo xtask docs`."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from check import Site
from gather import Gathering
from layout import ROOT

OUT = ROOT / "target/site"


def main() -> int:
    """Gathers the pages, builds the site in strict mode, and checks what came out."""
    gathering = Gathering(ROOT / "target/docs-source")
    gathering.gather()
    if gathering.faults:
        return report(gathering.faults)
    shutil.copyfile(ROOT / "site/site.css", gathering.out / "site.css")
    shutil.rmtree(OUT, ignore_errors=True)
    zensical = [sys.executable, "-m", "zensical", "build", "--strict", "--clean"]
    built = subprocess.run(zensical, cwd=ROOT, env={**os.environ, "NO_COLOR": "1"}, check=False)
    if built.returncode:
        return built.returncode
    site = Site(OUT)
    questions = json.loads((ROOT / "site/questions.json").read_text("utf-8"))
    codes = [path.stem for path in sorted((ROOT / "docs/errors").glob("SP*.md"))]
    faults = [
        *site.broken(),
        *site.missing(f"errors/{code}/" for code in codes),
        *site.unsearchable(),
        *site.far(questions),
    ]
    if faults:
        return report(faults)
    print(
        f"docs: {len(site.pages)} pages in {Path(os.path.relpath(OUT))}, all links lead somewhere"
    )
    return 0


def report(faults: list[str]) -> int:
    """Prints faults; returns the exit code for them."""
    for fault in faults:
        print(f"docs: {fault}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
