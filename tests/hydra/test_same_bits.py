"""The same picture, bit for bit, whatever the threads and from run to run."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import (
    ALL_AOVS,
    Picture,
    View,
    add_camera,
    add_cube,
    add_distant_light,
    add_grid,
    assert_same,
    make_stage,
    render,
)
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

EVERY_AOV = (
    *ALL_AOVS,
    *("hdcc:level", "hdcc:fan", "hdcc:cost", "hdcc:material"),
    *("primvars:displayColor", "primvars:st"),
)


def make_scene() -> Usd.Stage:
    stage = make_stage(light=False)
    add_distant_light(stage, shadows=True).AddRotateXOp().Set(-35.0)
    add_grid(stage, "/Floor", size=7, bump=0.5, holeIndices=[3, 24])
    for i in range(12):
        cube = add_cube(stage, f"/Cubes/Cube{i}", half=0.4)
        cube.AddTranslateOp().Set(Gf.Vec3d(i % 4 - 1.5, i // 4 - 1.0, 1.0 + 0.1 * i))
    return stage


@pytest.mark.parametrize("tracer", ["packet", "algorithm1", "single", "tessellated"])
def test_threads_do_not_matter(tracer: str) -> None:
    stage = make_scene()
    one = render(stage, threads=1, tracer=tracer, size=(97, 61))
    for threads in (2, 3, 0):
        assert_same(render(stage, threads=threads, tracer=tracer, size=(97, 61)), one)


def test_runs_do_not_matter() -> None:
    stage = make_scene()
    view = View(stage)
    first = view.render()
    view.set("seed", 1)
    view.execute()
    view.set("seed", 0)
    assert_same(view.render(), first)
    assert_same(render(make_scene()), first)


def test_seed_matters() -> None:
    stage = make_scene()
    assert (render(stage, seed=0)["color"] != render(stage, seed=1)["color"]).any()


def make_everything() -> Usd.Stage:
    """One prim of each kind, with tags, materials and motion, under a shutter that is open."""
    stage = make_stage(camera=False, light=False)
    add_camera(stage, **{"shutter:open": 0.0, "shutter:close": 0.5})
    add_distant_light(stage, shadows=True).AddRotateXOp().Set(-35.0)
    add_floor(stage)
    add_points_and_curves(stage)
    instancer = UsdGeom.PointInstancer.Define(stage, "/Instancer")
    add_cube(stage, "/Instancer/Cube", half=0.3)
    instancer.CreatePrototypesRel().SetTargets(["/Instancer/Cube"])
    instancer.CreatePositionsAttr([(x, -1.5, 1) for x in (-1.5, -0.5, 0.5, 1.5)])
    instancer.CreateProtoIndicesAttr([0, 0, 0, 0])
    cylinder = UsdGeom.Cylinder.Define(stage, "/Cylinder")
    cylinder.CreateRadiusAttr(0.4)
    cylinder.CreateHeightAttr(0.8)
    cylinder.AddTranslateOp().Set(Gf.Vec3d(1.3, 0.2, 1))
    slide = add_cube(stage, "/Moving", half=0.5).AddTranslateOp()
    for frame in (1, 2):
        slide.Set(Gf.Vec3d(0.6 * frame - 1.2, 0.4, 1.5), frame)
    return stage


def add_floor(stage: Usd.Stage) -> None:
    """A bumpy sheet with holes, creases, a primvar, and materials for some of its faces."""
    floor = add_grid(
        stage,
        "/Floor",
        size=7,
        bump=0.5,
        holeIndices=[3, 24],
        creaseIndices=[9, 10, 11, 12],
        creaseLengths=[4],
        creaseSharpnesses=[2.5],
        cornerIndices=[30],
        cornerSharpnesses=[10.0],
        displayColor=[(0.2, 0.5, 0.7)],
    )
    primvar = UsdGeom.PrimvarsAPI(floor).CreatePrimvar(
        "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex
    )
    primvar.Set([Gf.Vec2f(p[0], p[1]) for p in floor.GetPointsAttr().Get()])
    binding = UsdShade.MaterialBindingAPI.Apply(floor.GetPrim())
    binding.Bind(UsdShade.Material.Define(stage, "/Materials/Whole"))
    subset = binding.CreateMaterialBindSubset("Part", list(range(20, 40)))
    part = UsdShade.Material.Define(stage, "/Materials/Part")
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(part)


def add_points_and_curves(stage: Usd.Stage) -> None:
    """A row of beads, and two curves of four points."""
    beads = UsdGeom.Points.Define(stage, "/Beads")
    beads.CreatePointsAttr([(0.3 * i - 1.8, 1.6, 1) for i in range(13)])
    beads.CreateWidthsAttr([0.15 + 0.01 * i for i in range(13)])
    curves = UsdGeom.BasisCurves.Define(stage, "/Curves")
    curves.CreateCurveVertexCountsAttr([4, 4])
    curves.CreatePointsAttr(
        [(0.4 * i - 1.6, 1 + 0.3 * (-1) ** i - 0.8 * j, 1.2) for j in range(2) for i in range(4)]
    )
    curves.CreateWidthsAttr([0.1])
    curves.SetWidthsInterpolation(UsdGeom.Tokens.constant)


def shows_every_aov(picture: Picture) -> bool:
    """True if each AOV has more than one value."""
    return all(len(np.unique(picture[name])) > 1 for name in EVERY_AOV)


def picture_of_everything(stage: Usd.Stage, **settings: Any) -> Picture:
    view = View(stage, size=(193, 121), aovs=EVERY_AOV, **settings)
    view.params.frame = Usd.TimeCode(1)
    return view.render()


@pytest.mark.parametrize("tracer", ["packet", "single", "algorithm1", "tessellated"])
def test_threads_do_not_matter_to_any_aov(tracer: str) -> None:
    stage = make_everything()
    one = picture_of_everything(stage, tracer=tracer, threads=1)
    assert shows_every_aov(one)
    assert len(np.unique(one["primId"])) == 7
    for threads in (2, 8):
        assert_same(picture_of_everything(stage, tracer=tracer, threads=threads), one, EVERY_AOV)


@pytest.mark.parametrize("tracer", ["packet", "single"])
def test_threads_do_not_matter_at_fine_levels(tracer: str) -> None:
    stage = make_everything()
    settings = {"tracer": tracer, "level": 6, "pixelError": 0.05}
    one = picture_of_everything(stage, threads=1, **settings)
    for threads in (2, 8):
        assert_same(picture_of_everything(stage, threads=threads, **settings), one, EVERY_AOV)
