"""The add-on for Blender: packaged, unpacked elsewhere, and rendered with."""

import json
import os
import subprocess
import zipfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from _lib import sdk

ROOT = Path(__file__).resolve().parents[2]
INSIDE = Path(__file__).with_name("render_in_blender.py")


@pytest.fixture(scope="module")
def add_on(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("blender")
    command = [str(ROOT / "tools" / "blender" / "package"), str(folder / "add_on.zip")]
    packaged = subprocess.run(command, capture_output=True, text=True, check=False)
    assert packaged.returncode == 0, packaged.stderr
    with zipfile.ZipFile(folder / "add_on.zip") as archive:
        archive.extractall(folder / "hdcc")
    return folder / "hdcc"


@pytest.fixture(scope="module")
def made(add_on: Path) -> tuple[Path, dict]:
    """The folder of pictures, and what the add-on said."""
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in ("PXR_PLUGINPATH_NAME", "PYTHONPATH")
    }
    python = sdk.ensure(quiet=True).python
    finished = subprocess.run(
        [str(python), str(INSIDE), str(add_on), str(add_on.parent)],
        capture_output=True,
        text=True,
        env=environment,
        timeout=300,
        check=False,
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr
    said = [line for line in finished.stdout.splitlines() if line.startswith("{")]
    return add_on.parent, json.loads(said[-1])


def picture(folder: Path, name: str) -> np.ndarray:
    pixels = oiio.ImageBuf(str(folder / f"{name}.exr")).get_pixels()
    assert pixels.shape == (108, 192, 4)
    return pixels


def test_startup_scene(made) -> None:
    pixels = picture(made[0], "startup")
    seen = pixels[..., 3] > 0.5
    # The cube is in the middle, a sixth of the picture large, and its top is the brightest side.
    assert seen[54, 96] and not seen[0, 0] and not seen[-1, -1]
    assert 0.1 < seen.mean() < 0.25
    top, side = pixels[30, 96, :3], pixels[62, 112, :3]
    assert (top > side).all() and (side > 0).all()


def test_subdivided_cube_is_round(made) -> None:
    cube, ball = (picture(made[0], name)[..., 3] > 0.5 for name in ("startup", "subdivided"))
    rows, columns = np.nonzero(ball)
    assert (cube | ~ball).all()
    assert 0.2 < ball.sum() / cube.sum() < 0.5
    # A disk fills pi / 4 of the square around it.
    square = (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    assert ball.sum() / square == pytest.approx(np.pi / 4, abs=0.04)


def test_edits_are_seen(made) -> None:
    before, after = (picture(made[0], name)[..., 3] > 0.5 for name in ("subdivided", "moved"))
    assert np.nonzero(after)[1].mean() > np.nonzero(before)[1].mean() + 10


def test_panels_and_settings(made) -> None:
    said = made[1]
    assert {"HDCC_PT_sampling", "HDCC_PT_subdivision"} <= set(said["panels"])
    assert said["settings"]["hdcc:samples"] == 4
    assert said["settings"]["hdcc:level"] == 0


def test_other_files_than_zips_are_refused(tmp_path: Path) -> None:
    command = [str(ROOT / "tools" / "blender" / "package"), str(tmp_path / "out.tar")]
    refused = subprocess.run(command, capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert len(refused.stderr.splitlines()) == 1 and "out.tar" in refused.stderr
    assert not (tmp_path / "out.tar").exists()
