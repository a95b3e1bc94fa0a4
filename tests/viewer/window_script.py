"""Uses the window as a person does: `window_script.py PART` runs one of the functions below."""

import os
import sys
import time
from collections.abc import Callable

import numpy as np
from _lib.view_options import parse
from _lib.viewer.session import Session
from _lib.viewer.window import Window
from conftest import ROOT
from pxr import Gf
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QSlider

SCENE = str(ROOT / "usd_scenes/features/cube_holes.usda")
TIME = str(ROOT / "usd_scenes/features/time.usda")


class Desk:
    """A window, and somebody in front of it."""

    def __init__(self, scene: str = SCENE) -> None:
        self.application = QApplication(sys.argv[:1])
        options = parse([scene, "--size", "320x200", "--set", "hdcc:samples=2"])
        self.session = Session(options)
        self.window = Window(self.session, "test", None)
        self.window.show_at(*options.size)
        self.picture = self.window.centralWidget().layout().itemAt(0).widget()
        self.settle()

    def settle(self) -> np.ndarray:
        """Waits until the picture has converged, and gives it."""
        deadline = time.monotonic() + 120
        before = None
        while time.monotonic() < deadline:
            QTest.qWait(50)
            if self.session.render():
                QTest.qWait(60)
                shown = self.shown()
                if before is not None and (shown == before).all():
                    return shown
                before = shown
        raise AssertionError("the picture does not converge")

    def shown(self) -> np.ndarray:
        image = (
            self.picture.pixmap()
            .toImage()
            .convertToFormat(self.picture.pixmap().toImage().Format.Format_RGB888)
        )
        rows = np.frombuffer(image.constBits(), np.uint8).reshape(-1, image.bytesPerLine())
        return rows[:, : 3 * image.width()].copy()

    def action(self, *titles: str) -> QAction:
        """Of a menu, by the titles on the way."""
        actions = self.window.menuBar().actions()
        for title in titles[:-1]:
            menu = next(a.menu() for a in actions if a.text().replace("&", "") == title)
            menu.aboutToShow.emit()
            actions = menu.actions()
        return next(a for a in actions if a.text().replace("&", "").startswith(titles[-1]))

    def says(self) -> str:
        return self.window._message.text()


def orbit() -> None:
    desk = Desk()
    before = desk.settle()
    at = desk.picture.rect().center()
    QTest.mousePress(desk.picture, Qt.MouseButton.LeftButton, pos=at)
    QTest.mouseMove(desk.picture, at + QPoint(60, 20))
    QTest.mouseRelease(desk.picture, Qt.MouseButton.LeftButton, pos=at + QPoint(60, 20))
    after = desk.settle()
    assert desk.session.camera_path.isEmpty
    assert (before != after).mean() > 0.05
    desk.action("View", "Frame all").trigger()
    assert (desk.settle() != after).mean() > 0.01


def click() -> None:
    desk = Desk()
    desk.settle()
    QTest.mouseClick(desk.picture, Qt.MouseButton.LeftButton, pos=desk.picture.rect().center())
    assert desk.says().startswith("/World/"), desk.says()
    assert "face" in desk.says()
    QTest.mouseClick(desk.picture, Qt.MouseButton.LeftButton, pos=QPoint(1, 1))
    assert desk.says() == "nothing is there"


def aov() -> None:
    desk = Desk()
    before = desk.settle()
    desk.action("AOV", "normal").trigger()
    assert (desk.settle() != before).any()
    assert desk.session.aov == "normal"
    desk.action("AOV", "color").trigger()
    assert (desk.settle() == before).all()


def settings() -> None:
    desk = Desk()
    adaptive = desk.action("Settings", "Adaptive levels")
    assert adaptive.isChecked()
    adaptive.trigger()
    desk.settle()
    assert ("Adaptive levels", "hdcc:adaptive", False) in desk.session.settings()
    desk.window._set("hdcc:level", "9")
    assert "hdcc:level cannot be '9'" in desk.says()
    desk.window._set("hdcc:level", "2")
    assert desk.says() == ""
    assert "Finest level: 2" in desk.action("Settings", "Finest level").text()


def camera() -> None:
    desk = Desk()
    (path,) = desk.session.cameras
    before = desk.settle()
    desk.action("View", "Free camera").trigger()
    # It stands where the scene's camera stood.
    free = desk.settle()
    assert np.abs(free.astype(int) - before).mean() < 12
    desk.session.orbit.dolly(0.5)
    desk.action("View", str(path)).trigger()
    assert (desk.settle() == before).all()


def time_line() -> None:
    desk = Desk(TIME)
    before = desk.settle()
    (slider,) = desk.window.findChildren(QSlider)
    slider.setValue(slider.maximum())
    assert (desk.settle() != before).any()
    assert desk.says() == f"frame {slider.maximum()}"
    slider.setValue(slider.minimum())
    assert (desk.settle() == before).all()


def pause() -> None:
    desk = Desk()
    desk.action("Render", "Pause").trigger()
    desk.session.set("hdcc:samples", 8)
    QTest.qWait(300)
    assert not desk.session.render()
    desk.action("Render", "Pause").trigger()
    desk.settle()
    assert desk.session.stats()["numCompletedSamples"] == 8


def resize() -> None:
    desk = Desk()
    desk.window.resize(500, 420)
    desk.settle()
    assert desk.session.size == (desk.picture.width(), desk.picture.height()) != (320, 200)
    image = desk.picture.pixmap().toImage()
    assert (image.width(), image.height()) == desk.session.size
    assert isinstance(desk.session.orbit.target, Gf.Vec3d)


PARTS: dict[str, Callable[[], None]] = {
    "orbit": orbit, "click": click, "aov": aov, "settings": settings, "camera": camera,
    "time": time_line, "pause": pause, "resize": resize,
}  # fmt: skip

if __name__ == "__main__":
    try:
        PARTS[sys.argv[1]]()
    except BaseException:
        sys.excepthook(*sys.exc_info())
        sys.stderr.flush()
        os._exit(1)
    os._exit(0)
