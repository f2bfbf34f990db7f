"""A window that shows a match while it is played."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from setpiece._errors import UnavailableError
from setpiece._optional import need


class Window:
    """Shows frames at a steady rate, until it is closed."""

    def __init__(self, title: str, fps: int) -> None:
        """Opens with the first frame; `title` is its caption."""
        self._pygame: ModuleType = need("pygame", "human", '`render_mode="human"`')
        self._title, self._fps = title, fps
        self._clock: Any = self._pygame.time.Clock()
        self._screen: Any = None
        self._closed = False

    def show(self, frame: NDArray[np.uint8]) -> None:
        """Shows a frame, uint8 `(height, width, 3)`, and waits until the next one is due.

        A window that its user has closed stays closed. Raises `UnavailableError` without a display.
        """
        if self._closed:
            return
        pygame, size = self._pygame, frame.shape[1::-1]
        if self._screen is None or self._screen.get_size() != size:
            try:
                pygame.display.init()
                self._screen = pygame.display.set_mode(size)
            except pygame.error as error:
                raise UnavailableError(
                    f"no window can be opened: {error}",
                    name="render_mode",
                    help='`render_mode="rgb_array"` needs no display',
                ) from None
            pygame.display.set_caption(self._title)
        if any(event.type == pygame.QUIT for event in pygame.event.get()):
            self.close()
            return
        self._screen.blit(pygame.image.frombuffer(frame.tobytes(), size, "RGB"), (0, 0))
        pygame.display.flip()
        self._clock.tick(self._fps)

    def close(self) -> None:
        """Closes the window."""
        self._closed = True
        if self._screen is not None:
            self._screen = None
            self._pygame.display.quit()


def mosaic(frames: list[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    """Returns frames of one size as one picture, side by side in rows; empty places are black."""
    columns = int(np.ceil(np.sqrt(len(frames))))
    rows = -(-len(frames) // columns)
    height, width, channels = frames[0].shape
    picture = np.zeros((rows * height, columns * width, channels), np.uint8)
    for at, frame in enumerate(frames):
        top, left = at // columns * height, at % columns * width
        picture[top : top + height, left : left + width] = frame
    return picture
