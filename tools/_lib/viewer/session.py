"""A stage, and the engine that renders it while it is looked at."""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio
from pxr import Gf, Sdf, Tf, Usd, UsdGeom

from .. import engine as engines
from .. import render_settings
from ..console import CommandError
from ..record_options import AOVS
from ..stage import View, open_stage
from ..view_options import ViewOptions
from .orbit_camera import OrbitCamera

#: What the command pick reads.
_PICKED = ("primId", "instanceId", "elementId", "cameraDepth")


class Session:
    """Renders a stage; knows nothing of windows."""

    def __init__(self, options: ViewOptions) -> None:
        self._options = options
        self.complexity = "low"
        self.purposes = ["default", "proxy"]
        self._folder = tempfile.TemporaryDirectory(prefix="hdcc-view-")
        self.stage = open_stage(options)
        self.up_is_y = UsdGeom.GetStageUpAxis(self.stage) == UsdGeom.Tokens.y
        self.when = self._first_time()
        self.size = options.size
        self.aov = options.aov
        self.cameras = [prim.GetPath() for prim in self.stage.Traverse()
                        if prim.IsA(UsdGeom.Camera)]  # fmt: skip
        self.orbit = OrbitCamera(Gf.Vec3d(0), 1.0, up_is_y=self.up_is_y)
        self.orbit.frame(self.bounds())
        self.camera_path = self._first_camera()
        self._engine = engines.make_engine()
        render_settings.apply(self._engine, options.settings)
        self._engine.SetRendererAov("color")

    def _first_time(self) -> Usd.TimeCode:
        if self._options.frame is not None:
            return Usd.TimeCode(self._options.frame)
        return Usd.TimeCode(self.stage.GetStartTimeCode())

    def _first_camera(self) -> Sdf.Path:
        """The one that the options name, or else the scene's first; empty for the free camera."""
        wanted = self._options.camera
        if wanted is None:
            return self.cameras[0] if self.cameras else Sdf.Path.emptyPath
        if wanted not in map(str, self.cameras):
            raise CommandError(f"there is no camera at {wanted}")
        return Sdf.Path(wanted)

    # ---- What is shown ----

    @property
    def times(self) -> tuple[float, float] | None:
        """The stage's first and last time code, if it says so and they differ."""
        first, last = self.stage.GetStartTimeCode(), self.stage.GetEndTimeCode()
        return (first, last) if self.stage.HasAuthoredTimeCodeRange() and first < last else None

    def bounds(self) -> Gf.Range3d:
        """Of all that is shown, in the world."""
        included = [UsdGeom.Tokens.default_, UsdGeom.Tokens.proxy, UsdGeom.Tokens.render]
        cache = UsdGeom.BBoxCache(self.when, included, useExtentsHint=True)
        return cache.ComputeWorldBound(self.stage.GetPseudoRoot()).ComputeAlignedRange()

    def free_camera(self) -> OrbitCamera:
        """Leaves the scene's camera, and stands where that stood."""
        if not self.camera_path.isEmpty:
            camera = self._camera()
            bounds = self.bounds()
            center = Gf.Vec3d(0) if bounds.IsEmpty() else bounds.GetMidpoint()
            distance = max((center - camera.frustum.position).GetLength(), 1e-3)
            self.orbit = OrbitCamera.like(camera, distance, self.up_is_y)
            self.camera_path = Sdf.Path.emptyPath
        return self.orbit

    def _camera(self) -> Gf.Camera:
        if self.camera_path.isEmpty:
            return self.orbit.camera(self.size[0] / self.size[1])
        return UsdGeom.Camera.Get(self.stage, self.camera_path).GetCamera(self.when)

    def aovs(self) -> list[str]:
        """Names of those that can be shown."""
        return [name for name in AOVS if not name.startswith("primvars:")] + ["primvars:st"]

    def reload(self) -> None:
        """Reads the scene's files again."""
        self.stage.Reload()

    # ---- Rendering ----

    def render(self) -> bool:
        """Begins a frame, or goes on with it. Returns true once it is converged."""
        camera = self._camera()
        engines.show_view(self._engine, View(camera, self.camera_path, *self.size))
        engines.set_camera_light(self._engine, camera, self._options.camera_light)
        names = dict.fromkeys(("color", self.aov, *_PICKED))
        self._engine.SetRendererSetting("hdcc:aovs", " ".join(names))
        params = engines.render_params(self.when, self)
        self._engine.Render(self.stage.GetPseudoRoot(), params)
        return bool(self._engine.IsConverged())

    def plane(self) -> np.ndarray | None:
        """What was rendered last of the AOV that is shown; None if there is nothing yet."""
        file = Path(self._folder.name) / "frame.exr"
        try:
            self._engine.InvokeRendererCommand("write", {"path": str(file), "aovs": self.aov})
        except Tf.ErrorException:
            return None
        image = oiio.ImageInput.open(str(file))
        pixels = np.asarray(image.read_image(0, 0, 0, image.spec().nchannels, oiio.FLOAT))
        image.close()
        return pixels

    def write(self, file: str) -> str:
        """Writes the picture that was rendered last. Returns why it could not, or nothing."""
        arguments = {"path": file, "aovs": self.aov, "colorCorrection": "sRGB"}
        try:
            self._engine.InvokeRendererCommand("write", arguments)
        except Tf.ErrorException as failure:
            return _line(failure)
        return ""

    def pick(self, x: int, y: int) -> dict[str, Any]:
        """What is seen at a pixel, counted from the upper left corner; empty for nothing."""
        try:
            self._engine.InvokeRendererCommand("pick", {"x": x, "y": y})
        except Tf.ErrorException:
            return {}
        return dict(self._engine.GetRenderStats()["pick"])

    def stats(self) -> dict[str, Any]:
        """What the picture took so far."""
        return dict(self._engine.GetRenderStats())

    # ---- Settings and control ----

    def settings(self) -> list[tuple[str, str, Any]]:
        """Titles, keys and values of the render settings, but for those that the window has."""
        return [
            (setting.name, setting.key, self._engine.GetRendererSetting(setting.key))
            for setting in self._engine.GetRendererSettingsList()
            if setting.key not in ("hdcc:aovs", "hdcc:dump")
        ]

    def set(self, key: str, value: Any) -> str:
        """Changes a render setting. Returns why that is refused, or nothing."""
        try:
            self._engine.SetRendererSetting(key, value)
        except Tf.ErrorException as failure:
            return _line(failure)
        return ""

    def pause(self, is_paused: bool) -> None:
        """Holds what renders, or lets it go on."""
        if is_paused:
            self._engine.PauseRenderer()
        else:
            self._engine.ResumeRenderer()

    def stop(self, is_stopped: bool) -> None:
        """Leaves the picture as it is, or goes on with it."""
        if is_stopped:
            self._engine.StopRenderer()
        else:
            self._engine.RestartRenderer()

    def close(self) -> None:
        """Ends what renders, and takes the temporary files away."""
        self._engine.StopRenderer()
        self._folder.cleanup()


def _line(failure: Tf.ErrorException) -> str:
    return "; ".join(" ".join(item.commentary.split()) for item in failure.args)
