"""Writes control cages, lights and cameras to a USD stage, the same bytes each time."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mesh_kit import ControlCage
from numpy.typing import ArrayLike, NDArray
from pxr import Gf, Tf, Usd, UsdGeom, UsdLux, Vt
from quad_mesh import QuadMesh


@dataclass
class Colour:
    """A displayColor: values, how they lie on the surface, and optionally indices into them."""

    interpolation: str
    values: ArrayLike
    indices: ArrayLike | None = None


def colour_by_label(cage: ControlCage, palette: Mapping[str, ArrayLike]) -> Colour:
    """One colour a face, looked up by the face's label."""
    names = sorted(set(cage.labels))
    missing = [name for name in names if name not in palette]
    if missing:
        raise KeyError(f"the palette lacks {', '.join(missing)}")
    index_of = {name: index for index, name in enumerate(names)}
    indices = [index_of[label] for label in cage.labels]
    return Colour("uniform", [palette[name] for name in names], indices)


def colour_by_vertex(values: ArrayLike) -> Colour:
    """One colour a control vertex, smooth over the surface."""
    return Colour("vertex", np.clip(np.asarray(values), 0.0, 1.0))


def rounded(values: ArrayLike, digits: int = 3) -> NDArray[np.float32]:
    """Values short enough to write, with no negative zero."""
    return (np.round(np.asarray(values, dtype=np.float64), digits) + 0.0).astype(np.float32)


def new_stage(documentation: str, metres_per_unit: float = 0.01) -> Usd.Stage:
    """An empty stage with a /World, Y up."""
    stage = Usd.Stage.CreateInMemory()
    stage.SetMetadata("documentation", documentation)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, metres_per_unit)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/World").GetPrim())
    return stage


def place(
    prim: UsdGeom.Xformable,
    translate: ArrayLike = (0, 0, 0),
    rotate: ArrayLike = (0, 0, 0),
    scale: float = 1.0,
) -> None:
    """Gives a prim a transform, leaving out what is the identity."""
    if np.any(translate):
        prim.AddTranslateOp().Set(Gf.Vec3d(*(float(value) for value in translate)))
    if np.any(rotate):
        prim.AddRotateXYZOp().Set(Gf.Vec3f(*(float(value) for value in rotate)))
    if scale != 1.0:
        prim.AddScaleOp().Set(Gf.Vec3f(scale))


def add_cage(
    stage: Usd.Stage, path: str, cage: ControlCage, colour: Colour, double_sided: bool = False
) -> UsdGeom.Mesh:
    """Writes a cage as a Catmull-Clark mesh with all that the cage knows about itself."""
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = rounded(cage.points)
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.stack([points.min(0), points.max(0)])))
    counts = np.array([len(face) for face in cage.faces], dtype=np.int32)
    indices = np.array([vertex for face in cage.faces for vertex in face], dtype=np.int32)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(counts))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(indices))
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.catmullClark)
    mesh.CreateInterpolateBoundaryAttr(UsdGeom.Tokens.edgeAndCorner)
    mesh.CreateOrientationAttr(UsdGeom.Tokens.rightHanded)
    mesh.CreateDoubleSidedAttr(double_sided)
    if cage.holes:
        mesh.CreateHoleIndicesAttr(cage.holes)
    if cage.creases:
        mesh.CreateCreaseIndicesAttr([vertex for chain, _ in cage.creases for vertex in chain])
        mesh.CreateCreaseLengthsAttr([len(chain) for chain, _ in cage.creases])
        mesh.CreateCreaseSharpnessesAttr([sharpness for _, sharpness in cage.creases])
    _set_colour(mesh, colour)
    return mesh


def add_quad_mesh(
    stage: Usd.Stage,
    path: str,
    mesh: QuadMesh,
    palette: ArrayLike,
    double_sided: bool = False,
) -> UsdGeom.Mesh:
    """Writes an array cage as a Catmull-Clark mesh, each face in its colour of the palette."""
    prim = UsdGeom.Mesh.Define(stage, path)
    points = rounded(mesh.points, 4)
    prim.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.stack([points.min(0), points.max(0)])))
    prim.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    counts = np.full(len(mesh.faces), 4, np.int32)
    prim.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(counts))
    prim.CreateFaceVertexIndicesAttr(_int_array(mesh.faces))
    prim.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.catmullClark)
    prim.CreateInterpolateBoundaryAttr(UsdGeom.Tokens.edgeAndCorner)
    prim.CreateDoubleSidedAttr(double_sided)
    if mesh.holes.any():
        prim.CreateHoleIndicesAttr(_int_array(np.flatnonzero(mesh.holes)))
    if len(mesh.crease_edges):
        prim.CreateCreaseIndicesAttr(_int_array(mesh.crease_edges))
        prim.CreateCreaseLengthsAttr(_int_array(np.full(len(mesh.crease_edges), 2)))
        sharpness = mesh.crease_sharpness.astype(np.float32)
        prim.CreateCreaseSharpnessesAttr(Vt.FloatArray.FromNumpy(sharpness))
    used, indices = np.unique(mesh.colours, return_inverse=True)
    primvar = prim.CreateDisplayColorPrimvar("uniform")
    primvar.Set(Vt.Vec3fArray.FromNumpy(rounded(np.asarray(palette)[used])))
    primvar.SetIndices(_int_array(indices))
    return prim


def _int_array(values: ArrayLike) -> Vt.IntArray:
    return Vt.IntArray.FromNumpy(np.ascontiguousarray(values, dtype=np.int32).ravel())


def _set_colour(mesh: UsdGeom.Mesh, colour: Colour) -> None:
    primvar = mesh.CreateDisplayColorPrimvar(colour.interpolation)
    values = np.atleast_2d(rounded(colour.values))
    primvar.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(values)))
    if colour.indices is not None:
        primvar.SetIndices(Vt.IntArray([int(index) for index in colour.indices]))


def look_at(eye: ArrayLike, target: ArrayLike) -> Gf.Matrix4d:
    """The transform of a camera or light at eye that looks along -Z at target."""
    towards = Gf.Matrix4d().SetLookAt(
        Gf.Vec3d(*map(float, eye)), Gf.Vec3d(*map(float, target)), Gf.Vec3d(0, 1, 0)
    )
    inverse = towards.GetInverse()
    return Gf.Matrix4d(
        *(round(inverse[row][column], 6) + 0.0 for row in range(4) for column in range(4))
    )


def add_camera(
    stage: Usd.Stage,
    path: str,
    eye: ArrayLike,
    target: ArrayLike,
    focal_length: float,
    aspect: float = 16.0 / 9.0,
) -> UsdGeom.Camera:
    """A camera with a 36 mm wide aperture."""
    camera = UsdGeom.Camera.Define(stage, path)
    camera.AddTransformOp().Set(look_at(eye, target))
    camera.CreateHorizontalApertureAttr(36.0)
    camera.CreateVerticalApertureAttr(36.0 / aspect)
    camera.CreateFocalLengthAttr(focal_length)
    camera.CreateClippingRangeAttr(Gf.Vec2f(0.1, 1000.0))
    camera.CreateFocusDistanceAttr(round(float(np.linalg.norm(np.subtract(eye, target))), 3))
    return camera


def add_distant_light(
    stage: Usd.Stage, path: str, towards: ArrayLike, intensity: float, colour: ArrayLike
) -> None:
    """A sun or moon whose light travels along the direction; intensity is its irradiance."""
    light = UsdLux.DistantLight.Define(stage, path)
    light.AddTransformOp().Set(look_at((0, 0, 0), towards))
    light.CreateAngleAttr(0.53)
    _set_light(light, intensity, colour)


def add_sphere_light(
    stage: Usd.Stage,
    path: str,
    position: ArrayLike,
    radius: float,
    intensity: float,
    colour: ArrayLike,
) -> None:
    """A lamp; intensity is four times its irradiance at distance one, whatever its radius."""
    light = UsdLux.SphereLight.Define(stage, path)
    place(light, translate=position)
    light.CreateRadiusAttr(radius)
    _set_light(light, intensity, colour)


def _set_light(light: UsdLux.BoundableLightBase, intensity: float, colour: ArrayLike) -> None:
    light.CreateIntensityAttr(intensity)
    light.CreateColorAttr(Gf.Vec3f(*(float(value) for value in colour)))
    light.CreateNormalizeAttr(True)


def save(stage: Usd.Stage, path: Path) -> None:
    """Writes the stage, or raises OSError with a message that names the path."""
    if path.suffix not in (".usda", ".usdc", ".usd"):
        raise OSError(f"{path} is no .usda, .usdc or .usd file")
    if not path.parent.is_dir():
        raise OSError(f"no such folder: {path.parent}")
    if not stage.GetRootLayer().Export(str(path)):
        raise OSError(f"could not write {path}")


def face_count(stage: Usd.Stage) -> int:
    """The number of base faces on a stage."""
    meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    return sum(len(mesh.GetFaceVertexCountsAttr().Get()) for mesh in meshes)


def main_of(documentation: str, build: Callable[[], Usd.Stage], default: Path) -> int:
    """The command of a generator: writes its stage to OUT and says how large it is."""
    parser = argparse.ArgumentParser(description=documentation.splitlines()[0])
    parser.add_argument("out", nargs="?", type=Path, default=default, metavar="OUT")
    return write_stage(build(), parser.parse_args().out)


def write_stage(stage: Usd.Stage, out: Path) -> int:
    """Saves a stage and says how large it is; returns the exit status."""
    try:
        save(stage, out)
    except (OSError, Tf.ErrorException) as error:
        print(f"{Path(sys.argv[0]).name}: {error}", file=sys.stderr)
        return 1
    print(f"{out}: {face_count(stage)} base faces")
    return 0
