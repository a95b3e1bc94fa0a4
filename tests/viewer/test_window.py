"""The window of tools/view, on a display without a screen."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, View
from picture_kit import layers

HERO = ROOT / "usd_scenes/hero.usda"
HOLES = ROOT / "usd_scenes/features/cube_holes.usda"
SIZE = (480, 270)
OPTIONS = ("--size", "480x270", "--set", "hdcc:samples=4")


def shot(view: View, tmp_path: Path, scene: Path, *more: str) -> np.ndarray:
    """A picture of the whole window."""
    picture = tmp_path / "window.png"
    finished = view(scene, *OPTIONS, "--screenshot", picture, *more)
    assert finished.returncode == 0, finished.stderr
    assert not finished.stderr
    return layers(picture)["color"][..., :3]


def inside(window: np.ndarray) -> np.ndarray:
    """The picture between menus and status line."""
    bar = int(np.argmax(window[:, 400].min(axis=-1) < 0.6))
    assert 10 < bar < 50, "there is no menu bar"
    assert (window[:bar] > 0.8).mean() > 0.9
    assert (window[bar + SIZE[1] + 2 :] > 0.8).mean() > 0.8, "there is no status line"
    return window[bar : bar + SIZE[1], : SIZE[0]]


def test_it_shows_what_the_recorder_writes(view: View, tmp_path: Path) -> None:
    shown = inside(shot(view, tmp_path, HERO))
    recorded = tmp_path / "recorded.png"
    command = [ROOT / "tools/record", HERO, recorded, "--imageWidth", SIZE[0], "--quiet"]
    subprocess.run([*map(str, command), "--set", "hdcc:samples=4"], check=True)
    expected = layers(recorded)["color"][..., :3]
    assert expected.std() > 0.1
    assert np.abs(shown - expected).mean() < 0.002
    assert np.abs(shown - expected).max() < 0.02


def test_another_aov(view: View, tmp_path: Path) -> None:
    shown = inside(shot(view, tmp_path, HOLES, "--aov", "primId"))
    colors = np.unique((shown.reshape(-1, 3) * 255).round().astype(int), axis=0)
    assert 2 <= len(colors) <= 12
    assert [0, 0, 0] in colors.tolist()


@pytest.mark.parametrize(
    ("arguments", "code", "named"),
    [
        ([], 2, "scene"),
        (["missing.usda"], 1, "missing.usda"),
        ([HOLES, "--aov", "dept"], 2, "dept"),
        ([HOLES, "--size", "480"], 2, "480"),
        ([HOLES, "--size", "0x10"], 2, "0x10"),
        ([HOLES, "--frame", "now"], 2, "now"),
        ([HOLES, "--set", "hdcc:level"], 2, "hdcc:level"),
        ([HOLES, "--set", "hdcc:level=9"], 2, "hdcc:level"),
        ([HOLES, "--camera", "/Nobody"], 1, "/Nobody"),
        ([HOLES, "--screenshot", "nowhere/shot.png"], 1, "nowhere"),
    ],
)
def test_refusals(view: View, arguments: list[object], code: int, named: str) -> None:
    finished = view(*arguments)
    assert finished.returncode == code, finished.stderr
    assert len(finished.stderr.splitlines()) == 1, finished.stderr
    assert finished.stderr.startswith("error: ")
    assert named in finished.stderr.lower() if not arguments else named in finished.stderr


def test_without_a_display(view: View) -> None:
    finished = view(HOLES, DISPLAY="")
    assert finished.returncode == 1
    assert finished.stderr == "error: there is no display: DISPLAY is not set\n"


@pytest.mark.parametrize(
    "part", ["orbit", "click", "aov", "settings", "camera", "time", "pause", "resize"]
)
def test_what_people_do(display: str, part: str) -> None:
    environment = {**os.environ, "DISPLAY": display}
    environment["PYTHONPATH"] = os.pathsep.join(sys.path)
    script = Path(__file__).with_name("window_script.py")
    finished = subprocess.run(
        [sys.executable, str(script), part],
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr
