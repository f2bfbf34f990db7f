"""Windows: matches that are watched and played by hand, without a display."""

from __future__ import annotations

import gc
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import setpiece
from setpiece import Action, gfootball
from setpiece._window import Window, mosaic, tile_size
from setpiece.gfootball import play_game
from setpiece.gfootball.env.observation_processor import read_dump

pygame: Any = pytest.importorskip("pygame")

CLOSE = "academy_empty_goal_close"
THREE = "academy_3_vs_1_with_keeper"


@pytest.fixture(autouse=True)
def no_display(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """SDL's driver that draws into memory."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    yield
    pygame.display.quit()


def windows() -> list[Any]:
    """The open windows of pygame, in the order in which they were opened."""
    gc.collect()
    found = (each for each in gc.get_objects() if type(each) is Window and each._window)
    return sorted((each._window for each in found), key=lambda window: window.id)


def close_by_hand(window: Any) -> None:
    pygame.event.post(pygame.event.Event(pygame.WINDOWCLOSE, window=window))


def shown(window: Any) -> np.ndarray:
    return pygame.surfarray.array3d(window.get_surface()).swapaxes(0, 1)


def test_every_step_is_shown() -> None:
    env = setpiece.make(THREE, render_mode="human", render_size=(96, 72))
    env.reset(seed=1)
    (window,) = windows()
    assert (window.size, window.title) == ((96, 72), THREE)
    assert np.array_equal(shown(window), env.picture())
    before = shown(window)
    env.step(Action.RIGHT)
    assert np.array_equal(shown(window), env.picture())
    assert np.any(shown(window) != before)
    env.close()
    assert not windows()


def test_each_environment_has_its_own_window() -> None:
    first, second = (
        setpiece.make(name, render_mode="human", render_size=(64, 48)) for name in (CLOSE, THREE)
    )
    first.reset(seed=1)
    second.reset(seed=1)
    one, other = windows()
    assert np.array_equal(shown(one), first.picture())
    # A window that its user closes stays closed; the match goes on, and so does the other window.
    close_by_hand(one)
    second.step(Action.RIGHT)
    assert windows() == [other]
    first.step(Action.RIGHT)
    first.reset()
    assert windows() == [other]
    assert np.array_equal(shown(other), second.picture())
    pygame.event.post(pygame.event.Event(pygame.QUIT))
    second.step(Action.RIGHT)
    assert not windows()


def test_a_vector_is_a_mosaic_that_fits() -> None:
    envs = setpiece.make_vec(CLOSE, 5, render_mode="human", render_size=(320, 180))
    envs.reset(seed=1)
    (window,) = windows()
    assert window.size == (3 * 106, 2 * 60)
    pictures = shown(window)
    single = setpiece.make(CLOSE)
    single.reset(seed=2)
    assert np.array_equal(pictures[:60, 106:212], single.picture((106, 60)))
    assert not pictures[60:, 212:].any()
    envs.close()
    assert not windows()


def test_tiles_fill_their_picture() -> None:
    assert tile_size((1280, 720), 1) == (1280, 720)
    assert tile_size((1280, 720), 64) == (160, 90)
    assert tile_size((16, 16), 1000) == (1, 1)
    tiles = [np.full((2, 3, 3), number, np.uint8) for number in (1, 2, 3)]
    assert mosaic(tiles)[..., 0].tolist() == [[1] * 3 + [2] * 3] * 2 + [[3] * 3 + [0] * 3] * 2


def test_without_a_display_the_error_says_what_needs_none(monkeypatch: pytest.MonkeyPatch) -> None:
    pygame.display.quit()
    monkeypatch.setenv("SDL_VIDEODRIVER", "none of SDL's")
    env = setpiece.make(CLOSE, render_mode="human")
    with pytest.raises(setpiece.UnavailableError, match="no window can be opened") as caught:
        env.reset(seed=1)
    assert "rgb_array" in str(caught.value.help)


def test_the_older_pygame_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(pygame, "Window")
    with pytest.raises(setpiece.MissingPackageError, match="pygame-ce") as caught:
        setpiece.make(CLOSE, render_mode="human")
    assert "setpiece[human]" in str(caught.value.help)


def held(monkeypatch: pytest.MonkeyPatch, *keys: int) -> None:
    """Holds keys of the keyboard."""
    down = defaultdict(bool, dict.fromkeys(keys, True))
    monkeypatch.setattr(pygame.key, "get_pressed", lambda: down)


def play(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *arguments: str) -> list[dict[str, Any]]:
    """Plays by hand; returns the records of the dump."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    command = ["--level", CLOSE, "--real_time=false", "--episodes=1", *arguments]
    assert play_game.main(command) == 0
    (dump,) = tmp_path.rglob("*.dump")
    return read_dump(str(dump))


def test_a_goal_is_scored_at_the_keyboard(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    held(monkeypatch, pygame.K_RIGHT, pygame.K_d)
    records = play(tmp_path, monkeypatch)
    assert records[-1]["cumulative_reward"] == 1
    # Dumps are of the match, not of the window.
    assert all("frame" not in record["observation"] for record in records)
    assert not windows()


def test_closing_the_window_ends_the_game(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def held_until_closed() -> dict[int, bool]:
        if windows():
            close_by_hand(windows()[0])
        return defaultdict(bool)

    monkeypatch.setattr(pygame.key, "get_pressed", held_until_closed)
    assert len(play(tmp_path, monkeypatch)) == 1


def test_the_drop_in_is_watched_and_no_longer() -> None:
    env = gfootball.env.create_environment(
        CLOSE, render=True, other_config_options={"render_resolution_x": 320}
    )
    env.reset()
    (window,) = windows()
    assert window.size == (320, 180)
    env.disable_render()
    assert not windows()
    env.step(0)
    assert env.render() is True
    assert len(windows()) == 1
    env.close()
