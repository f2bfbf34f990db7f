"""docs/examples.md: its files, its pictures, and the table that one of its files reads."""

import importlib
import re
import shutil
import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pages import DOCS

import setpiece

ROOT = DOCS.parent
PAGE = (DOCS / "examples.md").read_text(encoding="utf-8")
CSV = ROOT / "examples" / "expected_threat.csv"


def module(folder: str, name: str) -> Any:
    sys.path.insert(0, str(ROOT / folder))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(ROOT / folder))


def size(png: bytes) -> tuple[int, int]:
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", png[16:24])
    return width, height


def test_the_page_has_a_file_a_command_and_a_picture_for_each() -> None:
    pictures = re.findall(r"!\[[^]]+\]\(examples/(\w+)\.png\)", PAGE)
    assert pictures == list(module("lab/pictures", "pictures").PICTURES)
    for name in pictures:
        assert f"](../examples/{name}.pitch)" in PAGE
        assert f"setpiece run examples/{name}.pitch" in PAGE
        setpiece.load(ROOT / "examples" / f"{name}.pitch")
    for link in re.findall(r"\]\(([^)#:]+)\)", PAGE):
        assert (DOCS / link).exists(), link


def test_the_pictures_are_drawn_again(tmp_path: Path) -> None:
    pictures = module("lab/pictures", "pictures")
    pictures.main(["--out", str(tmp_path)])
    for name in pictures.PICTURES:
        drawn = (tmp_path / f"{name}.png").read_bytes()
        kept = (DOCS / "examples" / f"{name}.png").read_bytes()
        assert size(drawn) == size(kept), f"{name}: `cargo xtask pictures` draws it"
        assert len(kept) <= 60_000
    with pytest.raises(SystemExit):
        pictures.main(["nobody"])


def test_a_picture_keeps_its_few_colours(tmp_path: Path) -> None:
    pygame = pytest.importorskip("pygame")
    drawing = module("lab/pictures", "drawing")
    pixels = np.full((20, 30, 3), 30, np.uint8)
    pixels[5:9, 7:20] = (250, 10, 90)
    drawing.save(tmp_path / "two.png", pixels)
    read = pygame.surfarray.array3d(pygame.image.load(tmp_path / "two.png")).swapaxes(0, 1)
    assert np.abs(read.astype(int) - pixels).max() <= 2


def test_the_table_is_what_few_matches_give(tmp_path: Path) -> None:
    example = module("examples", "expected_threat")
    out = tmp_path / CSV.name
    table = example.main(["--matches", "2", "--out", str(out)])
    assert table.shape == (8, 12)
    assert table.min() >= 0
    assert 0 < table.max() <= 1
    assert np.array_equal(table, table[::-1])
    assert np.allclose(np.loadtxt(out, delimiter=","), table, atol=1e-4)
    assert "--matches 2 --seconds 10 --seed 0" in out.read_text(encoding="utf-8")
    shutil.copy(CSV.with_suffix(".pitch"), tmp_path)
    env = setpiece.make(tmp_path / "expected_threat.pitch", seed=0)
    env.reset()
    with pytest.raises(SystemExit):
        example.main(["--matches", "0"])


def test_the_committed_table_is_smooth_and_grows_towards_their_goal() -> None:
    table = np.loadtxt(CSV, delimiter=",")
    middle = table[3]
    assert table.shape == (8, 12)
    assert (np.diff(middle) >= 0).all()
    assert middle[-1] > 10 * table[0, -1]


def test_a_moment_counts_if_the_team_scores_before_an_opponent_has_the_ball() -> None:
    example = module("examples", "expected_threat")
    owner = np.array([1, 1, 0, -1, 1, 1, 0, 0, 1], np.int8)[:, None]
    goal = np.array([0, 0, 0, 0, 0, 0, 0, 1, 0], np.int8)[:, None]
    ball = np.zeros((9, 1, 2), np.float32)
    ball[5] = (0.99, 0.3)
    watched = example.Watched(owner, goal, ball)
    assert example.scores_soon(watched, 1, 10)[:, 0].tolist() == [0, 0, 0, 1, 1, 1, 1, 0, 0]
    assert example.scores_soon(watched, 1, 2)[:, 0].tolist() == [0, 0, 0, 0, 0, 1, 1, 0, 0]
    assert not example.scores_soon(watched, -1, 10).any()
    moments, good = example.counted(watched, 10)
    assert moments.sum() == 2 * 6  # Each moment counts on both sides.
    assert good[6, 11] == good[1, 11] == moments[6, 11] == 1
