"""Writes features/irregular_cage.usda: an animal head such as a modeller leaves it.

Quads, triangles, pentagons and hexagons, vertices of valence 3 to 8, and two open eyes.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from mesh_kit import CageError, ControlCage, ExtrudeStep, Face, Points, extrude, quad_sphere
from numpy.typing import ArrayLike
from pxr import Usd
from stage_kit import (
    add_cage,
    add_camera,
    add_distant_light,
    colour_by_vertex,
    main_of,
    new_stage,
)

DOCUMENTATION = """An animal head: mostly quads, with a fan of triangles on the crown, pentagons
beside it and hexagons at the back. Extraordinary vertices have valences 3, 5, 6 and 8. The eyes are
open boundaries, round and smooth, through which one sees the inside of the head. HeadBehind is the
same cage, turned to show the n-gons. No seam and no bump shows where faces are irregular.
Written by generators/irregular_cage.py."""

FUR, MUZZLE, INNER_EAR = (0.55, 0.34, 0.20), (0.86, 0.70, 0.52), (0.80, 0.45, 0.40)


def unit(vector: ArrayLike) -> Points:
    """The vector at length one."""
    vector = np.asarray(vector, dtype=np.float64)
    return vector / np.linalg.norm(vector)


def block_facing(cage: ControlCage, direction: ArrayLike) -> list[int]:
    """The faces around the vertex that lies farthest in a direction."""
    reach = cage.points @ unit(direction) / np.linalg.norm(cage.points, axis=1)
    vertex = int(np.argmax(reach))
    return [index for index, face in enumerate(cage.faces) if vertex in face]


def pull(
    cage: ControlCage,
    region: Sequence[int],
    direction: ArrayLike,
    steps: Sequence[tuple[float, float]],
    wall: str,
    end: str,
) -> None:
    """Extrudes a region along one direction; each step is (distance, scale)."""
    vertices = sorted({vertex for face in region for vertex in cage.faces[face]})
    start, direction = cage.points[vertices].mean(axis=0), unit(direction)
    path = [ExtrudeStep(start + far * direction, direction, size, wall) for far, size in steps]
    extrude(cage, region, path)
    cage.relabel(region, end)


def head() -> ControlCage:
    """The cage, with its eyes cut out."""
    cage = quad_sphere(6, "fur")
    cage.points = cage.points * np.array([1.0, 0.94, 0.95])
    muzzle = [index for index in range(len(cage.faces)) if _on_muzzle(cage.face_centre(index))]
    steps = [(0.10, 0.92), (0.32, 0.78), (0.46, 0.5)]
    pull(cage, muzzle, (0, -0.2, 1), steps, "muzzle", "muzzle")
    for side in (-1.0, 1.0):
        ear = (0.78 * side, 0.66, -0.02)
        cup = [(0.08, 0.9), (0.30, 1.5), (0.38, 1.35), (0.30, 0.95), (0.16, 0.7)]
        pull(cage, block_facing(cage, ear), ear, cup, "ear", "ear")
        eye = (0.5 * side, 0.5, 0.82)
        pull(cage, block_facing(cage, eye), eye, [(0.07, 0.92), (0.03, 0.62)], "lid", "eye")
    cage = without(cage, cage.faces_labelled("eye"))
    crown = fan_of_triangles(cage, (0.0, 1.0, -0.1), quads=4)
    fan_of_triangles(cage, (0.0, 0.1, -1.0), quads=2)
    for triangle in (crown[0], crown[3]):
        make_pentagon(cage, triangle)
    merge_pairs(cage, wanted=8)
    return cage


def _on_muzzle(centre: Points) -> bool:
    """The lower middle of the sphere's front, four by four faces."""
    x, y, z = centre
    return bool(z > 0.0 and abs(x) < 0.6 * z and -1.0 * z < y < 0.26 * z)


def without(cage: ControlCage, removed: Sequence[int]) -> ControlCage:
    """The cage less some faces, and less the points that only they used."""
    kept = [index for index in range(len(cage.faces)) if index not in set(removed)]
    used = sorted({vertex for index in kept for vertex in cage.faces[index]})
    new_index = {vertex: index for index, vertex in enumerate(used)}
    faces = [tuple(new_index[vertex] for vertex in cage.faces[index]) for index in kept]
    return ControlCage(cage.points[used], faces, [cage.labels[index] for index in kept])


def fan_of_triangles(cage: ControlCage, direction: ArrayLike, quads: int) -> list[Face]:
    """Splits some quads around a vertex at it, one more edge each; returns half the triangles."""
    block = block_facing(cage, direction)
    vertex = set.intersection(*(set(cage.faces[face]) for face in block)).pop()
    for index in block[:quads]:
        face = cage.faces[index]
        turn = face.index(vertex)
        a, b, c, d = face[turn:] + face[:turn]
        cage.faces[index] = (a, b, c)
        cage.faces.append((a, c, d))
        cage.labels.append(cage.labels[index])
    return [cage.faces[index] for index in block[:quads]]


def make_pentagon(cage: ControlCage, triangle: Face) -> None:
    """Joins a triangle with the quad across the edge that its fan's centre does not touch."""
    neighbour = _neighbour(cage, triangle[1], triangle[2])
    _join(cage, cage.faces.index(triangle), neighbour)


def merge_pairs(cage: ControlCage, wanted: int) -> None:
    """Joins pairs of quads at the back of the head into hexagons that do not touch."""
    taken: set[int] = set()
    for index in range(len(cage.faces)):
        face = cage.faces[index]
        if wanted == 0:
            return
        if len(face) != 4 or cage.face_centre(index)[2] > -0.25 or taken & set(face):
            continue
        neighbour = _neighbour(cage, face[1], face[2])
        if len(cage.faces[neighbour]) == 4 and not taken & set(cage.faces[neighbour]):
            taken |= set(face) | set(cage.faces[neighbour])
            _join(cage, index, neighbour)
            wanted -= 1


def _neighbour(cage: ControlCage, start: int, end: int) -> int:
    """The face on the other side of a directed edge."""
    for index, face in enumerate(cage.faces):
        if (end, start) in zip(face, face[1:] + face[:1], strict=True):
            return index
    raise CageError(f"edge {start}, {end} lies on a boundary")


def _join(cage: ControlCage, first: int, second: int) -> None:
    """Makes one face of two that share an edge, in the first one's place."""
    kept, gone = cage.faces[first], cage.faces[second]
    for turn in range(len(kept)):
        face: Face = kept[turn:] + kept[:turn]
        if face[0] in gone and face[-1] in gone:
            after = gone.index(face[-1]) + 1
            between = (gone[after:] + gone[:after])[:-1]
            cage.faces[first] = face + tuple(v for v in between if v != face[0])
            cage.faces.pop(second)
            cage.labels.pop(second)
            return
    raise CageError(f"faces {first} and {second} share no edge")


def check(cage: ControlCage) -> str:
    """Raises CageError if the head is not what it says; returns its statistics as words."""
    if max(cage.edge_uses().values()) > 1:
        raise CageError("an edge is used twice in one direction")
    sizes = Counter(len(face) for face in cage.faces)
    if not {3, 4, 5, 6} <= set(sizes) or not {3, 5, 6, 8} <= set(cage.valences()):
        raise CageError(f"faces {dict(sizes)}, valences {dict(cage.valences())}")
    return f"{len(cage.faces)} faces {sorted(sizes.items())}"


def fur_colour(cage: ControlCage) -> Points:
    """Brown fur, a pale muzzle, pink ears."""
    colours = np.tile(FUR, (len(cage.points), 1))
    for face, label in zip(cage.faces, cage.labels, strict=True):
        if label in ("muzzle", "lid"):
            colours[list(face)] = MUZZLE
    for face, label in zip(cage.faces, cage.labels, strict=True):
        if label == "ear" and cage.points[list(face)].mean(axis=0)[2] > 0.12:
            colours[list(face)] = INNER_EAR
    return colours


def build() -> Usd.Stage:
    """The stage: two heads, one from the front and one from behind."""
    cage = head()
    check(cage)
    colour = colour_by_vertex(fur_colour(cage))
    stage = new_stage(DOCUMENTATION)
    for name, turn, where in (("Head", -22.0, (-1.7, 0, 0)), ("HeadBehind", 158.0, (1.7, 0, 0))):
        mesh = add_cage(stage, f"/World/{name}", cage, colour, double_sided=True)
        mesh.AddTranslateOp().Set(where)
        mesh.AddRotateYOp().Set(turn)
    add_distant_light(stage, "/World/Key", (-0.45, -0.8, -0.75), 2.2, (1.0, 0.96, 0.9))
    add_camera(stage, "/World/Camera", (0.0, 0.9, 8.5), (0.0, 0.1, 0.0), 52.0)
    return stage


if __name__ == "__main__":
    default = Path(__file__).resolve().parents[1] / "features" / "irregular_cage.usda"
    sys.exit(main_of(__doc__, build, default))
