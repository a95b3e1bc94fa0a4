"""What shadow rays see may be coarser than what the camera sees, and lets no light through."""

import numpy as np
from hydra_kit import Picture, View, add_cube, add_distant_light, add_grid, make_stage
from pxr import Usd, UsdGeom

SIZE = (96, 96)
AOVS = ("color", "primId", "cameraDepth")


def stage_with_sun(slant: float = 35) -> Usd.Stage:
    stage = make_stage(light=False)
    sun = add_distant_light(stage, shadows=True)
    UsdGeom.Xformable(sun).AddRotateXYZOp().Set((-slant, slant, 0))
    return stage


def render(stage: Usd.Stage, error: float) -> Picture:
    settings = {"pixelError": 0.05, "level": 8, "samples": 1, "secondaryError": error}
    return View(stage, size=SIZE, aovs=AOVS, **settings).render()


def changed(a: Picture, b: Picture) -> np.ndarray:
    return np.any(a["color"] != b["color"], axis=-1)


def test_shadows_of_other_meshes_are_coarser_at_their_edges_only() -> None:
    stage = stage_with_sun()
    add_grid(stage, "/Floor")
    add_cube(stage, "/Cube", half=0.7).AddTranslateOp().Set((0, 0, 1.2))
    fine, coarse = render(stage, 0), render(stage, 30)
    assert (fine["cameraDepth"] == coarse["cameraDepth"]).all()
    different = changed(fine, coarse)
    assert 5 < different.sum() < 0.05 * different.size
    # Only the floor can tell: the cube shades itself as finely as it is seen.
    assert (fine["primId"][different] == fine["primId"][-1, 0]).all()


def test_a_mesh_shades_itself_as_it_is_seen() -> None:
    stage = stage_with_sun(slant=70)
    add_grid(stage, "/Waves", size=6, bump=0.8)
    fine, coarse = render(stage, 0), render(stage, 1000)
    dark = fine["color"][..., 0] == 0
    assert 0.05 < dark.mean() < 0.9
    assert not changed(fine, coarse).any()


def test_no_light_comes_into_a_closed_mesh() -> None:
    stage = stage_with_sun()
    add_grid(stage, "/Floor", half=0.8, bump=0.3)
    # The camera is inside and sees the floor and the far wall.
    add_cube(stage, "/Shell", half=9)
    UsdGeom.Camera.Get(stage, "/Camera").GetClippingRangeAttr().Set((1, 30))
    for error in (0, 1, 10, 1000):
        picture = render(stage, error)
        assert (picture["primId"] >= 0).all()
        assert (picture["color"][..., :3] == 0).all(), error
