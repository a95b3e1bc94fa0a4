"""Builds control cages for Catmull-Clark surfaces.

A cage is made by a few verbs that keep it all quads: sheet, loft, quad_sphere, extrude. Each face
carries a label, by which later steps find it: a colour, a hole, a region to extrude.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Points = NDArray[np.float64]
Face = tuple[int, ...]


class CageError(ValueError):
    """A cage that breaks the promise its maker gave, such as being closed or two-manifold."""


@dataclass
class ControlCage:
    """Points and faces, with the tags of a subdivision surface and one label a face."""

    points: Points
    faces: list[Face]
    labels: list[str]
    holes: list[int] = field(default_factory=list)
    creases: list[tuple[list[int], float]] = field(default_factory=list)

    def faces_labelled(self, *labels: str) -> list[int]:
        """The indices of all faces that carry one of the labels."""
        return [index for index, label in enumerate(self.labels) if label in labels]

    def relabel(self, face_indices: Iterable[int], label: str) -> None:
        """Gives the faces another label."""
        for index in face_indices:
            self.labels[index] = label

    def make_holes(self, *labels: str) -> None:
        """Turns all faces with one of the labels into holes."""
        self.holes = sorted({*self.holes, *self.faces_labelled(*labels)})

    def face_centre(self, face_index: int) -> Points:
        """The mean of the face's corners."""
        return self.points[list(self.faces[face_index])].mean(axis=0)

    def signed_volume(self) -> float:
        """Positive where the faces of a closed cage look outward."""
        total = 0.0
        centre = self.points.mean(axis=0)
        for face in self.faces:
            corners = self.points[list(face)] - centre
            for second, third in zip(corners[1:-1], corners[2:], strict=True):
                total += float(np.dot(corners[0], np.cross(second, third)))
        return total / 6.0

    def turn_outward(self) -> ControlCage:
        """Reverses every face if the cage is inside out."""
        if self.signed_volume() < 0.0:
            self.faces = [face[::-1] for face in self.faces]
        return self

    def moved(self, place: Callable[[Points], Points]) -> ControlCage:
        """The same topology with its points moved by a function of all points."""
        creases = [(list(chain), sharpness) for chain, sharpness in self.creases]
        return ControlCage(
            place(self.points.copy()),
            list(self.faces),
            list(self.labels),
            list(self.holes),
            creases,
        )

    def edge_uses(self) -> Counter[tuple[int, int]]:
        """How often each directed edge is used; a consistent manifold uses each at most once."""
        uses: Counter[tuple[int, int]] = Counter()
        for face in self.faces:
            uses.update(zip(face, face[1:] + face[:1], strict=True))
        return uses

    def boundary_edge_count(self) -> int:
        """The number of edges with one face only."""
        uses = self.edge_uses()
        return sum((end, start) not in uses for start, end in uses)

    def valences(self) -> Counter[int]:
        """How many interior vertices have each valence."""
        uses = self.edge_uses()
        edges_at: Counter[int] = Counter()
        on_boundary: set[int] = set()
        for start, end in uses:
            edges_at[start] += 1
            if (end, start) not in uses:
                on_boundary.update((start, end))
        return Counter(n for vertex, n in edges_at.items() if vertex not in on_boundary)

    def check(self, closed: bool = False) -> ControlCage:
        """Raises CageError unless the cage is an oriented two-manifold of quads."""
        if any(len(set(face)) != 4 or len(face) != 4 for face in self.faces):
            raise CageError("a face is not a quad of four different vertices")
        if len(self.labels) != len(self.faces):
            raise CageError(f"{len(self.labels)} labels for {len(self.faces)} faces")
        repeated = [edge for edge, count in self.edge_uses().items() if count > 1]
        if repeated:
            raise CageError(f"{len(repeated)} directed edges are used twice, first {repeated[0]}")
        if closed and self.boundary_edge_count():
            raise CageError(f"a closed cage has {self.boundary_edge_count()} boundary edges")
        if set(range(len(self.points))) != {vertex for face in self.faces for vertex in face}:
            raise CageError("a point is used by no face")
        return self


class CageBuilder:
    """Collects faces whose vertices are named by keys, so that parts with equal keys are joined."""

    def __init__(self) -> None:
        self._index_of: dict[tuple[object, ...], int] = {}
        self._points: list[Points] = []
        self._faces: list[Face] = []
        self._labels: list[str] = []

    def vertex(self, key: tuple[object, ...], position: ArrayLike) -> int:
        """The index of the vertex with this key, made at this position when it is new."""
        if key not in self._index_of:
            self._index_of[key] = len(self._points)
            self._points.append(np.asarray(position, dtype=np.float64))
        return self._index_of[key]

    def face(self, vertices: Sequence[int], label: str) -> None:
        """Adds one face."""
        self._faces.append(tuple(vertices))
        self._labels.append(label)

    def build(self) -> ControlCage:
        """The cage that was collected."""
        return ControlCage(np.array(self._points), self._faces, self._labels)


def merge(cages: Sequence[ControlCage]) -> ControlCage:
    """One cage of several parts that share no vertex."""
    merged = ControlCage(np.concatenate([cage.points for cage in cages]), [], [])
    first_vertex = 0
    for cage in cages:
        first_face = len(merged.faces)
        merged.faces += [tuple(v + first_vertex for v in face) for face in cage.faces]
        merged.labels += cage.labels
        merged.holes += [face + first_face for face in cage.holes]
        for chain, sharpness in cage.creases:
            merged.creases.append(([v + first_vertex for v in chain], sharpness))
        first_vertex += len(cage.points)
    return merged


def sheet(
    columns: int, rows: int, place: Callable[[float, float], ArrayLike], label: str = "sheet"
) -> ControlCage:
    """An open grid of quads; place maps (0..1, 0..1) to a position."""
    points = [
        place(column / columns, row / rows)
        for row in range(rows + 1)
        for column in range(columns + 1)
    ]
    stride = columns + 1
    corners = [row * stride + column for row in range(rows) for column in range(columns)]
    faces: list[Face] = [(c, c + 1, c + stride + 1, c + stride) for c in corners]
    return ControlCage(np.array(points, dtype=np.float64), faces, [label] * len(faces))


def quad_sphere(segments: int, label: str = "sphere") -> ControlCage:
    """A unit sphere made of a cube's six grids: eight vertices of valence 3, all others 4."""
    builder = CageBuilder()
    steps = np.tan(np.linspace(-np.pi / 4, np.pi / 4, segments + 1))
    steps[[0, -1]] = (-1.0, 1.0)
    for axis in range(3):
        for sign in (-1.0, 1.0):
            _add_cube_side(builder, steps, axis, sign, label)
    return builder.build().turn_outward()


def _add_cube_side(builder: CageBuilder, steps: Points, axis: int, sign: float, label: str) -> None:
    def corner(i: int, j: int) -> int:
        position = np.empty(3)
        position[axis] = sign
        position[(axis + 1) % 3] = steps[i]
        position[(axis + 2) % 3] = steps[j]
        key = tuple(np.round(position, 6).tolist())
        return builder.vertex(key, position / np.linalg.norm(position))

    for i in range(len(steps) - 1):
        for j in range(len(steps) - 1):
            quad = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
            builder.face(quad if sign > 0 else quad[::-1], label)


def loft(
    rings: Points, cap_start: float | None = None, cap_end: float | None = None, label: str = "side"
) -> ControlCage:
    """A tube through closed rings, shape (rings, 4m, 3).

    A cap is an m by m grid of quads that bulges by the given distance; None leaves the end open.
    """
    ring_count, sides, _ = rings.shape
    points = [point for ring in rings for point in ring]
    faces: list[Face] = []
    for ring in range(ring_count - 1):
        for side in range(sides):
            here, there = ring * sides, (ring + 1) * sides
            after = (side + 1) % sides
            faces.append((here + side, here + after, there + after, there + side))
    labels = [label] * len(faces)
    caps = (
        (cap_start, 0, rings[0] - rings[1], "cap_start"),
        (cap_end, ring_count - 1, rings[-1] - rings[-2], "cap_end"),
    )
    for bulge, ring, outward, cap_label in caps:
        if bulge is None:
            continue
        direction = outward.mean(axis=0)
        direction /= np.linalg.norm(direction)
        cap = _cap_faces(points, range(ring * sides, ring * sides + sides), direction * bulge)
        faces += cap if ring else [face[::-1] for face in cap]
        labels += [cap_label] * len(cap)
    return ControlCage(np.array(points), faces, labels)


def _cap_faces(points: list[Points], ring: Sequence[int], bulge: Points) -> list[Face]:
    """Fills a ring of 4m vertices by an m by m grid (a Coons patch); new points are appended."""
    m = len(ring) // 4
    if len(ring) != 4 * m or m < 1:
        raise CageError(f"a cap needs a multiple of four vertices, not {len(ring)}")
    # The grid's corners lie at an eighth of the ring, so that its rows are level.
    start = m // 2
    index = np.empty((m + 1, m + 1), dtype=int)
    for k in range(m):
        index[k, 0] = ring[(start + k) % (4 * m)]
        index[m, k] = ring[(start + m + k) % (4 * m)]
        index[m - k, m] = ring[(start + 2 * m + k) % (4 * m)]
        index[0, m - k] = ring[(start + 3 * m + k) % (4 * m)]
    for i in range(1, m):
        for j in range(1, m):
            u, v = i / m, j / m
            edges = (1 - v) * points[index[i, 0]] + v * points[index[i, m]]
            edges = edges + (1 - u) * points[index[0, j]] + u * points[index[m, j]]
            corners = (1 - u) * (1 - v) * points[index[0, 0]] + u * v * points[index[m, m]]
            corners = (
                corners + u * (1 - v) * points[index[m, 0]] + (1 - u) * v * points[index[0, m]]
            )
            lift = bulge * (16.0 * u * (1 - u) * v * (1 - v)) ** 0.5
            index[i, j] = len(points)
            points.append(edges - corners + lift)
    cells = [(i, j) for i in range(m) for j in range(m)]
    return [
        (int(index[i, j]), int(index[i + 1, j]), int(index[i + 1, j + 1]), int(index[i, j + 1]))
        for i, j in cells
    ]


@dataclass
class ExtrudeStep:
    """Where one step of an extrusion puts the region: its centre, its direction and its size."""

    centre: ArrayLike
    direction: ArrayLike
    scale: float
    label: str = "extruded"


def extrude(cage: ControlCage, region: Sequence[int], steps: Sequence[ExtrudeStep]) -> ControlCage:
    """Pulls a region of faces out along a path; walls of quads follow. The cage is changed.

    Corners of the region become vertices of valence 5, as they do in a modeller's hands.
    """
    region = list(region)
    vertices = sorted({vertex for face in region for vertex in cage.faces[face]})
    base = cage.points[vertices]
    centre = base.mean(axis=0)
    normal = mean_normal(cage, region)
    flat = base - centre
    flat = flat - np.outer(flat @ normal, normal)
    rim = _rim(cage, region)
    current = {vertex: vertex for vertex in vertices}
    for step in steps:
        direction = np.asarray(step.direction, dtype=np.float64)
        direction = direction / np.linalg.norm(direction)
        turned = flat @ rotation_between(normal, direction).T
        placed = np.asarray(step.centre, dtype=np.float64) + step.scale * turned
        current = _add_wall(
            cage, rim, current, dict(zip(vertices, placed, strict=True)), step.label
        )
    for face in region:
        cage.faces[face] = tuple(current[vertex] for vertex in cage.faces[face])
    used = sorted({vertex for face in cage.faces for vertex in face})
    return _drop_unused(cage, used)


def _rim(cage: ControlCage, region: Sequence[int]) -> list[tuple[int, int]]:
    """The directed edges around a region of faces."""
    edges = [
        edge
        for face in region
        for edge in zip(cage.faces[face], cage.faces[face][1:] + cage.faces[face][:1], strict=True)
    ]
    inside = set(edges)
    return [(start, end) for start, end in edges if (end, start) not in inside]


def _add_wall(
    cage: ControlCage,
    rim: Sequence[tuple[int, int]],
    current: dict[int, int],
    placed: dict[int, Points],
    label: str,
) -> dict[int, int]:
    """Adds the points of one extrusion step and the ring of quads that leads to them."""
    first = len(cage.points)
    following = {vertex: first + offset for offset, vertex in enumerate(placed)}
    cage.points = np.concatenate([cage.points, np.array(list(placed.values()))])
    for start, end in rim:
        cage.faces.append((current[start], current[end], following[end], following[start]))
        cage.labels.append(label)
    return following


def _drop_unused(cage: ControlCage, used: Sequence[int]) -> ControlCage:
    """Removes points that no face uses any more."""
    new_index = {vertex: index for index, vertex in enumerate(used)}
    cage.points = cage.points[list(used)]
    cage.faces = [tuple(new_index[vertex] for vertex in face) for face in cage.faces]
    cage.creases = [([new_index[v] for v in chain], sharp) for chain, sharp in cage.creases]
    return cage


def mean_normal(cage: ControlCage, region: Sequence[int]) -> Points:
    """The mean direction in which a region of quads looks."""
    normal = np.zeros(3)
    for face in region:
        corners = cage.points[list(cage.faces[face])]
        normal += np.cross(corners[2] - corners[0], corners[3] - corners[1])
    return normal / np.linalg.norm(normal)


def rotation_between(start: ArrayLike, end: ArrayLike) -> Points:
    """The smallest rotation that takes one unit vector to another."""
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    axis, cosine = np.cross(a, b), float(np.dot(a, b))
    if cosine < -0.999999:
        helper = np.eye(3)[int(np.argmin(np.abs(a)))]
        axis = np.cross(a, helper)
        axis /= np.linalg.norm(axis)
        return 2.0 * np.outer(axis, axis) - np.eye(3)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + cross + cross @ cross / (1.0 + cosine)


def spline(knots: ArrayLike, count: int) -> Points:
    """Samples a Catmull-Rom curve through knots of any dimension at evenly spaced parameters."""
    knots = np.atleast_2d(np.asarray(knots, dtype=np.float64))
    padded = np.concatenate([[2 * knots[0] - knots[1]], knots, [2 * knots[-1] - knots[-2]]])
    samples = []
    for parameter in np.linspace(0.0, len(knots) - 1.0, count):
        span = min(int(parameter), len(knots) - 2)
        t = parameter - span
        p0, p1, p2, p3 = padded[span : span + 4]
        slope = (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2
        samples.append(p1 + 0.5 * (slope + (3 * p1 - p0 - 3 * p2 + p3) * t**3))
    return np.array(samples)


def tangents(path: Points) -> Points:
    """Unit tangents of a sampled path."""
    slopes = np.gradient(path, axis=0)
    return slopes / np.linalg.norm(slopes, axis=1, keepdims=True)


def blob_noise(points: Points, seed: int, scale: float) -> Points:
    """Smooth noise in -1..1, a sum of a few plane waves with seeded directions."""
    generator = np.random.default_rng(seed)
    total = np.zeros(len(points))
    for octave in range(5):
        wave = generator.normal(size=3) * scale * (1.0 + 0.45 * octave)
        total += np.sin(points @ wave + generator.uniform(0.0, 2.0 * np.pi)) / (1.0 + 0.5 * octave)
    return total / 3.0
