"""UsdGeomPoints: spheres, where the closed formula says."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hydra_kit import (
    ALL_AOVS,
    View,
    add_distant_light,
    add_grid,
    assert_same,
    make_stage,
    render,
)
from pxr import Gf, Sdf, Usd, UsdGeom

SIZE = (64, 64)
CENTERS = [(-1.0, 0.5, 0.0), (0.9, -0.6, 0.5), (0.8, 1.0, -1.0)]
WIDTHS = [1.4, 1.0, 0.6]
TRACERS = ("packet", "algorithm1", "single", "tessellated")


def add_points(
    stage: Usd.Stage, path: str, points: Any, widths: Any = None, interpolation: str = "vertex"
) -> UsdGeom.Points:
    prim = UsdGeom.Points.Define(stage, path)
    prim.CreatePointsAttr(points)
    if widths is not None:
        prim.CreateWidthsAttr(widths)
        prim.SetWidthsInterpolation(interpolation)
    return prim


def spheres(stage: Usd.Stage) -> UsdGeom.Points:
    return add_points(stage, "/Points", CENTERS, WIDTHS)


def pixel_grid() -> tuple[np.ndarray, np.ndarray]:
    """x and y of the middle of each pixel, in the camera's window of -2..2."""
    steps = (np.arange(SIZE[0]) + 0.5) / SIZE[0] * 4 - 2
    return np.meshgrid(steps, -steps)


def expected(centers: Any, widths: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The nearest sphere, its depth and normal at each pixel, seen from z = 5 along -z."""
    x, y = pixel_grid()
    index = np.full(x.shape, -1)
    depth = np.zeros(x.shape)
    normal = np.zeros((*x.shape, 3))
    for i, (center, width) in enumerate(zip(centers, widths, strict=True)):
        dx, dy, radius = x - center[0], y - center[1], width / 2
        square = radius**2 - dx**2 - dy**2
        height = np.sqrt(np.maximum(square, 0))
        distance = 5 - center[2] - height
        nearer = (square > 0) & ((index < 0) | (distance < depth))
        index[nearer] = i
        depth[nearer] = distance[nearer]
        normal[nearer] = (np.stack([dx, dy, height], -1) / radius)[nearer]
    return index, depth, normal


@pytest.mark.parametrize("tracer", TRACERS)
def test_points_are_spheres(tracer: str) -> None:
    stage = make_stage()
    spheres(stage)
    picture = render(stage, size=SIZE, tracer=tracer)
    index, depth, normal = expected(CENTERS, WIDTHS)
    assert (index >= 0).sum() > 500
    assert (picture["elementId"] == index).all()
    assert (picture["primId"] == np.where(index >= 0, 0, -1)).all()
    assert np.abs(picture["cameraDepth"] - depth).max() < 2e-5
    # Normals are written as half floats, and steep at the silhouette.
    assert np.abs(picture["normal"] - normal).max() < 4e-3


def test_points_are_as_wide_as_their_widths() -> None:
    for widths, interpolation, each in (
        (None, "", [1.0, 1.0, 1.0]),
        ([0.7], "constant", [0.7, 0.7, 0.7]),
        (WIDTHS, "vertex", WIDTHS),
        (WIDTHS, "varying", WIDTHS),
    ):
        stage = make_stage()
        add_points(stage, "/Points", CENTERS, widths, interpolation)
        picture = render(stage, size=SIZE, aovs=("elementId",))
        assert (picture["elementId"] == expected(CENTERS, each)[0]).all(), interpolation


def test_points_have_colours_and_primvars_of_their_own() -> None:
    stage = make_stage()
    points = spheres(stage)
    colours = [Gf.Vec3f(1, 0, 0), Gf.Vec3f(0, 1, 0), Gf.Vec3f(0, 0, 1)]
    points.CreateDisplayColorPrimvar("vertex").Set(colours)
    api = UsdGeom.PrimvarsAPI(points)
    api.CreatePrimvar("mass", Sdf.ValueTypeNames.FloatArray, "varying").Set([3.0, 5.0, 7.0])
    picture = render(stage, size=SIZE, aovs=(*ALL_AOVS, "primvars:mass"), samples=1)
    index, _, normal = expected(CENTERS, WIDTHS)
    seen = index >= 0
    assert (picture["primvars:mass"][seen] == np.array([3.0, 5.0, 7.0])[index[seen]]).all()
    # A head light of radiance 1, without shadows, on a diffuse sphere.
    inside = seen & (normal[..., 2] > 0.9)
    assert inside.sum() > 50
    lit = picture["color"][inside][:, :3]
    strongest = lit[np.arange(len(lit)), index[inside]]
    assert (strongest > 0).all()
    ratio = strongest / normal[inside][:, 2]
    assert np.abs(ratio / ratio.mean() - 1).max() < 2e-2
    assert np.count_nonzero(lit) == len(lit)


def test_points_do_not_shadow_themselves() -> None:
    """None of the spheres stands in the light of another, so shadows change nothing."""
    stage = make_stage(light=False)
    spheres(stage)
    light = add_distant_light(stage, shadows=False)
    light.AddRotateYOp().Set(40.0)
    without = render(stage, size=SIZE, samples=1)
    light.GetPrim().GetAttribute("inputs:shadow:enable").Set(True)
    shadowed = render(stage, size=SIZE, samples=1)
    assert_same(shadowed, without)


def test_instancers_and_transforms_move_points() -> None:
    stage = make_stage()
    instancer = UsdGeom.PointInstancer.Define(stage, "/I")
    instancer.CreatePrototypesRel().SetTargets(["/I/Points"])
    instancer.CreatePositionsAttr([(-1, 1, 0), (1, -1, 0)])
    instancer.CreateScalesAttr([(1, 1, 1), (2, 2, 2)])
    instancer.CreateProtoIndicesAttr([0, 0])
    add_points(stage, "/I/Points", [(0, 0, 0)], [0.8])
    picture = render(stage, size=SIZE)
    index, depth, _ = expected([(-1, 1, 0), (1, -1, 0)], [0.8, 1.6])
    assert (picture["instanceId"] == index).all()
    assert np.abs(picture["cameraDepth"] - depth).max() < 2e-5


Edit = Callable[[UsdGeom.Points], None]


def add_a_point(points: UsdGeom.Points) -> None:
    points.GetPointsAttr().Set([*CENTERS, (-1, -1, 0)])
    points.GetWidthsAttr().Set([*WIDTHS, 0.5])


def move_prim(points: UsdGeom.Points) -> None:
    points.AddTranslateOp().Set(Gf.Vec3d(0.5, 0, 0))


EDITS: dict[str, Edit] = {
    "points": lambda points: points.GetPointsAttr().Set([(0, 0, 0), (1, 1, 0), (-1, -1, 0)]),
    "widths": lambda points: points.GetWidthsAttr().Set([0.4, 1.2, 0.9]),
    "count": add_a_point,
    "transform": move_prim,
    "visibility": lambda points: points.MakeInvisible(),
    "colour": lambda points: points.CreateDisplayColorPrimvar("constant").Set([Gf.Vec3f(1, 0, 0)]),
}


@pytest.mark.parametrize("edit", EDITS)
def test_edited_points_look_freshly_loaded(edit: str) -> None:
    stage = make_stage()
    points = spheres(stage)
    view = View(stage, size=SIZE)
    before = view.render()
    EDITS[edit](points)
    after = view.render()
    assert any((after[name] != before[name]).any() for name in ALL_AOVS)
    assert_same(after, render(stage, size=SIZE))


NAN = float("nan")
LEFT_OUT = {
    "a_point_is_nan": ([*CENTERS, (NAN, 0, 0)], [*WIDTHS, 1.0], "left out"),
    "a_width_is_negative": ([*CENTERS, (0, 0, 3)], [*WIDTHS, -1.0], "left out"),
    "a_width_is_nan": ([*CENTERS, (0, 0, 3)], [*WIDTHS, NAN], "left out"),
    "a_width_is_zero": ([*CENTERS, (0, 0, 3)], [*WIDTHS, 0.0], ""),
}


@pytest.mark.parametrize("name", LEFT_OUT)
def test_points_that_cannot_be_shown_are_left_out(name: str, warnings: Any) -> None:
    points, widths, told = LEFT_OUT[name]
    stage = make_stage()
    spheres(stage)
    good = render(stage, size=SIZE)
    stage = make_stage()
    add_points(stage, "/Points", points, widths)
    assert_same(render(stage, size=SIZE), good)
    said = warnings.read()
    assert ("</Points>" in said) == bool(told)
    assert told in said


def test_wrong_numbers_of_widths_are_told(warnings: Any) -> None:
    stage = make_stage()
    add_points(stage, "/Points", CENTERS, [0.2, 0.3])
    picture = render(stage, size=SIZE, aovs=("elementId",))
    assert "</Points>: widths" in warnings.read()
    assert (picture["elementId"] == expected(CENTERS, [1.0, 1.0, 1.0])[0]).all()


def test_no_points_are_nothing(warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage)
    alone = render(stage)
    add_points(stage, "/Points", [], [])
    assert_same(render(stage), alone)
    assert "<" not in warnings.read()
