"""What part of the scene a picture shows: apertures, window policies, framing."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import View, add_camera, add_grid, make_stage
from pxr import CameraUtil, Gf, Sdf, UsdGeom

WIDE, TALL = (48, 16), (16, 32)

Size = tuple[int, int]
Window = tuple[float, float, float, float]


def make_view(size: Size, **camera: Any) -> View:
    """A camera with an aperture of 4 by 2 units, 5 units before a square that says where it is."""
    stage = make_stage(camera=False)
    add_camera(stage, verticalAperture=20.0, focalLength=50.0, **camera)
    mesh = add_grid(stage, size=1, half=16.0, subdivisionScheme="bilinear")
    position = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "at", Sdf.ValueTypeNames.Float2Array, UsdGeom.Tokens.vertex
    )
    position.Set([Gf.Vec2f(p[0], p[1]) for p in mesh.GetPointsAttr().Get()])
    return View(stage, size=size, aovs=("color", "primvars:at"))


def seen(view: View) -> Window:
    """Left, bottom, right and top of what the picture shows, in the plane of the square."""
    at = view.render()["primvars:at"]
    (left, top), (right, bottom) = at[0, 0, :2], at[-1, -1, :2]
    rows, columns = at.shape[:2]
    x, y = (right - left) / (columns - 1) / 2, (top - bottom) / (rows - 1) / 2
    return left - x, bottom - y, right + x, top + y


def around(x: float, y: float, width: float, height: float) -> Any:
    window = (x - width / 2, y - height / 2, x + width / 2, y + height / 2)
    return pytest.approx(window, abs=1e-4)


POLICIES = [
    (CameraUtil.Fit, WIDE, (6, 2)),
    (CameraUtil.Fit, TALL, (4, 8)),
    (CameraUtil.Crop, WIDE, (4, 4 / 3)),
    (CameraUtil.Crop, TALL, (1, 2)),
    (CameraUtil.MatchHorizontally, WIDE, (4, 4 / 3)),
    (CameraUtil.MatchHorizontally, TALL, (4, 8)),
    (CameraUtil.MatchVertically, WIDE, (6, 2)),
    (CameraUtil.MatchVertically, TALL, (1, 2)),
    (CameraUtil.DontConform, WIDE, (4, 2)),
    (CameraUtil.DontConform, TALL, (4, 2)),
]


@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
@pytest.mark.parametrize(("policy", "size", "shown"), POLICIES, ids=str)
def test_window_policy(policy: Any, size: Size, shown: Size, projection: str) -> None:
    view = make_view(size, projection=projection)
    view.engine.SetWindowPolicy(policy)
    assert seen(view) == around(0, 0, *shown)


@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
@pytest.mark.parametrize(("policy", "size", "shown"), POLICIES, ids=str)
def test_aperture_offsets_move_the_middle(
    policy: Any, size: Size, shown: Size, projection: str
) -> None:
    offsets = {"horizontalApertureOffset": 10.0, "verticalApertureOffset": -5.0}
    view = make_view(size, projection=projection, **offsets)
    view.engine.SetWindowPolicy(policy)
    assert seen(view) == around(1, -0.5, *shown)


@pytest.mark.parametrize(
    ("aspect", "shown"), [(2.0, (4, 2)), (0.5, (4, 8)), (4.0, (8, 2))], ids=str
)
@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
def test_pixels_that_are_not_square(aspect: float, shown: Size, projection: str) -> None:
    view = make_view((32, 32), projection=projection)
    display = Gf.Range2f(Gf.Vec2f(0, 0), Gf.Vec2f(32, 32))
    view.engine.SetFraming(CameraUtil.Framing(display, Gf.Rect2i(Gf.Vec2i(0), 32, 32), aspect))
    view.engine.SetWindowPolicy(CameraUtil.Fit)
    assert seen(view) == around(0, 0, *shown)


#: The display window shows 4 by 4 units with 8 pixels a unit. Windows are left, top, right,
#: bottom in pixels from the top.
DATA_WINDOWS = {
    "whole": ((0, 0, 32, 32), (0, 0, 32, 32), (32, 32), (-2, -2, 2, 2)),
    "crop": ((0, 0, 32, 32), (8, 4, 24, 16), (32, 32), (-1, 0, 1, 1.5)),
    "overscan": ((8, 8, 40, 40), (0, 0, 48, 48), (48, 48), (-3, -3, 3, 3)),
    "lopsided overscan": ((8, 4, 40, 36), (0, 0, 40, 48), (40, 48), (-3, -3.5, 2, 2.5)),
    "crop of overscan": ((8, 4, 40, 36), (4, 2, 12, 22), (40, 48), (-2.5, -0.25, -1.5, 2.25)),
    "out at the lower right": ((0, 0, 32, 32), (16, 24, 48, 40), (32, 32), (0, -2, 2, -1)),
    "out at the upper left": ((0, 0, 32, 32), (-8, -16, 8, 8), (32, 32), (-2, 1, -1, 2)),
    "out all round": ((0, 0, 32, 32), (-8, -4, 40, 36), (32, 32), (-2, -2, 2, 2)),
}


@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
@pytest.mark.parametrize("name", DATA_WINDOWS)
def test_data_window(name: str, projection: str) -> None:
    display, data, buffer, shown = DATA_WINDOWS[name]
    view = make_view(buffer, projection=projection)
    view.engine.SetWindowPolicy(CameraUtil.Fit)
    framing = CameraUtil.Framing(
        Gf.Range2f(Gf.Vec2f(*display[:2]), Gf.Vec2f(*display[2:])),
        Gf.Rect2i(Gf.Vec2i(*data[:2]), data[2] - data[0], data[3] - data[1]),
        1.0,
    )
    view.engine.SetFraming(framing)
    assert seen(view) == pytest.approx(shown, abs=1e-4)
    at = view.read()["primvars:at"]
    assert at.shape[:2] == ((shown[3] - shown[1]) * 8, (shown[2] - shown[0]) * 8)


def test_a_lens_knows_nothing_of_the_data_window() -> None:
    """A crop shows the same blur as the whole picture, but for where samples lie."""

    def view_through_lens() -> View:
        view = make_view((32, 32), projection="perspective", fStop=3.0, focusDistance=2.5)
        view.set("samples", 256)
        UsdGeom.Mesh(view.stage.GetPrimAtPath("/Grid")).GetPointsAttr().Set(
            [(-1, -1, 0), (1, -1, 0), (-1, 1, 0), (1, 1, 0)]
        )
        return view

    whole = view_through_lens().render()["color"][:, :, 3]
    cropped = view_through_lens()
    cropped.set_data_window(4, 8, 16, 20, display=(32, 32))
    part = cropped.render()["color"][:, :, 3]
    assert np.ptp(part) > 0.2
    apart = part - whole[8:28, 4:20]
    assert np.abs(apart).max() < 0.06 and abs(apart.mean()) < 0.003
