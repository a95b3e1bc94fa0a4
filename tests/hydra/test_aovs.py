"""Values of AOVs on surfaces that are known in closed form."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import View, add_camera, add_cube, add_grid, make_stage, render
from pxr import Gf, UsdGeom

BACKGROUND = {
    "color": 0,
    "depth": 1,
    "cameraDepth": 0,
    "primId": -1,
    "instanceId": -1,
    "elementId": -1,
    "normal": 0,
    "Neye": 0,
}


def test_background() -> None:
    picture = render(make_stage())
    assert set(picture) == set(BACKGROUND)
    for name, value in BACKGROUND.items():
        assert (picture[name] == value).all(), name


def test_flat_grid_from_an_orthographic_camera() -> None:
    stage = make_stage()
    add_grid(stage, displayColor=[(0.5, 0.25, 1.0)])
    picture = render(stage)
    rows, columns = np.mgrid[0:32, 0:32] // 8
    assert (picture["elementId"] == 4 * (3 - rows) + columns).all()
    assert (picture["primId"] == 0).all()
    assert np.allclose(picture["cameraDepth"], 5, atol=1e-5)
    assert np.allclose(picture["depth"], (5 - 1) / (9 - 1), atol=1e-6)
    assert np.allclose(picture["normal"], (0, 0, 1), atol=1e-3)
    assert np.allclose(picture["Neye"], (0, 0, 1), atol=1e-3)
    assert np.allclose(picture["color"][..., 3], 1)
    color = picture["color"][16, 16, :3]
    assert np.allclose(color / color[2], (0.5, 0.25, 1.0), atol=1e-3)


def test_depths_from_a_perspective_camera() -> None:
    stage = make_stage(camera=False)
    camera = add_camera(stage, projection="perspective", focalLength=40.0)
    camera.GetPrim().GetAttribute("clippingRange").Set(Gf.Vec2f(2, 50))
    add_grid(stage, half=8.0)
    picture = render(stage)
    # Distance along the view axis, and not along each ray.
    assert np.allclose(picture["cameraDepth"], 5, atol=1e-4)
    near, far, z = 2.0, 50.0, 5.0
    ndc = (far + near) / (far - near) - 2 * far * near / ((far - near) * z)
    assert np.allclose(picture["depth"], 0.5 * ndc + 0.5, atol=1e-5)


def test_clipping_range_cuts() -> None:
    stage = make_stage()
    add_grid(stage, "/Near").AddTranslateOp().Set(Gf.Vec3d(0, 0, 4.5))
    add_grid(stage, "/Far").AddTranslateOp().Set(Gf.Vec3d(0, 0, -4.5))
    assert (render(stage)["primId"] == -1).all()


def test_normals_are_in_world_and_camera_space() -> None:
    stage = make_stage(camera=False)
    camera = add_camera(stage)
    camera.AddRotateYOp().Set(30.0)
    camera.GetXformOpOrderAttr().Set(["xformOp:rotateY", "xformOp:translate"])
    add_grid(stage, half=1.0)
    picture = render(stage)
    hit = picture["primId"] >= 0
    assert hit.any()
    assert np.allclose(picture["normal"][hit], (0, 0, 1), atol=1e-3)
    angle = np.radians(30)
    assert np.allclose(picture["Neye"][hit], (-np.sin(angle), 0, np.cos(angle)), atol=1e-3)


def test_normals_transform_by_the_inverse_transpose() -> None:
    stage = make_stage()
    mesh = add_grid(stage, half=4.0)
    mesh.AddScaleOp().Set(Gf.Vec3f(1, 1, 0.25))
    mesh.AddRotateYOp().Set(45.0)
    picture = render(stage)
    expected = np.array([0.25, 0, 1]) / np.linalg.norm([0.25, 0, 1])
    assert np.allclose(picture["normal"][16, 16], expected, atol=1e-3)


def test_sphere_like_surface() -> None:
    stage = make_stage()
    add_cube(stage, half=1.5)
    picture = render(stage)
    hit = picture["primId"] >= 0
    # The limit of a cube is far inside it, and symmetric.
    assert 200 < hit.sum() < 500
    assert (hit == hit[::-1]).all() and (hit == hit[:, ::-1]).all()
    assert np.allclose(np.linalg.norm(picture["normal"][hit], axis=-1), 1, atol=2e-3)
    # Face 1 faces the camera, and face 0 faces away.
    assert picture["elementId"][16, 16] == 1
    assert set(np.unique(picture["elementId"][hit])) == {1, 2, 3, 4, 5}


def test_prim_ids_tell_prims_apart() -> None:
    stage = make_stage()
    add_grid(stage, "/A", half=0.5).AddTranslateOp().Set(Gf.Vec3d(-1, 0, 0))
    add_grid(stage, "/B", half=0.5).AddTranslateOp().Set(Gf.Vec3d(1, 0, 0))
    ids = render(stage)["primId"]
    assert set(np.unique(ids)) == {-1, 0, 1}
    assert len(np.unique(ids[:, :16])) == 2 and len(np.unique(ids[:, 16:])) == 2


@pytest.mark.parametrize("bound", ["color", "depth", "primId", "normal", "Neye"])
def test_any_aov_may_be_bound_alone(bound: str) -> None:
    stage = make_stage()
    add_grid(stage)
    view = View(stage, aovs=[])
    view.engine.SetRendererAov(bound)
    view.execute()
    assert set(view.read([bound])) == {bound}


def test_unsupported_aov_warns_and_converges(warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage)
    view = View(stage)
    view.engine.SetRendererAov("velocity")
    view.execute()


def test_data_window_crops() -> None:
    stage = make_stage()
    add_cube(stage)
    view = View(stage)
    whole = view.render()
    view.set_data_window(8, 4, 16, 12, display=(32, 32))
    part = view.render()
    assert part["primId"].shape == (12, 16)
    for name in ("primId", "elementId"):
        assert (part[name] == whole[name][4:16, 8:24]).all()
    assert np.allclose(part["cameraDepth"], whole["cameraDepth"][4:16, 8:24], atol=1e-4)


def test_data_window_beyond_the_buffer_is_cropped() -> None:
    stage = make_stage()
    add_cube(stage)
    view = View(stage)
    whole = view.render()
    view.set_data_window(-8, -8, 48, 48, display=(32, 32))
    assert (view.render()["primId"] == whole["primId"]).all()


def test_data_window_counts_from_the_top() -> None:
    stage = make_stage()
    add_grid(stage, bump=0.3)
    view = View(stage)
    whole = view.render()["elementId"]
    view.set_data_window(0, -8, 32, 32, display=(32, 32))
    assert (view.render()["elementId"] == whole[:24]).all()


def test_free_camera() -> None:
    stage = make_stage()
    add_cube(stage)
    frustum = UsdGeom.Camera(stage.GetPrimAtPath("/Camera")).GetCamera(0).frustum
    view = View(stage, camera="")
    view.engine.SetCameraState(frustum.ComputeViewMatrix(), frustum.ComputeProjectionMatrix())
    expected = render(stage)
    assert (view.render()["primId"] == expected["primId"]).all()
    assert np.allclose(view.read()["cameraDepth"], expected["cameraDepth"], atol=1e-4)


def test_viewport_without_framing() -> None:
    stage = make_stage()
    add_cube(stage)
    expected = render(stage)
    view = View(stage)
    view.engine.SetRenderViewport(Gf.Vec4d(0, 0, 32, 32))
    assert (view.render()["primId"] == expected["primId"]).all()
