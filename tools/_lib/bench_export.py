"""Exports the cages and a camera of a USD scene for cc_bench, which knows no USD.

Run as a module, under a Python that has pxr: python -m _lib.bench_export SCENE OUT
"""

import struct
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import ArrayLike
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdUtils

MAGIC = b"ccbench2"
#: cc::Scheme, cc::BoundaryRule and cc::TriangleRule; schemes that core does not know are bilinear
SCHEMES = {"catmullClark": 0, "bilinear": 1, "none": 2, "loop": 3}
BOUNDARY_RULES = {"none": 0, "edgeOnly": 1, "edgeAndCorner": 2}
TRIANGLE_RULES = {"catmullClark": 0, "smooth": 1}
PURPOSES = ("default", "proxy")


def export(scene: str, out: str) -> None:
    """Writes the scene at its start time."""
    stage = Usd.Stage.Open(scene)
    when = Usd.TimeCode(stage.GetStartTimeCode())
    meshes = list(_placed_meshes(stage, when))
    with Path(out).open("wb") as file:
        file.write(MAGIC)
        camera = _camera(stage, when)
        _write_camera(file, camera)
        for light in _lights(stage, when, camera):
            file.write(struct.pack("<3f", *light))
        file.write(struct.pack("<I", len(meshes)))
        for mesh, matrix in meshes:
            _write_mesh(file, mesh, matrix, when)


def _camera(stage: Usd.Stage, when: Usd.TimeCode) -> Gf.Camera:
    primary = UsdUtils.GetPrimaryCameraName()
    cameras = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Camera)]
    cameras.sort(key=lambda prim: prim.GetName() != primary)
    if not cameras:
        raise SystemExit(f"error: {stage.GetRootLayer().identifier} has no camera")
    return UsdGeom.Camera(cameras[0]).GetCamera(when)


def _lights(stage: Usd.Stage, when: Usd.TimeCode, camera: Gf.Camera) -> list[Gf.Vec3d]:
    """Where two point lights are: the stage's first lights, else beside and above the camera."""
    cache = UsdGeom.XformCache(when)
    box = UsdGeom.BBoxCache(when, [UsdGeom.Tokens.default_], useExtentsHint=True)
    bounds = box.ComputeWorldBound(stage.GetPseudoRoot()).ComputeAlignedRange()
    places = []
    for prim in stage.Traverse():
        matrix = cache.GetLocalToWorldTransform(prim)
        if prim.IsA(UsdLux.DistantLight):
            towards = matrix.TransformDir(Gf.Vec3d(0, 0, -1)).GetNormalized()
            places.append(bounds.GetMidpoint() - towards * bounds.GetSize().GetLength())
        elif prim.IsA(UsdLux.BoundableLightBase):
            places.append(matrix.ExtractTranslation())
    far = 0.25 * bounds.GetSize().GetLength() if not bounds.IsEmpty() else 1.0
    places += [camera.transform.Transform(Gf.Vec3d(side * far, far, 0)) for side in (-1, 1)]
    return places[:2]


def _placed_meshes(
    stage: Usd.Stage, when: Usd.TimeCode
) -> Iterator[tuple[UsdGeom.Mesh, Gf.Matrix4d]]:
    """Visible meshes and where they stand; instances come once for each place."""
    cache = UsdGeom.XformCache(when)
    below = iter(Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()))
    for prim in below:
        if prim.IsA(UsdGeom.PointInstancer):
            below.PruneChildren()
            yield from _instanced_meshes(UsdGeom.PointInstancer(prim), cache, when)
        elif _is_shown(prim, when):
            yield UsdGeom.Mesh(prim), cache.GetLocalToWorldTransform(prim)


def _instanced_meshes(
    instancer: UsdGeom.PointInstancer, cache: UsdGeom.XformCache, when: Usd.TimeCode
) -> Iterator[tuple[UsdGeom.Mesh, Gf.Matrix4d]]:
    stage = instancer.GetPrim().GetStage()
    to_world = cache.GetLocalToWorldTransform(instancer.GetPrim())
    prototypes = [stage.GetPrimAtPath(p) for p in instancer.GetPrototypesRel().GetTargets()]
    places = instancer.ComputeInstanceTransformsAtTime(
        when, when, UsdGeom.PointInstancer.ExcludeProtoXform
    )
    kept = instancer.ComputeMaskAtTime(when)
    indices = instancer.GetProtoIndicesAttr().Get(when)
    kept_indices = [index for i, index in enumerate(indices) if not kept or kept[i]]
    for index, place in zip(kept_indices, places, strict=True):
        root = prototypes[index]
        above = cache.GetLocalToWorldTransform(root.GetParent()).GetInverse()
        for prim in Usd.PrimRange(root, Usd.TraverseInstanceProxies()):
            if _is_shown(prim, when):
                yield (
                    UsdGeom.Mesh(prim),
                    cache.GetLocalToWorldTransform(prim) * above * place * to_world,
                )


def _is_shown(prim: Usd.Prim, when: Usd.TimeCode) -> bool:
    if not prim.IsA(UsdGeom.Mesh):
        return False
    imageable = UsdGeom.Imageable(prim)
    shown = imageable.ComputeVisibility(when) != UsdGeom.Tokens.invisible
    return shown and imageable.ComputePurpose() in PURPOSES


def _write_camera(file: BinaryIO, camera: Gf.Camera) -> None:
    frustum = camera.frustum
    is_flat = frustum.projectionType == Gf.Frustum.Orthographic
    window = frustum.window
    _write_matrix(file, camera.transform)
    file.write(struct.pack("<i", is_flat))
    file.write(struct.pack("<4f", *window.min, *window.max))
    file.write(struct.pack("<2f", camera.clippingRange.min, camera.clippingRange.max))


def _write_matrix(file: BinaryIO, matrix: Gf.Matrix4d) -> None:
    """Three rows for column vectors; USD's matrices are for row vectors."""
    file.write(
        struct.pack("<12d", *(matrix[column][row] for row in range(3) for column in range(4)))
    )


def _write_mesh(
    file: BinaryIO, mesh: UsdGeom.Mesh, matrix: Gf.Matrix4d, when: Usd.TimeCode
) -> None:
    _write_text(file, str(mesh.GetPath()))
    _write_matrix(file, matrix)
    left_handed = mesh.GetOrientationAttr().Get(when) == UsdGeom.Tokens.leftHanded
    file.write(
        struct.pack(
            "<4i",
            SCHEMES.get(mesh.GetSubdivisionSchemeAttr().Get(when), 1),
            BOUNDARY_RULES.get(mesh.GetInterpolateBoundaryAttr().Get(when), 2),
            TRIANGLE_RULES.get(mesh.GetTriangleSubdivisionRuleAttr().Get(when), 0),
            left_handed,
        )
    )
    _write_array(file, "i", mesh.GetFaceVertexCountsAttr().Get(when))
    _write_array(file, "i", mesh.GetFaceVertexIndicesAttr().Get(when))
    _write_array(file, "i", mesh.GetHoleIndicesAttr().Get(when))
    _write_array(file, "i", mesh.GetCreaseIndicesAttr().Get(when))
    _write_array(file, "i", mesh.GetCreaseLengthsAttr().Get(when))
    _write_array(file, "f", mesh.GetCreaseSharpnessesAttr().Get(when))
    _write_array(file, "i", mesh.GetCornerIndicesAttr().Get(when))
    _write_array(file, "f", mesh.GetCornerSharpnessesAttr().Get(when))
    points = np.asarray(mesh.GetPointsAttr().Get(when) or np.zeros((0, 3)), dtype="<f4")
    file.write(struct.pack("<I", len(points)))
    points.tofile(file)


def _write_array(file: BinaryIO, kind: str, values: ArrayLike | None) -> None:
    """Numbers of a kind, 'i' or 'f', of four bytes each, with their count before them."""
    numbers = np.asarray([] if values is None else values, dtype=f"<{kind}4")
    file.write(struct.pack("<I", len(numbers)))
    numbers.tofile(file)


def _write_text(file: BinaryIO, text: str) -> None:
    data = text.encode()
    file.write(struct.pack("<I", len(data)) + data)


if __name__ == "__main__":
    export(sys.argv[1], sys.argv[2])
