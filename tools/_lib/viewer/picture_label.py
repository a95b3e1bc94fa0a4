"""The picture in the window, and what the mouse does in it."""

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage, QMouseEvent, QPixmap, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QLabel, QSizePolicy

from .orbit_camera import OrbitCamera

_DEGREES_A_PIXEL = 0.4
_DOLLY_A_PIXEL = 0.005
_DOLLY_A_NOTCH = 0.9
#: Pixels that a click may slip.
_CLICK = 3


class PictureLabel(QLabel):
    """Shows pictures; drags move the camera, clicks ask what is there."""

    def __init__(
        self,
        take_camera: Callable[[], OrbitCamera],
        on_move: Callable[[], None],
        on_click: Callable[[int, int], None],
        on_resize: Callable[[int, int], None],
    ) -> None:
        super().__init__()
        self._take_camera = take_camera
        self._on_move = on_move
        self._on_click = on_click
        self._on_resize = on_resize
        self._pressed_at = self._last = QPoint()
        self.setMinimumSize(64, 36)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setStyleSheet("background: black")

    def show_rgb(self, rgb: np.ndarray) -> None:
        """Shows bytes of red, green and blue."""
        height, width, _ = rgb.shape
        image = QImage(rgb.tobytes(), width, height, 3 * width, QImage.Format.Format_RGB888)
        self.setPixmap(QPixmap.fromImage(image))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Remembers where a drag begins."""
        self._pressed_at = self._last = event.position().toPoint()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A press that has not moved is a click."""
        at = event.position().toPoint()
        if (at - self._pressed_at).manhattanLength() <= _CLICK:
            self._on_click(at.x(), at.y())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Orbits with the left button, pans with the middle one, goes nearer with the right."""
        at = event.position().toPoint()
        if (at - self._pressed_at).manhattanLength() <= _CLICK:
            return
        step, self._last = at - self._last, at
        camera = self._take_camera()
        buttons = event.buttons()
        is_shifted = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        if buttons & Qt.MouseButton.MiddleButton or (
            buttons & Qt.MouseButton.LeftButton and is_shifted
        ):
            camera.pan(-step.x() / self.height(), step.y() / self.height())
        elif buttons & Qt.MouseButton.LeftButton:
            camera.orbit(-_DEGREES_A_PIXEL * step.x(), _DEGREES_A_PIXEL * step.y())
        elif buttons & Qt.MouseButton.RightButton:
            camera.dolly(max(1 - _DOLLY_A_PIXEL * (step.x() - step.y()), 0.1))
        self._on_move()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Goes nearer or farther."""
        self._take_camera().dolly(_DOLLY_A_NOTCH ** (event.angleDelta().y() / 120))
        self._on_move()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Pictures are as large as the window has room for."""
        super().resizeEvent(event)
        self._on_resize(self.width(), self.height())
