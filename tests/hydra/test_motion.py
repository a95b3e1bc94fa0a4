"""Motion blur: pixels are covered for the share of the shutter's time that something is there."""

from collections.abc import Callable

import numpy as np
import pytest
from hydra_kit import (
    CENTER_AOVS,
    Picture,
    View,
    add_camera,
    add_cube,
    add_distant_light,
    add_mesh,
    assert_same,
    make_stage,
)
from pxr import Gf, Usd, UsdGeom
from skel_kit import skin

SIZE = 40
SAMPLES = 32
TOLERANCE = 0.07  # of coverage: two of the samples
SQUARE = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]


def is_sharp(row: np.ndarray) -> bool:
    """True if there is nothing between covered and not, but for a sample on the border."""
    return bool(np.minimum(row, 1 - row).max() < 1.5 / SAMPLES and row.max() == 1)


def make_moving_stage(opens: float = 0.0, closes: float = 1.0) -> Usd.Stage:
    """A stage seen in x, y from -2 to 2 while the shutter is open."""
    stage = make_stage(camera=False)
    add_camera(stage, **{"shutter:open": opens, "shutter:close": closes})
    return stage


def add_square(stage: Usd.Stage, path: str = "/Square") -> UsdGeom.Mesh:
    return add_mesh(stage, path, SQUARE, [4], [0, 1, 2, 3], subdivisionScheme="bilinear")


def slide(prim: UsdGeom.Xformable, speed: float = 1.0) -> None:
    """Moves a prim along x: it is at x = speed * (frame - 10)."""
    operation = prim.AddTranslateOp()
    for frame in (9, 10, 11):
        operation.Set(Gf.Vec3d(speed * (frame - 10), 0, 0), frame)


def view(stage: Usd.Stage, frame: float = 10, **options: object) -> View:
    seen = View(stage, size=(SIZE, SIZE), samples=SAMPLES, **options)
    seen.params.frame = Usd.TimeCode(frame)
    return seen


def coverage(picture: Picture, y: float = 0.0) -> np.ndarray:
    """Of a row of pixels."""
    return picture["color"][int((2 - y) / 4 * SIZE), :, 3]


def expect_slid(row: np.ndarray, speed: float, opens: float, closes: float) -> None:
    """Expects the coverage of a square of width 1 that is at x = speed * time."""
    x = (np.arange(SIZE) + 0.5) * 4 / SIZE - 2
    enters, leaves = (x - 0.5) / speed, (x + 0.5) / speed
    share = (np.clip(leaves, opens, closes) - np.clip(enters, opens, closes)) / (closes - opens)
    assert np.abs(row - share).max() < TOLERANCE, (row, share)
    assert ((share > 0.1) & (share < 0.9)).any()


@pytest.mark.parametrize(("opens", "closes"), [(0.0, 1.0), (0.0, 0.5), (-0.25, 0.75)])
def test_a_transform_blurs(opens: float, closes: float) -> None:
    stage = make_moving_stage(opens, closes)
    slide(add_square(stage))
    expect_slid(coverage(view(stage).render()), 1, opens, closes)


def test_a_parents_transform_blurs() -> None:
    stage = make_moving_stage()
    slide(UsdGeom.Xform.Define(stage, "/Parent"))
    add_square(stage, "/Parent/Square")
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_points_blur() -> None:
    stage = make_moving_stage()
    points = add_square(stage).GetPointsAttr()
    for frame in (10, 10.5, 11):
        points.Set([(x + frame - 10, y, z) for x, y, z in SQUARE], frame)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_points_blur_along_bends() -> None:
    stage = make_moving_stage()
    points = add_square(stage).GetPointsAttr()
    for frame, height in ((10, 0.0), (10.5, 1.0), (11, 0.0)):
        points.Set([(x, y + height, z) for x, y, z in SQUARE], frame)
    column = view(stage).render()["color"][:, SIZE // 2, 3]
    y = 2 - (np.arange(SIZE) + 0.5) * 4 / SIZE
    # Half of the time on the way up, and as long on the way down.
    share = np.clip(y + 0.5, 0, 1) - np.clip(y - 0.5, 0, 1)
    assert np.abs(column - share).max() < TOLERANCE


def test_point_prims_blur() -> None:
    stage = make_moving_stage()
    spheres = UsdGeom.Points.Define(stage, "/Points")
    spheres.CreateWidthsAttr([1.0])
    for frame in (10, 11):
        spheres.CreatePointsAttr().Set([(frame - 10, 0, 0)], frame)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_curves_blur() -> None:
    stage = make_moving_stage()
    curves = UsdGeom.BasisCurves.Define(stage, "/Curves")
    curves.CreateTypeAttr("linear")
    curves.CreateWidthsAttr([1.0])
    curves.SetWidthsInterpolation("constant")
    curves.CreateCurveVertexCountsAttr([2])
    for frame in (10, 11):
        x = frame - 10
        curves.CreatePointsAttr().Set([(x, -1, 0), (x, 1, 0)], frame)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_skinned_points_blur() -> None:
    stage = make_moving_stage()
    animation = skin(stage, add_square(stage, "/Root/Square"))
    for frame in (10, 11):
        animation.GetTranslationsAttr().Set([(frame - 10, 0, 0)], frame)
    seen = view(stage)
    expect_slid(coverage(seen.render()), 1, 0, 1)
    stage.GetPrimAtPath("/Camera").GetAttribute("shutter:close").Set(0.0)
    assert is_sharp(coverage(seen.render()))


def test_blend_shapes_blur() -> None:
    stage = make_moving_stage()
    animation = skin(stage, add_square(stage, "/Root/Square"))
    for frame in (10, 11):
        animation.GetBlendShapeWeightsAttr().Set([frame - 10.0], frame)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_joints_and_blend_shapes_blur_together() -> None:
    stage = make_moving_stage()
    animation = skin(stage, add_square(stage, "/Root/Square"))
    for frame, by in ((10, 0.0), (10.5, 0.25), (11, 0.5)):
        animation.GetBlendShapeWeightsAttr().Set([by], frame)
    for frame in (10, 11):
        animation.GetTranslationsAttr().Set([(0.5 * (frame - 10), 0, 0)], frame)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_a_camera_blurs() -> None:
    stage = make_stage(camera=False)
    camera = add_camera(stage, **{"shutter:open": 0.0, "shutter:close": 1.0})
    operation = camera.GetOrderedXformOps()[0]
    operation.Set(Gf.Vec3d(0, 0, 5), 10)
    operation.Set(Gf.Vec3d(-1, 0, 5), 11)
    add_square(stage)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_instancers_blur() -> None:
    stage = make_moving_stage()
    instancer = UsdGeom.PointInstancer.Define(stage, "/I")
    add_square(stage, "/I/Square")
    instancer.CreatePrototypesRel().SetTargets(["/I/Square"])
    instancer.CreateProtoIndicesAttr([0, 0])
    for frame in (10, 11):
        instancer.CreatePositionsAttr().Set([(frame - 10, 1, 0), (10 - frame, -1, 0)], frame)
    picture = view(stage).render()
    expect_slid(coverage(picture, 1), 1, 0, 1)
    expect_slid(coverage(picture, -1)[::-1], 1, 0, 1)


def test_nested_instancers_blur_by_all_that_moves() -> None:
    stage = make_moving_stage()
    outer = UsdGeom.PointInstancer.Define(stage, "/O")
    inner = UsdGeom.PointInstancer.Define(stage, "/O/I")
    add_square(stage, "/O/I/Square")
    for instancer, prototype in ((outer, "/O/I"), (inner, "/O/I/Square")):
        instancer.CreatePrototypesRel().SetTargets([prototype])
        instancer.CreateProtoIndicesAttr([0])
        for frame in (10, 11):
            instancer.CreatePositionsAttr().Set([(0.5 * (frame - 10), 0, 0)], frame)
    expect_slid(coverage(view(stage).render()), 1, 0, 1)


def test_native_instances_blur() -> None:
    stage = make_moving_stage()
    stage.CreateClassPrim("/Class")
    add_square(stage, "/Class/Square")
    for name, speed in (("A", 1.0), ("B", 0.0)):
        prim = UsdGeom.Xform.Define(stage, f"/{name}")
        prim.GetPrim().GetReferences().AddInternalReference("/Class")
        prim.GetPrim().SetInstanceable(True)
        prim.AddTranslateOp(opSuffix="up").Set(Gf.Vec3d(0, 1 if name == "A" else -1, 0))
        slide(prim, speed)
    picture = view(stage).render()
    expect_slid(coverage(picture, 1), 1, 0, 1)
    assert is_sharp(coverage(picture, -1))


def test_rotations_of_instances_keep_their_size() -> None:
    stage = make_moving_stage()
    instancer = UsdGeom.PointInstancer.Define(stage, "/I")
    add_square(stage, "/I/Square").AddTranslateOp().Set(Gf.Vec3d(1, 0, 0))
    instancer.CreatePrototypesRel().SetTargets(["/I/Square"])
    instancer.CreateProtoIndicesAttr([0])
    instancer.CreatePositionsAttr([(0, 0, 0)])
    for frame, angle in ((10, 0.0), (11, 60.0)):
        turn = Gf.Rotation(Gf.Vec3d(0, 0, 1), angle).GetQuat()
        instancer.CreateOrientationsAttr().Set([Gf.Quath(turn)], frame)
    picture = view(stage).render()["color"][:, :, 3]
    total = picture.sum() * (4 / SIZE) ** 2
    # Between two matrices an angle of 60 degrees shrinks areas, by a sixth on the average.
    assert 0.8 < total < 1.02
    assert coverage({"color": np.dstack([picture] * 4)}, 0.9).max() > 0.1


def rest(stage: Usd.Stage) -> None:
    add_cube(stage, half=0.6)


def move_and_stay(stage: Usd.Stage) -> None:
    """Samples that are all alike are no motion."""
    operation = add_cube(stage, half=0.6).AddTranslateOp()
    for frame in (9, 10, 11):
        operation.Set(Gf.Vec3d(0.2, 0, 0), frame)


@pytest.mark.parametrize("add", [rest, move_and_stay])
def test_what_rests_looks_as_with_a_closed_shutter(add: Callable[[Usd.Stage], None]) -> None:
    pictures = []
    for closes in (0.0, 1.0):
        stage = make_moving_stage(0.0, closes)
        add(stage)
        pictures.append(view(stage).render())
    assert_same(pictures[0], pictures[1])


def test_all_but_color_is_that_of_the_frame() -> None:
    pictures = []
    for closes in (0.0, 1.0):
        stage = make_moving_stage(0.0, closes)
        slide(add_square(stage))
        pictures.append(view(stage).render())
    assert_same(pictures[0], pictures[1], CENTER_AOVS)
    assert (pictures[0]["color"] != pictures[1]["color"]).any()


def test_the_shutter_can_be_edited() -> None:
    stage = make_moving_stage(0.0, 0.0)
    slide(add_square(stage))
    seen = view(stage)
    sharp = seen.render()
    assert is_sharp(coverage(sharp))
    attribute = stage.GetPrimAtPath("/Camera").GetAttribute("shutter:close")
    attribute.Set(1.0)
    expect_slid(coverage(seen.render()), 1, 0, 1)
    attribute.Set(0.5)
    expect_slid(coverage(seen.render()), 1, 0, 0.5)
    attribute.Set(0.0)
    assert_same(seen.render(), sharp)


def test_motion_can_be_edited() -> None:
    stage = make_moving_stage()
    square = add_square(stage)
    slide(square)
    seen = view(stage)
    expect_slid(coverage(seen.render()), 1, 0, 1)
    operation = square.GetOrderedXformOps()[0]
    operation.Set(Gf.Vec3d(-2, 0, 0), 9)
    operation.Set(Gf.Vec3d(2, 0, 0), 11)
    expect_slid(coverage(seen.render()), 2, 0, 1)
    seen.params.frame = Usd.TimeCode(9)
    late = coverage(seen.render())
    assert np.abs(late - coverage(view(stage, 9).render())).max() == 0


def test_frames_follow_each_other() -> None:
    stage = make_moving_stage()
    slide(add_square(stage))
    seen = view(stage)
    for frame in (9.0, 10.0, 9.5):
        seen.params.frame = Usd.TimeCode(frame)
        assert_same(seen.render(), view(stage, frame).render())


def test_bits_do_not_depend_on_threads() -> None:
    stage = make_moving_stage()
    slide(add_cube(stage, half=0.6))
    pictures = [view(stage, threads=threads).render() for threads in (1, 2, 8)]
    assert_same(pictures[0], pictures[1])
    assert_same(pictures[0], pictures[2])


def test_shadows_move_along() -> None:
    stage = make_moving_stage()
    stage.RemovePrim("/Light")
    light = add_distant_light(stage, shadows=True)
    light.AddRotateYOp().Set(45.0)
    add_mesh(
        stage,
        "/Ground",
        [(-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)],
        [4],
        [0, 1, 2, 3],
        subdivisionScheme="bilinear",
    )
    square = add_square(stage)
    square.AddTranslateOp(opSuffix="up").Set(Gf.Vec3d(1.5, 0, 1.5))
    slide(square)
    lit = view(stage).render()["color"][SIZE // 2, :, 0]
    light_there = lit / lit.max()
    # The shadow is 1.5 to the left of the square, which itself covers none of it.
    x = (np.arange(SIZE) + 0.5) * 4 / SIZE - 2
    share = np.clip(x + 0.5, 0, 1) - np.clip(x - 0.5, 0, 1)
    seen = x < 0.9
    assert np.abs(1 - light_there - share)[seen].max() < TOLERANCE


@pytest.mark.parametrize(("opens", "closes"), [(1.0, 0.0), (float("nan"), 1.0)])
def test_a_shutter_that_makes_no_sense_is_closed(opens: float, closes: float, warnings) -> None:
    stage = make_moving_stage(opens, closes)
    slide(add_square(stage))
    seen = view(stage)
    assert is_sharp(coverage(seen.render()))
    said = warnings.read()
    assert said.count("</Camera>: shutter:open is") == 1


def test_points_of_other_counts_are_shown_at_rest(warnings) -> None:
    stage = make_moving_stage()
    square = add_square(stage)
    square.GetPointsAttr().Set(SQUARE, 10)
    square.GetPointsAttr().Set(SQUARE[:3], 11)
    assert is_sharp(coverage(view(stage).render()))
    assert warnings.read().count("</Square>: pose 1 of its motion has 3 points") == 1


def test_motion_that_begins_while_the_shutter_is_closed() -> None:
    stage = make_moving_stage(0.0, 1.0)
    square = add_square(stage)
    seen = view(stage)
    seen.render()
    closes = stage.GetPrimAtPath("/Camera").GetAttribute("shutter:close")
    closes.Set(0.0)
    slide(square)
    assert is_sharp(coverage(seen.render()))
    closes.Set(0.5)
    expect_slid(coverage(seen.render()), 1, 0, 0.5)


def test_at_the_default_time_everything_rests() -> None:
    stage = make_moving_stage()
    slide(add_square(stage))
    animation = skin(stage, add_square(stage, "/Root/Square"))
    animation.GetTranslationsAttr().Set([(-1, 1, 0)])
    for frame in (10, 11):
        animation.GetTranslationsAttr().Set([(frame, 0, 0)], frame)
    instancer = UsdGeom.PointInstancer.Define(stage, "/I")
    add_square(stage, "/I/Square")
    instancer.CreatePrototypesRel().SetTargets(["/I/Square"])
    instancer.CreateProtoIndicesAttr([0])
    instancer.CreatePositionsAttr([(1, -1, 0)])
    seen = view(stage)
    seen.params.frame = Usd.TimeCode.Default()
    picture = seen.render()
    for y, left in ((1, 5), (0, 15), (-1, 25)):
        row = coverage(picture, y)
        assert is_sharp(row)
        assert (row[left + 1 : left + 9] == 1).all(), y
        assert row.sum() == pytest.approx(10, abs=0.2), y
