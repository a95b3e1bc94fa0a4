"""After an edit the picture is the one that a fresh load of the edited stage gives."""

from collections.abc import Callable

import pytest
from hydra_kit import (
    ALL_AOVS,
    View,
    add_cube,
    add_distant_light,
    add_grid,
    assert_same,
    grid_faces,
    grid_points,
    make_stage,
    render,
)
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux

Edit = Callable[[Usd.Stage], None]


def make_scene() -> Usd.Stage:
    stage = make_stage()
    UsdGeom.Xform.Define(stage, "/World")
    add_grid(stage, "/World/Grid", bump=0.4).AddTranslateOp().Set(Gf.Vec3d(0, 0, -1))
    add_cube(stage, "/World/Cube")
    return stage


def grid(stage: Usd.Stage) -> UsdGeom.Mesh:
    return UsdGeom.Mesh(stage.GetPrimAtPath("/World/Grid"))


def move_points(stage: Usd.Stage) -> None:
    grid(stage).GetPointsAttr().Set(grid_points(4, half=1.5, bump=0.9))


def move_prim(stage: Usd.Stage) -> None:
    stage.GetPrimAtPath("/World/Grid").GetAttribute("xformOp:translate").Set(Gf.Vec3d(1, 0, -2))


def turn_parent(stage: Usd.Stage) -> None:
    UsdGeom.Xformable(stage.GetPrimAtPath("/World")).AddRotateZOp().Set(20.0)


def hide(stage: Usd.Stage) -> None:
    grid(stage).MakeInvisible()


def change_topology(stage: Usd.Stage) -> None:
    counts, indices = grid_faces(6)
    grid(stage).GetPointsAttr().Set(grid_points(6, bump=0.4))
    grid(stage).GetFaceVertexCountsAttr().Set(counts)
    grid(stage).GetFaceVertexIndicesAttr().Set(indices)


def add_tags(stage: Usd.Stage) -> None:
    grid(stage).CreateHoleIndicesAttr([5, 6])
    grid(stage).CreateCornerIndicesAttr([12])
    grid(stage).CreateCornerSharpnessesAttr([10.0])


def change_scheme(stage: Usd.Stage) -> None:
    grid(stage).CreateSubdivisionSchemeAttr("bilinear")


def change_color(stage: Usd.Stage) -> None:
    grid(stage).CreateDisplayColorAttr([(1, 0, 0)])


def turn_over(stage: Usd.Stage) -> None:
    grid(stage).CreateOrientationAttr("leftHanded")


def change_light(stage: Usd.Stage) -> None:
    UsdLux.DistantLight(stage.GetPrimAtPath("/Light")).GetIntensityAttr().Set(3.0)


def turn_light(stage: Usd.Stage) -> None:
    UsdGeom.Xformable(stage.GetPrimAtPath("/Light")).AddRotateYOp().Set(40.0)


def add_light(stage: Usd.Stage) -> None:
    light = add_distant_light(stage, "/Second", intensity=0.5)
    UsdGeom.Xformable(light).AddRotateXOp().Set(-30.0)


def hide_light(stage: Usd.Stage) -> None:
    UsdGeom.Imageable(stage.GetPrimAtPath("/Light")).MakeInvisible()


def move_camera(stage: Usd.Stage) -> None:
    stage.GetPrimAtPath("/Camera").GetAttribute("xformOp:translate").Set(Gf.Vec3d(0.5, 0.25, 5))


def change_lens(stage: Usd.Stage) -> None:
    stage.GetPrimAtPath("/Camera").GetAttribute("projection").Set("perspective")


def add_prim(stage: Usd.Stage) -> None:
    add_cube(stage, "/World/Zoo", half=0.5).AddTranslateOp().Set(Gf.Vec3d(1, 1, 2))


EDITS = [
    move_points,
    move_prim,
    turn_parent,
    hide,
    change_topology,
    add_tags,
    change_scheme,
    change_color,
    turn_over,
    change_light,
    turn_light,
    add_light,
    hide_light,
    move_camera,
    change_lens,
    add_prim,
]


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: edit.__name__)
def test_edit_equals_a_fresh_load(edit: Edit) -> None:
    stage = make_scene()
    view = View(stage)
    before = view.render()
    edit(stage)
    after = view.render()
    assert any((before[name] != after[name]).any() for name in ALL_AOVS if name in before) or (
        edit is turn_over
    )
    assert_same(after, render(stage))


@pytest.mark.parametrize("edit", [move_points, move_prim, hide, change_topology, add_tags])
def test_edit_can_be_taken_back(edit: Edit) -> None:
    stage = make_scene()
    view = View(stage)
    before = view.render()
    undo = Sdf.Layer.CreateAnonymous()
    undo.TransferContent(stage.GetRootLayer())
    edit(stage)
    view.execute()
    stage.GetRootLayer().TransferContent(undo)
    after = view.render()
    # Prims that come back get new ids.
    assert_same(after, before, [name for name in ALL_AOVS if name != "primId"])


def test_removal_and_return() -> None:
    stage = make_scene()
    view = View(stage)
    view.execute()
    stage.RemovePrim("/World/Grid")
    without = [name for name in ALL_AOVS if name != "primId"]
    assert_same(view.render(), render(stage), without)
    add_grid(stage, "/World/Grid", bump=0.7)
    assert_same(view.render(), render(stage), without)
    stage.RemovePrim("/World")
    assert (view.render()["primId"] == -1).all()


def test_many_edits_in_turn() -> None:
    stage = make_scene()
    view = View(stage)
    for edit in (move_points, move_prim, change_color, change_topology, add_tags, move_camera):
        edit(stage)
        assert_same(view.render(), render(stage))


def test_tessellations_see_edits() -> None:
    stage = make_scene()
    view = View(stage, tracer="tessellated")
    view.execute()
    for edit in (move_points, move_prim, change_topology, add_tags, add_prim, move_camera):
        edit(stage)
        assert_same(view.render(), render(stage, tracer="tessellated"))


def test_the_tracer_may_change_between_frames() -> None:
    stage = make_scene()
    view = View(stage)
    frames = [("tessellated", 4), ("algorithm1", 4), ("tessellated", 3), ("tessellated", 5)]
    for tracer, level in [*frames, ("single", 2), ("packet", 4)]:
        view.set("tracer", tracer)
        view.set("level", level)
        assert_same(view.render(), render(stage, tracer=tracer, level=level))


def test_time_samples() -> None:
    stage = make_stage()
    points = add_grid(stage, bump=0.2).GetPointsAttr()
    points.Set(grid_points(4, bump=0.2), 1)
    points.Set(grid_points(4, bump=1.2), 2)
    view = View(stage)
    view.params.frame = Usd.TimeCode(1)
    first = view.render()
    view.params.frame = Usd.TimeCode(2)
    second = view.render()
    assert (first["normal"] != second["normal"]).any()
    view.params.frame = Usd.TimeCode(1)
    assert_same(view.render(), first)


def test_settings_are_edits_too() -> None:
    stage = make_scene()
    view = View(stage, level=1)
    coarse = view.render()
    view.set("level", 5)
    fine = view.render()
    assert (coarse["cameraDepth"] != fine["cameraDepth"]).any()
    assert_same(fine, render(stage, level=5))


def test_nothing_changed_renders_nothing() -> None:
    view = View(make_scene())
    view.execute()
    before = view.engine.GetRenderStats()["seconds"]
    view.execute()
    assert view.engine.GetRenderStats()["seconds"] == before
