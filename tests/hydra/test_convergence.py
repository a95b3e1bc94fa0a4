"""Whatever is wrong, the pass converges at once and the process goes on."""

from typing import Any

import pytest
from hydra_kit import View, add_camera, add_grid, make_stage, shows_something
from pxr import Gf, Tf, Usd


def make_scene() -> Usd.Stage:
    stage = make_stage()
    add_grid(stage)
    return stage


def recovers(view: View) -> bool:
    """The same engine still makes a picture."""
    view.engine.SetCameraPath("/Camera")
    view.set_size(32, 32)
    return shows_something(view.render())


def test_empty_stage() -> None:
    view = View(Usd.Stage.CreateInMemory(), camera="")
    view.execute()


def test_no_such_camera() -> None:
    view = View(make_scene(), camera="/Nowhere")
    view.execute()
    assert recovers(view)


@pytest.mark.parametrize("size", [(0, 0), (0, 16), (16, 0)])
def test_no_pixels(size: tuple[int, int]) -> None:
    view = View(make_scene(), size=size)
    view.execute()
    assert recovers(view)


@pytest.mark.parametrize(
    "attributes",
    [
        {"horizontalAperture": 0.0},
        {"verticalAperture": 0.0},
        {"projection": "perspective", "focalLength": 0.0},
        {"clippingRange": Gf.Vec2f(5, 5)},
        {"clippingRange": Gf.Vec2f(9, 1)},
        {"clippingRange": Gf.Vec2f(float("nan"), 1)},
        {"horizontalAperture": float("nan")},
        {"horizontalAperture": float("inf")},
        {"projection": "perspective", "clippingRange": Gf.Vec2f(0, 9)},
        {"projection": "perspective", "clippingRange": Gf.Vec2f(-3, 9)},
    ],
    ids=str,
)
def test_broken_lens(attributes: dict[str, Any]) -> None:
    stage = make_scene()
    add_camera(stage, "/Broken", **attributes)
    view = View(stage, camera="/Broken")
    view.execute()
    assert recovers(view)


@pytest.mark.parametrize("scale", [0.0, float("nan"), float("inf"), 1e-200])
def test_broken_camera_transform(scale: float, warnings: Any) -> None:
    stage = make_scene()
    camera = add_camera(stage, "/Broken")
    camera.AddTransformOp().Set(Gf.Matrix4d(1).SetScale(Gf.Vec3d(1, scale, 1)))
    view = View(stage, camera="/Broken")
    view.execute()
    assert "</Broken>" in warnings.read()
    assert recovers(view)


def test_broken_camera_shows_the_background() -> None:
    view = View(make_scene())
    view.execute()
    add_camera(view.stage, "/Broken", horizontalAperture=0.0, verticalAperture=0.0)
    view.engine.SetCameraPath("/Broken")
    view.execute()
    with pytest.raises(Tf.ErrorException, match="no frame"):
        view.read()


def test_data_window_outside_the_buffer() -> None:
    view = View(make_scene())
    view.set_data_window(100, 100, 32, 32, display=(32, 32))
    view.execute()
    assert recovers(view)


def test_renderer_can_be_left_and_entered_again() -> None:
    stage = make_scene()
    for _ in range(5):
        view = View(stage)
        assert shows_something(view.render())
        del view


def test_size_changes() -> None:
    view = View(make_scene())
    for size in ((8, 8), (64, 32), (1, 1), (33, 17)):
        view.set_size(*size)
        assert view.render()["primId"].reshape(-1).size == size[0] * size[1]
