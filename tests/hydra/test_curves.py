"""UsdGeomBasisCurves: tubes and ribbons, where the closed formulas say."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hydra_kit import ALL_AOVS, View, add_distant_light, add_grid, assert_same, make_stage, render
from pxr import Gf, Sdf, Usd, UsdGeom

SIZE = (64, 64)
TRACERS = ("packet", "algorithm1", "single", "tessellated")


def add_curves(
    stage: Usd.Stage,
    path: str,
    points: Any,
    counts: Any,
    widths: Any = (0.5,),
    interpolation: str = "constant",
    **attributes: Any,
) -> UsdGeom.BasisCurves:
    curves = UsdGeom.BasisCurves.Define(stage, path)
    curves.CreatePointsAttr(points)
    curves.CreateCurveVertexCountsAttr(counts)
    if widths is not None:
        curves.CreateWidthsAttr(widths)
        curves.SetWidthsInterpolation(interpolation)
    for name, value in attributes.items():
        curves.GetPrim().GetAttribute(name).Set(value)
    return curves


def pixel_grid() -> tuple[np.ndarray, np.ndarray]:
    """x and y of the middle of each pixel, in the camera's window of -2..2."""
    steps = (np.arange(SIZE[0]) + 0.5) / SIZE[0] * 4 - 2
    return np.meshgrid(steps, -steps)


def row(count: int, y: float = 0.0) -> list[tuple[float, float, float]]:
    """Points along x, 0.5 apart, from -1.5 on."""
    return [(-1.5 + 0.5 * i, y, 0.0) for i in range(count)]


#: type, basis, wrap, points, begin and end of the tube, in points
STRAIGHT = {
    "linear": ("linear", "bezier", "nonperiodic", 7, 0, 6),
    "bezier": ("cubic", "bezier", "nonperiodic", 7, 0, 6),
    "bspline": ("cubic", "bspline", "nonperiodic", 7, 1, 5),
    "bspline_pinned": ("cubic", "bspline", "pinned", 7, 0, 6),
    "catmullRom": ("cubic", "catmullRom", "nonperiodic", 7, 1, 5),
    "catmullRom_pinned": ("cubic", "catmullRom", "pinned", 7, 0, 6),
}


@pytest.mark.parametrize("name", STRAIGHT)
def test_straight_curves_are_tubes(name: str) -> None:
    kind, basis, wrap, count, begin, end = STRAIGHT[name]
    stage = make_stage()
    add_curves(stage, "/Curves", row(count, 0.3), [count], type=kind, basis=basis, wrap=wrap)
    picture = render(stage, size=SIZE)
    x, y = pixel_grid()
    square = 0.25**2 - (y - 0.3) ** 2
    seen = (square > 0) & (x > -1.5 + 0.5 * begin) & (x < -1.5 + 0.5 * end)
    height = np.sqrt(np.maximum(square, 0))
    assert seen.sum() > 200
    assert ((picture["elementId"] == 0) == seen).all()
    assert np.abs(picture["cameraDepth"] - np.where(seen, 5 - height, 0)).max() < 2e-5
    normal = np.stack([0 * x, (y - 0.3) / 0.25, height / 0.25], -1)
    # Normals are written as half floats, and steep at the silhouette.
    assert np.abs(picture["normal"] - np.where(seen[..., None], normal, 0)).max() < 4e-3


@pytest.mark.parametrize("tracer", TRACERS)
def test_periodic_bsplines_are_closed(tracer: str) -> None:
    """A B-spline over a regular polygon is nearly a circle: a ring without a gap."""
    stage = make_stage()
    angles = np.arange(12) * 2 * np.pi / 12
    points = [(1.4 * np.cos(a), 1.4 * np.sin(a), 0.0) for a in angles]
    add_curves(stage, "/C", points, [12], type="cubic", basis="bspline", wrap="periodic")
    picture = render(stage, size=SIZE, tracer=tracer, aovs=("elementId", "cameraDepth"))
    x, y = pixel_grid()
    # At a knot: two thirds of a point, and a sixth of each neighbour.
    circle = 1.4 * (2 / 3 + np.cos(2 * np.pi / 12) / 3)
    away = np.abs(np.hypot(x, y) - circle)
    seen = picture["elementId"] == 0
    assert seen[away < 0.24].all()
    assert not seen[away > 0.26].any()
    near = away < 0.2
    height = np.sqrt(0.25**2 - away[near] ** 2)
    assert np.abs(picture["cameraDepth"][near] - (5 - height)).max() < 0.02


def test_curves_have_widths_and_primvars_of_their_own() -> None:
    stage = make_stage()
    points = [*row(2, 1.0), *row(2, -1.0)]
    points = [(6 * x + 7.5, y, z) for x, y, z in points]
    curves = add_curves(stage, "/C", points, [2, 2], [0.2, 0.6], "uniform", type="linear")
    api = UsdGeom.PrimvarsAPI(curves)
    values = {"uniform": [3.0, 5.0], "varying": [0.0, 1.0, 4.0, 6.0], "constant": [8.0]}
    for interpolation, numbers in values.items():
        kind = Sdf.ValueTypeNames.FloatArray
        api.CreatePrimvar(f"x_{interpolation}", kind, interpolation).Set(numbers)
    aovs = ("elementId", *(f"primvars:x_{name}" for name in values))
    picture = render(stage, size=SIZE, aovs=aovs)
    x, y = pixel_grid()
    element = np.where(np.abs(y - 1) < 0.1, 0, np.where(np.abs(y + 1) < 0.3, 1, -1))
    element[np.abs(x) > 1.5] = -1
    assert (picture["elementId"] == element).all()
    for i, (begin, end) in enumerate(((0.0, 1.0), (4.0, 6.0))):
        on = element == i
        assert (picture["primvars:x_uniform"][on] == values["uniform"][i]).all()
        assert (picture["primvars:x_constant"][on] == 8).all()
        along = begin + (end - begin) * (x[on] + 1.5) / 3
        assert np.abs(picture["primvars:x_varying"][on] - along).max() < 1e-5


def test_normals_make_ribbons() -> None:
    stage = make_stage()
    curves = add_curves(stage, "/C", [(-1.5, 0, 0), (1.5, 0, 0)], [2], [1.0], type="linear")
    curves.CreateNormalsAttr([Gf.Vec3f(0, 0, 1)] * 2)
    curves.SetNormalsInterpolation("varying")
    picture = render(stage, size=SIZE)
    x, y = pixel_grid()
    seen = (np.abs(x) < 1.5) & (np.abs(y) < 0.5)
    assert ((picture["elementId"] == 0) == seen).all()
    assert np.abs(picture["cameraDepth"][seen] - 5).max() < 1e-5
    assert np.abs(picture["normal"][seen] - [0, 0, 1]).max() < 1e-3
    # Turned to the side, one sees the edge.
    curves.GetNormalsAttr().Set([Gf.Vec3f(0, 0.8, 0.6)] * 2)
    turned = render(stage, size=SIZE)
    seen = (np.abs(x) < 1.5) & (np.abs(y) < 0.3)
    assert ((turned["elementId"] == 0) == seen).all()
    assert np.abs(turned["normal"][seen] - [0, 0.8, 0.6]).max() < 1e-3


def test_curves_do_not_shadow_themselves() -> None:
    stage = make_stage(light=False)
    points = [(-1.5, -1, 0), (-0.5, 1.5, 0), (0.5, 1.5, 0), (1.5, -1, 0)]
    add_curves(stage, "/C", points, [4], [0.6], type="cubic", basis="bezier")
    light = add_distant_light(stage, shadows=False)
    without = render(stage, size=SIZE, samples=1)
    light.GetPrim().GetAttribute("inputs:shadow:enable").Set(True)
    shadowed = render(stage, size=SIZE, samples=1)
    assert_same(shadowed, without)


def wave(stage: Usd.Stage) -> UsdGeom.BasisCurves:
    points = [(-1.5, 0, 0), (-0.5, 1.5, 0), (0.5, -1.5, 0), (1.5, 0, 0)]
    return add_curves(stage, "/C", points, [4], [0.3], type="cubic", basis="bezier")


def change_topology(curves: UsdGeom.BasisCurves) -> None:
    curves.GetPointsAttr().Set([(-1, 1, 0), (1, 1, 0), (-1, -1, 0), (1, -1, 0)])
    curves.GetCurveVertexCountsAttr().Set([2, 2])
    curves.GetTypeAttr().Set("linear")


EDITS: dict[str, Callable[[UsdGeom.BasisCurves], Any]] = {
    "points": lambda c: c.GetPointsAttr().Set([(-1, 0, 0), (0, 1, 0), (0, 1, 0), (1, 0, 0)]),
    "widths": lambda c: c.GetWidthsAttr().Set([0.8]),
    "topology": change_topology,
    "basis": lambda c: c.GetBasisAttr().Set("bspline"),
    "wrap": lambda c: (c.GetBasisAttr().Set("catmullRom"), c.GetWrapAttr().Set("pinned")),
    "normals": lambda c: c.CreateNormalsAttr([Gf.Vec3f(0, 0, 1)] * 4),
    "transform": lambda c: c.AddTranslateOp().Set(Gf.Vec3d(0.5, 0, 0)),
}


@pytest.mark.parametrize("edit", EDITS)
def test_edited_curves_look_freshly_loaded(edit: str) -> None:
    stage = make_stage()
    curves = wave(stage)
    view = View(stage, size=SIZE)
    before = view.render()
    EDITS[edit](curves)
    after = view.render()
    assert any((after[name] != before[name]).any() for name in ALL_AOVS)
    assert_same(after, render(stage, size=SIZE))


NAN = float("nan")
BROKEN: dict[str, dict[str, Any]] = {
    "too_few_points": {"points": row(3), "counts": [4]},
    "too_few_for_the_basis": {"points": row(3), "counts": [3]},
    "negative_count": {"points": row(4), "counts": [-4]},
    "huge_count": {"points": row(4), "counts": [2**31 - 1]},
    "nan_point": {"points": [*row(3), (NAN, 0, 0)], "counts": [4]},
    "negative_width": {"points": row(4), "counts": [4], "widths": [-1.0]},
    "nan_width": {"points": row(4), "counts": [4], "widths": [NAN]},
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_curves_are_left_out(name: str, warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage, "/Good", bump=0.5)
    good = render(stage)
    assert "<" not in warnings.read()
    options = {"type": "cubic", "basis": "bspline", **BROKEN[name]}
    add_curves(stage, "/Worse/Bad", **options)
    assert_same(render(stage), good)
    assert "/Worse/Bad" in warnings.read()


def test_curves_without_width_or_points_are_nothing(warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage)
    alone = render(stage)
    add_curves(stage, "/Zero", row(4), [4], [0.0], type="linear")
    add_curves(stage, "/None", [], [], [], type="linear")
    assert_same(render(stage), alone)
    assert "<" not in warnings.read()
