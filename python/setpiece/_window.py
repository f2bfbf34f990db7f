"""Windows that show matches while they are played."""

from __future__ import annotations

from types import ModuleType
from typing import Any
from weakref import WeakSet

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import MissingPackageError, UnavailableError
from setpiece._optional import need


class Window:
    """Shows frames at a steady rate, until it is closed. A process may have several."""

    def __init__(self, title: str, fps: int) -> None:
        """Opens with the first frame; `title` is its caption."""
        self._pygame: ModuleType = pygame_ce('`render_mode="human"`')
        self._title, self._fps = title, fps
        self._clock: Any = self._pygame.time.Clock()
        self._window: Any = None
        self.closed = False
        """Whether it is closed, by its user or by `close`."""

    def show(self, frame: NDArray[np.uint8]) -> None:
        """Shows a frame, uint8 `(height, width, 3)`, and waits until the next one is due.

        A window that its user has closed stays closed. Raises `UnavailableError` without a display.
        """
        pygame, size = self._pygame, frame.shape[1::-1]
        if self.closed:
            return
        try:
            if self._window is None:
                pygame.display.init()
                self._window = pygame.Window(self._title, size)
                _OPEN.add(self)
            elif self._window.size != size:
                self._window.size = size
        except pygame.error as error:
            raise UnavailableError(
                f"no window can be opened: {error}",
                name="render_mode",
                help='`render_mode="rgb_array"` needs no display',
            ) from None
        _close_as_asked(pygame)
        if self._window is None:
            return
        picture = pygame.image.frombuffer(frame.tobytes(), size, "RGB")
        self._window.get_surface().blit(picture, (0, 0))
        self._window.flip()
        self._clock.tick(self._fps)

    def close(self) -> None:
        """Closes the window."""
        self.closed = True
        if self._window is not None:
            self._window.destroy()
            self._window = None
        _OPEN.discard(self)

    def is_on(self, window: Any) -> bool:
        """Whether this is pygame's window."""
        return self._window is not None and self._window is window


_OPEN: WeakSet[Window] = WeakSet()
"""All windows: whichever is shown next reads the events of all."""


def _close_as_asked(pygame: ModuleType) -> None:
    """Closes the windows that their users have closed."""
    for event in pygame.event.get():
        for window in [*_OPEN]:
            if event.type == pygame.QUIT or (
                event.type == pygame.WINDOWCLOSE and window.is_on(event.window)
            ):
                window.close()


def pygame_ce(what: str) -> ModuleType:
    """Imports pygame-ce; raises `MissingPackageError`, also if there is only the older pygame."""
    pygame = need("pygame", "human", what)
    if not hasattr(pygame, "Window"):
        raise MissingPackageError(
            f"{what} needs the package `pygame-ce`, and `pygame` is in its place",
            name="pygame-ce",
            help="pip uninstall pygame, then pip install 'setpiece[human]'",
        )
    return pygame


def tile_size(whole: tuple[int, int], n: int) -> tuple[int, int]:
    """Returns the width and height of n pictures that `mosaic` puts into one of size `whole`."""
    columns = _columns(n)
    return max(1, whole[0] // columns), max(1, whole[1] // columns)


def mosaic(frames: list[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    """Returns frames of one size as one picture, side by side in rows; empty places are black."""
    columns = _columns(len(frames))
    rows = -(-len(frames) // columns)
    height, width, channels = frames[0].shape
    picture = np.zeros((rows * height, columns * width, channels), np.uint8)
    for at, frame in enumerate(frames):
        top, left = at // columns * height, at % columns * width
        picture[top : top + height, left : left + width] = frame
    return picture


def _columns(n: int) -> int:
    return int(np.ceil(np.sqrt(n)))
