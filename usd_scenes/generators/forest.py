"""Writes the forest for benchmarks: about 122,000 faces in some hundreds of meshes.

Broad-leaved trees, ferns, toadstools and stones. Every tree has a cage of its own, trunk and
leaves, so that nothing can be instanced; leaves and fronds are open sheets.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from mesh_kit import ExtrudeStep, Points, blob_noise, extrude, loft, quad_sphere, spline, tangents
from numpy.typing import ArrayLike
from pxr import Usd, UsdGeom
from quad_mesh import QuadMesh, from_cage, from_grid, repeated
from stage_kit import (
    add_camera,
    add_distant_light,
    add_quad_mesh,
    add_sphere_light,
    main_of,
    new_stage,
)

DOCUMENTATION = """A wood in autumn: trees with branches and leaves, ferns, toadstools, stones.

For benchmarks: many meshes, long thin branches, thousands of small open leaves, and depth from the
feet of the viewer to the far trees. Written by generators/forest.py."""

COLOURS = {
    "bark": (0.16, 0.10, 0.06),
    "moss": (0.13, 0.20, 0.06),
    "leaf1": (0.10, 0.26, 0.05),
    "leaf2": (0.22, 0.34, 0.05),
    "leaf3": (0.48, 0.32, 0.04),
    "leaf4": (0.50, 0.14, 0.03),
    "fern": (0.07, 0.22, 0.07),
    "earth": (0.14, 0.10, 0.06),
    "stone": (0.27, 0.27, 0.28),
    "stem": (0.62, 0.56, 0.44),
    "cap": (0.60, 0.06, 0.04),
}
NAMES = list(COLOURS)
TREES = 34
FERNS = 54
SIDES = 8


def ground_height(x: ArrayLike, z: ArrayLike) -> Points:
    """A floor with roots' bumps, lower along the path in the middle."""
    x, z = np.asarray(x, np.float64), np.asarray(z, np.float64)
    path = x - 1.6 * np.sin(0.16 * z)
    dip = -0.35 * np.exp(-((path / 1.8) ** 2))
    waves = 0.22 * np.sin(0.31 * x + 0.9) * np.cos(0.27 * z) + 0.10 * np.sin(0.9 * x - 0.7 * z)
    return waves + dip + 0.05 * np.abs(path) ** 0.8 + 0.012 * np.maximum(0.0, -z)


def ground() -> QuadMesh:
    """The floor, finer near the viewer."""
    columns, rows = 72, 80
    v = np.linspace(0.0, 1.0, rows + 1).reshape(-1, 1)
    u = np.linspace(-1.0, 1.0, columns + 1).reshape(1, -1)
    z = 9.0 - 64.0 * v**1.5 + 0.0 * u
    x = u * (8.0 + 30.0 * v)
    bumps = blob_noise(np.stack([x, 0 * x, z], -1).reshape(-1, 3), 5, 1.7).reshape(x.shape)
    mesh = from_grid(np.stack([x, ground_height(x, z) + 0.05 * bumps, z], axis=-1))
    centres = mesh.points[mesh.faces].mean(axis=1)
    mossy = blob_noise(centres, 9, 0.8) + 0.25 * np.abs(centres[:, 0]) > 0.5
    mesh.colours = np.where(mossy, NAMES.index("moss"), NAMES.index("earth")).astype(np.int32)
    return mesh


def trunk(
    root: Points, height: float, generator: np.random.Generator
) -> tuple[QuadMesh, list[Points]]:
    """A tree without its leaves, and the curves of its branches."""
    lean = generator.uniform(-0.10, 0.10, size=2) * height
    knots = [
        root + np.array([lean[0] * t**2, height * t, lean[1] * t**2])
        + generator.normal(size=3) * (0.03, 0.0, 0.03) * height * (t > 0) for t in (0, 0.3, 0.65, 1)
    ]  # fmt: skip
    spine = spline(knots, 13)
    base = 0.040 * height
    taper = base * (1.0 - 0.80 * np.linspace(0, 1, 13)) * (1 + 1.1 * np.exp(-np.arange(13) / 0.9))
    angles = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)
    flutes = 1.0 + 0.16 * np.cos(3 * angles + generator.uniform(0, 6))
    circle = np.stack([np.cos(angles) * flutes, 0 * angles, -np.sin(angles) * flutes], axis=1)
    cage = loft(spine[:, None] + taper[:, None, None] * circle, 0.0, 0.05, "bark").turn_outward()
    curves = []
    sides = generator.permutation(SIDES)
    for number, span in enumerate((4, 5, 6, 7, 8, 9, 10, 11)):
        side = int(sides[number % SIDES])
        curves.append(_grow_branch(cage, span * SIDES + side, height, generator))
    curves.append(spine[-4:])
    cage.relabel(cage.faces_labelled("cap_start", "cap_end"), "bark")
    cage.relabel(range(0, 2 * SIDES), "moss")
    return from_cage(cage.check(closed=True), NAMES), curves


def _grow_branch(cage, face: int, height: float, generator: np.random.Generator) -> Points:
    """Pulls a branch out of a face of the trunk; returns its curve."""
    start = cage.face_centre(face)
    corners = cage.points[list(cage.faces[face])]
    radius = float(np.mean(np.linalg.norm(corners - start, axis=1)))
    normal = np.cross(corners[2] - corners[0], corners[3] - corners[1])
    out = normal / np.linalg.norm(normal)
    out = np.array([out[0], 0.0, out[2]]) / np.hypot(out[0], out[2])
    reach = height * generator.uniform(0.22, 0.34)
    rise = generator.uniform(0.35, 0.85)
    sway = generator.normal(size=3) * 0.10 * reach
    end = start + reach * (out + np.array([0.0, rise, 0.0])) + sway
    middle = 0.5 * (start + end) + np.array([0.0, -0.08, 0.0]) * reach + sway
    curve = spline([start, middle, end], 7)
    sizes = np.linspace(0.62, 0.12, 6) * min(1.0, 0.022 * height / radius)
    steps = [
        ExtrudeStep(point, direction, size, "bark")
        for point, direction, size in zip(curve[1:], tangents(curve)[1:], sizes)
    ]
    extrude(cage, [face], steps)
    cage.relabel([face], "bark")
    return curve


def leaf_shape(columns: int = 2, rows: int = 4) -> QuadMesh:
    """A leaf of unit length along z, folded along its middle and bent at its tip."""
    v = np.linspace(0.0, 1.0, rows + 1).reshape(-1, 1)
    u = np.linspace(-1.0, 1.0, columns + 1).reshape(1, -1)
    width = 0.34 * np.sin(np.pi * (0.06 + 0.90 * v**0.85)) ** 0.8
    x, z = u * width, v + 0.0 * u
    y = 0.30 * np.abs(u) * width - 0.25 * v**2
    return from_grid(np.stack([x, y, z], axis=-1))


def random_frames(
    count: int, along: Points, size: Points, generator: np.random.Generator
) -> Points:
    """Frames whose z runs along given directions, turned at random about them."""
    z = along / np.linalg.norm(along, axis=1, keepdims=True)
    x = np.cross(z, generator.normal(size=(count, 3)) + np.array([0.0, 2.5, 0.0]))
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    return np.stack([x, np.cross(z, x), z], axis=-1) * size.reshape(-1, 1, 1)


def leaves(
    curves: list[Points], count: int, height: float, generator: np.random.Generator
) -> QuadMesh:
    """Leaves around the outer halves of branches."""
    paths = np.concatenate([curve[len(curve) // 3 :] for curve in curves])
    centre = paths.mean(axis=0)
    at = paths[generator.integers(len(paths), size=count)]
    at = at + generator.normal(size=(count, 3)) * 0.058 * height
    along = (at - centre) * (1.0, 0.6, 1.0) + generator.normal(size=(count, 3)) * 0.12 * height
    along[:, 1] -= 0.08 * height
    size = generator.uniform(0.045, 0.075, count) * height
    mesh = repeated(leaf_shape(), random_frames(count, along, size, generator), at)
    tint = generator.integers(4)
    per_leaf = (tint + generator.choice(3, p=(0.6, 0.3, 0.1), size=count)) % 4
    first = NAMES.index("leaf1")
    mesh.colours = np.repeat(per_leaf + first, len(leaf_shape().faces)).astype(np.int32)
    return mesh


def fern(generator: np.random.Generator) -> QuadMesh:
    """A rosette of fronds, each a ribbon with a serrated edge that arches outward."""
    fronds = int(generator.integers(7, 11))
    v = np.linspace(0.0, 1.0, 13).reshape(-1, 1)
    u = np.linspace(-1.0, 1.0, 5).reshape(1, -1)
    teeth = 1.0 - 0.55 * (np.arange(13).reshape(-1, 1) % 2) * np.abs(u)
    width = 0.15 * np.sin(np.pi * (0.08 + 0.90 * v)) * teeth
    points = np.stack([u * width, 1.1 * np.sin(2.0 * v) * 0.62 - 0.06 * np.abs(u), v + 0 * u], -1)
    frond = from_grid(points, NAMES.index("fern"))
    turn = np.linspace(0, 2 * np.pi, fronds, endpoint=False) + generator.normal(size=fronds) * 0.2
    size = generator.uniform(0.5, 0.95, fronds)
    along = np.stack([np.cos(turn), np.zeros(fronds), np.sin(turn)], axis=1)
    x = np.cross((0.0, 1.0, 0.0), along)
    up = np.tile((0.0, 1.0, 0.0), (fronds, 1))
    frames = np.stack([x, up, along], axis=-1) * size.reshape(-1, 1, 1)
    return repeated(frond, frames, np.zeros((fronds, 3)))


def toadstool() -> QuadMesh:
    """A toadstool of unit height."""
    profile = [(0.16, 0.0), (0.13, 0.3), (0.11, 0.62), (0.40, 0.60), (0.52, 0.66), (0.48, 0.78),
               (0.30, 0.94), (0.12, 1.0)]  # fmt: skip
    angles = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    circle = np.stack([np.cos(angles), 0 * angles, -np.sin(angles)], axis=1)
    rings = np.array([radius * circle + (0.0, level, 0.0) for radius, level in profile])
    cage = loft(rings, 0.0, 0.02, "stem").turn_outward()
    cage.relabel(range(4 * 12, 7 * 12), "cap")
    cage.relabel(cage.faces_labelled("cap_end"), "cap")
    cage.relabel(cage.faces_labelled("cap_start"), "stem")
    return from_cage(cage.check(closed=True), NAMES)


def stone(seed: int) -> QuadMesh:
    """A quad sphere pushed about by noise, mossy above."""
    cage = quad_sphere(6, "stone")
    lumps = 1.0 + 0.20 * blob_noise(cage.points, seed, 1.5) + 0.05 * blob_noise(cage.points, 1, 5.0)
    cage.points = cage.points * lumps[:, None] * (1.2, 0.7, 1.0)
    mesh = from_cage(cage, NAMES)
    high = mesh.points[mesh.faces].mean(axis=1)[:, 1] > 0.35
    mesh.colours = np.where(high, NAMES.index("moss"), mesh.colours).astype(np.int32)
    return mesh


def tree_places(generator: np.random.Generator) -> list[tuple[float, float]]:
    """Places beside the path, near ones first, none too close to another."""
    places: list[tuple[float, float]] = [(-3.3, 0.6), (3.6, -1.6)]
    while len(places) < TREES:
        z = 2.0 - 46.0 * generator.uniform() ** 0.8
        x = generator.uniform(-1.0, 1.0) * (7.0 + 0.42 * -z)
        path = abs(x - 1.6 * np.sin(0.16 * z))
        if path > 2.3 and all(np.hypot(x - a, z - b) > 2.6 for a, b in places):
            places.append((float(x), float(z)))
    return places


def standing_at(x: float, z: float, sink: float = 0.0) -> Points:
    """A point of the floor."""
    return np.array([x, float(ground_height(x, z)) - sink, z])


def build() -> Usd.Stage:
    """The whole stage."""
    generator = np.random.default_rng(122)
    stage = new_stage(DOCUMENTATION, 1.0)
    palette = list(COLOURS.values())
    for group in ("Trees", "Ferns", "Toadstools", "Stones"):
        UsdGeom.Xform.Define(stage, f"/World/{group}")

    def add(path: str, mesh: QuadMesh, double_sided: bool = False) -> None:
        add_quad_mesh(stage, f"/World/{path}", mesh, palette, double_sided)

    add("Ground", ground())
    for number, (x, z) in enumerate(tree_places(generator)):
        height = generator.uniform(6.5, 10.5)
        wood, curves = trunk(standing_at(x, z, 0.15), height, generator)
        add(f"Trees/Trunk{number:02}", wood)
        crown = leaves(curves, int(generator.integers(250, 308)), height, generator)
        add(f"Trees/Leaves{number:02}", crown, True)
    for number in range(FERNS):
        z = 5.0 - 24.0 * generator.uniform() ** 1.3
        x = 1.6 * np.sin(0.16 * z) + generator.choice((-1, 1)) * generator.uniform(1.5, 7.0)
        at = standing_at(x, z, 0.03)
        add(f"Ferns/Fern{number:02}", fern(generator).placed(np.eye(3), at), True)
    for number in range(16):
        z, side = generator.uniform(-6.0, 4.5), generator.choice((-1, 1))
        x = 1.6 * np.sin(0.16 * z) + side * generator.uniform(1.0, 3.2)
        size = generator.uniform(0.18, 0.45)
        mesh = toadstool().placed(size * np.eye(3), standing_at(x, z, 0.02))
        add(f"Toadstools/Toadstool{number:02}", mesh)
    for number in range(30):
        z = 4.5 - 30.0 * generator.uniform() ** 1.4
        x = 1.6 * np.sin(0.16 * z) + generator.choice((-1, 1)) * generator.uniform(1.2, 8.0)
        size = generator.uniform(0.15, 0.8)
        mesh = stone(number).placed(size * np.eye(3), standing_at(x, z, -0.2 * size))
        add(f"Stones/Stone{number:02}", mesh)
    UsdGeom.Xform.Define(stage, "/World/Lights")
    add_distant_light(stage, "/World/Lights/Sun", (-0.55, -0.75, -0.35), 3.4, (1.0, 0.86, 0.62))
    add_sphere_light(stage, "/World/Lights/Sky", (6.0, 14.0, 10.0), 1.0, 500.0, (0.55, 0.7, 1.0))
    add_camera(stage, "/World/Camera", (0.1, 1.9, 9.0), (0.1, 2.9, -6.0), 30.0, aspect=1.0)
    return stage


if __name__ == "__main__":
    default = Path(__file__).resolve().parents[2] / "build" / "bench" / "forest.usdc"
    sys.exit(main_of(__doc__, build, default))
