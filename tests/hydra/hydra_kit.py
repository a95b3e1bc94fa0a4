"""Small stages, and pictures of them as arrays."""

import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio
from pxr import CameraUtil, Gf, Sdf, Usd, UsdGeom, UsdImagingGL, UsdLux

PLUGIN = "HdCCRendererPlugin"
ALL_AOVS = ("color", "depth", "cameraDepth", "primId", "instanceId", "elementId", "normal", "Neye")
CENTER_AOVS = tuple(name for name in ALL_AOVS if name != "color")

Picture = dict[str, np.ndarray]
Point = tuple[float, float, float]


def make_stage(*, camera: bool = True, light: bool = True) -> Usd.Stage:
    """A stage with an orthographic camera that sees x, y in -2..2 from z = 5, and a head light."""
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    if camera:
        add_camera(stage)
    if light:
        add_distant_light(stage)
    return stage


def add_camera(stage: Usd.Stage, path: str = "/Camera", **attributes: Any) -> UsdGeom.Camera:
    camera = UsdGeom.Camera.Define(stage, path)
    values: dict[str, Any] = {
        "projection": "orthographic",
        "horizontalAperture": 40.0,
        "verticalAperture": 40.0,
        "clippingRange": Gf.Vec2f(1, 9),
    }
    for name, value in {**values, **attributes}.items():
        camera.GetPrim().GetAttribute(name).Set(value)
    camera.AddTranslateOp().Set(Gf.Vec3d(0, 0, 5))
    return camera


def add_distant_light(
    stage: Usd.Stage, path: str = "/Light", *, intensity: float = 1.0, shadows: bool = False
) -> UsdLux.DistantLight:
    light = UsdLux.DistantLight.Define(stage, path)
    light.CreateIntensityAttr(intensity)
    light.CreateAngleAttr(0.0)
    UsdLux.ShadowAPI.Apply(light.GetPrim()).CreateShadowEnableAttr(shadows)
    return light


def add_mesh(
    stage: Usd.Stage,
    path: str,
    points: Sequence[Point],
    counts: Sequence[int],
    indices: Sequence[int],
    **attributes: Any,
) -> UsdGeom.Mesh:
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr(counts)
    mesh.CreateFaceVertexIndicesAttr(indices)
    if "displayColor" in attributes:
        mesh.CreateDisplayColorAttr()
    for name, value in attributes.items():
        name = "primvars:displayColor" if name == "displayColor" else name
        mesh.GetPrim().GetAttribute(name).Set(value)
    return mesh


def grid_points(size: int, *, half: float = 2.0, bump: float = 0.0) -> list[Point]:
    """Points of a square grid in the xy plane, row by row from the lower left."""
    steps = [half * (2 * i / size - 1) for i in range(size + 1)]
    return [(x, y, bump * float(np.sin(2.1 * x) * np.cos(1.7 * y))) for y in steps for x in steps]


def grid_faces(size: int) -> tuple[list[int], list[int]]:
    """Counts and indices of a grid of quads that face +z, row by row from the lower left."""
    indices = []
    for y in range(size):
        for x in range(size):
            corner = y * (size + 1) + x
            indices += [corner, corner + 1, corner + size + 2, corner + size + 1]
    return [4] * (size * size), indices


def add_grid(
    stage: Usd.Stage,
    path: str = "/Grid",
    *,
    size: int = 4,
    half: float = 2.0,
    bump: float = 0.0,
    **attributes: Any,
) -> UsdGeom.Mesh:
    counts, indices = grid_faces(size)
    points = grid_points(size, half=half, bump=bump)
    return add_mesh(stage, path, points, counts, indices, **attributes)


def add_cube(stage: Usd.Stage, path: str = "/Cube", *, half: float = 1.0) -> UsdGeom.Mesh:
    points = [(x, y, z) for z in (-half, half) for y in (-half, half) for x in (-half, half)]
    indices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5]
    return add_mesh(stage, path, points, [4] * 6, indices)


class View:
    """An engine that renders one stage, again and again."""

    def __init__(
        self,
        stage: Usd.Stage,
        *,
        camera: str = "/Camera",
        size: tuple[int, int] = (32, 32),
        aovs: Iterable[str] = ALL_AOVS,
        interactive: bool = False,
        **settings: Any,
    ) -> None:
        self.stage = stage
        parameters = UsdImagingGL.Engine.Parameters()
        parameters.gpuEnabled = False
        parameters.rendererPluginId = PLUGIN
        self.engine = UsdImagingGL.Engine(parameters)
        self.engine.SetRendererSetting("enableInteractive", interactive)
        self.aovs = tuple(aovs)
        self.set("aovs", " ".join(self.aovs))
        self.set("samples", 4)
        for name, value in settings.items():
            self.set(name, value)
        self.engine.SetRendererAov("color")
        if camera:
            self.engine.SetCameraPath(Sdf.Path(camera))
        self.set_size(*size)
        self.params = UsdImagingGL.RenderParams()
        self.params.frame = Usd.TimeCode.Default()

    def set(self, name: str, value: Any) -> None:
        """Sets a render setting, without its hdcc: before it."""
        self.engine.SetRendererSetting(f"hdcc:{name}", value)

    def set_size(self, width: int, height: int) -> None:
        self.engine.SetRenderBufferSize(Gf.Vec2i(width, height))
        self.set_data_window(0, 0, width, height, display=(width, height))

    def set_data_window(
        self, x: int, y: int, width: int, height: int, *, display: tuple[int, int]
    ) -> None:
        """Pixels from the upper left corner of a picture of the size `display`."""
        window = Gf.Range2f(Gf.Vec2f(0, 0), Gf.Vec2f(*display))
        data = Gf.Rect2i(Gf.Vec2i(x, y), width, height)
        self.engine.SetFraming(CameraUtil.Framing(window, data, 1.0))

    def execute(self) -> None:
        """Renders until the pass is converged, which must be after the first time."""
        self.engine.Render(self.stage.GetPseudoRoot(), self.params)
        assert self.engine.IsConverged()

    def read(self, aovs: Iterable[str] | None = None) -> Picture:
        """The last frame."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "frame.exr"
            names = " ".join(aovs or self.aovs)
            assert self.engine.InvokeRendererCommand("write", {"path": str(path), "aovs": names})
            return read_exr(path)

    def render(self) -> Picture:
        self.execute()
        return self.read()


def render(stage: Usd.Stage, **options: Any) -> Picture:
    """A picture of a stage, made by an engine of its own."""
    return View(stage, **options).render()


def read_exr(path: Path) -> Picture:
    """Planes by the names of AOVs: rows from the top, ids as integers."""
    source = oiio.ImageInput.open(str(path))
    assert source, oiio.geterror()
    spec = source.spec()
    planes: dict[str, list[np.ndarray]] = {}
    for channel, name in enumerate(spec.channelnames):
        layer = "color" if name in "RGBA" else name.split(".")[0]
        values = np.asarray(source.read_image(0, 0, channel, channel + 1, "float"))[:, :, 0]
        planes.setdefault(layer, []).append(values.astype(int) if layer.endswith("Id") else values)
    source.close()
    return {name: np.squeeze(np.stack(parts, -1)) for name, parts in planes.items()}


def assert_same(a: Picture, b: Picture, aovs: Iterable[str] = ALL_AOVS) -> None:
    """Asserts that two pictures are equal bit for bit."""
    for name in aovs:
        different = np.argwhere(a[name] != b[name])
        assert not len(different), f"{name} differs at {len(different)} places: {different[:3]}"


def shows_something(picture: Picture) -> bool:
    return bool((picture["primId"] >= 0).any())
