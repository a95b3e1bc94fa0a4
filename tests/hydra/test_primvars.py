"""Primvars of every type and interpolation, read back as AOVs."""

from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio
import pytest
from hydra_kit import View, add_cube, add_grid, add_mesh, make_stage, render, shows_something
from pxr import Gf, Sdf, Usd, UsdGeom

#: Pixel centres of a picture of 32 x 32 that shows -2..2.
AXIS = (np.arange(32) + 0.5) / 8 - 2
X, Y = np.meshgrid(AXIS, -AXIS)
TYPES = Sdf.ValueTypeNames


def add_primvar(
    mesh: UsdGeom.Mesh,
    name: str,
    type_name: Sdf.ValueTypeName,
    interpolation: str,
    value: Any,
    indices: list[int] | None = None,
) -> UsdGeom.Primvar:
    primvar = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(name, type_name, interpolation)
    assert primvar.Set(value)
    if indices:
        primvar.SetIndices(indices)
    return primvar


def read(stage: Usd.Stage, name: str = "st") -> np.ndarray:
    picture = render(stage, aovs=[f"primvars:{name}", "primId"])
    return picture[f"primvars:{name}"]


def add_quad(stage: Usd.Stage, path: str = "/Quad", **attributes: Any) -> UsdGeom.Mesh:
    points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    settings = {"subdivisionScheme": "bilinear", **attributes}
    return add_mesh(stage, path, points, [4], [0, 1, 2, 3], **settings)


@pytest.mark.parametrize("precision", ["h", "f", "d", "i"])
@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_numbers_and_vectors_of_every_precision(size: int, precision: str) -> None:
    scalars = {"h": TYPES.HalfArray, "f": TYPES.FloatArray, "d": TYPES.DoubleArray}
    words = {"h": "Half", "f": "Float", "d": "Double", "i": "Int"}
    type_name = (
        scalars.get(precision, TYPES.IntArray)
        if size == 1
        else getattr(TYPES, f"{words[precision]}{size}Array")
    )
    corners = [[1, 2, 3, 4], [5, 2, 3, 4], [5, 6, 7, 4], [1, 6, 7, 0]]
    value = [c[0] if size == 1 else tuple(c[:size]) for c in corners]
    stage = make_stage()
    add_primvar(add_quad(stage), "st", type_name, "vertex", value)
    found = read(stage).reshape(32, 32, -1)
    assert found.shape[2] == size
    u, v = (X + 2) / 4, (Y + 2) / 4
    expected = [1 + 4 * u, 2 + 4 * v, 3 + 4 * v, 4 - 4 * (1 - u) * v]
    assert np.allclose(found, np.stack(expected[:size], -1), atol=1e-4)


@pytest.mark.parametrize("role", ["color3f", "point3f", "normal3f", "vector3f", "texCoord3f"])
def test_roles(role: str) -> None:
    stage = make_stage()
    type_name = Sdf.ValueTypeNames.Find(f"{role}[]")
    add_primvar(add_quad(stage), "st", type_name, "constant", [(1, 2, 3)])
    assert np.allclose(read(stage), (1, 2, 3))


def test_interpolations_on_a_grid() -> None:
    """A grid whose smooth limit is the grid itself, so that all but uniform are the same ramp."""
    ramp = [(x / 4, y / 4) for y in range(5) for x in range(5)]
    stage = make_stage()
    grid = add_grid(stage, size=4)
    corners = list(grid.GetFaceVertexIndicesAttr().Get())
    per_corner = [ramp[i] for i in corners]
    add_primvar(grid, "varying", TYPES.Float2Array, "varying", ramp)
    add_primvar(grid, "indexed", TYPES.Float2Array, "varying", ramp[::-1], list(range(24, -1, -1)))
    add_primvar(grid, "vertex", TYPES.Float2Array, "vertex", ramp)
    add_primvar(grid, "corners", TYPES.Float2Array, "faceVarying", per_corner)
    add_primvar(grid, "welded", TYPES.Float2Array, "faceVarying", ramp, corners)
    add_primvar(grid, "faces", TYPES.FloatArray, "uniform", [float(i) for i in range(16)])
    add_primvar(grid, "one", TYPES.Float, "constant", 0.25)
    names = ["varying", "indexed", "vertex", "corners", "welded", "faces", "one"]
    picture = render(stage, aovs=["elementId", *(f"primvars:{name}" for name in names)])
    expected = np.stack([(X + 2) / 4, (Y + 2) / 4], -1)
    for name in names[:5]:
        assert np.allclose(picture[f"primvars:{name}"], expected, atol=1e-5), name
    assert (picture["primvars:faces"] == picture["elementId"]).all()
    assert (picture["primvars:one"] == 0.25).all()


def test_seams_split_values() -> None:
    stage = make_stage()
    points = [(x, y, 0) for y in (-2, 2) for x in (-2, 0, 2)]
    mesh = add_mesh(stage, "/Mesh", points, [4, 4], [0, 1, 4, 3, 1, 2, 5, 4])
    add_primvar(mesh, "st", TYPES.FloatArray, "faceVarying", [0, 1, 1, 0, 5, 6, 6, 5])
    found = read(stage)
    assert np.allclose(found[16, :16], (X[16, :16] + 2) / 2, atol=1e-4)
    assert np.allclose(found[16, 16:], X[16, 16:] / 2 + 5, atol=1e-4)


def test_meshes_without_the_primvar_show_the_clear_value() -> None:
    stage = make_stage()
    add_primvar(add_grid(stage, "/A", half=1.0), "st", TYPES.Float2Array, "constant", [(3, 4)])
    add_grid(stage, "/B", half=2.0).AddTranslateOp().Set(Gf.Vec3d(0, 0, -1))
    picture = render(stage, aovs=["primvars:st", "primId"])
    assert set(np.unique(picture["primId"])) == {0, 1}
    near = (abs(X) < 1) & (abs(Y) < 1)
    assert (picture["primvars:st"][near] == (3, 4)).all()
    assert (picture["primvars:st"][~near] == 0).all()


@pytest.mark.parametrize(("size", "shown"), [(1, [7]), (2, [7, 8]), (4, [7, 8, 9, 10])])
def test_bound_aov_has_the_formats_of_hydra(size: int, shown: list[float]) -> None:
    stage = make_stage()
    type_name = TYPES.FloatArray if size == 1 else getattr(TYPES, f"Float{size}Array")
    value = [7] if size == 1 else [(7, 8, 9, 10)[:size]]
    add_primvar(add_grid(stage), "st", type_name, "constant", value)
    view = View(stage, aovs=[])
    view.engine.SetRendererAov("primvars:st")
    view.execute()
    found = view.read(["primvars:st"])["primvars:st"]
    assert np.allclose(found[16, 16], np.squeeze(shown))


def test_asking_later_needs_no_edit() -> None:
    stage = make_stage()
    add_primvar(add_grid(stage), "st", TYPES.Float2Array, "constant", [(3, 4)])
    view = View(stage, aovs=["primId"])
    assert shows_something(view.render())
    view.set("aovs", "primvars:st")
    view.execute()
    assert (view.read(["primvars:st"])["primvars:st"] == (3, 4)).all()


def test_edits() -> None:
    stage = make_stage()
    grid = add_grid(stage)
    primvar = add_primvar(grid, "st", TYPES.Float2Array, "constant", [(3, 4)])
    view = View(stage, aovs=["primvars:st"])
    assert (view.render()["primvars:st"] == (3, 4)).all()
    primvar.Set([(5, 6)])
    assert (view.render()["primvars:st"] == (5, 6)).all()
    UsdGeom.PrimvarsAPI(grid).RemovePrimvar("st")
    assert (view.render()["primvars:st"] == 0).all()
    add_primvar(grid, "st", TYPES.Float3Array, "constant", [(7, 8, 9)])
    assert (view.render()["primvars:st"] == (7, 8, 9)).all()
    grid.GetPrim().GetAttribute("points").Set([(p[0], p[1], 1) for p in _points(grid)])
    assert (view.render()["primvars:st"] == (7, 8, 9)).all()


def _points(mesh: UsdGeom.Mesh) -> list[Gf.Vec3f]:
    return list(mesh.GetPointsAttr().Get())


def test_channels_of_the_file_are_exact(tmp_path: Path) -> None:
    stage = make_stage()
    grid = add_grid(stage)
    add_primvar(grid, "st", TYPES.Float2Array, "constant", [(0.1, 100000.5)])
    add_primvar(grid, "heat", TYPES.FloatArray, "constant", [0.3])
    view = View(stage, aovs=["color", "primvars:st", "primvars:heat"])
    view.render()
    path = tmp_path / "frame.exr"
    arguments = {"path": str(path), "aovs": "color primvars:st primvars:heat"}
    assert view.engine.InvokeRendererCommand("write", arguments)
    source = oiio.ImageInput.open(str(path))
    names = {"R", "G", "B", "A", "primvars:st.X", "primvars:st.Y", "primvars:heat.X"}
    assert set(source.spec().channelnames) == names
    at = source.spec().channelindex("primvars:st.Y")
    assert (np.asarray(source.read_image(0, 0, at, at + 1, "float")) == 100000.5).all()
    source.close()


@pytest.mark.parametrize(
    ("interpolation", "count"),
    [("constant", 3), ("uniform", 5), ("varying", 7), ("vertex", 9), ("faceVarying", 23)],
)
def test_wrong_sizes_are_said_once(interpolation: str, count: int, warnings: Any) -> None:
    stage = make_stage()
    cube = add_cube(stage)
    add_primvar(cube, "st", TYPES.FloatArray, interpolation, [1.0] * count)
    view = View(stage, aovs=["primvars:st", "primId"])
    picture = view.render()
    assert shows_something(picture)
    assert (picture["primvars:st"] == 0).all()
    said = warnings.read()
    assert said.count("</Cube>: st is") == 1 and interpolation in said
    view.render()
    assert "/Cube" not in warnings.read()


def test_types_that_are_no_numbers_are_ignored(warnings: Any) -> None:
    stage = make_stage()
    add_primvar(add_grid(stage), "st", TYPES.StringArray, "constant", ["left"])
    assert (read(stage) == 0).all()
    assert "/Grid" in warnings.read()
