"""Drives Hydra: renders frames of a stage with hdCC, or with another renderer as usdrecord does."""

import time
from pathlib import Path
from typing import Any, Protocol

from pxr import CameraUtil, Gf, Glf, Sdf, Tf, Usd, UsdAppUtils, UsdGeom, UsdImagingGL, UsdRender

from . import render_settings, render_stats
from .console import CommandError, error
from .products import Product
from .record_options import COMPLEXITIES, RENDERER, RENDERER_PLUGIN, RecordOptions
from .stage import Framing, View

_SCENE_AMBIENT = Gf.Vec4f(0.01, 0.01, 0.01, 1)
_COMPLEXITY_VALUES = dict(zip(COMPLEXITIES, (1.0, 1.1, 1.2, 1.3), strict=True))


class Recorder(Protocol):
    """Renders frames into files."""

    def record(self, stage: Usd.Stage, view: View, when: Usd.TimeCode, picture: Path) -> None:
        """Renders a frame and writes it; raises CommandError if that fails."""

    def fraction_done(self) -> float:
        """How much of the current frame is done. May be asked from another thread."""

    def stats(self) -> dict[str, Any]:
        """What the last frame took."""


def make_recorder(options: RecordOptions, settings: UsdRender.Settings | None) -> Recorder:
    """The recorder for the renderer that the options name."""
    plugin = _find_plugin(options.renderer)
    if plugin == RENDERER_PLUGIN:
        return EngineRecorder(options, settings)
    return FrameRecorder(options, settings, plugin)


def _find_plugin(name: str) -> str:
    plugin = UsdAppUtils.rendererArgs.GetPluginIdFromArgument(name)
    if plugin:
        return plugin
    if name == RENDERER:
        raise CommandError("the plugin hdCC was not found or could not be loaded")
    known = UsdAppUtils.rendererArgs.GetAllPluginArguments()
    raise CommandError(f"unknown renderer '{name}' (known: {' '.join(known)})", 2)


class EngineRecorder:
    """Renders with hdCC through UsdImagingGL.Engine, which gives access to AOVs and statistics."""

    def __init__(self, options: RecordOptions, settings: UsdRender.Settings | None) -> None:
        self._options = options
        self._engine = _make_engine()
        self._engine.SetRendererSetting("enableInteractive", False)
        self._engine.SetRendererSetting("domeLightCameraVisibility", options.dome_light_visible)
        if options.render_pass:
            self._engine.SetActiveRenderPassPrimPath(Sdf.Path(options.render_pass))
        if settings:
            self._engine.SetActiveRenderSettingsPrimPath(settings.GetPath())
        if options.aovs:
            self._engine.SetRendererSetting("hdcc:aovs", " ".join(options.aovs))
        render_settings.apply(self._engine, options.settings)
        self._engine.SetRendererAov("color")

    def record(self, stage: Usd.Stage, view: View, when: Usd.TimeCode, picture: Path) -> None:
        """Renders a frame and writes it; raises CommandError if that fails."""
        self._render_view(stage, view, when)
        self._write(picture, {"aovs": " ".join(["color", *self._options.aovs])})

    def record_product(
        self, stage: Usd.Stage, view: View, when: Usd.TimeCode, picture: Path, product: Product
    ) -> None:
        """Renders what a product asks for and writes it; raises CommandError if that fails."""
        aovs = dict.fromkeys(var.aov for var in product.vars)
        self._engine.SetRendererSetting("hdcc:aovs", " ".join(aovs))
        self._render_view(stage, view, when)
        view_matrix = view.camera.frustum.ComputeViewMatrix()
        projection = view.camera.frustum.ComputeProjectionMatrix()
        framing = view.framing
        self._write(
            picture,
            {
                "aovs": " ".join(var.aov for var in product.vars),
                "layers": " ".join(var.layer for var in product.vars),
                "types": " ".join(var.type for var in product.vars),
                "window": Gf.Vec4i(*framing.data_window.min, *framing.size),
                "pixelAspect": framing.pixel_aspect,
                "metadata": {
                    "camera": str(view.path),
                    "frame": 0.0 if when.IsDefault() else when.GetValue(),
                    "worldtocamera": view_matrix,
                    "worldtoscreen": view_matrix * projection,
                    **product.metadata,
                },
            },
        )

    def _render_view(self, stage: Usd.Stage, view: View, when: Usd.TimeCode) -> None:
        self._set_view(view)
        self._set_lights(view.camera)
        self._render(stage.GetPseudoRoot(), self._render_params(when))

    def fraction_done(self) -> float:
        """How much of the current frame is done. May be asked from another thread."""
        return float(self._engine.GetRenderStats().get("fractionDone", 0.0))

    def stats(self) -> dict[str, Any]:
        """What the last frame took, with the keys of --stats."""
        return render_stats.select(self._engine.GetRenderStats())

    def _set_view(self, view: View) -> None:
        if view.path.isEmpty:
            frustum = view.camera.frustum
            self._engine.SetCameraState(
                frustum.ComputeViewMatrix(), frustum.ComputeProjectionMatrix()
            )
        else:
            self._engine.SetCameraPath(view.path)
        whole = Gf.Rect2i(Gf.Vec2i(0, 0), view.width, view.height)
        framing = view.framing or Framing((view.width, view.height), whole)
        # Buffers hold the data window alone: the picture is moved so that it begins with them.
        data = framing.data_window
        corner = Gf.Vec2f(*-data.min)
        display = Gf.Range2f(corner, corner + Gf.Vec2f(*framing.size))
        moved = Gf.Rect2i(Gf.Vec2i(0, 0), data.GetWidth(), data.GetHeight())
        self._engine.SetFraming(CameraUtil.Framing(display, moved, framing.pixel_aspect))
        if view.framing:
            self._engine.SetWindowPolicy(framing.conform)
        self._engine.SetRenderBufferSize(moved.GetSize())

    def _set_lights(self, camera: Gf.Camera) -> None:
        lights = []
        if self._options.camera_light:
            light = Glf.SimpleLight()
            position = camera.frustum.position
            light.position = Gf.Vec4f(*position, 1)
            light.transform = camera.frustum.ComputeViewInverse()
            light.ambient = _SCENE_AMBIENT
            lights.append(light)
        material = Glf.SimpleMaterial()
        material.ambient = Gf.Vec4f(0.2, 0.2, 0.2, 1)
        material.specular = Gf.Vec4f(0.1, 0.1, 0.1, 1)
        material.shininess = 32
        self._engine.SetLightingState(lights, material, _SCENE_AMBIENT)

    def _render_params(self, when: Usd.TimeCode) -> UsdImagingGL.RenderParams:
        params = UsdImagingGL.RenderParams()
        params.frame = when
        params.complexity = _COMPLEXITY_VALUES[self._options.complexity]
        params.colorCorrectionMode = "disabled"
        params.clearColor = Gf.Vec4f(0)
        params.showRender = UsdGeom.Tokens.render in self._options.purposes
        params.showProxy = UsdGeom.Tokens.proxy in self._options.purposes
        params.showGuides = UsdGeom.Tokens.guide in self._options.purposes
        return params

    def _render(self, root: Usd.Prim, params: UsdImagingGL.RenderParams) -> None:
        """Renders until the picture has converged. Errors on the way are reported, once."""
        wait = 0.001
        last_failure = ""
        while True:
            failure = self._render_once(root, params)
            if self._engine.IsConverged():
                return
            if failure and failure == last_failure:
                raise CommandError(f"the frame cannot be rendered: {failure}")
            last_failure = failure
            time.sleep(wait)
            wait = min(wait * 1.5, 0.05)

    def _render_once(self, root: Usd.Prim, params: UsdImagingGL.RenderParams) -> str:
        try:
            self._engine.Render(root, params)
        except Tf.ErrorException as failure:
            messages = [" ".join(item.commentary.split()) for item in failure.args]
            for message in messages:
                error(message)
            return "; ".join(messages)
        return ""

    def _write(self, picture: Path, args: dict[str, Any]) -> None:
        args |= {"path": str(picture), "colorCorrection": self._options.color_mode}
        reason = f"{picture}: the renderer could not write it"
        try:
            if self._engine.InvokeRendererCommand("write", args):
                return
        except Tf.ErrorException as failure:
            reason = "; ".join(" ".join(item.commentary.split()) for item in failure.args)
        raise CommandError(reason)


def _make_engine() -> UsdImagingGL.Engine:
    parameters = UsdImagingGL.Engine.Parameters()
    parameters.gpuEnabled = False
    parameters.rendererPluginId = RENDERER_PLUGIN
    return UsdImagingGL.Engine(parameters)


class FrameRecorder:
    """Renders with any other renderer, through the recorder that usdrecord uses."""

    def __init__(
        self, options: RecordOptions, settings: UsdRender.Settings | None, plugin: str
    ) -> None:
        gpu_enabled = False
        self._recorder = UsdAppUtils.FrameRecorder(plugin, gpu_enabled)
        if options.render_pass:
            self._recorder.SetActiveRenderPassPrimPath(Sdf.Path(options.render_pass))
        if settings:
            self._recorder.SetActiveRenderSettingsPrimPath(settings.GetPath())
        self._recorder.SetComplexity(_COMPLEXITY_VALUES[options.complexity])
        self._recorder.SetCameraLightEnabled(options.camera_light)
        self._recorder.SetIncludedPurposes(options.purposes)
        self._recorder.SetDomeLightVisibility(options.dome_light_visible)
        if options.color_mode_given:
            self._recorder.SetColorCorrectionMode(options.color_mode)

    def record(self, stage: Usd.Stage, view: View, when: Usd.TimeCode, picture: Path) -> None:
        """Renders a frame and writes it; raises CommandError if that fails."""
        self._recorder.SetImageWidth(view.width)
        camera = UsdGeom.Camera(Usd.Prim() if view.path.isEmpty else stage.GetPrimAtPath(view.path))
        if not self._recorder.Record(stage, camera, when, str(picture)) or not picture.is_file():
            raise CommandError(f"{picture}: the renderer could not write it")

    def fraction_done(self) -> float:
        """Unknown."""
        return 0.0

    def stats(self) -> dict[str, Any]:
        """None are kept."""
        return {}
