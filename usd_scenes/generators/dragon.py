"""Writes the creature for benchmarks: a drake as one closed mesh of about 12,000 faces.

It is modelled coarse, by a loft and extrusions, refined, studded with scales and refined again, as
a sculptor's base cage is: mostly regular, with extraordinary vertices wherever something grows out
of something else, and semi-sharp creases around claws, horns and lips.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from mesh_kit import (
    ControlCage,
    ExtrudeStep,
    Points,
    blob_noise,
    extrude,
    loft,
    mean_normal,
    spline,
    tangents,
)
from numpy.typing import ArrayLike
from pxr import Usd
from quad_mesh import QuadMesh, border_between, from_cage, refined, vertex_normals
from stage_kit import (
    add_camera,
    add_distant_light,
    add_quad_mesh,
    add_sphere_light,
    main_of,
    new_stage,
)

DOCUMENTATION = """A drake: one closed mesh of all quads, with extraordinary vertices of valence 3
and 5 at legs, claws, horns, spikes and scales, and semi-sharp creases at its hard parts.

For benchmarks. Written by generators/dragon.py."""

SIDES = 12
RINGS = 21
PALETTE = {
    "skin": (0.16, 0.36, 0.28),
    "belly": (0.62, 0.52, 0.30),
    "spike": (0.66, 0.24, 0.12),
    "horn": (0.72, 0.66, 0.52),
    "claw": (0.10, 0.09, 0.08),
    "mouth": (0.45, 0.08, 0.10),
    "eye": (0.95, 0.62, 0.05),
    "pupil": (0.02, 0.02, 0.02),
    "scale": (0.10, 0.25, 0.24),
}
HARD = ("claw", "horn", "mouth")
# x, y, z, half width, half height, from the tip of the tail to the snout
SPINE = (
    (2.05, 0.22, 2.75, 0.03, 0.03),
    (3.00, 0.20, 2.80, 0.10, 0.09),
    (4.05, 0.26, 2.25, 0.17, 0.16),
    (4.40, 0.38, 1.25, 0.26, 0.24),
    (4.00, 0.58, 0.40, 0.36, 0.36),
    (3.20, 0.92, 0.02, 0.50, 0.54),
    (2.40, 1.22, -0.05, 0.66, 0.72),
    (1.55, 1.32, 0.00, 0.72, 0.76),
    (0.70, 1.30, 0.05, 0.72, 0.78),
    (-0.15, 1.40, 0.05, 0.78, 0.90),
    (-0.90, 1.66, 0.00, 0.70, 0.86),
    (-1.45, 2.15, 0.00, 0.50, 0.62),
    (-1.75, 2.72, 0.02, 0.40, 0.46),
    (-2.00, 3.25, 0.08, 0.38, 0.42),
    (-2.40, 3.62, 0.18, 0.50, 0.48),
    (-2.95, 3.72, 0.30, 0.56, 0.46),
    (-3.50, 3.62, 0.42, 0.44, 0.36),
    (-4.00, 3.50, 0.54, 0.34, 0.28),
    (-4.35, 3.44, 0.62, 0.26, 0.20),
)


def body() -> ControlCage:
    """The tube from tail to snout, its back at the first side."""
    spine = spline(SPINE, RINGS)
    along = tangents(spine[:, :3])
    side = np.array([0.0, 0.0, 1.0]) - along * along[:, 2:3]
    # The tail turns towards z: sideways there is what is level and across.
    level = np.cross(along, (0.0, 1.0, 0.0)) * np.array([1.0, 1.0, 1.0])
    level /= np.linalg.norm(level, axis=1, keepdims=True)
    side = np.where(np.abs(along[:, 2:3]) > 0.25, -level, side)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    back = np.cross(side, along)
    back = np.where(back[:, 1:2] < -0.2, -back, back)
    angles = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    rings = [
        centre[:3]
        + np.outer(np.cos(angles), up) * centre[4]
        + np.outer(np.sin(angles), across) * centre[3]
        for centre, up, across in zip(spine, back, side)
    ]
    cage = loft(np.array(rings), cap_start=0.03, cap_end=0.10, label="skin").turn_outward()
    for span in range(RINGS - 1):
        cage.relabel([_face(span, 5), _face(span, 6)], "belly")
    return cage


def _face(span: int, side: int) -> int:
    return span * SIDES + side % SIDES


def _span_near(x: float, y: float | None = None) -> int:
    """The span of the body whose spine is nearest to x (and y)."""
    spine = spline(SPINE, RINGS)
    middle = 0.5 * (spine[1:] + spine[:-1])
    far = np.abs(middle[:, 0] - x) + (0.0 if y is None else np.abs(middle[:, 1] - y))
    far = far + 10.0 * (middle[:, 2] > 1.0)
    return int(np.argmin(far))


def _radius(cage: ControlCage, region: Sequence[int]) -> float:
    corners = cage.points[sorted({v for face in region for v in cage.faces[face]})]
    return float(np.mean(np.linalg.norm(corners - corners.mean(axis=0), axis=1)))


def grow(
    cage: ControlCage,
    region: Sequence[int],
    path: Points,
    sizes: Sequence[float],
    label: str,
    end: str | None = None,
) -> None:
    """Pulls a region out along a path; sizes are radii at the steps after the first point."""
    base = _radius(cage, region)
    steps = [
        ExtrudeStep(point, direction, size / base, label)
        for point, direction, size in zip(path[1:], tangents(path)[1:], sizes)
    ]
    extrude(cage, region, steps)
    cage.relabel(region, end or label)


def grow_leg(cage: ControlCage, span: int, side: int, knee: ArrayLike, foot: ArrayLike) -> None:
    """A leg from four faces of the flank: thigh, shin, ankle, foot, and two pairs of claws."""
    first = 3 if side > 0 else SIDES - 5
    region = [_face(s, k) for s in (span, span + 1) for k in (first, first + 1)]
    start = np.mean([cage.face_centre(face) for face in region], axis=0)
    knee, foot = np.asarray(knee), np.asarray(foot)
    ankle = foot + np.array([0.22, 0.30, 0.0])
    path = spline([start, 0.45 * start + 0.55 * knee, knee, ankle, foot], 6)
    grow(cage, region, path, (0.47, 0.38, 0.27, 0.20, 0.28), "skin")
    for face in sorted(region, key=lambda index: cage.face_centre(index)[0]):
        centre = cage.face_centre(face)
        spread = np.array([0.0, 0.0, 0.25 * np.sign(centre[2] - foot[2])])
        ahead = np.array([-1.0, 0.1, 0.0]) + spread
        reach = 0.30 if centre[0] < foot[0] else 0.16
        ahead = ahead if centre[0] < foot[0] else np.array([0.8, -0.1, 0.0]) + spread
        toe = centre + reach * ahead
        grow(cage, [face], np.array([centre, toe]), (0.12,), "skin")
        tip = toe + np.array([0.24 * ahead[0], -0.10, 0.24 * ahead[2]])
        grow(cage, [face], np.array([toe, tip]), (0.025,), "claw")


def grow_head(cage: ControlCage) -> None:
    """Mouth, eyes, horns and ears."""
    cap = cage.faces_labelled("cap_end")
    # The middle row of the snout's end, pushed in: lips, then a gullet.
    region = [cap[k] for k in (3, 4, 5)]
    into = -mean_normal(cage, region)
    start = np.mean([cage.face_centre(face) for face in region], axis=0)
    path = np.array([start + into * d for d in (0.0, 0.02, 0.45)])
    grow(cage, region, path, (0.17, 0.11), "mouth")
    cage.relabel([face for face in cap if face not in region], "skin")
    cage.relabel(cage.faces_labelled("cap_start"), "skin")

    head = _span_near(-2.9, 3.7)
    for side in (1, SIDES - 2):
        _grow_eye(cage, [_face(head, side)])
        outer = 2 if side == 1 else SIDES - 3
        horn = [_face(head - 1, side)]
        _grow_horn(cage, horn, np.array([0.9, 0.55, 0.35 if side == 1 else -0.35]), 1.05, 0.13)
        ear = [_face(head - 1, outer)]
        _grow_horn(cage, ear, np.array([0.55, 0.1, 0.75 if side == 1 else -0.75]), 0.6, 0.10)
        nostril = [_face(RINGS - 3, side)]
        out = mean_normal(cage, nostril)
        at = cage.face_centre(nostril[0])
        steps = [
            ExtrudeStep(at + 0.05 * out, out, 0.70, "skin"),
            ExtrudeStep(at - 0.02 * out, out, 0.40, "mouth"),
        ]
        extrude(cage, nostril, steps)
        cage.relabel(nostril, "mouth")


def _grow_eye(cage: ControlCage, region: Sequence[int]) -> None:
    """A brow around an eye around a pupil."""
    out = mean_normal(cage, region)
    start = cage.face_centre(region[0])
    steps = [
        ExtrudeStep(start + 0.07 * out, out, 0.95, "skin"),
        ExtrudeStep(start + 0.05 * out, out, 0.68, "skin"),
        ExtrudeStep(start + 0.11 * out, out, 0.62, "eye"),
        ExtrudeStep(start + 0.17 * out, out, 0.34, "eye"),
    ]
    extrude(cage, region, steps)
    cage.relabel(region, "pupil")


def _grow_horn(
    cage: ControlCage, region: Sequence[int], towards: Points, length: float, radius: float
) -> None:
    start = cage.face_centre(region[0])
    towards = towards / np.linalg.norm(towards)
    bend = np.array([0.0, 0.35, 0.0]) * length
    path = spline([start, start + 0.5 * length * towards, start + length * towards + bend], 5)
    grow(cage, region, path, radius * np.array((1.15, 0.85, 0.50, 0.12)), "horn")


def grow_spikes(cage: ControlCage) -> None:
    """A ridge of spikes from the neck to the end of the tail."""
    for span in range(3, RINGS - 6, 2):
        region = [_face(span, SIDES - 1), _face(span, 0)]
        start = np.mean([cage.face_centre(face) for face in region], axis=0)
        out = mean_normal(cage, region)
        size = _radius(cage, region)
        height = 0.9 * size + 0.18
        lean = np.array([0.35 * height, 0.0, 0.0])
        steps = [
            ExtrudeStep(start + 0.30 * height * out, out, 0.62, "spike"),
            ExtrudeStep(start + height * out + lean, out, 0.12, "spike"),
        ]
        extrude(cage, region, steps)
        cage.relabel(region, "spike")


def stud(cage: ControlCage, generator: np.random.Generator, count: int) -> None:
    """Raises scales out of single faces of the skin that do not touch each other."""
    centres = np.array([cage.face_centre(face) for face in range(len(cage.faces))])
    on_back = [face for face in cage.faces_labelled("skin") if 0.5 < centres[face][1] < 3.2]
    taken: set[int] = set()
    for face in generator.permutation(on_back):
        if count == 0:
            break
        region = [int(face)]
        if taken & set(cage.faces[region[0]]) or _radius(cage, region) < 0.08:
            continue
        taken |= set(cage.faces[region[0]])
        out, start = mean_normal(cage, region), centres[face]
        rise = 0.35 * _radius(cage, region)
        steps = [
            ExtrudeStep(start + 0.3 * rise * out, out, 0.82, "scale"),
            ExtrudeStep(start + rise * out, out, 0.52, "scale"),
        ]
        extrude(cage, region, steps)
        cage.relabel(region, "scale")
        count -= 1


def to_cage(mesh: QuadMesh) -> ControlCage:
    """The other way of quad_mesh.from_cage, for a mesh without tags."""
    names = list(PALETTE)
    faces = [tuple(int(v) for v in face) for face in mesh.faces]
    return ControlCage(mesh.points, faces, [names[colour] for colour in mesh.colours])


def drake() -> QuadMesh:
    """The whole animal."""
    cage = body()
    shoulder, hip = _span_near(-0.45), _span_near(2.5)
    for side in (1, -1):
        z = 1.0 * side
        grow_leg(cage, shoulder, side, (-0.35, 0.85, 1.05 * z), (-0.75, 0.10, 0.95 * z))
        grow_leg(cage, hip, side, (1.75, 0.85, 1.20 * z), (2.30, 0.10, 1.05 * z))
    grow_head(cage)
    grow_spikes(cage)
    cage = to_cage(refined(from_cage(cage.check(closed=True), list(PALETTE))))
    stud(cage, np.random.default_rng(12), 16)
    mesh = refined(from_cage(cage.check(closed=True), list(PALETTE)))
    soft = np.isin(mesh.colours, [list(PALETTE).index(name) for name in ("skin", "belly")])
    rough = np.zeros((len(mesh.points), 1))
    rough[mesh.faces[soft]] = 1.0
    wrinkles = 0.014 * blob_noise(mesh.points, 31, 5.0) + 0.007 * blob_noise(mesh.points, 32, 14.0)
    mesh.points = mesh.points + rough * wrinkles[:, None] * vertex_normals(mesh)
    mesh.crease_edges = np.concatenate(
        [border_between(mesh, list(PALETTE).index(name)) for name in HARD]
    )
    mesh.crease_sharpness = np.full(len(mesh.crease_edges), 2.5, np.float32)
    return mesh


def build() -> Usd.Stage:
    """The whole stage."""
    stage = new_stage(DOCUMENTATION)
    add_quad_mesh(stage, "/World/Drake", drake(), list(PALETTE.values()))
    add_distant_light(stage, "/World/Sun", (0.5, -0.8, -0.6), 3.0, (1.0, 0.94, 0.85))
    add_sphere_light(stage, "/World/Lamp", (-6.0, 5.0, 5.0), 0.2, 120.0, (0.6, 0.75, 1.0))
    add_camera(stage, "/World/Camera", (-9.6, 3.6, 6.2), (-0.60, 1.90, 0.40), 60.0, aspect=1.0)
    return stage


if __name__ == "__main__":
    default = Path(__file__).resolve().parents[2] / "build" / "bench" / "creature.usdc"
    sys.exit(main_of(__doc__, build, default))
