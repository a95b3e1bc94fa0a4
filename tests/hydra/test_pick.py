"""The command "pick": what a pixel shows."""

from typing import Any

import pytest
from hydra_kit import View, add_cube, add_grid, make_stage
from interactive_kit import converge, make_view
from pxr import Gf, Tf, UsdGeom

IDS = ("color", "primId", "instanceId", "elementId", "cameraDepth")


def pick(view: View, x: Any, y: Any) -> dict[str, Any]:
    assert view.engine.InvokeRendererCommand("pick", {"x": x, "y": y})
    return dict(view.engine.GetRenderStats()["pick"])


def test_prim_and_face() -> None:
    stage = make_stage()
    add_grid(stage, half=1.0)  # x, y in -2..2 are 32 pixels
    add_cube(stage, half=0.4).AddTranslateOp().Set(Gf.Vec3d(1.5, 1.5, 0))
    view = View(stage, aovs=IDS)
    view.execute()
    # Sixteen faces, row by row from the lower left.
    found = pick(view, 10, 21)
    assert (found["path"], found["instance"], found["element"]) == ("/Grid", 0, 0)
    assert found["depth"] == pytest.approx(5)
    assert pick(view, 21, 10)["element"] == 15
    assert pick(view, 28, 4)["path"] == "/Cube"
    assert pick(view, 2, 30) == {}


def test_instances() -> None:
    stage = make_stage()
    instancer = UsdGeom.PointInstancer.Define(stage, "/I")
    add_cube(stage, "/I/Cube", half=0.5)
    add_grid(stage, "/I/Grid", size=1, half=0.4)
    instancer.CreatePrototypesRel().SetTargets(["/I/Cube", "/I/Grid"])
    instancer.CreateProtoIndicesAttr([0, 1, 0])
    instancer.CreatePositionsAttr([(-1, 0, 0), (1, 1, 0), (1, -1, 0)])
    view = View(stage, aovs=IDS)
    view.execute()
    seen = [pick(view, x, y) for x, y in ((8, 16), (24, 8), (24, 24))]
    assert [found["instance"] for found in seen] == [0, 0, 1]
    assert seen[0]["path"] == seen[2]["path"] != seen[1]["path"]
    assert "Cube" in seen[0]["path"]
    assert "Grid" in seen[1]["path"]


def test_while_a_frame_renders() -> None:
    view = make_view(aovs=IDS)
    converge(view)
    assert pick(view, 16, 16)["path"] in ("/Cube", "/Grid")


def test_an_edit_is_seen() -> None:
    stage = make_stage()
    add_cube(stage)
    view = View(stage, aovs=IDS)
    view.execute()
    assert pick(view, 16, 16)["path"] == "/Cube"
    stage.RemovePrim("/Cube")
    view.execute()
    assert pick(view, 16, 16) == {}


@pytest.mark.parametrize(
    ("x", "y", "aovs", "named"),
    [
        (32, 0, IDS, "no pixel 32, 0 in a frame of 32 x 32"),
        (0, -1, IDS, "no pixel 0, -1"),
        ("left", 0, IDS, "x and y must be whole numbers"),
        (0, 0, ("color",), "' is not in the last frame"),
    ],
)
def test_refusals(x: Any, y: Any, aovs: tuple[str, ...], named: str) -> None:
    view = View(make_stage(), aovs=aovs)
    view.execute()
    with pytest.raises(Tf.ErrorException, match=named):
        pick(view, x, y)


def test_before_the_first_frame() -> None:
    with pytest.raises(Tf.ErrorException, match="no frame has been rendered"):
        pick(View(make_stage()), 0, 0)
