"""Control cages of quads as arrays, for scenes with very many faces.

A QuadMesh is made from grids of points and joined by whole arrays, never face by face; mesh_kit's
ControlCage is the better tool where faces are modelled one at a time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from mesh_kit import ControlCage, Points
from numpy.typing import ArrayLike, NDArray

Faces = NDArray[np.int32]
Mask = NDArray[np.bool_]


@dataclass
class QuadMesh:
    """Points (n, 3) and faces (m, 4); of each face its colour and whether it is a hole."""

    points: Points
    faces: Faces
    #: indices into a palette, (m,)
    colours: NDArray[np.int32]
    holes: Mask
    #: edges (k, 2) and their sharpness (k,)
    crease_edges: Faces = field(default_factory=lambda: np.zeros((0, 2), np.int32))
    crease_sharpness: NDArray[np.float32] = field(default_factory=lambda: np.zeros(0, np.float32))

    def moved(self, points: Points) -> QuadMesh:
        """The same faces over other points."""
        return QuadMesh(
            points, self.faces, self.colours, self.holes, self.crease_edges, self.crease_sharpness
        )

    def placed(self, matrix: ArrayLike, offset: ArrayLike) -> QuadMesh:
        """The same mesh after a linear map and a shift."""
        return self.moved(self.points @ np.asarray(matrix).T + np.asarray(offset))

    def coloured(self, colour: int) -> QuadMesh:
        """The same mesh in one colour."""
        self.colours = np.full(len(self.faces), colour, np.int32)
        return self


def from_grid(points: Points, colour: int = 0, closed: bool = False) -> QuadMesh:
    """A sheet over (rows, columns, 3) points; closed joins the last column to the first.

    Faces are numbered row by row. They look where rows x columns points to: out of a tube whose
    rows rise and whose columns run counter-clockwise as seen from above.
    """
    rows, columns, _ = points.shape
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    if closed:
        index = np.concatenate([index, index[:, :1]], axis=1)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1)
    faces = quads.reshape(-1, 4)
    return QuadMesh(
        points.reshape(-1, 3).astype(np.float64),
        faces,
        np.full(len(faces), colour, np.int32),
        np.zeros(len(faces), np.bool_),
    )


def capped_tube(rings: Points, lift: float, colour: int = 0, cap_colour: int = 0) -> QuadMesh:
    """A tube through (rings, 4m, 3) whose last ring is closed by a grid of m x m quads.

    The cap is a Coons patch that rises by `lift` in its middle. Its four corners are vertices of
    valence 3.
    """
    tube = from_grid(rings, colour, closed=True)
    count, sides, _ = rings.shape
    m = sides // 4
    if sides != 4 * m or m < 1:
        raise ValueError(f"a cap needs a multiple of four columns, not {sides}")
    index = np.full((m + 1, m + 1), -1, np.int32)
    # The grid's corners lie in the middle of the plan's sides' ends, an eighth of the way round.
    around = (count - 1) * sides + (m // 2 + np.arange(sides)) % sides
    index[:-1, 0], index[-1, :-1] = around[:m], around[m : 2 * m]
    index[:0:-1, -1], index[0, :0:-1] = around[2 * m : 3 * m], around[3 * m :]
    inside = len(tube.points) + np.arange((m - 1) ** 2, dtype=np.int32)
    index[1:-1, 1:-1] = inside.reshape(m - 1, m - 1)
    points = np.concatenate([tube.points, _coons(tube.points, index, lift)])
    quads = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1)
    faces = np.concatenate([tube.faces, quads.reshape(-1, 4)])
    colours = np.concatenate([tube.colours, np.full(m * m, cap_colour, np.int32)])
    return QuadMesh(points, faces, colours, np.zeros(len(faces), np.bool_))


def _coons(points: Points, index: Faces, lift: float) -> Points:
    """The inner points of a grid whose border has points already."""
    m = len(index) - 1
    u, v = np.meshgrid(np.arange(1, m) / m, np.arange(1, m) / m, indexing="ij")
    u, v = u.reshape(-1, 1), v.reshape(-1, 1)
    row, column = np.divmod(np.arange((m - 1) ** 2), max(m - 1, 1))

    def at(i: ArrayLike, j: ArrayLike) -> Points:
        return points[index[i, j]]

    sides = (1 - v) * at(row + 1, 0) + v * at(row + 1, -1)
    sides = sides + (1 - u) * at(0, column + 1) + u * at(-1, column + 1)
    corners = (1 - u) * ((1 - v) * at(0, 0) + v * at(0, -1))
    corners = corners + u * ((1 - v) * at(-1, 0) + v * at(-1, -1))
    rise = lift * np.sqrt(16.0 * u * (1 - u) * v * (1 - v))
    return sides - corners + rise * np.array([0.0, 1.0, 0.0])


def from_cage(cage: ControlCage, palette: Sequence[str]) -> QuadMesh:
    """A cage of quads; its labels are names of the palette's colours."""
    holes = np.zeros(len(cage.faces), np.bool_)
    holes[cage.holes] = True
    colours = np.array([palette.index(label) for label in cage.labels], np.int32)
    mesh = QuadMesh(cage.points, np.array(cage.faces, np.int32), colours, holes)
    edges = [
        (edge, sharpness) for chain, sharpness in cage.creases for edge in zip(chain, chain[1:])
    ]
    if edges:
        mesh.crease_edges = np.array([edge for edge, _ in edges], np.int32)
        mesh.crease_sharpness = np.array([sharpness for _, sharpness in edges], np.float32)
    return mesh


def joined(meshes: Sequence[QuadMesh]) -> QuadMesh:
    """One mesh of several that share no point."""
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    return QuadMesh(
        np.concatenate([mesh.points for mesh in meshes]),
        np.concatenate([mesh.faces + s for mesh, s in zip(meshes, starts)]).astype(np.int32),
        np.concatenate([mesh.colours for mesh in meshes]),
        np.concatenate([mesh.holes for mesh in meshes]),
        np.concatenate([mesh.crease_edges + s for mesh, s in zip(meshes, starts)]).astype(np.int32),
        np.concatenate([mesh.crease_sharpness for mesh in meshes]),
    )


def repeated(mesh: QuadMesh, frames: Points, offsets: Points) -> QuadMesh:
    """One mesh of copies: frames are (copies, 3, 3) linear maps, offsets (copies, 3) shifts."""
    copies = len(frames)
    points = np.einsum("cij,pj->cpi", frames, mesh.points) + offsets[:, None, :]
    shift = (np.arange(copies, dtype=np.int32) * len(mesh.points)).reshape(-1, 1, 1)
    return QuadMesh(
        points.reshape(-1, 3),
        (mesh.faces[None] + shift).reshape(-1, 4),
        np.tile(mesh.colours, copies),
        np.tile(mesh.holes, copies),
        (mesh.crease_edges[None] + shift).reshape(-1, 2),
        np.tile(mesh.crease_sharpness, copies),
    )


def turned_about_y(angles: ArrayLike, scales: ArrayLike = 1.0) -> Points:
    """Frames for `repeated`: turns about the y axis, in radians, and uniform scales."""
    angles = np.asarray(angles, dtype=np.float64)
    c, s, zero, one = np.cos(angles), np.sin(angles), np.zeros_like(angles), np.ones_like(angles)
    frames = np.array([[c, zero, s], [zero, one, zero], [-s, zero, c]])
    return np.moveaxis(frames, -1, 0) * np.broadcast_to(scales, angles.shape)[:, None, None]


def refined(mesh: QuadMesh) -> QuadMesh:
    """One step of Catmull-Clark subdivision of a closed mesh without creases.

    The faces that a face becomes are its corners' in order, so face f gives 4f to 4f + 3.
    """
    points, faces = mesh.points, mesh.faces
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
    edges, edge_of = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    edge_of = edge_of.reshape(-1, 4)
    if len(edges) * 2 != len(ends):
        raise ValueError("only a closed mesh can be refined")
    face_points = points[faces].mean(axis=1)
    edge_sum = np.zeros((len(edges), 3))
    np.add.at(edge_sum, edge_of.ravel(), np.repeat(face_points, 4, axis=0))
    edge_points = (points[edges].sum(axis=1) + edge_sum) / 4.0

    valence = np.bincount(faces.ravel(), minlength=len(points)).reshape(-1, 1)
    face_mean, edge_mean = np.zeros_like(points), np.zeros_like(points)
    np.add.at(face_mean, faces.ravel(), np.repeat(face_points, 4, axis=0))
    middles = points[edges].mean(axis=1)
    for end in (0, 1):
        np.add.at(edge_mean, edges[:, end], middles)
    vertex_points = face_mean / valence + 2 * edge_mean / valence + (valence - 3) * points
    vertex_points = vertex_points / valence

    edge_index = edge_of + len(points)
    face_index = np.arange(len(faces)).reshape(-1, 1) + len(points) + len(edges)
    corners = np.stack(
        [faces, edge_index, np.broadcast_to(face_index, faces.shape), np.roll(edge_index, 1, 1)],
        axis=-1,
    )
    return QuadMesh(
        np.concatenate([vertex_points, edge_points, face_points]),
        corners.reshape(-1, 4).astype(np.int32),
        np.repeat(mesh.colours, 4),
        np.repeat(mesh.holes, 4),
    )


def vertex_normals(mesh: QuadMesh) -> Points:
    """Unit normals at the points, means of the faces around."""
    corners = mesh.points[mesh.faces]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    total = np.zeros_like(mesh.points)
    np.add.at(total, mesh.faces.ravel(), np.repeat(normals, 4, axis=0))
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-12)


def border_between(mesh: QuadMesh, colour: int) -> Faces:
    """The edges (k, 2) between faces of a colour and all others."""
    ends = np.stack([mesh.faces, np.roll(mesh.faces, -1, axis=1)], axis=-1).reshape(-1, 2)
    inside = np.repeat(mesh.colours == colour, 4)
    edges, edge_of = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    uses = np.bincount(edge_of.ravel(), minlength=len(edges))
    inner = np.bincount(edge_of.ravel(), weights=inside, minlength=len(edges))
    return edges[(uses == 2) & (inner == 1)].astype(np.int32)
