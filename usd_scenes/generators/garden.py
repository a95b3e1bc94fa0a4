"""What stands around the snails: ground, hills, sky, moon, toadstools, leaves, pebbles, a moth."""

from __future__ import annotations

import numpy as np
from creatures import CREAM, INK, PLUM, ROSE, TEAL, Part
from mesh_kit import ControlCage, Points, blob_noise, loft, merge, quad_sphere, sheet, spline
from numpy.typing import ArrayLike
from stage_kit import Colour, colour_by_label, colour_by_vertex

MOSS = (0.30, 0.42, 0.30)
EARTH = (0.70, 0.54, 0.48)
STONE = (0.50, 0.47, 0.52)


def ground_height(x: float, z: float) -> float:
    """A gently undulating floor that is flat where the hero stands and rises to the back."""
    away = min(1.0, (x * x / 30.0 + z * z / 6.0))
    waves = 0.20 * np.sin(0.55 * x + 0.4) * np.cos(0.48 * z) + 0.10 * np.sin(1.25 * x - 0.9 * z)
    return float(away * waves + 0.010 * max(0.0, -z - 3.0) ** 2)


def ground(columns: int = 48, rows: int = 36) -> Part:
    """The floor, wide enough to reach past the frame."""

    def place(u: float, v: float) -> Points:
        z = 7.5 - 25.0 * v
        x = (u - 0.5) * (16.0 + 22.0 * v)
        return np.array([x, ground_height(x, z), z])

    cage = sheet(columns, rows, place, "ground")
    patches = np.clip(0.5 + 0.8 * blob_noise(cage.points, 21, 0.9), 0.0, 1.0).reshape(-1, 1)
    far = np.clip((-cage.points[:, 2] - 2.0) / 14.0, 0.0, 1.0).reshape(-1, 1)
    colours = patches * np.array(MOSS) + (1 - patches) * np.array(EARTH)
    return Part("Ground", cage.check(), colour_by_vertex(colours * (1 - far) + far * HILLS[0]))


HILLS = (np.array((0.20, 0.27, 0.40)), np.array((0.25, 0.31, 0.50)), np.array((0.34, 0.37, 0.60)))


def hills(layer: int) -> Part:
    """One of three ranges behind each other, paler with distance."""
    depth = (-17.0, -23.0, -29.0)[layer]
    level = (2.3, 3.9, 5.0)[layer]

    def place(u: float, v: float) -> Points:
        x = (u - 0.5) * (44.0 + 10.0 * layer)
        crest = level + 1.1 * np.sin(0.33 * x + 1.9 * layer) + 0.45 * np.sin(0.81 * x + layer)
        return np.array([x, -1.0 + (crest + 1.0) * np.sin(v * np.pi / 2), depth - 1.5 * v * v])

    cage = sheet(40, 4, place, "hill").check()
    height = np.clip(cage.points[:, 1:2] / 6.0, 0.0, 1.0)
    colours = HILLS[layer] * (0.75 + 0.5 * height)
    return Part(f"Hills{layer + 1}", cage, colour_by_vertex(colours))


def sky() -> Part:
    """A curved backdrop from warm dusk at the horizon to indigo."""

    def place(u: float, v: float) -> Points:
        angle = (u - 0.5) * 1.5
        return np.array([48.0 * np.sin(angle), -2.0 + 18.5 * v, 2.0 - 42.0 * np.cos(angle)])

    cage = sheet(12, 8, place, "sky").check()
    height = np.clip((cage.points[:, 1] - 2.0) / 12.0, 0.0, 1.0)
    stops = [(0.98, 0.50, 0.38), (0.60, 0.33, 0.46), (0.20, 0.20, 0.40), (0.07, 0.09, 0.24)]
    channels = [np.interp(height, (0.0, 0.3, 0.62, 1.0), channel) for channel in zip(*stops)]
    return Part("Sky", cage, colour_by_vertex(np.stack(channels, axis=1)))


def moon(centre: ArrayLike, radius: float) -> Part:
    """A low moon with a few soft seas; flat, because the real one shows no shading either."""
    cage = quad_sphere(8, "moon").check(closed=True)
    seas = np.clip(blob_noise(cage.points, 8, 1.9) * 1.4, 0.0, 1.0).reshape(-1, 1)
    colours = (1 - 0.30 * seas) * np.array((1.0, 0.93, 0.74))
    cage = cage.moved(lambda points: np.asarray(centre) + radius * points * (1.0, 1.0, 0.12))
    return Part("Moon", cage, colour_by_vertex(colours))


def toadstool(root: ArrayLike, height: float, cap: float, lean: float, seed: int) -> ControlCage:
    """A toadstool whose cap is pierced by two rings of windows, like a small lantern."""
    generator = np.random.default_rng(seed)
    turn = generator.uniform(0.0, 2.0 * np.pi)
    around = np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False) + turn
    profile = [
        (0.20, 0.00), (0.15, 0.10), (0.11, 0.45), (0.12, 0.80), (0.16, 0.90), (0.62, 0.76),
        (0.92, 0.66), (1.00, 0.70), (0.97, 0.82), (0.80, 1.06), (0.58, 1.22), (0.34, 1.33),
        (0.14, 1.37),
    ]  # fmt: skip
    rings = []
    for index, (radius, level) in enumerate(profile):
        reach = radius * cap if index > 3 else radius * 0.75 * height
        twist = around + 0.06 * index
        rise = level * height if index < 4 else (0.9 + (level - 0.9) * cap / height) * height
        bend = lean * (rise / height) ** 2
        ring = np.stack([reach * np.cos(twist) + bend, np.full(16, rise), reach * np.sin(twist)], 1)
        rings.append(ring)
    cage = loft(np.array(rings), cap_start=0.0, cap_end=0.02, label="stem").turn_outward()
    cage.points = cage.points + np.asarray(root)
    bands = {4: "gills", 5: "gills", 6: "brim", 7: "brim", 8: "cap", 9: "cap", 10: "cap", 11: "cap"}
    for span, label in bands.items():
        cage.relabel(range(span * 16, span * 16 + 16), label)
    cage.relabel([8 * 16 + k for k in range(0, 16, 2)], "window")
    cage.relabel([10 * 16 + k for k in range(1, 16, 4)], "spot")
    cage.relabel(cage.faces_labelled("cap_end"), "cap")
    cage.relabel(cage.faces_labelled("cap_start"), "stem")
    cage.make_holes("window")
    return cage.check(closed=True)


TOADSTOOL_PALETTE = {
    "stem": CREAM,
    "gills": (0.98, 0.80, 0.62),
    "brim": CREAM,
    "cap": ROSE,
    "spot": CREAM,
    "window": ROSE,
}


def toadstools(places: ArrayLike, name: str = "Toadstools") -> Part:
    """A clump; each place is (x, z, height, cap radius, lean)."""
    parts = [
        toadstool((x, ground_height(x, z) - 0.03, z), height, cap, lean, seed)
        for seed, (x, z, height, cap, lean) in enumerate(np.asarray(places))
    ]
    cage = merge(parts)
    return Part(name, cage, colour_by_label(cage, TOADSTOOL_PALETTE), True)


def leaf(
    path: ArrayLike, width: float, droop: float, holed: bool, across: ArrayLike
) -> ControlCage:
    """A long open leaf along a path; a holed one is eaten through between its veins."""
    spine = spline(path, 15)
    across = np.asarray(across, dtype=np.float64)

    def place(u: float, v: float) -> Points:
        index = min(int(v * 14), 13)
        blend = v * 14 - index
        centre = (1 - blend) * spine[index] + blend * spine[index + 1]
        spread = width * np.sin(np.pi * (0.04 + 0.955 * v**0.8)) ** 0.75
        side = 2.0 * u - 1.0
        ripple = 0.06 * width * np.sin(v * 22.0) * side * side
        fold = droop * width * (abs(side) - 0.25 * side * side)
        return centre + across * side * spread + np.array([0.0, ripple - fold, 0.0])

    cage = sheet(6, 14, place, "blade")
    cage.relabel([row * 6 + column for row in range(14) for column in (2, 3)], "vein")
    if holed:
        eaten = [row * 6 + column for row in (4, 6, 8, 10) for column in (1, 4)]
        cage.relabel([*eaten, 7 * 6 + 1, 5 * 6 + 4], "bite")
        cage.make_holes("bite")
    return cage.check()


LEAF_PALETTE = {"blade": (0.12, 0.34, 0.26), "vein": (0.36, 0.56, 0.30), "bite": MOSS}


def pebbles(places: ArrayLike) -> Part:
    """Stones: quad spheres pushed about by noise; each place is (x, z, size)."""
    stones = []
    for seed, (x, z, size) in enumerate(np.asarray(places)):
        stone = quad_sphere(3, "stone")
        lumps = 1.0 + 0.16 * blob_noise(stone.points, 40 + seed, 1.6)
        shape = stone.points * lumps[:, None] * size * np.array([1.15, 0.66, 0.95])
        stone.points = shape + np.array([x, ground_height(x, z) + 0.28 * size, z])
        stones.append(stone.check(closed=True))
    cage = merge(stones)
    colours = np.array(STONE) * (0.85 + 0.3 * blob_noise(cage.points, 2, 0.8)[:, None])
    return Part("Pebbles", cage, colour_by_vertex(colours))


def moth(centre: ArrayLike, size: float) -> list[Part]:
    """A lamp moth: a ringed body and four open wings with an eye hole in each forewing."""
    profile = [(0.05, -0.75), (0.16, -0.6), (0.20, -0.35), (0.15, -0.05), (0.20, 0.12), (0.22, 0.3),
               (0.13, 0.46), (0.17, 0.6), (0.12, 0.76)]  # fmt: skip
    around = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
    circle = np.stack([np.zeros(8), np.cos(around), np.sin(around)], 1)
    axis = np.array([1.0, 0.0, 0.0])
    rings = np.array([radius * circle + along * axis for radius, along in profile])
    body = loft(rings, cap_start=0.05, cap_end=0.05, label="band").turn_outward()
    for span in range(0, 3):
        body.relabel(range(span * 8, span * 8 + 8), "glow")
    body.relabel(range(7 * 8, 8 * 8), "head")
    body.relabel(body.faces_labelled("cap_start"), "glow")
    body.relabel(body.faces_labelled("cap_end"), "head")
    wings = []
    for sign in (-1.0, 1.0):
        for back, reach, sweep in ((0.0, 1.25, 0.55), (0.32, 0.85, -0.55)):
            wings.append(_wing(sign, back, reach, sweep))
    wing = merge(wings)
    wing.make_holes("eye")
    turn = _turned(-0.75, 0.45)
    parts = []
    palette = {"band": PLUM, "glow": (0.95, 1.0, 0.45), "head": INK}
    for name, cage, colour in (
        ("MothBody", body.check(closed=True), colour_by_label(body, palette)),
        ("MothWings", wing.check(), colour_by_label(wing, WING_PALETTE)),
    ):
        moved = cage.moved(lambda points: size * points @ turn.T + np.asarray(centre))
        parts.append(Part(name, moved, colour, name == "MothWings"))
    return parts


WING_PALETTE = {"wing": (0.98, 0.42, 0.16), "edge": (0.40, 0.10, 0.22), "eye": TEAL}


def _wing(sign: float, back: float, reach: float, sweep: float) -> ControlCage:
    def place(u: float, v: float) -> Points:
        spread = reach * v
        chord = (u - 0.5) * (0.30 + 0.85 * np.sin(np.pi * min(1.0, 0.1 + 0.8 * v)))
        lift = spread * (0.42 - 0.15 * v)
        along = 0.25 - back + sweep * v * v * 0.8 + chord * 0.8
        return np.array([along, 0.1 + lift, sign * (0.12 + spread * 0.8)])

    cage = sheet(4, 5, place, "wing")
    cage.relabel([16, 17, 18, 19, 3, 7, 11, 15], "edge")
    cage.relabel([3 * 4 + 1], "eye")
    if sign < 0:
        cage.faces = [face[::-1] for face in cage.faces]
    return cage


def _turned(yaw: float, pitch: float) -> Points:
    c, s = np.cos(yaw), np.sin(yaw)
    about_y = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    c, s = np.cos(pitch), np.sin(pitch)
    return about_y @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def single_leaf(name: str, cage: ControlCage) -> Part:
    """A leaf as a prim of its own."""
    return Part(name, cage, colour_by_label(cage, LEAF_PALETTE), True)


def backdrop() -> list[Part]:
    """Ground, hills and sky."""
    return [ground(), hills(0), hills(1), hills(2), sky()]


def plain_colour(value: ArrayLike) -> Colour:
    """One colour for a whole prim."""
    return Colour("constant", [value])
