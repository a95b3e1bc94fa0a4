"""The window: menus, the time line, and the loop that renders."""

import time
from functools import partial
from typing import Any

from pxr import Sdf, Tf, Usd
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QAction, QActionGroup, QCloseEvent, QKeySequence
from PySide6.QtWidgets import (
    QFileDialog,
    QInputDialog,
    QLabel,
    QMainWindow,
    QMenu,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from .false_colors import to_rgb
from .picture_label import PictureLabel
from .session import Session

_MILLISECONDS = 20
#: Seconds between two readings of pictures that are still made of blocks.
_BLOCKS = 0.1
_PICTURES = "Pictures (*.exr *.png *.jpg *.tif)"


class Window(QMainWindow):
    """Shows a session until it is closed, or until its screenshot is written."""

    def __init__(self, session: Session, title: str, screenshot: str | None) -> None:
        super().__init__()
        self._session = session
        self._screenshot = screenshot
        self._shown: tuple[Any, ...] = ()
        self._read_at = 0.0
        self.setWindowTitle(f"{title} - hdCC")
        self._picture = PictureLabel(session.free_camera, self._move, self._pick, self._resize)
        self._message, self._numbers = QLabel(), QLabel()
        self.statusBar().addWidget(self._message, 1)
        self.statusBar().addPermanentWidget(self._numbers)
        self._lay_out()
        self._make_menus()
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._step)

    # ---- Layout and menus ----

    def _lay_out(self) -> None:
        column = QVBoxLayout()
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._picture, 1)
        if self._session.times:
            first, last = self._session.times
            slider = QSlider(Qt.Orientation.Horizontal)
            slider.setRange(round(first), round(last))
            slider.setValue(round(self._session.when.GetValue()))
            slider.valueChanged.connect(self._set_time)
            column.addWidget(slider)
        middle = QWidget()
        middle.setLayout(column)
        self.setCentralWidget(middle)

    def show_at(self, width: int, height: int) -> None:
        """Shows the window with a picture of that size."""
        self._picture.setFixedSize(width, height)
        self.adjustSize()
        self.show()
        self._go_on()
        self._picture.setMinimumSize(64, 36)
        self._picture.setMaximumSize(16777215, 16777215)

    def _make_menus(self) -> None:
        file = self.menuBar().addMenu("&File")
        self._add(file, "&Reload", self._reload, "Ctrl+R")
        self._add(file, "&Save picture ...", self._save, "Ctrl+S")
        self._add(file, "&Quit", self.close, "Ctrl+Q")
        view = self.menuBar().addMenu("&View")
        self._add(view, "Frame &all", self._frame_all, "F")
        view.addSeparator()
        cameras = [("Free camera", Sdf.Path.emptyPath)]
        cameras += [(str(path), path) for path in self._session.cameras]
        self._add_choices(view, cameras, self._session.camera_path, self._set_camera)
        aovs = self.menuBar().addMenu("&AOV")
        names = [(name, name) for name in self._session.aovs()]
        self._add_choices(aovs, names, self._session.aov, self._set_aov)
        self._settings = self.menuBar().addMenu("&Settings")
        self._settings.aboutToShow.connect(self._list_settings)
        render = self.menuBar().addMenu("&Render")
        self._add(render, "&Pause", self._session.pause, "Space").setCheckable(True)
        self._add(render, "&Stop", self._session.stop, "Esc").setCheckable(True)

    def _add(self, menu: QMenu, title: str, call: Any, keys: str = "") -> QAction:
        action = menu.addAction(title)
        action.setShortcut(QKeySequence(keys))
        action.triggered.connect(lambda is_checked: self._act(action, call, is_checked))
        return action

    def _act(self, action: QAction, call: Any, is_checked: bool) -> None:
        """Calls of checkable actions take whether they are checked, others nothing."""
        if action.isCheckable():
            call(is_checked)
        else:
            call()
        self._go_on()

    def _add_choices(
        self, menu: QMenu, choices: list[tuple[str, Any]], chosen: Any, choose: Any
    ) -> None:
        group = QActionGroup(menu)
        for title, value in choices:
            action = menu.addAction(title)
            action.setCheckable(True)
            action.setChecked(value == chosen)
            action.triggered.connect(partial(choose, value))
            group.addAction(action)

    def _list_settings(self) -> None:
        self._settings.clear()
        for title, key, value in self._session.settings():
            if isinstance(value, bool):
                action = self._add(self._settings, title, partial(self._set, key))
                action.setCheckable(True)
                action.setChecked(value)
            else:
                shown = f"{value:g}" if isinstance(value, float) else str(value)
                ask = partial(self._ask, title, key, shown)
                self._add(self._settings, f"{title}: {shown} ...", ask)

    # ---- What menus and the mouse do ----

    def _ask(self, title: str, key: str, shown: str) -> None:
        text, is_given = QInputDialog.getText(self, title, key, text=shown)
        if is_given:
            self._set(key, text)

    def _set(self, key: str, value: Any) -> None:
        self._message.setText(self._session.set(key, value))
        self._move()

    def _set_camera(self, path: Sdf.Path, *_: bool) -> None:
        if path.isEmpty:
            self._session.free_camera()
        self._session.camera_path = path
        self._move()

    def _set_aov(self, name: str, *_: bool) -> None:
        self._session.aov = name
        self._move()

    def _set_time(self, frame: int) -> None:
        self._session.when = Usd.TimeCode(frame)
        self._message.setText(f"frame {frame}")
        self._move()

    def _frame_all(self) -> None:
        self._session.free_camera().frame(self._session.bounds())
        self._move()

    def _reload(self) -> None:
        self._session.reload()
        self._move()

    def _save(self) -> None:
        file, _ = QFileDialog.getSaveFileName(self, "Save picture", "", _PICTURES)
        if file:
            self._message.setText(self._session.write(file) or f"{file} is written")

    def _pick(self, x: int, y: int) -> None:
        found = self._session.pick(x, y)
        text = "nothing is there"
        if found:
            text = "{path}  instance {instance}  face {element}  depth {depth:.4g}".format(**found)
        self._message.setText(text)

    def _resize(self, width: int, height: int) -> None:
        self._session.size = (width, height)
        self._move()

    def _move(self) -> None:
        """Something else is to be shown."""
        self._shown = ()
        self._go_on()

    def _go_on(self) -> None:
        """Looks for a new picture until there will be none."""
        if self.isVisible():
            self._timer.start(_MILLISECONDS)

    # ---- Rendering ----

    def _step(self) -> None:
        try:
            is_converged = self._session.render()
        except Tf.ErrorException as failure:
            self._message.setText("; ".join(item.commentary for item in failure.args))
            return
        stats = self._session.stats()
        samples = int(stats["numCompletedSamples"])
        newest = (samples, is_converged)
        is_due = samples == 0 and time.monotonic() - self._read_at > _BLOCKS
        if newest != self._shown or is_due:
            self._show_picture()
            self._shown = newest
        self._show_numbers(stats)
        if is_converged:
            self._timer.stop()
        if is_converged and self._screenshot:
            QTimer.singleShot(0, self._shoot)

    def _show_picture(self) -> None:
        plane = self._session.plane()
        self._read_at = time.monotonic()
        if plane is not None:
            self._picture.show_rgb(to_rgb(self._session.aov, plane))

    def _show_numbers(self, stats: dict[str, Any]) -> None:
        self._numbers.setText(
            f"{self._session.aov}   {stats['numCompletedSamples']} samples   "
            f"{stats['percentDone']:.0f} %   {stats['polyCounts']:,} faces   "
            f"{stats['totalMemory'] / 2**20:.1f} MB"
        )

    def _shoot(self) -> None:
        self.grab().save(self._screenshot)
        self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ends the rendering with the window."""
        self._timer.stop()
        self._session.close()
        super().closeEvent(event)
