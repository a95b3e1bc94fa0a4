"""What changes over time in usd_scenes/features: values that follow from the scenes themselves."""

import numpy as np
import pytest
from hydra_kit import assert_same
from limit_kit import LARGE, expect_limit, expect_other_limit
from pxr import Usd
from scene_kit import AOVS, CAMERA, Shot, open_scene
from subdivision_kit import Cage, cage_of, limit_points

SKIN = "/World/Arm/Skin"


def skinned(stage: Usd.Stage, frame: float) -> Cage:
    """The cage of the arm, with its points moved as linear blend skinning says."""
    bent = (5 - frame) / 4
    cage = cage_of(stage, SKIN)
    muscle = stage.GetPrimAtPath(f"{SKIN}/Muscle")
    weights = stage.GetPrimAtPath(SKIN).GetAttribute("primvars:skel:jointWeights").Get()
    for vertex, offset in zip(
        muscle.GetAttribute("pointIndices").Get(), muscle.GetAttribute("offsets").Get()
    ):
        cage.points[vertex] = cage.points[vertex] + bent * np.array(offset)
    angle, elbow = np.radians(75 * bent), np.array([0.0, 2.0, 0.0])
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    for vertex, point in enumerate(cage.points):
        share = weights[2 * vertex + 1]
        cage.points[vertex] = (1 - share) * point + share * (turn @ (point - elbow) + elbow)
    return cage


@pytest.mark.parametrize("frame", [1, 3, 5])
def test_skins_follow_their_joints_and_blend_shapes(frame: float) -> None:
    shot = Shot("skel", frame=frame, size=LARGE)
    expect_limit(shot, SKIN, skinned(shot.stage, frame), steps=2)
    if frame < 5:
        expect_other_limit(shot, SKIN, cage_of(shot.stage, SKIN), steps=2)


@pytest.mark.parametrize("scene", ["skel", "topology", "time"])
def test_one_view_shows_frames_as_views_of_their_own_do(scene: str) -> None:
    shot = Shot(scene, frame=1)
    for frame in (3, 2, 1):
        shot.go_to(frame)
        assert_same(shot.picture, Shot(scene, frame=frame).picture, AOVS)


@pytest.mark.parametrize(("frame", "faces"), [(1, 6), (2, 8), (3, 4)])
def test_topology_changes(frame: float, faces: int) -> None:
    shot = Shot("topology", frame=frame, size=LARGE, more_aovs=["primvars:displayColor"])
    path = "/World/Changing"
    cage = cage_of(shot.stage, path, shot.frame)
    assert len(cage.faces) == faces
    expect_limit(shot, path, cage)
    expect_limit(shot, "/World/Resting", steps=2)
    seen = shot.of(path)
    colors = np.array(shot.stage.GetPrimAtPath(path).GetAttribute("primvars:displayColor").Get())
    elements = shot["elementId"][seen]
    assert elements.max() < faces and len(np.unique(elements)) >= 3
    assert np.allclose(shot["primvars:displayColor"][seen], colors[elements % 3], atol=1e-3)


@pytest.mark.parametrize("frame", [1, 2, 4])
def test_frames_of_an_animation(frame: float) -> None:
    shot = Shot("time", frame=frame, size=LARGE, more_aovs=["primvars:displayColor"])
    for name in ("Growing", "Turning", "Blinking"):
        expect_limit(shot, f"/World/{name}")
    blinking = shot.at("primvars:displayColor", (3, 0, 0))
    share = (frame - 1) / 3
    red_to_green = (1 - share) * np.array([0.9, 0.2, 0.2]) + share * np.array([0.2, 0.8, 0.3])
    assert np.allclose(blinking, red_to_green, atol=1e-3)


def test_what_is_invisible_at_a_frame_is_not_there() -> None:
    shot = Shot("time", frame=3)
    assert shot.at("primId", (3, 0, 0)) == -1
    shot.go_to(4)
    assert shot.at("primId", (3, 0, 0)) >= 0


SAMPLES = 32


@pytest.fixture(scope="module")
def blurred() -> Shot:
    return Shot("motion_blur", frame=1, samples=SAMPLES)


@pytest.fixture(scope="module")
def sharp() -> Shot:
    """The same frame with a closed shutter."""
    stage = open_scene("motion_blur")
    stage.GetPrimAtPath(CAMERA).GetAttribute("shutter:close").Set(0.0)
    return Shot(stage, frame=1, samples=SAMPLES)


def coverage_around(shot: Shot, left: float, right: float, y: float) -> np.ndarray:
    """Of the pixels between two places of the plane z = 0, at a height."""
    (row, first), (_, last) = (shot.pixel((x, y, 0)) for x in (left, right))
    return shot["color"][row, max(first, 0) : last, 3]


def test_what_slides_covers_each_place_for_a_share_of_the_time(blurred: Shot, sharp: Shot) -> None:
    moving = coverage_around(blurred, -5.6, -2.1, -1.0)
    resting = coverage_around(sharp, -5.6, -2.1, -1.0)
    pixel = 12 * 36 / 42 / 320
    # As much in all as at rest, but over a way that is longer by the 1.2 that it moves.
    assert moving.sum() == pytest.approx(resting.sum(), rel=0.03)
    longer = (np.count_nonzero(moving) - np.count_nonzero(resting)) * pixel
    assert longer == pytest.approx(1.2, abs=0.1)
    width = resting.sum() * pixel
    # Its middle is covered all the time, as it is wider than it moves.
    assert np.count_nonzero(moving > 0.99) * pixel == pytest.approx(width - 1.2, abs=0.15)


def test_what_grows_covers_each_height_for_as_long_as_it_is_so_high(
    blurred: Shot,
) -> None:
    path = "/World/Growing"
    frames = (1, 1.125, 1.25, 1.375, 1.5)
    tops = []
    for frame in frames:
        limits = limit_points(cage_of(blurred.stage, path, Usd.TimeCode(frame)), 1)
        tops.append(max(limits, key=lambda limit: limit.point[1]).point[1] - 1)
    heights = np.interp(np.linspace(1, 1.5, 1001), frames, tops)
    for height in np.linspace(min(tops) + 0.1, max(tops) - 0.1, 8):
        row, column = blurred.pixel((-1.2, height, 0))
        share = np.mean(heights > height)
        assert blurred["color"][row, column, 3] == pytest.approx(share, abs=0.1), height


def test_what_turns_about_its_axis_keeps_its_top(blurred: Shot) -> None:
    row, column = blurred.pixel((1.4, -1 + 0.7, 0))
    column_of_box = blurred["color"][row - 12 : row + 12, column, 3]
    assert np.count_nonzero((column_of_box > 0.02) & (column_of_box < 0.98)) <= 2


def test_what_rests_is_as_sharp_as_with_a_closed_shutter(blurred: Shot, sharp: Shot) -> None:
    _, first = blurred.pixel((3.0, 0, 0))
    assert (blurred["color"][:, first:] == sharp["color"][:, first:]).all()
    assert (sharp["color"][:, first:, 3] == 1).sum() > 1000


def test_instances_that_part_cover_for_a_share_of_the_time(blurred: Shot, sharp: Shot) -> None:
    for side in (slice(0, 160), slice(160, 320)):
        rows = slice(0, blurred.pixel((0, 1.3, 0))[0])
        moving, resting = (shot["color"][rows, side, 3] for shot in (blurred, sharp))
        assert moving.sum() == pytest.approx(resting.sum(), rel=0.05)
        wide = [np.count_nonzero(part.max(axis=0)) for part in (moving, resting)]
        assert (wide[0] - wide[1]) * 12 * 36 / 42 / 320 == pytest.approx(1.2, abs=0.1)


def test_motion_changes_colour_only(blurred: Shot, sharp: Shot) -> None:
    ids = ("primId", "instanceId", "elementId", "normal")
    assert_same(blurred.picture, sharp.picture, ids)
    assert np.allclose(blurred["cameraDepth"], sharp["cameraDepth"], rtol=1e-6)
    assert (blurred["color"] != sharp["color"]).any()
