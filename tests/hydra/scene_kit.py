"""Frames of the scenes of usd_scenes/features, and what is seen where in them."""

from collections.abc import Iterable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from hydra_kit import View
from pxr import CameraUtil, Gf, Usd, UsdGeom

FEATURES = Path(__file__).resolve().parents[2] / "usd_scenes" / "features"
AOVS = ("color", "cameraDepth", "primId", "instanceId", "elementId", "normal")
CAMERA = "/World/Camera"
COLOR = "primvars:displayColor"


def open_scene(name: str) -> Usd.Stage:
    """The stage of a file of usd_scenes/features; edits are its own, as stages share files."""
    stage = Usd.Stage.Open(str(FEATURES / f"{name}.usda"))
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


class Shot:
    """One frame of a stage through a camera of its own; rows count from the top."""

    def __init__(
        self,
        scene: str | Usd.Stage,
        *,
        camera: str = CAMERA,
        frame: float | None = None,
        size: tuple[int, int] = (320, 180),
        more_aovs: Iterable[str] = (),
        **settings: Any,
    ) -> None:
        self.stage = open_scene(scene) if isinstance(scene, str) else scene
        self.size = size
        self.view = View(
            self.stage,
            camera=camera,
            size=size,
            aovs=(*AOVS, *more_aovs),
            **{"samples": 1, **settings},
        )
        self.camera = UsdGeom.Camera.Get(self.stage, camera)
        self.go_to(frame)

    def go_to(self, frame: float | None) -> None:
        """Renders another frame."""
        self.frame = Usd.TimeCode.Default() if frame is None else Usd.TimeCode(frame)
        self.view.params.frame = self.frame
        self.frustum = self.camera.GetCamera(self.frame).frustum
        self._to_picture = self.frustum.ComputeViewMatrix() * self.frustum.ComputeProjectionMatrix()
        self.picture = self.view.render()
        for name in ("hit", "positions"):
            self.__dict__.pop(name, None)

    def __getitem__(self, aov: str) -> np.ndarray:
        return self.picture[aov]

    @cached_property
    def hit(self) -> np.ndarray:
        """Where there is anything."""
        return self["primId"] >= 0

    @cached_property
    def positions(self) -> np.ndarray:
        """The point of the world that each pixel's centre shows, from its cameraDepth."""
        width, height = self.size
        x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
        flat = np.stack([2 * x - 1, 1 - 2 * y], -1)
        unproject = np.linalg.inv(np.array(self.frustum.ComputeProjectionMatrix()))
        near, far = (_transformed(_with(flat, z), unproject) for z in (-1.0, 1.0))
        share = (-self["cameraDepth"] - near[..., 2]) / (far[..., 2] - near[..., 2])
        seen = near + share[..., None] * (far - near)
        return _transformed(seen, np.linalg.inv(np.array(self.frustum.ComputeViewMatrix())))

    def pixel(self, point: Sequence[float]) -> tuple[int, int]:
        """The row and the column in which the camera sees a point of the world."""
        width, height = self.size
        x, y = self._projected(point)
        return int((1 - y) / 2 * height), int((x + 1) / 2 * width)

    def _projected(self, point: Sequence[float]) -> tuple[float, float]:
        """Where a point of the world is seen, right and up from -1 to 1."""
        x, y, _ = self._to_picture.Transform(Gf.Vec3d(*map(float, point)))
        return x, y

    def at(self, aov: str, point: Sequence[float]) -> Any:
        """What an AOV shows where a point of the world is seen."""
        return self[aov][self.pixel(point)]

    def matrix(self, path: str) -> np.ndarray:
        """From a prim's own space to the world, for rows of coordinates."""
        prim = UsdGeom.Xformable(self.stage.GetPrimAtPath(path))
        return np.array(prim.ComputeLocalToWorldTransform(self.frame))

    def world(self, path: str, points: Any) -> np.ndarray:
        """Points of a prim's own space in the world."""
        return _transformed(np.asarray(points, float), self.matrix(path))

    def local(self, path: str) -> np.ndarray:
        """The positions of all pixels in a prim's own space."""
        return _transformed(self.positions, np.linalg.inv(self.matrix(path)))

    def faces_camera(self, path: str, point: np.ndarray, normal: np.ndarray) -> bool:
        """True if a surface of a prim with this normal is seen well from in front."""
        matrix = self.matrix(path)
        outward = np.linalg.inv(matrix[:3, :3]) @ normal
        here = self.world(path, point)
        direction = np.array(self.frustum.ComputeViewDirection())
        if self.frustum.projectionType == Gf.Frustum.Perspective:
            direction = here - np.array(self.frustum.position)
        return bool(
            outward @ direction < -0.3 * np.linalg.norm(outward) * np.linalg.norm(direction)
        )

    def of(self, path: str, slack: float = 0.02) -> np.ndarray:
        """Pixels that show something inside the extent of a prim: scenes keep prims apart."""
        boundable = UsdGeom.Boundable(self.stage.GetPrimAtPath(path))
        low, high = np.array(UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, self.frame))
        place = self.local(path)
        inside = ((place >= low - slack) & (place <= high + slack)).all(axis=-1)
        return inside & self.hit

    def gap(self, point: Sequence[float]) -> float:
        """How far a point of the world is from the surface that is seen where it is.

        The least of the distances from the tangent planes of a few pixels, as edges pass between
        pixels; infinite if nothing is seen there.
        """
        near = self._near(point)
        apart = np.asarray(point, float) - self.positions[near]
        distance = np.abs((apart * self["normal"][near]).sum(axis=-1))
        close = self.hit[near] & (np.linalg.norm(apart, axis=-1) < 0.2)
        return float(distance[close].min()) if close.any() else float("inf")

    def shows_face(self, face: int, point: Sequence[float]) -> bool:
        """True if a face is seen at a point of the world, or in the pixel beside it."""
        return bool((self["elementId"][self._near(point)] == face).any())

    def _near(self, point: Sequence[float]) -> tuple[slice, slice]:
        row, column = self.pixel(point)
        return np.s_[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2]

    def close_up(self, aov: str, point: Sequence[float], scale: int = 512) -> np.ndarray:
        """The eight by eight pixels around a point of the world in a picture so much larger."""
        width, height = (scale * length for length in self.size)
        x, y = self._projected(point)
        corner = Gf.Vec2f(4 - round((x + 1) / 2 * width), 4 - round((1 - y) / 2 * height))
        window = Gf.Range2f(corner, corner + Gf.Vec2f(width, height))
        self.view.engine.SetRenderBufferSize(Gf.Vec2i(8, 8))
        self.view.engine.SetFraming(CameraUtil.Framing(window, Gf.Rect2i(Gf.Vec2i(0), 8, 8), 1.0))
        self.view.execute()
        return self.view.read([aov])[aov]


def attribute(shot: Shot, path: str, name: str) -> np.ndarray:
    """The numbers of an attribute as authored."""
    return np.array(shot.stage.GetPrimAtPath(path).GetAttribute(name).Get(), float)


def _with(flat: np.ndarray, last: float) -> np.ndarray:
    return np.concatenate([flat, np.full((*flat.shape[:-1], 1), last)], -1)


def _transformed(points: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Points by a matrix of OpenUSD's, which takes rows."""
    moved = _with(points, 1.0) @ matrix
    return moved[..., :3] / moved[..., 3:]
