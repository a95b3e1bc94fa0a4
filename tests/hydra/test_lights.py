"""UsdLux lights: how bright, from where, and what is refused."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import View, add_distant_light, add_grid, assert_same, make_stage, render
from pxr import Gf, Glf, Usd, UsdGeom, UsdLux

WHITE = [(1.0, 1.0, 1.0)]


def brightness(stage: Usd.Stage) -> np.ndarray:
    """Colour at the middle of a white square that faces the camera."""
    add_grid(stage, "/Target", displayColor=WHITE)
    return render(stage, size=(33, 33), samples=1)["color"][16, 16, :3]


def distant(**inputs: Any) -> np.ndarray:
    stage = make_stage(light=False)
    light = add_distant_light(stage)
    for name, value in inputs.items():
        light.GetPrim().GetAttribute(f"inputs:{name}").Set(value)
    return brightness(stage)


def sphere(*, distance: float = 4.0, scale: float = 1.0, **inputs: Any) -> np.ndarray:
    stage = make_stage(light=False)
    light = UsdLux.SphereLight.Define(stage, "/Light")
    light.AddTranslateOp().Set(Gf.Vec3d(0, 0, distance))
    light.AddScaleOp().Set(Gf.Vec3f(scale))
    for name, value in inputs.items():
        name = name if name == "treatAsPoint" else f"inputs:{name}"
        light.GetPrim().GetAttribute(name).Set(value)
    return brightness(stage)


@pytest.fixture(scope="module")
def unit() -> float:
    """What irradiance 1 gives."""
    return float(distant()[0])


def test_exposure_and_color_multiply(unit: float) -> None:
    assert np.allclose(distant(intensity=2.0), 2 * unit, rtol=2e-3)
    assert np.allclose(distant(exposure=-1.0), unit / 2, rtol=2e-3)
    assert np.allclose(distant(color=Gf.Vec3f(1, 0.5, 0.25)) / unit, (1, 0.5, 0.25), rtol=2e-3)
    assert np.allclose(distant(diffuse=0.5), unit / 2, rtol=2e-3)


def test_angle_makes_irradiance_of_radiance(unit: float) -> None:
    expected = np.pi * np.sin(np.radians(10)) ** 2
    assert np.allclose(distant(angle=20.0), expected * unit, rtol=2e-3)
    assert np.allclose(distant(angle=20.0, normalize=True), unit, rtol=2e-3)
    # The light that recorders put at the camera.
    assert np.allclose(distant(angle=0.53, intensity=15000.0), 1.008 * unit, rtol=2e-3)


def test_color_temperature(unit: float) -> None:
    for kelvin in (2000.0, 4000.0, 6500.0, 9000.0):
        found = distant(enableColorTemperature=True, colorTemperature=kelvin) / unit
        assert np.allclose(found, UsdLux.BlackbodyTemperatureAsRgb(kelvin), atol=0.06), kelvin
    assert np.allclose(distant(colorTemperature=2000.0), unit, rtol=2e-3)


def test_sphere_is_radiance_times_its_disk(unit: float) -> None:
    expected = unit * np.pi * 0.5**2 / 4**2
    assert np.allclose(sphere(intensity=10.0), 10 * expected, rtol=3e-3)
    assert np.allclose(sphere(intensity=10.0, radius=1.0), 40 * expected, rtol=3e-3)
    assert np.allclose(sphere(intensity=10.0, scale=2.0), 40 * expected, rtol=3e-3)
    assert np.allclose(sphere(intensity=10.0, distance=2.0), 40 * expected, rtol=3e-3)


def test_normalized_sphere_does_not_depend_on_its_size(unit: float) -> None:
    expected = 50 * unit / 4 / 4**2
    for radius in (0.1, 1.0, 3.0):
        found = sphere(intensity=50.0, radius=radius, normalize=True)
        assert np.allclose(found, expected, rtol=3e-3)
    found = sphere(intensity=50.0, radius=0.0, treatAsPoint=True)
    assert np.allclose(found, expected, rtol=3e-3)


def test_light_turns_with_its_transform() -> None:
    stage = make_stage(light=False)
    UsdGeom.Xformable(add_distant_light(stage)).AddRotateYOp().Set(60.0)
    straight = make_stage()
    assert np.allclose(brightness(stage), 0.5 * brightness(straight), rtol=3e-3)


@pytest.mark.parametrize("kind", ["DomeLight", "RectLight", "DiskLight", "CylinderLight"])
def test_unsupported_light_is_warned_about_once(kind: str, warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage)
    expected = render(stage)
    light = getattr(UsdLux, kind).Define(stage, "/World/Unsupported")
    view = View(stage)
    assert_same(view.render(), expected)
    light.GetIntensityAttr().Set(7.0)
    assert_same(view.render(), expected)
    assert warnings.read().count("</World/Unsupported>") == 1


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("intensity", float("nan")),
        ("intensity", float("inf")),
        ("intensity", -1.0),
        ("exposure", 1e6),
        ("color", Gf.Vec3f(1, -1, 0)),
        ("angle", float("nan")),
    ],
)
def test_bad_light_is_ignored(name: str, value: Any, warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage)
    expected = render(stage)
    light = add_distant_light(stage, "/World/Bad")
    light.GetPrim().GetAttribute(f"inputs:{name}").Set(value)
    if name == "angle":
        light.GetPrim().GetAttribute("inputs:normalize").Set(False)
    assert_same(render(stage), expected)
    assert "</World/Bad>" in warnings.read()


def test_camera_light_of_the_application() -> None:
    stage = make_stage(light=False)
    add_grid(stage)
    view = View(stage)
    dark = view.render()["color"][16, 16, 0]
    frustum = UsdGeom.Camera(stage.GetPrimAtPath("/Camera")).GetCamera(0).frustum
    light = Glf.SimpleLight()
    light.transform = frustum.ComputeViewInverse()
    view.engine.SetLightingState([light], Glf.SimpleMaterial(), Gf.Vec4f(0))
    lit = view.render()["color"][16, 16, 0]
    assert lit > dark
    assert np.isclose(lit, 1.008 * render(lit_stage())["color"][16, 16, 0], rtol=3e-3)


def lit_stage() -> Usd.Stage:
    stage = make_stage()
    add_grid(stage)
    return stage
