"""Expectations of limit surfaces in frames of scenes."""

import numpy as np
from pxr import UsdGeom
from scene_kit import Shot
from subdivision_kit import Cage, cage_of, limit_points

#: Of a scene's units: what a tangent plane is off between two pixels.
TOLERANCE = 2e-3
LARGE = (640, 360)


def gaps(shot: Shot, path: str, cage: Cage, steps: int) -> list[float]:
    """How far points of a cage's limit surface that face the camera are from what is seen.

    Infinite where their face is not seen.
    """
    holes = UsdGeom.Mesh(shot.stage.GetPrimAtPath(path)).GetHoleIndicesAttr().Get(shot.frame) or ()
    found = []
    for limit in limit_points(cage, steps):
        if limit.face in holes or not shot.faces_camera(path, limit.point, limit.normal):
            continue
        point = shot.world(path, limit.point)
        found.append(shot.gap(point) if shot.shows_face(limit.face, point) else np.inf)
    return found


def expect_limit(shot: Shot, path: str, cage: Cage | None = None, *, steps: int = 3) -> None:
    """Expects that a mesh shows the limit surface of its cage, face by face."""
    found = gaps(shot, path, cage or cage_of(shot.stage, path, shot.frame), steps)
    assert len(found) >= 15, path
    assert max(found) < TOLERANCE, (path, max(found))


def expect_other_limit(shot: Shot, path: str, cage: Cage, *, steps: int = 3) -> None:
    """Expects that a mesh shows another limit surface than that of a cage."""
    assert max(gaps(shot, path, cage, steps)) > 5 * TOLERANCE, path


def expect_cube(shot: Shot, path: str, half: float = 1.0) -> None:
    """Expects that a mesh shows a cube with flat sides, of which faces are seen."""
    seen = shot.of(path)
    assert np.allclose(np.abs(shot.local(path)[seen]).max(axis=-1), half, atol=1e-4)
    assert len(np.unique(shot["elementId"][seen])) == 3
