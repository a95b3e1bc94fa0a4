"""The recorder behind usdrecord, with no GPU."""

from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from hydra_kit import PLUGIN, add_cube, make_stage, render
from pxr import Gf, Usd, UsdAppUtils, UsdGeom


@pytest.mark.parametrize("suffix", ["exr", "png"])
def test_records_color(tmp_path: Path, suffix: str) -> None:
    stage = make_stage(light=False)
    # To the upper left, so that a picture upside down is seen.
    add_cube(stage).AddTranslateOp().Set(Gf.Vec3d(-0.75, 0.5, 0))
    recorder = UsdAppUtils.FrameRecorder(PLUGIN, False)
    recorder.SetImageWidth(32)
    path = tmp_path / f"frame.{suffix}"
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/Camera"))
    assert recorder.Record(stage, camera, Usd.TimeCode.Default(), str(path))
    pixels = oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)
    assert pixels.shape[:2] == (32, 32)
    hit = render(stage)["primId"] >= 0
    inside = hit & np.roll(hit, 1, 0) & np.roll(hit, -1, 0) & np.roll(hit, 1, 1)
    inside &= np.roll(hit, -1, 1)
    assert (pixels[inside][:, :3] > 0.01).all()
    assert (pixels[-1, -1] == 0).all()


def test_records_without_a_camera_prim(tmp_path: Path) -> None:
    stage = make_stage(camera=False)
    add_cube(stage)
    recorder = UsdAppUtils.FrameRecorder(PLUGIN, False)
    recorder.SetImageWidth(48)
    path = tmp_path / "frame.exr"
    assert recorder.Record(stage, UsdGeom.Camera(), Usd.TimeCode.Default(), str(path))
    assert oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT).max() > 0.1
