"""Parts of the viewer that need no window."""

import math

import numpy as np
import pytest
from _lib.viewer.false_colors import to_rgb
from _lib.viewer.orbit_camera import OrbitCamera
from pxr import Gf


def eye(camera: OrbitCamera) -> Gf.Vec3d:
    return camera.camera_to_world().ExtractTranslation()


def looks_at(camera: OrbitCamera) -> Gf.Vec3d:
    return camera.camera(1.5).frustum.ComputeViewDirection()


@pytest.mark.parametrize(
    ("up_is_y", "front", "right", "up"),
    [(True, (0, 0, 1), (1, 0, 0), (0, 1, 0)), (False, (0, -1, 0), (1, 0, 0), (0, 0, 1))],
)
def test_directions(up_is_y: bool, front: tuple, right: tuple, up: tuple) -> None:
    camera = OrbitCamera(Gf.Vec3d(1, 2, 3), 5.0, azimuth=0, elevation=0, up_is_y=up_is_y)
    assert Gf.IsClose(eye(camera), camera.target + 5 * Gf.Vec3d(*front), 1e-9)
    camera.orbit(90, 0)
    assert Gf.IsClose(eye(camera), camera.target + 5 * Gf.Vec3d(*right), 1e-9)
    camera.orbit(0, 30)
    expected = math.cos(math.radians(30)) * Gf.Vec3d(*right) + 0.5 * Gf.Vec3d(*up)
    assert Gf.IsClose(eye(camera), camera.target + 5 * expected, 1e-9)
    assert Gf.IsClose(looks_at(camera), -expected, 1e-9)


def test_it_does_not_turn_over() -> None:
    camera = OrbitCamera(Gf.Vec3d(0), 1.0)
    camera.orbit(0, 500)
    assert camera.elevation < 90
    camera.orbit(0, -900)
    assert camera.elevation > -90


def test_pan_keeps_a_point_under_the_mouse() -> None:
    camera = OrbitCamera(Gf.Vec3d(0), 10.0, azimuth=0, elevation=0, field_of_view=90)
    camera.pan(0.5, 0)
    assert Gf.IsClose(camera.target, Gf.Vec3d(10, 0, 0), 1e-9)
    camera.dolly(0.5)
    assert camera.distance == 5
    assert Gf.IsClose(eye(camera), Gf.Vec3d(10, 0, 5), 1e-9)


@pytest.mark.parametrize("up_is_y", [True, False])
def test_it_takes_over_where_another_camera_stands(up_is_y: bool) -> None:
    camera = OrbitCamera(Gf.Vec3d(1, 2, 3), 4.0, 200.0, -20.0, 33.0, up_is_y)
    other = OrbitCamera.like(camera.camera(1.5), 4.0, up_is_y)
    assert Gf.IsClose(other.camera_to_world().GetRow3(2), camera.camera_to_world().GetRow3(2), 1e-5)
    assert Gf.IsClose(eye(other), eye(camera), 1e-5)
    assert other.field_of_view == pytest.approx(33, abs=1e-3)


def test_framing_shows_all_of_a_box() -> None:
    camera = OrbitCamera(Gf.Vec3d(0), 1.0)
    box = Gf.Range3d(Gf.Vec3d(4, 4, 4), Gf.Vec3d(6, 8, 5))
    camera.frame(box)
    frustum = camera.camera(1.0).frustum
    assert all(frustum.Intersects(box.GetCorner(i)) for i in range(8))
    before = eye(camera)
    camera.frame(Gf.Range3d())
    assert eye(camera) == before


def plane(*values: float) -> np.ndarray:
    return np.array(values, np.float32).reshape(1, len(values), 1)


def test_colors_of_ids_differ_and_nothing_is_black() -> None:
    rgb = to_rgb("primId", plane(-1, *range(40)))[0]
    assert rgb[0].tolist() == [0, 0, 0]
    assert len({tuple(color) for color in rgb.tolist()}) == 41


def test_near_is_light_and_far_is_dark() -> None:
    rgb = to_rgb("cameraDepth", plane(0, 2, 3, 4))[0, :, 0]
    assert rgb[0] == 0
    assert rgb[1] == 255
    assert rgb[1] > rgb[2] > rgb[3] > 0
    assert to_rgb("depth", plane(1, 1)).max() == 0


def test_color_is_for_a_screen() -> None:
    pixels = np.array([[[0.18, 1.0, 2.0, 1.0], [0, 0, 0, 0]]], np.float32)
    rgb = to_rgb("color", pixels)[0]
    assert rgb[0].tolist() == [118, 255, 255]
    assert rgb[1, 0] == rgb[1, 1] == rgb[1, 2] > 0


@pytest.mark.parametrize(
    ("name", "components"),
    [("normal", 3), ("Neye", 3), ("hdcc:level", 1), ("hdcc:fan", 1), ("hdcc:cost", 1),
     ("hdcc:material", 1), ("primvars:st", 2), ("primvars:w", 1)],
)  # fmt: skip
def test_every_aov_has_colors(name: str, components: int) -> None:
    values = np.linspace(-1, 2, 20 * components, dtype=np.float32).reshape(4, 5, components)
    is_integer = name in ("hdcc:level", "hdcc:fan", "hdcc:material")
    values = values.round() if is_integer else values
    rgb = to_rgb(name, values)
    assert rgb.shape == (4, 5, 3)
    assert rgb.dtype == np.uint8
    assert len(np.unique(rgb)) > 1
    if not is_integer:
        assert to_rgb(name, np.full((2, 2, components), np.nan, np.float32)).shape == (2, 2, 3)
