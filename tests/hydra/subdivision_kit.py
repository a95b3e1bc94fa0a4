"""Catmull-Clark subdivision, step by step as the rules say it: points of limit surfaces.

It shares nothing with the renderer, which makes no finer cages, and takes no trouble to be fast.
"""

from collections import defaultdict
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

INFINITE = 10.0
Edge = tuple[int, int]


def edge_of(a: int, b: int) -> Edge:
    """The edge between two vertices, whichever comes first."""
    return (a, b) if a < b else (b, a)


def sharper(sharpness: float) -> float:
    """What is left of a sharpness after a step."""
    return sharpness if sharpness >= INFINITE else max(sharpness - 1, 0.0)


@dataclass
class Cage:
    """A polygon mesh with its tags, and for each face the face of the first cage that it is in."""

    points: list[np.ndarray]
    faces: list[list[int]]
    origins: list[int]
    edges: dict[Edge, float] = field(default_factory=dict)
    corners: dict[int, float] = field(default_factory=dict)
    triangle_weight: float = 0.25

    def __post_init__(self) -> None:
        self.faces_of_edge: dict[Edge, list[int]] = defaultdict(list)
        self.faces_of_vertex: dict[int, list[int]] = defaultdict(list)
        for index, face in enumerate(self.faces):
            for a, b in zip(face, face[1:] + face[:1]):
                self.faces_of_edge[edge_of(a, b)].append(index)
                self.faces_of_vertex[a].append(index)
        self.edges_of_vertex: dict[int, list[Edge]] = defaultdict(list)
        for edge in self.faces_of_edge:
            for vertex in edge:
                self.edges_of_vertex[vertex].append(edge)

    def sharpness(self, edge: Edge) -> float:
        return INFINITE if len(self.faces_of_edge[edge]) == 1 else self.edges.get(edge, 0.0)

    def refined(self) -> "Cage":
        """The cage after one step."""
        centres = [np.mean([self.points[v] for v in face], axis=0) for face in self.faces]
        numbers = {edge: len(self.points) + i for i, edge in enumerate(self.faces_of_edge)}
        points = [self._vertex_point(v, centres) for v in range(len(self.points))]
        points += [self._edge_point(edge, centres) for edge in numbers] + centres
        first_centre = len(self.points) + len(numbers)
        faces, origins = [], []
        for index, face in enumerate(self.faces):
            for i, vertex in enumerate(face):
                after = numbers[edge_of(vertex, face[(i + 1) % len(face)])]
                before = numbers[edge_of(vertex, face[i - 1])]
                faces.append([vertex, after, first_centre + index, before])
                origins.append(self.origins[index])
        edges = {
            edge_of(vertex, numbers[edge]): sharper(sharpness)
            for edge, sharpness in self.edges.items()
            for vertex in edge
        }
        corners = {vertex: sharper(sharpness) for vertex, sharpness in self.corners.items()}
        return Cage(points, faces, origins, edges, corners)

    def _edge_point(self, edge: Edge, centres: list[np.ndarray]) -> np.ndarray:
        ends = self.points[edge[0]] + self.points[edge[1]]
        sharp = min(self.sharpness(edge), 1.0)
        if sharp == 1:
            return ends / 2
        around = self.faces_of_edge[edge]
        weights = [self.triangle_weight if len(self.faces[f]) == 3 else 0.25 for f in around]
        weight = sum(weights) / 2
        smooth = (0.5 - weight) * ends + weight * sum(centres[f] for f in around)
        return sharp * ends / 2 + (1 - sharp) * smooth

    def _vertex_point(self, vertex: int, centres: list[np.ndarray]) -> np.ndarray:
        sharp = {edge: self.sharpness(edge) for edge in self.edges_of_vertex[vertex]}
        own = self.corners.get(vertex, 0.0)
        now = self._by_rule(vertex, centres, own, sharp)
        left = {edge: sharper(value) for edge, value in sharp.items()}
        then = self._by_rule(vertex, centres, sharper(own), left)
        ending = [s for s in (own, *sharp.values()) if 0 < s <= 1]
        share = min(float(np.mean(ending)), 1.0) if ending else 1.0
        return share * now + (1 - share) * then

    def _by_rule(
        self, vertex: int, centres: list[np.ndarray], own: float, sharp: dict[Edge, float]
    ) -> np.ndarray:
        point = self.points[vertex]
        others = [self.points[sum(e) - vertex] for e, s in sharp.items() if s > 0]
        if own > 0 or len(others) > 2:
            return point
        if len(others) == 2:
            return (6 * point + others[0] + others[1]) / 8
        count = len(sharp)
        ends = np.mean([self.points[sum(edge) - vertex] for edge in sharp], axis=0)
        middles = np.mean([centres[f] for f in self.faces_of_vertex[vertex]], axis=0)
        return ((count - 2) * point + ends + middles) / count

    def limit(self, vertex: int) -> np.ndarray:
        """Where a vertex ends; all faces around it are quads, and sharpnesses 0 or infinite."""
        point = self.points[vertex]
        edges = self.edges_of_vertex[vertex]
        sharp = [self.points[sum(e) - vertex] for e in edges if self.sharpness(e) > 0]
        if self.corners.get(vertex, 0.0) > 0 or len(sharp) > 2:
            return point
        if len(sharp) == 2:
            return (4 * point + sharp[0] + sharp[1]) / 6
        count = len(edges)
        ends = sum(self.points[sum(edge) - vertex] for edge in edges)
        quads = [self.faces[f] for f in self.faces_of_vertex[vertex]]
        opposite = sum(self.points[quad[quad.index(vertex) - 2]] for quad in quads)
        return (count**2 * point + 4 * ends + opposite) / (count * (count + 5))

    def normal(self, vertex: int) -> np.ndarray:
        """About the unit normal at a vertex: that of the faces around it."""
        faces = (self.faces[face] for face in self.faces_of_vertex[vertex])
        corners = [[self.points[v][:3] for v in face] for face in faces]
        total = sum(np.cross(c[2] - c[0], c[-1] - c[1]) for c in corners)
        return np.asarray(total / np.linalg.norm(total))


def cage_of(stage: Usd.Stage, path: str, frame: Usd.TimeCode | None = None) -> Cage:
    """The cage of a mesh, with the creases and corners of its tags and its boundary rule."""
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath(path))
    when = Usd.TimeCode.Default() if frame is None else frame
    points = [np.array(point, float) for point in mesh.GetPointsAttr().Get(when)]
    indices = iter(mesh.GetFaceVertexIndicesAttr().Get(when))
    faces = [[next(indices) for _ in range(n)] for n in mesh.GetFaceVertexCountsAttr().Get(when)]
    smooth = mesh.GetTriangleSubdivisionRuleAttr().Get() == UsdGeom.Tokens.smooth
    corners = _pairs(mesh.GetCornerIndicesAttr(), mesh.GetCornerSharpnessesAttr(), when)
    cage = Cage(
        points,
        faces,
        list(range(len(faces))),
        _creases(mesh, when),
        corners,
        0.47 if smooth else 0.25,
    )
    if mesh.GetInterpolateBoundaryAttr().Get() == UsdGeom.Tokens.edgeAndCorner:
        alone = [v for v, around in cage.faces_of_vertex.items() if len(around) == 1]
        cage.corners.update(dict.fromkeys(alone, INFINITE))
    return cage


def _pairs(names: Usd.Attribute, values: Usd.Attribute, when: Usd.TimeCode) -> dict[int, float]:
    return dict(zip(names.Get(when) or (), values.Get(when) or ()))


def _creases(mesh: UsdGeom.Mesh, when: Usd.TimeCode) -> dict[Edge, float]:
    """Sharpnesses of edges, of which a crease has one for all, or one for each."""
    indices = iter(mesh.GetCreaseIndicesAttr().Get(when) or ())
    lengths = mesh.GetCreaseLengthsAttr().Get(when) or ()
    values = list(mesh.GetCreaseSharpnessesAttr().Get(when) or ())
    runs: list[Any] = [[next(indices) for _ in range(length)] for length in lengths]
    edges = [[edge_of(a, b) for a, b in zip(run, run[1:])] for run in runs]
    if len(values) == len(runs):
        values = [value for run, value in zip(edges, values) for _ in run]
    flat = [edge for run in edges for edge in run]
    return dict(zip(flat, map(float, values)))


@dataclass
class LimitPoint:
    """A point of a limit surface, with about the normal there, inside a face of the first cage."""

    face: int
    point: np.ndarray
    normal: np.ndarray


def limit_points(cage: Cage, steps: int) -> list[LimitPoint]:
    """Points inside the faces of a cage; semi-sharp edges must be smooth after the steps."""
    for _ in range(steps):
        cage = cage.refined()
    found = []
    for vertex, around in cage.faces_of_vertex.items():
        origins = {cage.origins[face] for face in around}
        if len(origins) == 1 and len(around) > 2:
            found.append(LimitPoint(origins.pop(), cage.limit(vertex), cage.normal(vertex)))
    return found
