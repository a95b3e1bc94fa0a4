"""Says as JSON what is in a USD file; run under another OpenUSD than the renderer's."""

import json
import sys

from pxr import Usd, UsdGeom


def inspect(file: str) -> dict:
    """Faces, meshes, cameras and whatever is wrong with the meshes."""
    stage = Usd.Stage.Open(file)
    prims = list(stage.Traverse(Usd.TraverseInstanceProxies()))
    meshes = [UsdGeom.Mesh(prim) for prim in prims if prim.IsA(UsdGeom.Mesh)]
    problems = [line for mesh in meshes for line in problems_of(mesh)]
    return {
        "default_prim": bool(stage.GetDefaultPrim()),
        "cameras": sum(prim.IsA(UsdGeom.Camera) for prim in prims),
        "meshes": len(meshes),
        "faces": sum(len(mesh.GetFaceVertexCountsAttr().Get() or ()) for mesh in meshes),
        "problems": problems,
    }


def problems_of(mesh: UsdGeom.Mesh) -> list[str]:
    """Lines about a mesh whose topology or extent is not what it should be."""
    path = mesh.GetPath()
    counts = mesh.GetFaceVertexCountsAttr().Get() or ()
    indices = mesh.GetFaceVertexIndicesAttr().Get() or ()
    when = Usd.TimeCode.EarliestTime()
    points = mesh.GetPointsAttr().Get(when) or ()
    valid, reason = UsdGeom.Mesh.ValidateTopology(indices, counts, len(points))
    problems = [] if valid else [f"{path}: {reason}"]
    extent = mesh.GetExtentAttr().Get(when)
    computed = UsdGeom.PointBased.ComputeExtent(points)
    if extent is None:
        problems.append(f"{path}: has no extent")
    elif any(abs(a - b) > 1e-3 for x, y in zip(extent, computed) for a, b in zip(x, y)):
        problems.append(f"{path}: extent is not that of its points")
    return problems


if __name__ == "__main__":
    json.dump(inspect(sys.argv[1]), sys.stdout)
