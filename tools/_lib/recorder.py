"""Drives Hydra: renders frames of a stage with hdCC, or with another renderer as usdrecord does."""

import time
from pathlib import Path
from typing import Any, Protocol

from pxr import Gf, Sdf, Tf, Usd, UsdAppUtils, UsdGeom, UsdImagingGL, UsdRender

from . import engine, render_settings, render_stats
from .console import CommandError, error
from .products import Product
from .record_options import RENDERER, RENDERER_PLUGIN, RecordOptions
from .stage import View


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
        self._engine = engine.make_engine()
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
        engine.show_view(self._engine, view)
        engine.set_camera_light(self._engine, view.camera, self._options.camera_light)
        self._render(stage.GetPseudoRoot(), engine.render_params(when, self._options))

    def fraction_done(self) -> float:
        """How much of the current frame is done. May be asked from another thread."""
        return float(self._engine.GetRenderStats().get("fractionDone", 0.0))

    def stats(self) -> dict[str, Any]:
        """What the last frame took, with the keys of --stats."""
        return render_stats.select(self._engine.GetRenderStats())

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
        self._recorder.SetComplexity(engine.COMPLEXITY_VALUES[options.complexity])
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
