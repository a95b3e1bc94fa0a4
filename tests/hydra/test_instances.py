"""Point instancers and native instances: as if their copies stood in the scene by themselves."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import (
    ALL_AOVS,
    Picture,
    View,
    add_cube,
    add_grid,
    assert_same,
    make_stage,
    render,
    shows_something,
)
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

SIZE = (64, 64)
RED, GREEN, BLUE = Gf.Vec3f(1, 0, 0), Gf.Vec3f(0, 1, 0), Gf.Vec3f(0, 0, 1)
# Normals are written as half floats.
TOLERANCES = {"depth": 1e-5, "cameraDepth": 1e-4, "elementId": 0, "normal": 2e-3, "Neye": 2e-3}


def add_instancer(
    stage: Usd.Stage, path: str, positions: list, prototypes: list[str], indices: list[int]
) -> UsdGeom.PointInstancer:
    instancer = UsdGeom.PointInstancer.Define(stage, path)
    instancer.CreatePrototypesRel().SetTargets(prototypes)
    instancer.CreatePositionsAttr(positions)
    instancer.CreateProtoIndicesAttr(indices)
    return instancer


def two_cubes(stage: Usd.Stage) -> UsdGeom.PointInstancer:
    instancer = add_instancer(stage, "/I", [(-1, 0, 0), (1, 0, 0)], ["/I/Cube"], [0, 0])
    add_cube(stage, "/I/Cube", half=0.5)
    return instancer


def assert_alike(a: Picture, b: Picture) -> None:
    """Asserts that surfaces are the same, as far as rounding errors of transforms allow."""
    for name in TOLERANCES:
        assert a[name].shape == b[name].shape
        apart = np.abs(a[name] - b[name]) > TOLERANCES[name]
        assert apart.sum() <= 4, f"{name} differs at {np.argwhere(apart)[:5]}"


def at(picture: Picture, name: str, x: float, y: float) -> Any:
    """The value at a point of the plane z = 0, -2..2."""
    plane = picture[name]
    height, width = plane.shape[:2]
    return plane[int((2 - y) / 4 * height), int((x + 2) / 4 * width)]


def test_point_instances_are_where_they_are_put() -> None:
    stage = make_stage()
    instancer = add_instancer(
        stage, "/I", [(-1, 0.2, 0), (1, -0.5, 0.3), (0, 1.2, 0)], ["/I/Cube"], [0, 0, 0]
    )
    instancer.AddTranslateOp().Set((0.1, 0, 0))
    turn = Gf.Rotation(Gf.Vec3d(1, 2, 3), 40)
    quaternion = Gf.Quath(Gf.Quatf(turn.GetQuat()))
    instancer.CreateOrientationsAttr([Gf.Quath(1), quaternion, quaternion])
    instancer.CreateScalesAttr([(0.5, 1, 1), (1, 1, 1), (0.4, 0.3, 0.2)])
    add_cube(stage, "/I/Cube", half=0.6).AddTranslateOp().Set((0.05, 0, 0))
    picture = render(stage, size=SIZE)

    by_hand = make_stage()
    exact = Gf.Rotation(Gf.Quatd(Gf.Quatf(quaternion)).GetNormalized())
    for i, (position, rotation, scale) in enumerate(
        [
            ((-1, 0.2, 0), Gf.Rotation(Gf.Vec3d(1, 0, 0), 0), (0.5, 1, 1)),
            ((1, -0.5, 0.3), exact, (1, 1, 1)),
            ((0, 1.2, 0), exact, (0.4, 0.3, 0.2)),
        ]
    ):
        matrix = Gf.Matrix4d().SetTranslate(Gf.Vec3d(0.05, 0, 0))
        matrix *= Gf.Matrix4d().SetScale(Gf.Vec3d(*scale))
        matrix *= Gf.Matrix4d().SetRotate(rotation)
        matrix *= Gf.Matrix4d().SetTranslate(Gf.Vec3d(*position) + Gf.Vec3d(0.1, 0, 0))
        add_cube(by_hand, f"/Cube{i}", half=0.6).AddTransformOp().Set(matrix)
    assert_alike(picture, render(by_hand, size=SIZE))
    assert [at(picture, "instanceId", *xy) for xy in ((-1, 0.2), (1, -0.5), (0.1, 1.2))] == [
        0,
        1,
        2,
    ]
    assert at(picture, "instanceId", 1.9, 1.9) == -1


def test_each_prototype_counts_its_own_instances() -> None:
    stage = make_stage()
    add_instancer(
        stage,
        "/I",
        [(-1.2, 0, 0), (-0.4, 0, 0), (0.4, 0, 0), (1.2, 0, 0)],
        ["/I/A", "/I/B"],
        [0, 1, 1, 0],
    )
    add_cube(stage, "/I/A", half=0.3)
    add_cube(stage, "/I/B", half=0.3)
    picture = render(stage, size=SIZE)
    xs = (-1.2, -0.4, 0.4, 1.2)
    assert [at(picture, "instanceId", x, 0) for x in xs] == [0, 0, 1, 1]
    prims = [at(picture, "primId", x, 0) for x in xs]
    assert prims[0] == prims[3] != prims[1] == prims[2]


def test_nested_instancers_count_the_inner_one_fastest() -> None:
    stage = make_stage()
    add_instancer(stage, "/I", [(0, -1, 0), (0, 1, 0)], ["/I/Row"], [0, 0])
    row = add_instancer(
        stage, "/I/Row", [(-1, 0, 0), (0, 0, 0), (1, 0, 0)], ["/I/Row/Cube"], [0, 0, 0]
    )
    row.AddScaleOp().Set((1, 0.5, 1))
    add_cube(stage, "/I/Row/Cube", half=0.3)
    picture = render(stage, size=SIZE)
    ids = [at(picture, "instanceId", x, y) for y in (-1, 1) for x in (-1, 0, 1)]
    assert ids == [0, 1, 2, 3, 4, 5]
    # The row is half as high as it is wide: scaled by the inner instancer's own transform.
    column = picture["primId"][:, int((0 + 2) / 4 * 64)] >= 0
    line = picture["primId"][int((2 - 1) / 4 * 64)] >= 0
    assert column.sum() / 2 < 0.7 * line.sum() / 3


def test_native_instances_are_kept() -> None:
    stage = make_stage()
    source = stage.CreateClassPrim("/_Source")
    add_cube(stage, "/_Source/Cube", half=0.4)
    for i, x in enumerate((-1.0, 0.0, 1.0)):
        prim = stage.DefinePrim(f"/Copy{i}", "Xform")
        prim.GetReferences().AddInternalReference(source.GetPath())
        prim.SetInstanceable(True)
        UsdGeom.Xformable(prim).AddTranslateOp().Set((x, 0, 0))
    view = View(stage, size=SIZE)
    picture = view.render()
    assert [at(picture, "instanceId", x, 0) for x in (-1, 0, 1)] == [0, 1, 2]
    assert len({at(picture, "primId", x, 0) for x in (-1, 0, 1)}) == 1
    assert view.engine.GetRenderStats()["instances"] == 3
    assert view.engine.GetRenderStats()["faces"] == 6


def test_native_instances_in_point_instances() -> None:
    stage = make_stage()
    source = stage.CreateClassPrim("/_Source")
    add_cube(stage, "/_Source/Cube", half=0.3)
    add_instancer(stage, "/I", [(0, -1, 0), (0, 1, 0)], ["/I/Pair"], [0, 0])
    UsdGeom.Xform.Define(stage, "/I/Pair")
    for name, x in (("A", -1.0), ("B", 1.0)):
        prim = stage.DefinePrim(f"/I/Pair/{name}", "Xform")
        prim.GetReferences().AddInternalReference(source.GetPath())
        prim.SetInstanceable(True)
        UsdGeom.Xformable(prim).AddTranslateOp().Set((x, 0, 0))
    picture = render(stage, size=SIZE)
    # What is one prim and what an instance is OpenUSD's choice.
    ids = [
        [at(picture, name, x, y) for y in (-1, 1) for x in (-1, 1)]
        for name in ("primId", "instanceId")
    ]
    assert len(set(zip(*ids, strict=True))) == 4 and min(ids[0]) >= 0
    assert at(picture, "primId", 0, 0) == -1


def test_color_of_each_instance() -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    colors = UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.varying
    )
    colors.Set([RED, BLUE])
    picture = render(stage, size=SIZE, aovs=("color", "primvars:displayColor"))
    assert at(picture, "primvars:displayColor", -1, 0).tolist() == [1, 0, 0]
    assert at(picture, "primvars:displayColor", 1, 0).tolist() == [0, 0, 1]
    left = at(picture, "color", -1, 0)
    assert left[0] > 0.1 and left[1] == left[2] == 0


def test_what_a_mesh_has_itself_comes_first() -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    UsdGeom.Mesh.Get(stage, "/I/Cube").CreateDisplayColorAttr([GREEN])
    UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.varying
    ).Set([RED, BLUE])
    picture = render(stage, size=SIZE, aovs=("primvars:displayColor",))
    assert at(picture, "primvars:displayColor", -1, 0).tolist() == [0, 1, 0]


def test_primvars_of_nested_instancers() -> None:
    stage = make_stage()
    outer = add_instancer(stage, "/I", [(0, -1, 0), (0, 1, 0)], ["/I/Row"], [0, 0])
    row = add_instancer(stage, "/I/Row", [(-1, 0, 0), (1, 0, 0)], ["/I/Row/Cube"], [0, 0])
    add_cube(stage, "/I/Row/Cube", half=0.3)
    for instancer, name, values in ((outer, "outer", [1.0, 2.0]), (row, "inner", [3.0, 4.0])):
        UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
            name, Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.varying
        ).Set(values)
    aovs = ("primvars:outer", "primvars:inner")
    picture = render(stage, size=SIZE, aovs=aovs)
    shown = [[at(picture, name, x, y) for y in (-1, 1) for x in (-1, 1)] for name in aovs]
    assert shown == [[1, 1, 2, 2], [3, 4, 3, 4]]


def test_indexed_primvars_of_instances() -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    primvar = UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
        "heat", Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.varying
    )
    primvar.Set([5.0, 7.0])
    primvar.SetIndices(Vt.IntArray([1, 0]))
    picture = render(stage, size=SIZE, aovs=("primvars:heat",))
    assert [at(picture, "primvars:heat", x, 0) for x in (-1, 1)] == [7, 5]


def test_edits() -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    view = View(stage, size=SIZE)
    view.render()

    def assert_is_fresh() -> Picture:
        picture, fresh = view.render(), render(stage, size=SIZE)
        assert_same(picture, fresh, (name for name in ALL_AOVS if name != "primId"))
        assert ((picture["primId"] < 0) == (fresh["primId"] < 0)).all()
        return picture

    instancer.GetPositionsAttr().Set([(-1, 0, 0), (0, 1, 0)])
    assert at(assert_is_fresh(), "instanceId", 0, 1) == 1
    instancer.GetPositionsAttr().Set([(-1, 0, 0), (0, 1, 0), (0, -1, 0)])
    instancer.GetProtoIndicesAttr().Set([0, 0, 0])
    assert at(assert_is_fresh(), "instanceId", 0, -1) == 2
    instancer.CreateInvisibleIdsAttr([1])
    assert at(assert_is_fresh(), "primId", 0, 1) == -1
    instancer.AddTranslateOp().Set((0.5, 0, 0))
    assert_is_fresh()
    UsdGeom.Imageable(instancer).MakeInvisible()
    assert not shows_something(assert_is_fresh())
    UsdGeom.Imageable(instancer).MakeVisible()
    assert shows_something(assert_is_fresh())
    UsdGeom.Mesh.Get(stage, "/I/Cube").AddScaleOp().Set((0.5, 1, 1))
    assert_is_fresh()
    stage.RemovePrim("/I")
    assert not shows_something(assert_is_fresh())
    two_cubes(stage)
    assert shows_something(assert_is_fresh())


def test_moving_instances_leaves_the_surface_alone() -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    view = View(stage, size=SIZE)
    view.render()
    before = view.engine.GetRenderStats()
    instancer.GetPositionsAttr().Set([(-1, 0, 0), (0, 1, 0)])
    view.render()
    after = view.engine.GetRenderStats()
    assert after["bytes"]["structures"] == before["bytes"]["structures"]


@pytest.mark.parametrize("instanceable", [True, False])
def test_a_native_instance_may_stop_being_one(instanceable: bool) -> None:
    stage = make_stage()
    source = stage.CreateClassPrim("/_Source")
    add_cube(stage, "/_Source/Cube", half=0.4)
    for i, x in enumerate((-1.0, 1.0)):
        prim = stage.DefinePrim(f"/Copy{i}", "Xform")
        prim.GetReferences().AddInternalReference(source.GetPath())
        prim.SetInstanceable(not instanceable)
        UsdGeom.Xformable(prim).AddTranslateOp().Set((x, 0, 0))
    view = View(stage, size=SIZE)
    view.render()
    stage.GetPrimAtPath("/Copy0").SetInstanceable(instanceable)
    picture = view.render()
    assert_alike(picture, render(stage, size=SIZE))
    assert at(picture, "primId", -1, 0) >= 0 and at(picture, "primId", 1, 0) >= 0


@pytest.mark.parametrize(
    ("attribute", "value", "says"),
    [
        ("scales", [(0, 0, 0), (1, 1, 1)], "1 of 2 instances have a singular"),
        ("positions", [(-1, 0, 0), (float("nan"), 0, 0)], "1 of 2 instances have a singular"),
    ],
)
def test_instances_without_a_place(attribute: str, value: list, says: str, warnings: Any) -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    instancer.GetPrim().GetAttribute(attribute).Set(value)
    picture = render(stage, size=SIZE)
    told = warnings.read()
    assert says in told and "/I" in told
    shown = [at(picture, "primId", x, 0) >= 0 for x in (-1, 1)]
    assert sorted(shown) == [False, True]


def test_too_few_values_of_instances(warnings: Any) -> None:
    stage = make_stage()
    instancer = two_cubes(stage)
    UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.varying
    ).Set([RED])
    picture = render(stage, size=SIZE)
    assert "displayColor" in warnings.read()
    color = at(picture, "color", -1, 0)
    assert color[0] == color[1] == color[2] > 0


def test_prototypes_without_instances(warnings: Any) -> None:
    stage = make_stage()
    instancer = add_instancer(stage, "/I", [], ["/I/Cube"], [])
    add_cube(stage, "/I/Cube")
    UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.varying
    ).Set([])
    assert not shows_something(render(stage))
    assert "primvars" not in warnings.read()  # OpenUSD itself says that there are no indices


def test_same_bits_for_any_threads() -> None:
    stage = make_stage()
    add_grid(stage, "/Floor")
    random = np.random.default_rng(1)
    places = [tuple(map(float, p)) for p in random.uniform(-2, 2, (200, 3))]
    instancer = add_instancer(stage, "/I", places, ["/I/Cube"], [0] * 200)
    add_cube(stage, "/I/Cube", half=0.2)
    UsdGeom.PrimvarsAPI(instancer).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.varying
    ).Set([Gf.Vec3f(*map(float, c)) for c in random.uniform(0, 1, (200, 3))])
    pictures = [render(stage, size=SIZE, threads=threads) for threads in (1, 2, 8)]
    assert_same(pictures[0], pictures[1])
    assert_same(pictures[0], pictures[2])
    assert len(np.unique(pictures[0]["instanceId"])) > 100


def test_an_invisible_instancer_shows_nothing() -> None:
    stage = make_stage()
    instancer = UsdGeom.PointInstancer.Define(stage, "/Instancer")
    add_cube(stage, "/Instancer/Cube", half=0.4)
    instancer.CreatePrototypesRel().SetTargets(["/Instancer/Cube"])
    instancer.CreateProtoIndicesAttr([0])
    instancer.CreatePositionsAttr([(0, 0, 0)])
    view = View(stage)
    assert shows_something(view.render())
    UsdGeom.Imageable(instancer).MakeInvisible()
    assert not shows_something(view.render())
    assert not shows_something(render(stage))
    UsdGeom.Imageable(instancer).MakeVisible()
    assert shows_something(view.render())
