"""What cameras have beyond their matrices: lens, exposure, clipping planes."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import (
    CENTER_AOVS,
    Picture,
    View,
    add_camera,
    add_distant_light,
    add_grid,
    assert_same,
    make_stage,
    render,
)
from pxr import Gf, Usd, UsdGeom

#: Sees x, y in -2..2 at its focal plane, 5 units away: a focal length of 5 units.
PERSPECTIVE: dict[str, Any] = {
    "projection": "perspective",
    "focalLength": 50.0,
    "clippingRange": Gf.Vec2f(0.1, 100),
}


def make_scene(half: float, z: float, **camera: Any) -> Usd.Stage:
    """A square at a height, in the middle of a perspective camera's picture."""
    stage = make_stage(camera=False)
    add_camera(stage, **PERSPECTIVE, **camera)
    add_grid(stage, size=1, half=half, subdivisionScheme="bilinear")
    UsdGeom.Xformable(stage.GetPrimAtPath("/Grid")).AddTranslateOp().Set(Gf.Vec3d(0, 0, z))
    return stage


def variances(weights: np.ndarray) -> tuple[float, float]:
    """Of columns and rows, in pixels squared."""
    result = []
    for axis in (0, 1):
        profile = weights.sum(axis=axis)
        at = np.arange(len(profile))
        mean = (profile * at).sum() / profile.sum()
        result.append(float((profile * (at - mean) ** 2).sum() / profile.sum()))
    return result[0], result[1]


@pytest.mark.parametrize(
    ("z", "focus", "f_stop"),
    [(-5.0, 5.0, 2.0), (1.0, 8.0, 4.0)],
    ids=["beyond the focus", "before the focus"],
)
def test_blur_is_that_of_a_thin_lens(z: float, focus: float, f_stop: float) -> None:
    size, distance = 96, 5 - z
    half = 0.025 * distance  # 6 pixels wide wherever it is
    stage = make_scene(half, z, fStop=f_stop, focusDistance=focus)
    alpha = render(stage, size=(size, size), samples=256)["color"][:, :, 3]
    # The lens is focalLength / fStop wide, and what is seen at distance 1 is 0.8 wide.
    radius = 5 / f_stop / 2 * abs(1 / distance - 1 / focus) * size / 0.8
    assert radius > 6
    assert np.isclose(alpha.sum(), 36, rtol=0.03)
    for variance in variances(alpha):
        assert np.isclose(variance, radius**2 / 4 + 36 / 12 + 1 / 12, rtol=0.03)
    columns = np.nonzero(alpha.sum(axis=0))[0]
    assert np.ptp(columns) + 1 == pytest.approx(2 * radius + 6, abs=2)


def test_the_focal_plane_is_sharp() -> None:
    camera = {"fStop": 1.0, "focusDistance": 10.0}
    sharp = render(make_scene(1.03, -5.0), samples=16)["color"]
    through_lens = render(make_scene(1.03, -5.0, **camera), samples=16)["color"]
    assert np.allclose(through_lens, sharp, atol=1e-4)


def test_the_background_of_a_lens_is_the_only_thing_that_changes() -> None:
    pinhole = render(make_scene(1.0, -5.0))
    lens = render(make_scene(1.0, -5.0, fStop=1.0, focusDistance=3.0))
    assert_same(lens, pinhole, CENTER_AOVS)
    assert (lens["color"] != pinhole["color"]).any()


@pytest.mark.parametrize(
    "camera",
    [
        {"fStop": 0.0, "focusDistance": 3.0},
        {"fStop": 1.0, "focusDistance": 3.0, "projection": "orthographic"},
    ],
    ids=["fStop 0", "orthographic"],
)
def test_no_lens_changes_nothing(camera: dict[str, Any], warnings: Any) -> None:
    def picture(**values: Any) -> Picture:
        stage = make_stage(camera=False)
        add_camera(stage, **{**PERSPECTIVE, **values})
        add_grid(stage, bump=0.3)
        return render(stage)

    projection = {"projection": camera.get("projection", "perspective")}
    assert_same(picture(**camera), picture(**projection))
    assert warnings.read() == ""


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"fStop": -2.0, "focusDistance": 3.0}, "fStop is -2"),
        ({"fStop": float("nan"), "focusDistance": 3.0}, "fStop is nan"),
        ({"fStop": float("inf"), "focusDistance": 3.0}, "fStop is inf"),
        ({"fStop": 2.0, "focusDistance": -1.0}, "focusDistance is -1"),
        ({"fStop": 2.0, "focusDistance": float("nan")}, "focusDistance is nan"),
        ({"fStop": 2.0}, "focusDistance is 0"),
        ({"fStop": 1e-45, "focusDistance": 3.0}, "there is no lens"),
        ({"exposure": float("nan")}, "exposure comes to a factor of nan"),
        ({"exposure": 1e9}, "exposure comes to a factor of inf"),
        ({"exposure:time": -1.0}, "exposure comes to a factor of -1"),
        ({"clippingPlanes": [Gf.Vec4f(0, 0, 0, -1)]}, "(0, 0, 0, -1) is no clipping plane"),
        (
            {"clippingPlanes": [Gf.Vec4f(float("nan"), 0, 0, -1)]},
            "(nan, 0, 0, -1) is no clipping plane",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_bad_values_warn_and_change_nothing(
    values: dict[str, Any], said: str, warnings: Any
) -> None:
    plain = render(make_scene(1.0, -2.0))
    stage = make_scene(1.0, -2.0, **values)
    view = View(stage)
    assert_same(view.render(), plain)
    text = warnings.read()
    assert text.count(f"</Camera>: {said}") == 1
    stage.GetPrimAtPath("/Grid").GetAttribute("holeIndices").Set([7])
    view.execute()
    assert said not in warnings.read()


def test_edits_of_the_lens_show() -> None:
    stage = make_scene(1.0, -2.0, fStop=2.0, focusDistance=3.0)
    view = View(stage)
    before = view.render()
    for name, value in (("fStop", 1.0), ("focusDistance", 6.0), ("exposure", 1.0)):
        stage.GetPrimAtPath("/Camera").GetAttribute(name).Set(value)
        after = view.render()
        assert (after["color"] != before["color"]).any(), name
        before = after


@pytest.mark.parametrize(
    ("values", "factor"),
    [
        ({"exposure": 2.0}, 4.0),
        ({"exposure": -1.0}, 0.5),
        ({"exposure:time": 0.5, "exposure:iso": 200.0, "exposure:fStop": 2.0}, 0.25),
        ({"exposure": 1.0, "exposure:responsivity": 4.0}, 8.0),
    ],
    ids=str,
)
def test_exposure_scales_color(values: dict[str, Any], factor: float) -> None:
    plain = render(make_scene(1.0, -2.0))
    exposed = render(make_scene(1.0, -2.0, **values))
    assert_same(exposed, plain, CENTER_AOVS)
    assert (exposed["color"][:, :, 3] == plain["color"][:, :, 3]).all()
    assert (exposed["color"][:, :, :3] == factor * plain["color"][:, :, :3]).all()
    assert plain["color"][16, 16, 0] > 0


@pytest.mark.parametrize(
    ("plane", "columns"),
    [
        ((1, 0, 0, 0), slice(16, 32)),
        ((-1, 0, 0, 0), slice(0, 16)),
        ((2, 0, 0, 2), slice(8, 32)),
    ],
    ids=str,
)
@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
def test_clipping_planes_cut_off_what_is_below_zero(
    plane: tuple[float, ...], columns: slice, projection: str
) -> None:
    stage = make_stage(camera=False)
    camera = add_camera(
        stage, projection=projection, focalLength=50.0, clippingPlanes=[Gf.Vec4f(*plane)]
    )
    # Planes go with the camera.
    camera.GetOrderedXformOps()[0].Set(Gf.Vec3d(1, 0, 5))
    add_grid(stage, half=4.0, size=8)
    seen = np.zeros((32, 32), bool)
    seen[:, columns] = True
    assert ((render(stage)["primId"] >= 0) == seen).all()


def test_clipping_planes_show_what_is_behind() -> None:
    stage = make_stage(camera=False)
    # Everything nearer than 4 is cut off, and everything beyond 7.
    planes = [Gf.Vec4f(0, 0, -1, -4), Gf.Vec4f(0, 0, 2, 14)]
    camera = add_camera(stage, clippingPlanes=planes)
    for name, z in (("Near", 1.5), ("Middle", 0.0), ("Far", -3.0)):
        add_grid(stage, f"/{name}")
        UsdGeom.Xformable(stage.GetPrimAtPath(f"/{name}")).AddTranslateOp().Set(Gf.Vec3d(0, 0, z))
    view = View(stage)
    picture = view.render()
    assert (picture["cameraDepth"] == 5).all()
    assert (picture["depth"] == 0.5).all()
    stage.GetPrimAtPath("/Middle").SetActive(False)
    assert (view.render()["primId"] == -1).all()
    camera.GetClippingPlanesAttr().Set([])
    assert np.allclose(view.render()["cameraDepth"], 3.5)


def test_what_is_cut_off_casts_its_shadow() -> None:
    def picture(**camera: Any) -> Picture:
        stage = make_stage(camera=False, light=False)
        add_camera(stage, **camera)
        add_distant_light(stage, shadows=True)
        add_grid(stage, "/Floor")
        add_grid(stage, "/Roof", half=1.0)
        UsdGeom.Xformable(stage.GetPrimAtPath("/Roof")).AddTranslateOp().Set(Gf.Vec3d(0, 0, 2))
        return render(stage)

    whole = picture()
    cut = picture(clippingPlanes=[Gf.Vec4f(0, 0, -1, -4)])
    assert np.allclose(whole["cameraDepth"][16, 16], 3)
    assert np.allclose(cut["cameraDepth"], 5)
    assert (cut["color"][16, 16, :3] == 0).all()
    assert (cut["color"][2, 2, :3] > 0).all()
