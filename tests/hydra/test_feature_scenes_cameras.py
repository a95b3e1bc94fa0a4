"""Cameras of usd_scenes/features: where things are seen, by the arithmetic of cameras."""

import numpy as np
import pytest
from hydra_kit import assert_same
from limit_kit import LARGE, expect_limit
from scene_kit import AOVS, CAMERA, Shot, open_scene
from subdivision_kit import cage_of, limit_points

#: What a pixel's centre and a coarse set of points may be off, in pixels.
PIXEL = 1.2
BLURRED = (240, 135)
BLOBS = ("Orange", "Blue", "Green")


def window_of(shown: np.ndarray) -> np.ndarray:
    """The left, right, top and bottom edges of what is set, in pixels."""
    rows, columns = np.nonzero(shown)
    return np.array([columns.min(), columns.max() + 1, rows.min(), rows.max() + 1], float)


def blob(shot: Shot, name: str) -> np.ndarray:
    """Points all over a blob's limit surface, in the world."""
    limits = limit_points(cage_of(shot.stage, f"/World/{name}"), 4)
    return shot.world(f"/World/{name}", [limit.point for limit in limits])


def test_aperture_offsets_move_the_picture() -> None:
    shot = Shot("cameras", camera="/World/CameraSide", size=LARGE)
    # The camera is at (14, 0.2, -0.5) and looks along -x, so that its right is -z.
    place = blob(shot, "Green")
    right, up, distance = -(place[:, 2] + 0.5), place[:, 1] - 0.2, 14 - place[:, 0]
    column = ((60 * right / distance - 2) / 36 + 0.5) * 640
    row = (0.5 - (60 * up / distance - 1) / 20.25) * 360
    expected = [column.min(), column.max(), row.min(), row.max()]
    shown = shot["primId"] == shot.at("primId", (3.4, 0, -2))
    assert np.abs(window_of(shown) - expected).max() < PIXEL
    assert shot["cameraDepth"][shown].min() == pytest.approx(distance.min(), abs=5e-3)


def test_each_camera_sees_its_own_order() -> None:
    front, side = (Shot("cameras", camera=path) for path in (CAMERA, "/World/CameraSide"))
    nearest = {}
    for shot in (front, side):
        nearest[shot] = [shot["cameraDepth"][shot.of(f"/World/{name}")].min() for name in BLOBS]
    assert nearest[front] == sorted(nearest[front])
    assert nearest[side] == sorted(nearest[side])[::-1]
    for name in BLOBS:
        expect_limit(front, f"/World/{name}")


def test_orthographic_blobs_are_all_as_large() -> None:
    shot = Shot("orthographic", size=LARGE)
    pixels = 640 / 16
    depths = []
    for number in range(1, 6):
        path = f"/World/Blob{number}"
        centre = shot.world(path, (0, 0, 0))
        # The extent of a turned cube is more than that of the blob in it: go by its neighbours.
        shown = shot["primId"] == shot.at("primId", centre)
        place = blob(shot, f"Blob{number}")
        left, right, top, bottom = window_of(shown)
        assert left == pytest.approx((place[:, 0].min() + 8) * pixels, abs=PIXEL)
        assert right == pytest.approx((place[:, 0].max() + 8) * pixels, abs=PIXEL)
        assert top == pytest.approx((4.5 - place[:, 1].max()) * pixels, abs=PIXEL)
        assert bottom == pytest.approx((4.5 - place[:, 1].min()) * pixels, abs=PIXEL)
        depths.append(shot.at("cameraDepth", centre))
    assert np.allclose(np.diff(depths), 4, atol=0.02)


@pytest.fixture(scope="module")
def lens() -> Shot:
    return Shot("depth_of_field", size=BLURRED, samples=32)


@pytest.fixture(scope="module")
def pinhole() -> Shot:
    stage = open_scene("depth_of_field")
    stage.GetPrimAtPath(CAMERA).GetAttribute("fStop").Set(0.0)
    return Shot(stage, size=BLURRED, samples=32)


def blur_at(distance: float) -> float:
    """How far light from a point is spread by the lens, to each side, in pixels.

    The lens has a radius of 42 / 2.4 / 2 tenths of a unit, and what is seen at distance 10, where
    it is focused, is 360 / 42 units wide.
    """
    return 4.2 / 2.4 / 2 * abs(distance - 10) / distance / (360 / 42) * BLURRED[0]


def test_what_is_out_of_focus_is_blurred(lens: Shot, pinhole: Shot) -> None:
    # Green is at distance 20 and the rightmost; orange's outline is some 6 away, and as high in
    # the column of its middle as the left of the picture leaves room for.
    right = [window_of(shot["color"][..., 3] > 0)[1] for shot in (lens, pinhole)]
    assert right[0] - right[1] == pytest.approx(blur_at(20), abs=3)
    _, column = pinhole.pixel((-1.6, 0, 4))
    heights = [np.count_nonzero(shot["color"][:, column, 3]) for shot in (lens, pinhole)]
    assert heights[0] - heights[1] == pytest.approx(2 * blur_at(6), abs=5)
    assert blur_at(6) > 12 and blur_at(20) > 12


def test_what_is_in_focus_is_sharp(lens: Shot, pinhole: Shot) -> None:
    row, column = pinhole.pixel((0.5, -2, 0))
    above, at = (shot["color"][:row, column, 3] for shot in (lens, pinhole))
    assert at.max() == 1
    assert np.count_nonzero((above > 0.05) & (above < 0.95)) <= 4
    assert np.abs(np.count_nonzero(above > 0.5) - np.count_nonzero(at > 0.5)) <= 1


def test_a_lens_changes_colour_only(lens: Shot, pinhole: Shot) -> None:
    assert_same(lens.picture, pinhole.picture, [name for name in AOVS if name != "color"])


@pytest.fixture(scope="module")
def cut() -> Shot:
    return Shot("clipping_planes")


@pytest.fixture(scope="module")
def whole() -> Shot:
    stage = open_scene("clipping_planes")
    stage.GetPrimAtPath(CAMERA).GetAttribute("clippingPlanes").Set([])
    return Shot(stage)


def test_clipping_planes_leave_what_is_beyond_them(cut: Shot, whole: Shot) -> None:
    near = cut["cameraDepth"][cut.hit]
    assert 9.5 - 1e-4 < near.min() < 9.55
    assert whole["cameraDepth"][whole.hit].min() < 9.2
    # The camera is at (0, 0, 10) and not turned: the other plane leaves y > x - 3.
    x, y = np.moveaxis(cut.positions[cut.hit][:, :2], -1, 0)
    assert (y - x + 3 > -1e-3).all()
    x, y = np.moveaxis(whole.positions[whole.hit][:, :2], -1, 0)
    assert (y - x + 3 < 0).sum() > 100


def test_one_sees_what_was_hidden_by_what_is_cut_off(cut: Shot, whole: Shot) -> None:
    depth = whole["cameraDepth"]
    x, y = whole.positions[..., 0], whole.positions[..., 1]
    gone = whole.hit & ((depth < 9.499) | (y - x + 3 < -1e-3))
    kept = whole.hit & ~gone & (depth > 9.501) & (y - x + 3 > 1e-3)
    assert gone.sum() > 1000 and kept.sum() > 1000
    assert np.allclose(cut["cameraDepth"][kept], depth[kept], rtol=1e-5)
    behind = gone & cut.hit
    assert behind.sum() > 500
    assert (cut["cameraDepth"][behind] > depth[behind]).all()


def test_exposure_is_half_a_stop(whole: Shot) -> None:
    stage = open_scene("clipping_planes")
    stage.GetPrimAtPath(CAMERA).GetAttribute("clippingPlanes").Set([])
    stage.GetPrimAtPath(CAMERA).GetAttribute("exposure").Set(0.0)
    plain = Shot(stage)
    lit = plain["color"][..., :3] > 0.01
    share = whole["color"][..., :3][lit] / plain["color"][..., :3][lit]
    assert lit.sum() > 1000 and np.allclose(share, np.sqrt(2), rtol=2e-3)
