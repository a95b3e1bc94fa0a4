"""Writes a torus whose faces are all of one kind, to see what a kind of face costs in memory."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from mesh_kit import Points
from pxr import Usd
from quad_mesh import Faces, QuadMesh
from stage_kit import add_camera, add_distant_light, add_quad_mesh, new_stage, write_stage

DOCUMENTATION = """A torus of one kind of faces: regular ones; irregular ones, each with a vertex of
valence 3 and one of valence 6; or regular ones with a semi-sharp crease at every other edge.

For benchmarks. Written by generators/cages.py."""

KINDS = ("regular", "irregular", "creased")
COLUMNS, ROWS = 144, 64


def torus(u: Points, v: Points) -> Points:
    """Points at turns u around the axis and v around the tube, 0..1."""
    a, b = 2 * np.pi * u, 2 * np.pi * v
    reach = 1.0 + 0.4 * np.cos(b)
    return np.stack([reach * np.cos(a), 0.4 * np.sin(b), -reach * np.sin(a)], axis=-1)


def plain(points: Points, faces: Faces) -> QuadMesh:
    """A mesh without tags."""
    count = len(faces)
    return QuadMesh(
        points, faces.astype(np.int32), np.zeros(count, np.int32), np.zeros(count, np.bool_)
    )


def regular() -> QuadMesh:
    """A grid that closes both ways."""
    column, row = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))

    def index(across: int, up: int) -> Faces:
        return (row + up) % ROWS * COLUMNS + (column + across) % COLUMNS

    faces = np.stack([index(0, 0), index(1, 0), index(1, 1), index(0, 1)], axis=-1)
    points = torus(column.ravel() / COLUMNS, row.ravel() / ROWS)
    return plain(points, faces.reshape(-1, 4))


def creased() -> QuadMesh:
    """The same, sharp along every other row."""
    mesh = regular()
    row = np.arange(0, ROWS, 2).reshape(-1, 1) * COLUMNS
    column = np.arange(COLUMNS)
    edges = np.stack([row + column, row + (column + 1) % COLUMNS], axis=-1)
    mesh.crease_edges = edges.reshape(-1, 2).astype(np.int32)
    mesh.crease_sharpness = np.full(len(mesh.crease_edges), 2.0, np.float32)
    return mesh


def irregular() -> QuadMesh:
    """Triangles, six around a vertex, each split into three quads."""
    columns, rows = COLUMNS // 3, ROWS // 2
    # A lattice with half the spacing has the middles of edges; middles of triangles come after.
    wide, tall = 2 * columns, 2 * rows
    column, row = np.meshgrid(np.arange(wide), np.arange(tall))
    points = [torus(column.ravel() / wide, row.ravel() / tall)]
    x, y = (2 * each.ravel() for each in np.meshgrid(np.arange(columns), np.arange(rows)))
    faces = []
    first = wide * tall
    for corners in (((0, 0), (2, 0), (2, 2)), ((0, 0), (2, 2), (0, 2))):
        across, up = np.mean(corners, axis=0)
        points.append(torus((x + across) / wide, (y + up) / tall))
        middle = first + np.arange(len(x))
        first += len(x)
        for k in range(3):
            before, here, after = (np.array(corners[(k + step) % 3]) for step in (-1, 0, 1))
            ring = [here, (here + after) // 2, None, (before + here) // 2]
            quad = [
                middle if at is None else (y + at[1]) % tall * wide + (x + at[0]) % wide
                for at in ring
            ]
            faces.append(np.stack(quad, axis=-1))
    return plain(np.concatenate(points), np.concatenate(faces))


def build(kind: str) -> Usd.Stage:
    """The whole stage."""
    stage = new_stage(DOCUMENTATION)
    mesh = {"regular": regular, "irregular": irregular, "creased": creased}[kind]()
    add_quad_mesh(stage, "/World/Torus", mesh, [(0.5, 0.3, 0.2)])
    add_distant_light(stage, "/World/Sun", (0.5, -0.8, -0.6), 3.0, (1.0, 1.0, 1.0))
    add_camera(stage, "/World/Camera", (0.0, 2.6, 3.2), (0.0, 0.0, 0.0), 45.0, aspect=1.0)
    return stage


def main() -> int:
    """Writes the file and says how large the scene is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path, metavar="OUT", help="a .usdc or .usda file")
    parser.add_argument("--kind", choices=KINDS, default=KINDS[0])
    options = parser.parse_args()
    return write_stage(build(options.kind), options.out)


if __name__ == "__main__":
    sys.exit(main())
