"""Sphere, Cube, Cone, Cylinder, Capsule and Plane: meshes that look like what they are."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hydra_kit import ALL_AOVS, View, assert_same, make_stage, render
from pxr import Gf, Usd, UsdGeom

SIZE = (96, 96)
#: OpenUSD's meshes have ten points on a circle, and their limit surface is a B-spline over those:
#: it lies inside the circle, by this factor.
TEN_POINTS = 2 / 3 + np.cos(2 * np.pi / 10) / 3
#: No shape is smaller than by that and half as much again, in the other direction of spheres.
SMALLEST = 1 - 1.5 * (1 - TEN_POINTS)

Height = Callable[[np.ndarray, np.ndarray], np.ndarray]


def pixel_grid() -> tuple[np.ndarray, np.ndarray]:
    """x and y of the middle of each pixel, in the camera's window of -2..2."""
    steps = (np.arange(SIZE[0]) + 0.5) / SIZE[0] * 4 - 2
    return np.meshgrid(steps, -steps)


def root(values: np.ndarray) -> np.ndarray:
    """Where there is one; else not a number."""
    return np.sqrt(np.where(values >= 0, values, np.nan))


def capsule(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Of radius 0.5 and height 1 along y."""
    beyond = np.maximum(np.abs(y) - 0.5, 0)
    return root(0.25 - x**2 - beyond**2)


#: Attributes, and the height above z = 0 of what the camera sees.
SHAPES: dict[str, tuple[dict[str, Any], Height]] = {
    "Sphere": ({"radius": 1.3}, lambda x, y: root(1.69 - x**2 - y**2)),
    "Cube": (
        {"size": 2.2},
        lambda x, y: np.where(np.maximum(np.abs(x), np.abs(y)) < 1.1, 1.1, np.nan),
    ),
    "Cylinder": (
        {"radius": 0.8, "height": 2.5, "axis": "Y"},
        lambda x, y: np.where(np.abs(y) < 1.25, root(0.64 - x**2), np.nan),
    ),
    "Cone": (
        {"radius": 1.0, "height": 2.0, "axis": "Y"},
        lambda x, y: np.where(np.abs(y) < 1, root(((1 - y) / 2) ** 2 - x**2), np.nan),
    ),
    "Capsule": ({"radius": 0.5, "height": 1.0, "axis": "Y"}, capsule),
    "Plane": (
        {"width": 2.4, "length": 1.6, "axis": "Z"},
        lambda x, y: np.where((np.abs(x) < 1.2) & (np.abs(y) < 0.8), 0.0, np.nan),
    ),
}


def add(stage: Usd.Stage, name: str, attributes: dict[str, Any]) -> Usd.Prim:
    prim = getattr(UsdGeom, name).Define(stage, "/Shape").GetPrim()
    for attribute, value in attributes.items():
        prim.GetAttribute(attribute).Set(value)
    return prim


@pytest.mark.parametrize("name", SHAPES)
def test_silhouettes_are_those_of_the_shape(name: str) -> None:
    attributes, height = SHAPES[name]
    stage = make_stage()
    add(stage, name, attributes)
    picture = render(stage, size=SIZE)
    x, y = pixel_grid()
    seen = picture["primId"] == 0
    # The cone is round its tip, not its middle.
    down = y if name == "Cone" else y / SMALLEST
    inside = ~np.isnan(height(x / SMALLEST, down)) & (y < 0.8)
    assert inside.sum() > 500
    assert seen[inside].all()
    assert not seen[np.isnan(height(x, y))].any()
    # Nowhere before the shape, nor far behind it but where that is steep.
    behind = (picture["cameraDepth"] - (5 - height(x, y)))[seen]
    assert behind.min() > -1e-4
    assert np.median(behind) < 0.1


@pytest.mark.parametrize("name", ["Cube", "Plane"])
def test_flat_shapes_are_exact(name: str) -> None:
    attributes, height = SHAPES[name]
    stage = make_stage()
    add(stage, name, attributes)
    picture = render(stage, size=SIZE)
    expected = height(*pixel_grid())
    seen = picture["primId"] == 0
    assert (seen == ~np.isnan(expected)).all()
    assert np.abs(5 - picture["cameraDepth"] - expected)[seen].max() < 1e-5
    assert np.abs(picture["normal"][seen] - [0, 0, 1]).max() < 1e-6


def test_cylinders_are_as_round_as_a_bspline_of_ten_points() -> None:
    stage = make_stage()
    add(stage, "Cylinder", SHAPES["Cylinder"][0])
    picture = render(stage, size=SIZE)
    x, y = pixel_grid()
    radius = 0.8 * TEN_POINTS
    middle = (np.abs(y) < 0.5) & (np.abs(x) < 0.7 * radius)
    depth = 5 - np.sqrt(np.maximum(radius**2 - x**2, 0))
    # A quarter of a pixel, which quads may be off.
    assert np.abs(picture["cameraDepth"] - depth)[middle].max() < 0.01
    normal = np.stack([x / radius, 0 * x, (5 - depth) / radius], -1)
    assert np.abs(picture["normal"] - normal)[middle].max() < 0.02


@pytest.mark.parametrize("name", ["Sphere", "Cylinder", "Cone", "Capsule"])
def test_curved_shapes_have_no_facets(name: str) -> None:
    """Normals of neighbouring pixels hardly differ, but they do."""
    attributes, height = SHAPES[name]
    stage = make_stage()
    add(stage, name, attributes)
    normal = render(stage, size=SIZE)["normal"].astype(float)
    x, y = pixel_grid()
    clear = ~np.isnan(height(x / 0.7, y / 0.7)) & (np.abs(y) < 0.5) & (y < 0.2)
    assert clear.sum() > 200
    pairs = clear[:, 1:] & clear[:, :-1]
    cosine = np.sum(normal[:, 1:] * normal[:, :-1], -1)[pairs]
    turn = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
    # A facet of ten would turn by 36 degrees at its edge, and not at all before it.
    assert turn.max() < 9
    assert np.median(turn) > 0.5


EDITS = {
    "sphere_radius": ("Sphere", {"radius": 0.6}),
    "cube_size": ("Cube", {"size": 0.8}),
    "cylinder_height": ("Cylinder", {"height": 1.0}),
    "cylinder_axis": ("Cylinder", {"axis": "X"}),
    "cone_radius": ("Cone", {"radius": 0.4}),
    "capsule_axis": ("Capsule", {"axis": "X"}),
    "plane_width": ("Plane", {"width": 0.7}),
}


@pytest.mark.parametrize("edit", EDITS)
def test_edited_shapes_look_freshly_loaded(edit: str) -> None:
    name, changes = EDITS[edit]
    stage = make_stage()
    prim = add(stage, name, SHAPES[name][0])
    view = View(stage, size=SIZE)
    before = view.render()
    for attribute, value in changes.items():
        prim.GetAttribute(attribute).Set(value)
    after = view.render()
    assert (after["primId"] != before["primId"]).any()
    assert_same(after, render(stage, size=SIZE))


def test_colours_are_those_of_the_shape() -> None:
    stage = make_stage()
    prim = add(stage, "Sphere", {"radius": 1.0})
    UsdGeom.Gprim(prim).CreateDisplayColorAttr([Gf.Vec3f(1, 0, 0)])
    picture = render(stage, size=SIZE, samples=1)
    middle = picture["color"][SIZE[1] // 2, SIZE[0] // 2]
    assert middle[0] > 0.1
    assert (middle[1:3] == 0).all()
    assert set(ALL_AOVS) <= set(picture)
