"""The lantern snail and what lives around it, as control cages.

Everything here is a function from a few numbers to a cage.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mesh_kit import (
    CageBuilder,
    ControlCage,
    ExtrudeStep,
    Points,
    blob_noise,
    extrude,
    loft,
    mean_normal,
    merge,
    quad_sphere,
    sheet,
    spline,
    tangents,
)
from numpy.typing import ArrayLike
from stage_kit import Colour, colour_by_label, colour_by_vertex

SIDES = 16
RINGS = 44
# Angles from the back of the body, denser around the lips.
HALF_ANGLES = (0.0, 22.5, 45.0, 67.5, 89.0, 103.0, 127.0, 154.0, 180.0)

CREAM = (0.93, 0.86, 0.70)
INK = (0.03, 0.03, 0.05)
COPPER = (0.86, 0.50, 0.26)
BRASS = (0.95, 0.74, 0.36)
PLUM = (0.34, 0.16, 0.30)
TEAL = (0.10, 0.42, 0.44)
MINT = (0.55, 0.86, 0.76)
ROSE = (0.88, 0.25, 0.36)
RUFF = ((0.85, 0.16, 0.42), (1.0, 0.56, 0.48))
GULLET = (0.30, 0.05, 0.11)


@dataclass
class Part:
    """One prim to be: a cage, its colour, and whether its back is seen."""

    name: str
    cage: ControlCage
    colour: Colour
    double_sided: bool = False


@dataclass
class ShellShape:
    """The numbers of a coiled lantern shell."""

    radius: float = 1.85
    growth: float = 2.05
    turns: float = 2.5
    cells_per_turn: int = 26
    end_angle: float = -62.0
    half_width: float = 0.27
    apex: float = 0.34
    bulge: float = 0.42


# Rows across one whorl: groove, rib, two rows of windows, rib, groove. Windows sit on even spans.
WHORL_ROWS = (0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
KEEL_ROWS = (0.0, 0.2, 0.5, 0.8, 1.0)


class LanternShell:
    """A hollow shell whose strips of faces follow a spiral; each window is a ring of eight quads.

    The outer edge of one whorl and the inner edge of the next share their vertices, so that the
    whole shell is one surface with one mouth. Window corners have valence 8 outside and 3 inside.
    """

    def __init__(self, shape: ShellShape) -> None:
        self.shape = shape
        self.per_turn = 2 * shape.cells_per_turn
        self.end = 2 * round(shape.turns * shape.cells_per_turn)
        self.rows = len(WHORL_ROWS) - 1
        self.builder = CageBuilder()

    def build(self) -> ControlCage:
        """The cage, with its windows as holes and a semi-sharp crease along each groove."""
        for side in (1, -1):
            self._add_whorls(side)
            self._add_apex(side)
        self._add_keel()
        chains = [
            [self._strip_vertex(side, a, 0) for a in range(self.per_turn, self.end + 1)]
            for side in (1, -1)
        ]
        cage = self.builder.build().turn_outward()
        cage.make_holes("window")
        cage.creases = [(chain, 1.5) for chain in chains]
        return cage

    def _flare(self, a: float) -> float:
        """Widens the shell toward the lip of its mouth."""
        toward_lip = np.clip((a - self.end + 7.0) / 7.0, 0.0, 1.0)
        return float(toward_lip**2)

    def _spiral(self, a: float, rho: float, z: float) -> Points:
        turn = (a - self.end) / self.per_turn * 2.0 * np.pi
        angle = np.radians(self.shape.end_angle) + turn
        return np.array([-rho * np.cos(angle), rho * np.sin(angle), z])

    def _groove(self, rho: float, side: int) -> float:
        shape = self.shape
        apex = shape.apex if side > 0 else 0.55 * shape.apex
        relative = rho / shape.radius
        return shape.radius * (shape.half_width * min(1.0, 0.35 + relative) + apex * (1 - relative))

    def _outer_radius(self, a: float) -> float:
        return self.shape.radius * self.shape.growth ** ((a - self.end) / self.per_turn)

    def _on_whorl(self, side: int, a: float, s: float) -> Points:
        """The whorl's surface at angle a and s = 0..1 from its inner to its outer groove."""
        outer = self._outer_radius(a)
        inner = outer / self.shape.growth
        rho = inner + s * (outer - inner)
        puff = np.sin(np.pi * s) ** 0.7 if 0.0 < s < 1.0 else 0.0
        lip = self._flare(a)
        bulge = self.shape.bulge * (outer - inner) * puff * (1.0 + 0.5 * lip)
        rho += 0.12 * self.shape.radius * lip * s * (s > 0.05)
        return self._spiral(a, rho, side * (self._groove(rho, side) + bulge))

    def _on_keel(self, a: float, s: float) -> Points:
        """The outer rim between both sides, s = 0 on the right and 1 on the left."""
        left, right = self._on_whorl(1, a, 1.0), self._on_whorl(-1, a, 1.0)
        point = (1 - s) * right + s * left
        outward = np.array([point[0], point[1], 0.0])
        outward /= np.linalg.norm(outward)
        return point + outward * np.sin(np.pi * s) * 0.16 * self._outer_radius(a)

    def _strip_vertex(self, side: int, a: int, row: int) -> int:
        if row == self.rows and a + self.per_turn <= self.end:
            a, row = a + self.per_turn, 0
        if row == 0 and a >= self.per_turn:
            position = self._on_whorl(side, a - self.per_turn, 1.0)
        else:
            position = self._on_whorl(side, a, WHORL_ROWS[row])
        return self.builder.vertex(("whorl", side, a, row), position)

    def _keel_vertex(self, a: int, row: int) -> int:
        if row == 0:
            return self._strip_vertex(-1, a, self.rows)
        if row == len(KEEL_ROWS) - 1:
            return self._strip_vertex(1, a, self.rows)
        return self.builder.vertex(("keel", a, row), self._on_keel(a, KEEL_ROWS[row]))

    def _add_whorls(self, side: int) -> None:
        def vertex(a: int, row: int) -> int:
            return self._strip_vertex(side, a, row)

        def surface(a: float, row: float) -> Points:
            return self._on_whorl(side, a, float(np.interp(row, range(7), WHORL_ROWS)))

        for a in range(0, self.end, 2):
            lip = a >= self.end - 2
            solid = lip or a < self.per_turn // 2
            for first_row in (0, 5):
                self._add_plain(vertex, a, first_row, "lip" if lip else "rib", side > 0)
            for first_row in (1, 3):
                if solid:
                    label = "lip" if lip else "apex"
                    self._add_plain(vertex, a, first_row, label, side > 0)
                    self._add_plain(vertex, a, first_row + 1, label, side > 0)
                else:
                    key = ("pane", side, a, first_row)
                    self._add_window(vertex, surface, key, a, first_row, side > 0)

    def _add_keel(self) -> None:
        def surface(a: float, row: float) -> Points:
            return self._on_keel(a, float(np.interp(row, range(5), KEEL_ROWS)))

        for a in range(self.end - self.per_turn, self.end, 2):
            lip = a >= self.end - 2
            for first_row in (0, 3):
                self._add_plain(self._keel_vertex, a, first_row, "lip" if lip else "rib", False)
            if lip:
                self._add_plain(self._keel_vertex, a, 1, "lip", False)
                self._add_plain(self._keel_vertex, a, 2, "lip", False)
            else:
                self._add_window(self._keel_vertex, surface, ("pane", 0, a), a, 1, False)

    def _add_plain(
        self, vertex: Callable[[int, int], int], a: int, row: int, label: str, forward: bool
    ) -> None:
        for step in (a, a + 1):
            quad = [vertex(step, row), vertex(step + 1, row)]
            quad += [vertex(step + 1, row + 1), vertex(step, row + 1)]
            self.builder.face(quad if forward else quad[::-1], label)

    def _add_window(
        self,
        vertex: Callable[[int, int], int],
        surface: Callable[[float, float], Points],
        key: tuple[object, ...],
        a: int,
        row: int,
        forward: bool,
    ) -> None:
        """A cell of two by two steps: a frame of eight quads around a window of four."""
        around = ((-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0))
        outer = [vertex(a + 1 + i, row + 1 + j) for i, j in around]
        inner = []
        for i, j in around:
            reach = 0.58 if i and j else 0.72
            position = surface(a + 1 + reach * i, row + 1 + reach * j)
            inner.append(self.builder.vertex((*key, i, j), position))
        centre = self.builder.vertex((*key, 0, 0), surface(a + 1, row + 1))
        for k in range(8):
            after = (k + 1) % 8
            quad = [outer[k], outer[after], inner[after], inner[k]]
            self.builder.face(quad if forward else quad[::-1], "frame")
        for k in range(0, 8, 2):
            quad = [inner[k - 1], inner[k], inner[k + 1], centre]
            self.builder.face(quad if forward else quad[::-1], "window")

    def _add_apex(self, side: int) -> None:
        """Closes the eye of the spiral by a fan of quads around one pole."""
        loop = [self._strip_vertex(side, a, 0) for a in range(self.per_turn + 1)]
        loop += [self._strip_vertex(side, 0, row) for row in range(self.rows - 1, 0, -1)]
        tip = self._on_whorl(side, 0, 0.5) * np.array([0.0, 0.0, 1.08])
        pole = self.builder.vertex(("apex", side), tip)
        for k in range(0, len(loop), 2):
            quad = [pole, loop[k], loop[k + 1], loop[(k + 2) % len(loop)]]
            self.builder.face(quad if side < 0 else quad[::-1], "apex")


SHELL_PALETTE = {
    "frame": COPPER,
    "rib": BRASS,
    "lip": CREAM,
    "apex": PLUM,
    "window": COPPER,
}


@dataclass
class SnailPose:
    """Where a snail's spine runs (x, y, z, half width, half height) and where its eyes reach."""

    spine: ArrayLike
    left_eye: ArrayLike
    right_eye: ArrayLike
    gaze: ArrayLike
    eye_size: tuple[float, float] = (0.25, 0.21)


HERO_POSE = SnailPose(
    spine=[
        (3.35, 0.10, 0.95, 0.04, 0.05),
        (2.75, 0.16, 0.55, 0.20, 0.13),
        (1.90, 0.26, 0.20, 0.38, 0.24),
        (0.90, 0.36, 0.00, 0.52, 0.36),
        (0.00, 0.42, 0.00, 0.54, 0.42),
        (-0.75, 0.46, 0.05, 0.50, 0.42),
        (-1.30, 0.74, 0.12, 0.42, 0.40),
        (-1.62, 1.28, 0.20, 0.35, 0.36),
        (-1.76, 1.86, 0.30, 0.33, 0.34),
        (-1.98, 2.34, 0.46, 0.44, 0.42),
        (-2.36, 2.62, 0.66, 0.52, 0.47),
        (-2.86, 2.70, 0.90, 0.45, 0.40),
        (-3.16, 2.74, 1.04, 0.30, 0.27),
    ],
    left_eye=(-2.42, 3.86, 1.24),
    right_eye=(-2.98, 3.52, 0.24),
    gaze=(-4.45, 3.75, 2.1),
)


def body_frames(spine: Points) -> tuple[Points, Points]:
    """The side and back directions at each sample of a spine."""
    along = tangents(spine[:, :3])
    side = np.array([0.0, 0.0, 1.0]) - along * along[:, 2:3]
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    return side, np.cross(along, side)


def body_rings(pose: SnailPose) -> Points:
    """The rings of the body from tail to snout; they are close at the lips, which smile."""
    spine = spline(pose.spine, RINGS)
    side, back = body_frames(spine)
    half = np.radians(HALF_ANGLES)
    circles = []
    for ring, (x, y, z, width, height) in enumerate(spine):
        place = ring - RINGS
        smile = np.radians(np.interp(place, (-9.0, -6.0, -1.0), (0.0, -26.0, 14.0)))
        closed = np.radians(np.interp(place, (-8.0, -6.0, -3.0), (0.0, -12.0, 0.0)))
        angles = half.copy()
        angles[3:7] += smile * np.array((0.4, 1.0, 1.0, 0.6)) + closed * np.array((0, 0, 1, 0.4))
        angles = np.concatenate([angles, 2 * np.pi - angles[-2:0:-1]])
        circle = np.array([x, y, z]) + np.outer(np.cos(angles), back[ring]) * height
        circle += np.outer(np.sin(angles), side[ring]) * width
        circle[:, 1] = np.maximum(circle[:, 1], 0.03)
        circles.append(circle)
    return np.array(circles)


def throat(pose: SnailPose) -> ControlCage:
    """What one sees through the mouth and the gills: a smaller body in the body."""
    rings = body_rings(pose)[RINGS - 25 :]
    centres = rings.mean(axis=1, keepdims=True)
    inner = centres + 0.86 * (rings - centres)
    inner[-1] -= 0.05 * (rings[-1] - rings[-4]).mean(axis=0)
    return loft(inner, cap_start=0.02, cap_end=0.04, label="throat").turn_outward()


def snail_body(pose: SnailPose) -> tuple[ControlCage, list[ExtrudeStep]]:
    """The body with its mouth and eye sockets as holes, and the last step of each eye stalk."""
    rings = RINGS
    circles = body_rings(pose)
    cage = loft(circles, cap_start=0.02, cap_end=0.10, label="skin").turn_outward()
    _cut_mouth(cage, rings)
    _cut_gills(cage, rings)
    ends = [
        _grow_stalk(cage, rings, 1, pose.left_eye, pose.gaze, pose.eye_size[0]),
        _grow_stalk(cage, rings, 13, pose.right_eye, pose.gaze, pose.eye_size[1]),
    ]
    for span in range(rings - 24, rings - 9, 2):
        _grow_crest(cage, span)
    _grow_feeler(cage, rings, 5, -1)
    _grow_feeler(cage, rings, 10, 1)
    cage.make_holes("mouth", "socket", "gill")
    return cage, ends


def _side_face(span: int, side: int) -> int:
    return span * SIDES + side % SIDES


def _cut_mouth(cage: ControlCage, rings: int) -> None:
    last = rings - 2
    cap = cage.faces_labelled("cap_end")
    cage.relabel(cap[8:12], "mouth")
    for span in range(last - 4, last + 1):
        cage.relabel([_side_face(span, 4), _side_face(span, 11)], "mouth")


def _cut_gills(cage: ControlCage, rings: int) -> None:
    for span in range(rings - 22, rings - 16, 2):
        for side in (3, 4, 5, 10, 11, 12):
            cage.relabel([_side_face(span, side)], "gill")


def _grow_stalk(
    cage: ControlCage, rings: int, side: int, eye: ArrayLike, gaze: ArrayLike, size: float
) -> ExtrudeStep:
    """Pulls an eye stalk out of the head; its end looks at the gaze and opens as a socket."""
    first = rings - 9
    region = [_side_face(span, s) for span in (first, first + 1) for s in (side, side + 1)]
    start = np.mean([cage.face_centre(face) for face in region], axis=0)
    corners = cage.points[sorted({v for face in region for v in cage.faces[face]})]
    base = float(np.mean(np.linalg.norm(corners - corners.mean(axis=0), axis=1)))
    eye, gaze = np.asarray(eye, dtype=np.float64), np.asarray(gaze, dtype=np.float64)
    looking = (gaze - eye) / np.linalg.norm(gaze - eye)
    back = eye - looking * size * 1.5
    rise = np.array([0.10, 0.45, 0.0]) * np.linalg.norm(eye - start)
    path = spline([start, start + rise, back - np.array([-0.12, 0.16, 0.0]), back, eye], 13)
    directions = tangents(path)
    sizes = np.interp(
        np.linspace(0, 1, 13),
        [0.0, 0.12, 0.55, 0.72, 0.80, 0.93, 1.0],
        [base * 0.9, 0.13, 0.095, 0.10, size * 1.05, size * 1.3, size * 0.98],
    )
    steps = [
        ExtrudeStep(point, direction, radius / base, "lid" if index > 9 else "stalk")
        for index, (point, direction, radius) in enumerate(
            zip(path, directions, sizes, strict=True)
        )
    ][1:]
    steps[-1].direction = looking
    extrude(cage, region, steps)
    cage.relabel(region, "socket")
    return ExtrudeStep(eye, looking, size)


def _grow_feeler(cage: ControlCage, rings: int, side: int, sign: int) -> None:
    """A short feeler below the cheek."""
    region = [_side_face(rings - 4, side)]
    start = cage.face_centre(region[0])
    forward = np.array([-0.30, -0.16, -0.10 - 0.18 * sign])
    path = spline([start, start + 0.5 * forward, start + forward + (0.0, 0.12, 0.0)], 6)
    sizes = (1.0, 0.62, 0.5, 0.46, 0.62, 0.3)
    steps = [
        ExtrudeStep(point, direction, scale * 0.75, "feeler")
        for point, direction, scale in zip(path, tangents(path), sizes, strict=True)
    ]
    extrude(cage, region, steps[1:])


def _grow_crest(cage: ControlCage, span: int) -> None:
    """One of the soft spines along the back of the neck."""
    region = [_side_face(span, SIDES - 1), _side_face(span, 0)]
    start = np.mean([cage.face_centre(face) for face in region], axis=0)
    out = mean_normal(cage, region)
    steps = [
        ExtrudeStep(start + 0.06 * out, out, 0.75, "crest"),
        ExtrudeStep(start + 0.15 * out, out, 0.55, "crest"),
        ExtrudeStep(start + 0.21 * out, out, 0.25, "crest"),
    ]
    extrude(cage, region, steps)
    cage.relabel(region, "crest")


def body_colour(cage: ControlCage) -> Colour:
    """Mint below, teal on the back, plum toward the tips, with soft freckles."""
    points = cage.points
    along = np.clip((points[:, 1] - 0.1) / 2.4, 0.0, 1.0)
    back = np.clip((blob_noise(points, 3, 2.4) + 0.25) * 1.1, 0.0, 1.0)
    colours = _mix(np.tile(MINT, (len(points), 1)), TEAL, 0.35 + 0.35 * back - 0.2 * along)
    freckles = np.clip(blob_noise(points, 11, 7.5) * 4.0 - 1.3, 0.0, 1.0)
    colours = _mix(colours, CREAM, 0.75 * freckles)
    low = np.clip((0.28 - points[:, 1]) / 0.25, 0.0, 1.0)
    colours = _mix(colours, CREAM, 0.7 * low)
    tips = np.zeros(len(points))
    for face, label in zip(cage.faces, cage.labels, strict=True):
        if label in ("lid", "feeler", "socket", "gill", "crest"):
            tips[list(face)] = 1.0
    return colour_by_vertex(_mix(colours, ROSE, 0.8 * tips))


def _mix(colours: Points, other: ArrayLike, amount: Points | float) -> Points:
    weight = np.clip(np.asarray(amount, dtype=np.float64), 0.0, 1.0).reshape(-1, 1)
    return colours * (1.0 - weight) + np.asarray(other) * weight


def eyeball(end: ExtrudeStep) -> ControlCage:
    """An eyeball of rings around its line of sight: pupil, iris, white."""
    looking = np.asarray(end.direction, dtype=np.float64)
    side = np.cross((0.0, 1.0, 0.0), looking)
    side /= np.linalg.norm(side)
    up = np.cross(looking, side)
    around = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    circle = np.outer(np.cos(around), up) + np.outer(np.sin(around), side)
    polar = np.radians((21.0, 31.0, 42.0, 54.0, 75.0, 100.0, 130.0))
    radius = 1.12 * end.scale
    rings = [radius * (np.cos(p) * looking + np.sin(p) * circle) for p in polar]
    centre = np.asarray(end.centre) - 0.52 * end.scale * looking
    cage = loft(np.array(rings) + centre, cap_start=0.10 * radius, cap_end=0.3 * radius)
    cage.relabel(range(SIDES), "pupil")
    cage.relabel(range(SIDES, 3 * SIDES), "iris")
    cage.relabel(cage.faces_labelled("cap_start"), "pupil")
    cage.relabel(cage.faces_labelled("side", "cap_end"), "white")
    return cage.turn_outward()


EYE_PALETTE = {"pupil": INK, "iris": (0.95, 0.55, 0.08), "white": (0.95, 0.93, 0.88)}


def catchlight(end: ExtrudeStep) -> ControlCage:
    """A small bead on the eye where a highlight would be."""
    looking = np.asarray(end.direction, dtype=np.float64)
    side = np.cross((0.0, 1.0, 0.0), looking)
    side /= np.linalg.norm(side)
    aim = looking + 0.22 * np.cross(looking, side) + 0.20 * side
    aim /= np.linalg.norm(aim)
    centre = np.asarray(end.centre) + (1.10 * aim - 0.52 * looking) * end.scale
    return quad_sphere(2, "bead").moved(lambda points: centre + 0.17 * end.scale * points)


def mantle(pose: SnailPose) -> ControlCage:
    """The ruffled hem of the foot: an open sheet on each side, from tail to throat."""
    spine = spline(pose.spine, 60)[3:36]
    side, _ = body_frames(spine)
    parts = []
    for sign in (-1.0, 1.0):

        def hem(u: float, v: float, sign: float = sign) -> Points:
            index = u * (len(spine) - 1)
            low = int(min(index, len(spine) - 2))
            blend = index - low
            centre = (1 - blend) * spine[low] + blend * spine[low + 1]
            out = (1 - blend) * side[low] + blend * side[low + 1]
            ease = np.sin(np.pi * (0.02 + 0.96 * u)) ** 0.6
            wave = np.sin(u * 62.0 + sign + 0.8 * np.sin(u * 17.0))
            reach = centre[3] * 0.80 + v * 0.36 * ease * (1.0 + 0.22 * wave)
            lift = (
                0.24 * ease * (1 - v) ** 1.6
                + 0.03
                + 0.015 * ease
                + v * v * ease * 0.10 * (1.0 + wave)
            )
            point = centre[:3] + sign * out * reach
            return np.array([point[0], centre[1] * 0.25 * ease * (1 - v) + lift, point[2]])

        part = sheet(64, 4, hem, "hem")
        if sign > 0:
            part.faces = [face[::-1] for face in part.faces]
        parts.append(part)
    return merge(parts)


def hem_colour(cage: ControlCage) -> Colour:
    """Rose at the hem's edge, mint where it meets the body."""
    outward = np.tile(np.repeat(np.linspace(0.0, 1.0, 5), 65), 2)
    return colour_by_vertex(_mix(np.tile(MINT, (len(cage.points), 1)), ROSE, outward**1.5))


def petal(
    root: ArrayLike, out: ArrayLike, up: ArrayLike, length: float, width: float, curl: float
) -> ControlCage:
    """A cupped, open petal that leaves its root along up and curls toward out."""
    root, out, up = (np.asarray(value, dtype=np.float64) for value in (root, out, up))
    across = np.cross(up, out)
    across /= np.linalg.norm(across)

    def place(u: float, v: float) -> Points:
        bend = curl * v
        spread = width * (0.30 + 0.95 * np.sin(np.pi * min(1.0, 0.12 + 0.80 * v)) ** 1.2)
        cup = 0.35 * spread * (2 * u - 1) ** 2
        travel = length * (np.sin(bend) * out + (1 - 0.35 * v * curl) * v * up)
        tip = 0.20 * length * v**3 * (1 - (2 * u - 1) ** 2)
        return root + travel * 0.9 + across * (2 * u - 1) * spread + (up + out) * cup + out * tip

    return sheet(4, 6, place, "petal")


def collar(pose: SnailPose, seed: int = 5) -> ControlCage:
    """Petals around the neck, larger behind the head, no two alike."""
    spine = spline(pose.spine, 60)
    station = 42
    side, back = body_frames(spine)
    along = tangents(spine[:, :3])[station]
    generator = np.random.default_rng(seed)
    petals = []
    for layer, count in ((0, 8), (1, 6)):
        for k in range(count):
            angle = 2.0 * np.pi * (k + 0.5 * layer) / count + generator.uniform(-0.12, 0.12)
            out = np.cos(angle) * back[station] + np.sin(angle) * side[station]
            radius = spine[station, 3] * (0.86 - 0.06 * layer)
            root = spine[station, :3] + out * radius - along * (0.10 - 0.16 * layer)
            behind = 0.5 + 0.5 * np.cos(angle)
            length = (0.66 + 0.50 * behind) * generator.uniform(0.85, 1.15) * (1 - 0.22 * layer)
            curl = 1.0 + 0.35 * generator.uniform(-1.0, 1.0) - 0.25 * behind
            petals.append(petal(root, out, along * 0.75, length, 0.34 * length**0.5, curl))
    return merge(petals)


def petal_colour(cage: ControlCage, inner: ArrayLike, outer: ArrayLike) -> Colour:
    """One colour at the root of each petal, another at its tip; one value a face corner."""
    count = len(cage.points) // 35
    along = np.tile(np.repeat(np.linspace(0.0, 1.0, 7), 5), count)
    values = _mix(np.tile(np.asarray(inner), (7, 1)), outer, np.linspace(0.0, 1.0, 7) ** 1.3)
    steps = np.round(along * 6).astype(int)
    return Colour("faceVarying", values, [steps[v] for face in cage.faces for v in face])


def snail(
    pose: SnailPose = HERO_POSE,
    shell: ShellShape | None = None,
    shell_centre: ArrayLike = (0.45, 2.24, -0.05),
    lean: float = 0.16,
) -> list[Part]:
    """All parts of a lantern snail."""
    body, ends = snail_body(pose)
    house = (
        LanternShell(shell or ShellShape())
        .build()
        .moved(lambda points: _leaned(points, lean) + np.asarray(shell_centre))
    )
    hem, ruff, gullet = mantle(pose), collar(pose), throat(pose)
    eyes = merge([eyeball(end) for end in ends])
    beads = merge([catchlight(end) for end in ends])
    return [
        Part("Body", body.check(), body_colour(body), True),
        Part("Throat", gullet.check(closed=True), Colour("constant", [GULLET])),
        Part("Mantle", hem.check(), hem_colour(hem), True),
        Part("Shell", house.check(), colour_by_label(house, SHELL_PALETTE), True),
        Part("Collar", ruff.check(), petal_colour(ruff, *RUFF), True),
        Part("Eyes", eyes.check(closed=True), colour_by_label(eyes, EYE_PALETTE)),
        Part("Catchlights", beads.check(closed=True), Colour("constant", [(1.0, 1.0, 1.0)])),
    ]


def _leaned(points: Points, lean: float) -> Points:
    """Tips the shell about the x axis, away from the viewer."""
    c, s = np.cos(lean), np.sin(lean)
    return points @ np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]).T
