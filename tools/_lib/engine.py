"""Hydra's engine with hdCC in it: what a frame shows, and how it is lit."""

from typing import Protocol

from pxr import CameraUtil, Gf, Glf, Usd, UsdGeom, UsdImagingGL

from .record_options import COMPLEXITIES, RENDERER_PLUGIN
from .stage import Framing, View

COMPLEXITY_VALUES = dict(zip(COMPLEXITIES, (1.0, 1.1, 1.2, 1.3), strict=True))
_SCENE_AMBIENT = Gf.Vec4f(0.01, 0.01, 0.01, 1)


class RenderOptions(Protocol):
    """What decides which prims are shown."""

    complexity: str
    purposes: list[str]


def make_engine() -> UsdImagingGL.Engine:
    """An engine that needs neither a GPU nor a display."""
    parameters = UsdImagingGL.Engine.Parameters()
    parameters.gpuEnabled = False
    parameters.rendererPluginId = RENDERER_PLUGIN
    return UsdImagingGL.Engine(parameters)


def show_view(engine: UsdImagingGL.Engine, view: View) -> None:
    """Points the engine's camera, and sizes its buffers."""
    if view.path.isEmpty:
        frustum = view.camera.frustum
        engine.SetCameraState(frustum.ComputeViewMatrix(), frustum.ComputeProjectionMatrix())
    else:
        engine.SetCameraPath(view.path)
    whole = Gf.Rect2i(Gf.Vec2i(0, 0), view.width, view.height)
    framing = view.framing or Framing((view.width, view.height), whole)
    # Buffers hold the data window alone: the picture is moved so that it begins with them.
    data = framing.data_window
    corner = Gf.Vec2f(*-data.min)
    display = Gf.Range2f(corner, corner + Gf.Vec2f(*framing.size))
    moved = Gf.Rect2i(Gf.Vec2i(0, 0), data.GetWidth(), data.GetHeight())
    engine.SetFraming(CameraUtil.Framing(display, moved, framing.pixel_aspect))
    if view.framing:
        engine.SetWindowPolicy(framing.conform)
    engine.SetRenderBufferSize(moved.GetSize())


def set_camera_light(engine: UsdImagingGL.Engine, camera: Gf.Camera, is_on: bool) -> None:
    """Puts a light at the camera, as usdrecord does, or takes it away."""
    lights = []
    if is_on:
        light = Glf.SimpleLight()
        light.position = Gf.Vec4f(*camera.frustum.position, 1)
        light.transform = camera.frustum.ComputeViewInverse()
        light.ambient = _SCENE_AMBIENT
        lights.append(light)
    material = Glf.SimpleMaterial()
    material.ambient = Gf.Vec4f(0.2, 0.2, 0.2, 1)
    material.specular = Gf.Vec4f(0.1, 0.1, 0.1, 1)
    material.shininess = 32
    engine.SetLightingState(lights, material, _SCENE_AMBIENT)


def render_params(when: Usd.TimeCode, options: RenderOptions) -> UsdImagingGL.RenderParams:
    """What Render is called with."""
    params = UsdImagingGL.RenderParams()
    params.frame = when
    params.complexity = COMPLEXITY_VALUES[options.complexity]
    params.colorCorrectionMode = "disabled"
    params.clearColor = Gf.Vec4f(0)
    params.showRender = UsdGeom.Tokens.render in options.purposes
    params.showProxy = UsdGeom.Tokens.proxy in options.purposes
    params.showGuides = UsdGeom.Tokens.guide in options.purposes
    return params
