"""Meshes of scheme none: outlines, normals, edits."""

import math
from typing import Any

import numpy as np
import pytest
from hydra_kit import View, add_mesh, make_stage, render, shows_something
from pxr import Gf, Sdf, Usd, UsdGeom

#: Pixel centres of a picture of 32 x 32 that shows -2..2.
AXIS = (np.arange(32) + 0.5) / 8 - 2
X, Y = np.meshgrid(AXIS, -AXIS)
SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
LEFT, RIGHT, FRONT = (-0.6, 0, 0.8), (0.6, 0, 0.8), (0, 0, 1)


def add_square(stage: Usd.Stage, **attributes: Any) -> UsdGeom.Mesh:
    settings = {"subdivisionScheme": "none", **attributes}
    return add_mesh(stage, "/Square", SQUARE, [4], [0, 1, 2, 3], **settings)


def set_normals(mesh: UsdGeom.Mesh, interpolation: str, *normals: Any) -> None:
    mesh.CreateNormalsAttr([Gf.Vec3f(*normal) for normal in normals])
    mesh.SetNormalsInterpolation(interpolation)


def normal(stage: Usd.Stage) -> np.ndarray:
    return render(stage)["normal"][16, 16]


def test_concave_polygon_and_its_hole() -> None:
    stage = make_stage()
    outer = [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0)]
    inner = [(-0.5, -0.5, 0), (-0.5, 0.5, 0), (0.5, 0.5, 0), (0.5, -0.5, 0)]
    frame = [0, 1, 2, 3, 0, 4, 5, 6, 7, 4]
    add_mesh(stage, "/Frame", [*outer, *inner], [10], frame, subdivisionScheme="none")
    picture = render(stage)
    radius = np.maximum(abs(X), abs(Y))
    assert ((picture["primId"] == 0) == ((radius < 1.5) & (radius > 0.5))).all()
    assert (picture["elementId"][picture["primId"] == 0] == 0).all()


@pytest.mark.parametrize(
    ("interpolation", "count"),
    [("constant", 1), ("uniform", 1), ("varying", 4), ("vertex", 4), ("faceVarying", 4)],
)
def test_authored_normals(interpolation: str, count: int) -> None:
    stage = make_stage()
    square = add_square(stage)
    assert np.allclose(normal(stage), FRONT, atol=1e-3)
    set_normals(square, interpolation, *([RIGHT] * count))
    assert np.allclose(normal(stage), RIGHT, atol=1e-3)


def test_the_primvar_wins_over_the_attribute() -> None:
    stage = make_stage()
    square = add_square(stage)
    set_normals(square, "constant", LEFT)
    primvar = UsdGeom.PrimvarsAPI(square).CreatePrimvar(
        "normals", Sdf.ValueTypeNames.Normal3fArray, "faceVarying"
    )
    primvar.Set([Gf.Vec3f(*LEFT), Gf.Vec3f(*RIGHT)])
    primvar.SetIndices([1, 1, 1, 1])
    assert np.allclose(normal(stage), RIGHT, atol=1e-3)


@pytest.mark.parametrize("scheme", ["catmullClark", "bilinear"])
def test_subdivision_ignores_normals(scheme: str) -> None:
    stage = make_stage()
    set_normals(add_square(stage, subdivisionScheme=scheme), "constant", RIGHT)
    assert np.allclose(normal(stage), FRONT, atol=1e-3)


def test_edits_of_normals_and_scheme() -> None:
    stage = make_stage()
    square = add_square(stage)
    set_normals(square, "constant", RIGHT)
    view = View(stage)

    def seen() -> np.ndarray:
        return view.render()["normal"][16, 16]

    assert np.allclose(seen(), RIGHT, atol=1e-3)
    square.GetNormalsAttr().Set([Gf.Vec3f(*LEFT)])
    assert np.allclose(seen(), LEFT, atol=1e-3)
    square.GetSubdivisionSchemeAttr().Set("bilinear")
    assert np.allclose(seen(), FRONT, atol=1e-3)
    square.GetSubdivisionSchemeAttr().Set("none")
    assert np.allclose(seen(), LEFT, atol=1e-3)
    square.GetNormalsAttr().Clear()
    assert np.allclose(seen(), FRONT, atol=1e-3)


@pytest.mark.parametrize(
    "normals",
    [[(math.nan, 0, 1)] * 4, [(1, 0, 0)] * 3, [(0, 0, 0)] * 4],
    ids=["not finite", "too few", "no length"],
)
def test_bad_normals_are_said_once(normals: list[Any], warnings: Any) -> None:
    stage = make_stage()
    set_normals(add_square(stage), "vertex", *normals)
    view = View(stage)
    assert np.allclose(view.render()["normal"][16, 16], FRONT, atol=1e-3)
    said = warnings.read()
    assert said.count("/Square") == 1 and "normals" in said
    view.render()
    assert "/Square" not in warnings.read()


def test_a_polygon_of_fifty_thousand_corners() -> None:
    stage = make_stage()
    turn = 2 * math.pi / 50000
    points = [
        (r * math.cos(i * turn), r * math.sin(i * turn), 0)
        for i, r in ((i, 1.8 if i % 2 else 1.7) for i in range(50000))
    ]
    add_mesh(stage, "/Disk", points, [50000], list(range(50000)), subdivisionScheme="none")
    shown = render(stage)["primId"] == 0
    radius = np.hypot(X, Y)
    assert shown[radius < 1.69].all() and not shown[radius > 1.8].any()


def test_polygons_without_an_inside_do_no_harm() -> None:
    stage = make_stage()
    rng = np.random.default_rng(2)
    points = [tuple(map(float, p)) for p in rng.uniform(-1.5, 1.5, (400, 3))]
    add_mesh(stage, "/Scribble", points, [400], list(range(400)), subdivisionScheme="none")
    add_square(stage).AddTranslateOp().Set(Gf.Vec3d(0, 0, 3))
    picture = render(stage)
    assert shows_something(picture)
    assert (picture["primId"][(abs(X) < 1) & (abs(Y) < 1)] == 1).all()
