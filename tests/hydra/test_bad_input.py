"""Scenes that are wrong: one warning that names the prim, and the rest of the picture intact."""

from typing import Any

import pytest
from hydra_kit import (
    ALL_AOVS,
    View,
    add_grid,
    add_mesh,
    assert_same,
    grid_faces,
    grid_points,
    make_stage,
    render,
)
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

NAN, INF = float("nan"), float("inf")
SQUARE = [(-2.0, -2.0, 3.0), (2.0, -2.0, 3.0), (2.0, 2.0, 3.0), (-2.0, 2.0, 3.0)]

BROKEN = {
    "counts_and_indices_disagree": (SQUARE, [4, 4], [0, 1, 2, 3]),
    "index_too_large": (SQUARE, [4], [0, 1, 2, 4]),
    "index_negative": (SQUARE, [4], [0, 1, 2, -1]),
    "count_negative": (SQUARE, [-4], [0, 1, 2, 3]),
    "count_huge": (SQUARE, [2**31 - 1], [0, 1, 2, 3]),
    "no_points": ([], [4], [0, 1, 2, 3]),
    "point_is_nan": ([*SQUARE[:3], (NAN, 0.0, 0.0)], [4], [0, 1, 2, 3]),
    "point_is_infinite": ([*SQUARE[:3], (INF, 0.0, 0.0)], [4], [0, 1, 2, 3]),
}


def make_good_stage() -> Usd.Stage:
    stage = make_stage()
    add_grid(stage, "/Good", bump=0.5)
    return stage


@pytest.mark.parametrize("name", BROKEN)
def test_broken_mesh_is_left_out(name: str, warnings: Any) -> None:
    stage = make_good_stage()
    expected = render(stage)
    assert "<" not in warnings.read()
    add_mesh(stage, "/Worse/Bad", *BROKEN[name])
    assert_same(render(stage), expected)
    assert "/Worse/Bad" in warnings.read()


@pytest.mark.parametrize("name", BROKEN)
def test_broken_mesh_can_be_mended(name: str) -> None:
    stage = make_good_stage()
    mesh = add_mesh(stage, "/Worse/Bad", *BROKEN[name])
    view = View(stage)
    view.execute()
    mesh.GetPointsAttr().Set(SQUARE)
    mesh.GetFaceVertexCountsAttr().Set([4])
    mesh.GetFaceVertexIndicesAttr().Set([0, 1, 2, 3])
    mended = view.render()
    assert (mended["primId"] == 1).any()
    assert_same(mended, render(stage))


def test_mesh_can_break_while_it_is_shown(warnings: Any) -> None:
    stage = make_good_stage()
    expected = render(stage)
    mesh = add_mesh(stage, "/Worse/Bad", SQUARE, [4], [0, 1, 2, 3])
    view = View(stage)
    assert (view.render()["primId"] == 1).any()
    mesh.GetPointsAttr().Set(SQUARE[:2])
    assert_same(view.render(), expected)
    assert "/Worse/Bad" in warnings.read()


EMPTY = {
    "nothing": ([], [], []),
    "points_without_faces": (SQUARE, [], []),
}


@pytest.mark.parametrize("name", EMPTY)
def test_empty_mesh_is_nothing(name: str) -> None:
    stage = make_good_stage()
    expected = render(stage)
    add_mesh(stage, "/Worse/Empty", *EMPTY[name])
    UsdGeom.Mesh.Define(stage, "/Worse/Bare")
    assert_same(render(stage), expected)


DEGENERATE = {
    "faces_without_area": ([(0.0, 0.0, 3.0)] * 4, [4], [0, 1, 2, 3]),
    "repeated_vertex": (SQUARE, [4], [0, 1, 1, 3]),
    "same_face_twice": (SQUARE, [4, 4], [0, 1, 2, 3, 0, 1, 2, 3]),
    "edge_of_three_faces": (
        [*SQUARE, (0.0, 0.0, 4.0), (0.0, 0.0, 2.0)],
        [3, 3, 3],
        [0, 1, 2, 0, 1, 4, 0, 1, 5],
    ),
    "two_points_and_none": (SQUARE, [2, 1, 0, 4], [0, 1, 2, 0, 1, 2, 3]),
    "huge_coordinates": ([(x * 1e30, y * 1e30, z) for x, y, z in SQUARE], [4], [0, 1, 2, 3]),
}


@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_mesh_does_no_harm(name: str) -> None:
    stage = make_good_stage()
    add_mesh(stage, "/Worse/Odd", *DEGENERATE[name])
    picture = render(stage)
    assert (picture["primId"] >= 0).all()


TAGS: dict[str, dict[str, Any]] = {
    "crease_of_no_edge": {
        "creaseIndices": [0, 24],
        "creaseLengths": [2],
        "creaseSharpnesses": [5.0],
    },
    "crease_index_out_of_range": {
        "creaseIndices": [0, 999],
        "creaseLengths": [2],
        "creaseSharpnesses": [5.0],
    },
    "crease_lengths_disagree": {
        "creaseIndices": [0, 1],
        "creaseLengths": [5],
        "creaseSharpnesses": [5.0],
    },
    "crease_length_negative": {
        "creaseIndices": [0, 1],
        "creaseLengths": [-2],
        "creaseSharpnesses": [5.0],
    },
    "crease_sharpnesses_disagree": {
        "creaseIndices": [0, 1],
        "creaseLengths": [2],
        "creaseSharpnesses": [5.0, 1.0, 2.0],
    },
    "crease_sharpness_nan": {
        "creaseIndices": [6, 7],
        "creaseLengths": [2],
        "creaseSharpnesses": [NAN],
    },
    "corner_index_out_of_range": {"cornerIndices": [-1], "cornerSharpnesses": [10.0]},
    "corner_sharpnesses_disagree": {"cornerIndices": [0], "cornerSharpnesses": []},
    "hole_out_of_range": {"holeIndices": [16, -1]},
}


@pytest.mark.parametrize("name", TAGS)
def test_bad_tags_are_dropped(name: str, warnings: Any) -> None:
    expected = render(make_good_stage())
    stage = make_stage()
    add_grid(stage, "/Good", bump=0.5, **TAGS[name])
    assert_same(render(stage), expected)
    assert "/Good" in warnings.read()


RULES = {
    "interpolateBoundary": "edgeAndCorner",
    "faceVaryingLinearInterpolation": "cornersPlus1",
    "triangleSubdivisionRule": "catmullClark",
    "orientation": "rightHanded",
}


@pytest.mark.parametrize("attribute", RULES)
def test_rule_that_does_not_exist_is_warned_about_once(attribute: str, warnings: Any) -> None:
    expected = render(make_good_stage())
    stage = make_stage()
    mesh = add_grid(stage, "/Good", bump=0.5, **{attribute: "sometimes"})
    view = View(stage)
    assert_same(view.render(), expected)
    said = warnings.read()
    assert f"</Good>: {attribute} cannot be 'sometimes'; {RULES[attribute]} is used" in said
    assert said.count("</Good>") == 1
    mesh.GetHoleIndicesAttr().Set([3])
    view.execute()
    assert "</Good>" not in warnings.read()


COLORS: dict[str, tuple[str, int, list[int] | None]] = {
    "none_constant": ("constant", 0, None),
    "none_vertex": ("vertex", 0, None),
    "too_few_vertex": ("vertex", 3, None),
    "too_many_vertex": ("vertex", 100, None),
    "too_few_uniform": ("uniform", 1, None),
    "too_few_face_varying": ("faceVarying", 5, None),
    "index_out_of_range": ("uniform", 2, [0, 1, 2, 3] * 4),
    "index_negative": ("uniform", 2, [-1] * 16),
}


@pytest.mark.parametrize("name", COLORS)
def test_bad_color_is_ignored(name: str, warnings: Any) -> None:
    expected = render(make_good_stage())
    stage = make_good_stage()
    interpolation, count, indices = COLORS[name]
    primvar = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/Good")).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, interpolation
    )
    primvar.Set(Vt.Vec3fArray([Gf.Vec3f(1, 0, 0)] * count))
    if indices:
        primvar.SetIndices(Vt.IntArray(indices))
    picture = render(stage)
    assert_same(picture, expected, [aov for aov in ALL_AOVS if aov != "color"])
    assert "/Good" in warnings.read()


def test_empty_mesh_may_have_empty_colors(warnings: Any) -> None:
    stage = make_good_stage()
    add_mesh(stage, "/Worse/Empty", [], [], [], displayColor=[])
    render(stage)
    assert "/Worse/Empty" not in warnings.read()


@pytest.mark.parametrize("scale", [0.0, NAN, INF])
def test_broken_transform_leaves_the_mesh_out(scale: float, warnings: Any) -> None:
    stage = make_good_stage()
    expected = render(stage)
    mesh = add_grid(stage, "/Worse/Bad")
    mesh.AddTransformOp().Set(Gf.Matrix4d(1).SetScale(Gf.Vec3d(1, scale, 1)))
    assert_same(render(stage), expected)
    assert "/Worse/Bad" in warnings.read()


def test_large_mesh() -> None:
    stage = make_stage()
    counts, indices = grid_faces(200)
    add_mesh(stage, "/Large", grid_points(200), counts, indices)
    assert (render(stage)["primId"] == 0).all()


def test_face_with_many_vertices() -> None:
    import math

    count = 100
    ring = [
        (3 * math.cos(2 * math.pi * i / count), 3 * math.sin(2 * math.pi * i / count), 0.0)
        for i in range(count)
    ]
    stage = make_stage()
    add_mesh(stage, "/Fan", ring, [count], list(range(count)))
    assert render(stage)["primId"][16, 16] == 0


@pytest.mark.parametrize("edit", ["points", "topology"])
def test_edit_to_broken_and_back(edit: str) -> None:
    stage = make_good_stage()
    view = View(stage)
    before = view.render()
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/Good"))
    attribute = mesh.GetPointsAttr() if edit == "points" else mesh.GetFaceVertexCountsAttr()
    good = attribute.Get()
    attribute.Set([])
    assert (view.render()["primId"] == -1).all()
    attribute.Set(good)
    assert_same(view.render(), before)
