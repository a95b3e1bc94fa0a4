"""A camera that turns about a point."""

import math
from dataclasses import dataclass

from pxr import Gf

#: Degrees; beyond, the picture would turn over.
_STEEPEST = 89.0
_LEAST_DISTANCE, _MOST_DISTANCE = 1e-4, 1e9


@dataclass
class OrbitCamera:
    """Looks at a target from a distance.

    Azimuth counts from the stage's front (+z with y up, -y with z up), to the right; elevation from
    the horizon up; both are in degrees, and so is the field of view from top to bottom.
    """

    target: Gf.Vec3d
    distance: float
    azimuth: float = 25.0
    elevation: float = 15.0
    field_of_view: float = 30.0
    up_is_y: bool = True

    @classmethod
    def like(cls, camera: Gf.Camera, distance: float, up_is_y: bool) -> "OrbitCamera":
        """Stands where another camera stands, and looks where it looks; its roll is lost."""
        frustum = camera.frustum
        view = frustum.ComputeViewDirection()
        away = _from_world(-view, up_is_y)
        return cls(
            target=frustum.position + distance * view,
            distance=distance,
            azimuth=math.degrees(math.atan2(away[0], away[2])),
            elevation=math.degrees(math.asin(min(max(away[1], -1.0), 1.0))),
            field_of_view=camera.GetFieldOfView(Gf.Camera.FOVVertical),
            up_is_y=up_is_y,
        )

    def orbit(self, right: float, up: float) -> None:
        """Moves the camera around its target, by degrees."""
        self.azimuth = (self.azimuth + right) % 360
        self.elevation = min(max(self.elevation + up, -_STEEPEST), _STEEPEST)

    def pan(self, right: float, up: float) -> None:
        """Moves camera and target, in heights of the picture at the target."""
        matrix = self.camera_to_world()
        height = 2 * self.distance * math.tan(math.radians(self.field_of_view / 2))
        self.target += height * (right * matrix.GetRow3(0) + up * matrix.GetRow3(1))

    def dolly(self, factor: float) -> None:
        """Changes the distance."""
        self.distance = min(max(self.distance * factor, _LEAST_DISTANCE), _MOST_DISTANCE)

    def frame(self, bounds: Gf.Range3d) -> None:
        """Steps back until a box can be seen whole."""
        if bounds.IsEmpty():
            return
        self.target = bounds.GetMidpoint()
        radius = max(bounds.GetSize().GetLength() / 2, _LEAST_DISTANCE)
        self.distance = radius / math.sin(math.radians(self.field_of_view / 2))

    def camera_to_world(self) -> Gf.Matrix4d:
        """Rows are the camera's right, up and back, and its position."""
        azimuth, elevation = math.radians(self.azimuth), math.radians(self.elevation)
        away = Gf.Vec3d(
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
            math.cos(elevation) * math.cos(azimuth),
        )
        eye = self.target + self.distance * _to_world(away, self.up_is_y)
        up = _to_world(Gf.Vec3d(0, 1, 0), self.up_is_y)
        return Gf.Matrix4d().SetLookAt(eye, self.target, up).GetInverse()

    def camera(self, aspect: float) -> Gf.Camera:
        """The camera for a picture of an aspect ratio, width over height."""
        camera = Gf.Camera()
        camera.transform = self.camera_to_world()
        camera.SetPerspectiveFromAspectRatioAndFieldOfView(
            aspect, self.field_of_view, Gf.Camera.FOVVertical
        )
        camera.clippingRange = Gf.Range1f(self.distance * 1e-3, self.distance * 1e3)
        return camera


def _to_world(v: Gf.Vec3d, up_is_y: bool) -> Gf.Vec3d:
    return v if up_is_y else Gf.Vec3d(v[0], -v[2], v[1])


def _from_world(v: Gf.Vec3d, up_is_y: bool) -> Gf.Vec3d:
    return v if up_is_y else Gf.Vec3d(v[0], v[2], -v[1])
