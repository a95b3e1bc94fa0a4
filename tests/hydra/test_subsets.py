"""GeomSubsets: which material faces have, as the AOV hdcc:material shows it."""

import numpy as np
from hydra_kit import Picture, View, add_grid, make_stage
from pxr import Usd, UsdGeom, UsdShade

AOVS = ("color", "elementId", "primId", "hdcc:material")


def add_material(stage: Usd.Stage, path: str) -> UsdShade.Material:
    return UsdShade.Material.Define(stage, path)


def bind(prim: Usd.Prim, material: UsdShade.Material) -> None:
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)


def add_subset(mesh: UsdGeom.Mesh, name: str, faces: list[int]) -> UsdGeom.Subset:
    return UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).CreateMaterialBindSubset(name, faces)


def materials(picture: Picture, view: View) -> dict[int, str]:
    """The material that each face of a picture has."""
    names = ["", *view.engine.GetRenderStats()["materials"]]
    shown = picture["primId"] >= 0
    found = {}
    for face in np.unique(picture["elementId"][shown]):
        numbers = np.unique(picture["hdcc:material"][shown & (picture["elementId"] == face)])
        assert len(numbers) == 1, (face, numbers)
        found[int(face)] = names[int(numbers[0]) + 1]
    return found


def render(view: View) -> dict[int, str]:
    return materials(view.render(), view)


def make_view(stage: Usd.Stage) -> View:
    return View(stage, size=(64, 64), aovs=AOVS)


def test_faces_have_the_material_of_their_subset() -> None:
    stage = make_stage()
    mesh = add_grid(stage, size=2)
    bind(mesh.GetPrim(), add_material(stage, "/M/Whole"))
    bind(add_subset(mesh, "one", [1]).GetPrim(), add_material(stage, "/M/One"))
    bind(add_subset(mesh, "two", [2]).GetPrim(), add_material(stage, "/M/Two"))
    expected = {0: "/M/Whole", 1: "/M/One", 2: "/M/Two", 3: "/M/Whole"}
    assert render(make_view(stage)) == expected


def test_without_materials_there_is_none() -> None:
    stage = make_stage()
    add_subset(add_grid(stage, size=2), "one", [1])
    view = make_view(stage)
    picture = view.render()
    assert (picture["hdcc:material"] == -1).all()
    assert list(view.engine.GetRenderStats()["materials"]) == []


def test_subsets_can_be_edited() -> None:
    stage = make_stage()
    mesh = add_grid(stage, size=2)
    first, second = add_material(stage, "/M/First"), add_material(stage, "/M/Second")
    view = make_view(stage)
    assert set(render(view).values()) == {""}
    bind(mesh.GetPrim(), first)
    assert set(render(view).values()) == {"/M/First"}
    subset = add_subset(mesh, "part", [0, 3])
    bind(subset.GetPrim(), second)
    assert render(view) == {0: "/M/Second", 1: "/M/First", 2: "/M/First", 3: "/M/Second"}
    subset.GetIndicesAttr().Set([1])
    assert render(view) == {0: "/M/First", 1: "/M/Second", 2: "/M/First", 3: "/M/First"}
    stage.RemovePrim(subset.GetPath())
    assert set(render(view).values()) == {"/M/First"}
    mesh.GetHoleIndicesAttr().Set([2])
    assert set(render(view)) == {0, 1, 3}


def test_bad_indices_are_warned_of(warnings) -> None:
    stage = make_stage()
    mesh = add_grid(stage, size=2)
    subset = add_subset(mesh, "part", [1])
    bind(subset.GetPrim(), add_material(stage, "/M/Part"))
    subset.GetIndicesAttr().Set([1, 99, -3])
    found = render(make_view(stage))
    assert found == {0: "", 1: "/M/Part", 2: "", 3: ""}
    assert warnings.read().count("</Grid>: its subsets have 2 indices of faces") == 1
