"""Writes the city for benchmarks: about 1.8 million faces, one in seven of them a hole.

Every window is a hole in a smooth facade, through which one sees floors and lit rooms; courtyards
are holes in roofs. No crease is tagged: edges are kept tight by lines of vertices close to each
other, as modellers do it. Streets run from the viewer's feet to the horizon.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mesh_kit import Points, blob_noise, quad_sphere
from numpy.typing import ArrayLike
from pxr import Usd, UsdGeom
from quad_mesh import (
    QuadMesh,
    capped_tube,
    from_cage,
    from_grid,
    joined,
    repeated,
    turned_about_y,
)
from stage_kit import (
    add_camera,
    add_distant_light,
    add_quad_mesh,
    new_stage,
    write_stage,
)

DOCUMENTATION = """A city of smooth towers: every window is a hole face, with floors behind it, and
roofs of blocks have courtyards that are holes too.

For benchmarks: many holes, large faces beside tiny ones, and depth from the near street to the
skyline. Written by generators/city.py."""

COLOURS = {
    "asphalt": (0.045, 0.045, 0.055),
    "paving": (0.26, 0.25, 0.24),
    "line": (0.55, 0.52, 0.40),
    "grass": (0.11, 0.24, 0.06),
    "sand": (0.60, 0.48, 0.34),
    "brick": (0.42, 0.17, 0.11),
    "white": (0.66, 0.66, 0.63),
    "teal": (0.10, 0.34, 0.36),
    "rose": (0.58, 0.30, 0.28),
    "ochre": (0.58, 0.38, 0.12),
    "slate": (0.20, 0.23, 0.29),
    "roof": (0.15, 0.15, 0.17),
    "floor": (0.30, 0.28, 0.25),
    "dark": (0.05, 0.06, 0.08),
    "lit": (0.90, 0.62, 0.22),
    "leaf": (0.09, 0.25, 0.06),
    "bark": (0.16, 0.10, 0.06),
    "metal": (0.32, 0.33, 0.36),
    "red": (0.60, 0.05, 0.04),
    "blue": (0.05, 0.13, 0.45),
    "tyre": (0.02, 0.02, 0.02),
}
NAMES = list(COLOURS)
WALLS = ("sand", "brick", "white", "teal", "rose", "ochre", "slate")

#: Streets are a grid; a block is what lies between four of them.
BLOCK, STREET = 44.0, 16.0
PITCH = BLOCK + STREET
#: Columns of a bay and rows of a storey; one column is a pier, one row a spandrel, the rest holes.
BAY, STOREY = 3, 3
STOREY_HEIGHT = 3.4
BAY_WIDTH = 3.2


@dataclass
class Tower:
    """Where a tower stands, how it rises, and what its plan is like."""

    centre: tuple[float, float]
    half_width: tuple[float, float]
    storeys: int
    #: exponent of the superellipse that is its plan: 2 is an ellipse, 8 nearly a rectangle
    squareness: float
    #: how much smaller it is at its top, and how far it turns on the way, in radians
    taper: float
    twist: float
    #: rise of the roof's middle, in half widths
    dome: float
    wall: str


def number_of(name: str) -> int:
    """A colour's index in the palette."""
    return NAMES.index(name)


def plan(tower: Tower, columns: int) -> Points:
    """The unit plan (columns, 2): points of the superellipse at even distances, anticlockwise.

    A column lies in the middle of each pier, so that piers turn the corners.
    """
    fine = np.linspace(0, 2 * np.pi, 2049)
    c, s = np.cos(fine), np.sin(fine)
    power = 2.0 / tower.squareness
    x = tower.half_width[0] * np.sign(c) * np.abs(c) ** power
    z = tower.half_width[1] * np.sign(s) * np.abs(s) ** power
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(z)))])
    bays = columns // BAY
    # Within a bay: the pier is a fifth of it, its windows share the rest.
    steps = np.array([0.0, 0.24, 0.62])
    at = (np.arange(bays).reshape(-1, 1) + steps).ravel() / bays * along[-1]
    return np.stack([np.interp(at, along, x), -np.interp(at, along, z)], axis=1)


def bays_of(tower: Tower) -> int:
    """How many bays go round, a multiple of four so that the roof is a grid."""
    around = 3.4 * (tower.half_width[0] + tower.half_width[1])
    return max(8, 4 * round(around / BAY_WIDTH / 4))


def levels(tower: Tower) -> Points:
    """Heights of the rows: two of the base, three a storey, and the parapet."""
    storeys = np.arange(tower.storeys).reshape(-1, 1) + np.array([0.0, 0.30, 0.64])
    body = 4.2 + storeys.ravel() * STOREY_HEIGHT
    top = 4.2 + tower.storeys * STOREY_HEIGHT
    return np.concatenate([[-0.3, 3.9], body, [top, top + 0.25, top + 1.1, top + 1.2]])


def shell(tower: Tower) -> QuadMesh:
    """The outside: walls with windows as holes, a parapet and a roof."""
    bays = bays_of(tower)
    columns = bays * BAY
    rows = levels(tower)
    share = np.clip(rows / rows[-1], 0.0, 1.0)
    scale = 1.0 - tower.taper * share**1.5
    outline = plan(tower, columns)
    # Piers and spandrels stand out a little; the base is wider.
    normal = outline / np.linalg.norm(outline, axis=1, keepdims=True)
    relief = np.zeros((len(rows), columns))
    relief[2:-4, ::BAY] += 0.22
    relief[2:-4, 1::BAY] += 0.22
    body_rows = np.arange(len(rows) - 6) % STOREY
    relief[2:-4][body_rows < 2] += 0.16
    relief[:2] += 0.55
    relief[-4:-1] += 0.50
    rings = outline[None] * scale[:, None, None] + normal[None] * relief[..., None]
    rings = _twisted(rings, tower.twist * share)
    points = np.stack([_at_height(ring, height) for ring, height in zip(rings, rows)])
    # The parapet's inner edge and the roof behind it.
    rim = points[-1]
    middle = rim.mean(axis=0) * (1.0, 0.0, 1.0)
    for reach, drop in ((0.96, 0.0), (0.95, 1.0), (0.90, 1.05)):
        ring = middle + (rim - middle) * (reach, 1.0, reach) - (0.0, drop, 0.0)
        points = np.concatenate([points, ring[None]])
    lift = tower.dome * min(tower.half_width)
    mesh = capped_tube(points, lift, number_of(tower.wall), number_of("roof"))
    _cut_windows(mesh, tower, columns)
    if tower.dome > 0.3:
        mesh.colours[-((columns // 4) ** 2) :] = number_of(tower.wall)
    mesh.points[:, [0, 2]] += tower.centre
    return mesh


def _at_height(outline: Points, height: float) -> Points:
    """A plan (columns, 2) as a level ring (columns, 3)."""
    return np.insert(outline, 1, height, axis=1)


def _twisted(rings: Points, angles: Points) -> Points:
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x, z = rings[..., 0], rings[..., 1]
    return np.stack([c * x - s * z, s * x + c * z], axis=-1)


def _cut_windows(mesh: QuadMesh, tower: Tower, columns: int) -> None:
    """Tags as holes what is neither pier nor spandrel, and colours the bands between."""
    rows = 3 * tower.storeys
    face = np.arange(rows * columns).reshape(rows, columns)
    row = np.arange(rows).reshape(-1, 1) % STOREY
    column = np.arange(columns).reshape(1, -1) % BAY
    body = 2 * columns + face
    mesh.holes[body[(row > 0) & (column > 0)]] = True
    if tower.squareness < 4:
        mesh.colours[body[(row == 0) & (column >= 0)]] = number_of("white")
    # Doors and shop windows: the base is open between its piers.
    mesh.holes[columns + np.arange(columns)[np.arange(columns) % BAY > 0]] = False
    entrance = np.arange(columns)[(np.arange(columns) % (4 * BAY)) == 1]
    mesh.holes[entrance] = True
    mesh.colours[: 2 * columns] = number_of("slate")


def rooms(tower: Tower, generator: np.random.Generator) -> QuadMesh:
    """What one sees through the windows: a floor a storey, and walls that are lit or dark."""
    bays = bays_of(tower)
    rows = 4.2 + np.arange(tower.storeys + 1) * STOREY_HEIGHT - 0.12
    rows = np.concatenate([[0.1], rows])
    share = rows / levels(tower)[-1]
    outline = plan(tower, bays * BAY)[::BAY]
    scale = 1.0 - tower.taper * share**1.5
    rings = []
    for level, size, turn in zip(rows, scale, tower.twist * share):
        # Out along the floor, back to the core: a slab's edge close behind the facade.
        for reach, rise in ((0.80, 0.0), (0.965, 0.0), (0.965, 0.14), (0.80, 0.14)):
            ring = _twisted(reach * size * outline[None], np.array([turn]))[0]
            rings.append(_at_height(ring, level + rise))
    mesh = capped_tube(np.array(rings), 0.0, number_of("floor"), number_of("floor"))
    face = np.arange((len(rings) - 1) * bays).reshape(-1, bays)
    cores = face[3::4].ravel()
    lit = generator.uniform(size=cores.size) < 0.35
    mesh.colours[cores] = np.where(lit, number_of("lit"), number_of("dark"))
    mesh.points[:, [0, 2]] += tower.centre
    return mesh


def court(centre: tuple[float, float], storeys: int, wall: str, generator) -> list[QuadMesh]:
    """A block of flats around a courtyard, which is a hole in its roof; and the yard's walls."""
    half = 0.5 * BLOCK - 3.0
    tower = Tower(centre, (half, half), storeys, 9.0, 0.0, 0.0, 0.0, wall)
    outer = shell(tower)
    m = bays_of(tower) * BAY // 4
    roof = len(outer.faces) - m * m + np.arange(m * m).reshape(m, m)
    border = round(0.28 * m)
    outer.holes[roof[border:-border, border:-border]] = True
    inner = Tower(centre, (half * 0.44, half * 0.44), storeys, 9.0, 0.0, 0.0, 0.0, "sand")
    yard = shell(inner)
    # Seen from inside: turned round, without its roof, up to the rim of the hole.
    keep = slice(0, (2 + 3 * storeys) * bays_of(inner) * BAY)
    yard = QuadMesh(
        yard.points, yard.faces[keep, ::-1].copy(), yard.colours[keep], yard.holes[keep]
    )
    used, faces = np.unique(yard.faces, return_inverse=True)
    yard.points, yard.faces = yard.points[used], faces.reshape(-1, 4).astype(np.int32)
    return [outer, yard, rooms_ring(tower, generator)]


def rooms_ring(tower: Tower, generator: np.random.Generator) -> QuadMesh:
    """As rooms, for a building with a yard: a thinner ring of walls behind the facade, open."""
    mesh = rooms(tower, generator)
    bays = bays_of(tower)
    keep = slice(0, len(mesh.faces) - (bays // 4) ** 2)
    mesh = QuadMesh(mesh.points, mesh.faces[keep], mesh.colours[keep], mesh.holes[keep])
    used, faces = np.unique(mesh.faces, return_inverse=True)
    mesh.points, mesh.faces = mesh.points[used], faces.reshape(-1, 4).astype(np.int32)
    return mesh


def slab(half: ArrayLike, top: float, colour: str, round_corners: float = 12.0) -> QuadMesh:
    """A pavement or a lawn with rounded corners and a kerb."""
    flat = Tower((0, 0), (float(half[0]), float(half[1])), 0, round_corners, 0, 0, 0, colour)
    outline = plan(flat, 48)
    rings = []
    for reach, level in ((1.0, -0.2), (1.0, top - 0.03), (0.997, top), (0.96, top + 0.005)):
        rings.append(
            np.stack([reach * outline[:, 0], np.full(48, level), reach * outline[:, 1]], 1)
        )
    return capped_tube(np.array(rings), 0.0, number_of(colour), number_of(colour))


def tree() -> QuadMesh:
    """A street tree of unit height: a crown of noise over a thin trunk."""
    crown = quad_sphere(5, "leaf")
    lumps = 1.0 + 0.24 * blob_noise(crown.points, 3, 2.6)
    crown.points = crown.points * lumps[:, None] * (0.34, 0.36, 0.34) + (0.0, 0.66, 0.0)
    angles = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    circle = np.stack([np.cos(angles), 0 * angles, -np.sin(angles)], axis=1)
    rings = [r * circle + (0, y, 0) for r, y in ((0.045, -0.05), (0.03, 0.1), (0.026, 0.5))]
    trunk = capped_tube(np.array(rings), 0.0, number_of("bark"), number_of("bark"))
    return joined([from_cage(crown, NAMES), trunk])


def lamp() -> QuadMesh:
    """A street lamp: a post with a globe."""
    angles = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    circle = np.stack([np.cos(angles), 0 * angles, -np.sin(angles)], axis=1)
    profile = ((0.22, 0.0), (0.20, 0.3), (0.08, 0.45), (0.06, 2.0), (0.05, 5.0), (0.14, 5.1))
    rings = np.array([r * circle + (0, y, 0) for r, y in profile])
    globe = quad_sphere(3, "lit")
    globe.points = globe.points * 0.34 + (0.0, 5.4, 0.0)
    post = capped_tube(rings, 0.0, number_of("metal"), number_of("metal"))
    return joined([post, from_cage(globe, NAMES)])


def car() -> QuadMesh:
    """A rounded car, 4 m long along x, in the colour "red"."""
    along = np.array([-2.0, -1.98, -1.7, -0.9, -0.55, 0.5, 1.0, 1.85, 1.98, 2.0])
    top = np.array([0.55, 0.72, 0.86, 0.92, 1.38, 1.42, 0.95, 0.82, 0.66, 0.55])
    half = np.array([0.55, 0.72, 0.82, 0.86, 0.72, 0.72, 0.86, 0.82, 0.72, 0.55])
    angles = np.linspace(0, 2 * np.pi, 12, endpoint=False) + np.pi / 4
    c, s = np.cos(angles), np.sin(angles)
    square = np.stack([np.sign(c) * np.abs(c) ** 0.45, np.sign(s) * np.abs(s) ** 0.45], axis=1)
    rings = [
        np.stack(
            [np.full(12, x), 0.28 + (h - 0.28) * (0.5 + 0.5 * square[:, 1]), w * square[:, 0]], 1
        )
        for x, h, w in zip(along, top, half)
    ]
    start = np.repeat(np.array(rings[0]).mean(axis=0)[None], 12, axis=0)
    rings.insert(0, 0.9 * np.array(rings[0]) + 0.1 * start)
    end = np.array(rings[-1])
    rings.append(0.9 * end + 0.1 * end.mean(axis=0))
    body = capped_tube(np.array(rings), 0.0, number_of("red"), number_of("red"))
    face = np.arange(11 * 12).reshape(11, 12)
    glass = face[4:7, :]
    high = body.points[body.faces[glass.ravel()]].mean(axis=1)[:, 1] > 0.98
    body.colours[glass.ravel()[high]] = number_of("dark")
    wheel = quad_sphere(2, "tyre")
    spots = np.array([(x, 0.32, z) for x in (-1.25, 1.25) for z in (-0.78, 0.78)])
    wheel.points = wheel.points * (0.36, 0.36, 0.16)
    wheels = repeated(from_cage(wheel, NAMES), np.tile(np.eye(3), (4, 1, 1)), spots)
    return joined([body, wheels])


def towers_of_block(
    centre: tuple[float, float], far: float, generator: np.random.Generator
) -> list[Tower]:
    """One large tower, or two, or four smaller ones."""
    count = int(generator.choice((1, 2, 4), p=(0.25, 0.30, 0.45)))
    room = 0.5 * BLOCK - 2.0
    spots = {
        1: [(0.0, 0.0, 0.80, 0.80)],
        2: [(-0.5, 0.0, 0.42, 0.86), (0.5, 0.0, 0.42, 0.86)],
        4: [(x, z, 0.43, 0.43) for x in (-0.5, 0.5) for z in (-0.5, 0.5)],
    }[count]
    tallest = (26.0 - 10.0 * min(far, 1.0)) / (1.0 if count > 1 else 1.3)
    made = []
    for x, z, a, b in spots:
        is_round = generator.uniform() < 0.4
        made.append(
            Tower(
                (centre[0] + x * room, centre[1] + z * room),
                (a * room * generator.uniform(0.82, 1.0), b * room * generator.uniform(0.82, 1.0)),
                int(generator.uniform(0.30, 1.0) ** 1.3 * tallest / (1.0 if count > 1 else 1.3))
                + 3,
                generator.uniform(2.0, 3.0) if is_round else generator.uniform(6.0, 9.0),
                generator.uniform(0.0, 0.35) if is_round else generator.choice((0.0, 0.0, 0.2)),
                generator.uniform(-0.9, 0.9) if generator.uniform() < 0.2 else 0.0,
                generator.uniform(0.5, 1.1) if is_round else 0.0,
                str(generator.choice(WALLS)),
            )
        )
    return made


def street_life(centre: tuple[float, float], generator: np.random.Generator) -> list[QuadMesh]:
    """Trees and lamps along the kerbs of a block and cars beside them, one mesh each."""
    half = 0.5 * BLOCK + 1.8
    along = np.arange(-18.0, 18.1, 9.0)
    edges = np.array(
        [(t, side * half) for t in along for side in (-1, 1)]
        + [(side * half, t) for t in along for side in (-1, 1)]
    )
    spots = np.stack([edges[:, 0], np.full(len(edges), 0.12), edges[:, 1]], axis=1)
    spots = spots + np.array([centre[0], 0.0, centre[1]])
    turns = generator.uniform(0, 6.28, len(spots))
    trees = repeated(tree(), turned_about_y(turns, generator.uniform(4.5, 7.0, len(spots))), spots)
    poles = spots[::2] + np.array([2.5, 0.0, 2.5])
    lamps = repeated(lamp(), turned_about_y(np.zeros(len(poles))), poles)
    count = int(generator.integers(4, 9))
    side = generator.choice((-1, 1), count)
    lane = 0.5 * BLOCK + 0.5 * STREET - 3.4
    at = generator.uniform(-20.0, 20.0, count)
    turn = generator.integers(0, 2, count)
    x = np.where(turn == 0, at, side * (lane + 0.6))
    z = np.where(turn == 0, side * (lane + 0.6), at)
    places = np.stack([x + centre[0], np.full(count, 0.0), z + centre[1]], axis=1)
    cars = repeated(car(), turned_about_y(turn * np.pi / 2 + np.pi * (side > 0)), places)
    paint = generator.choice([number_of(name) for name in ("red", "blue", "white", "slate")], count)
    of_body = cars.colours == number_of("red")
    cars.colours = np.where(of_body, np.repeat(paint, len(car().faces)), cars.colours)
    return [trees, lamps, cars]


def park(centre: tuple[float, float], generator: np.random.Generator) -> list[QuadMesh]:
    """A lawn with trees and a dome of many openings."""
    lawn = slab((0.5 * BLOCK - 1, 0.5 * BLOCK - 1), 0.22, "grass", 5.0)
    lawn = lawn.placed(np.eye(3), (centre[0], 0.05, centre[1]))
    spots = generator.uniform(-18, 18, size=(30, 2))
    spots = spots[np.hypot(spots[:, 0], spots[:, 1]) > 9.5]
    places = np.stack(
        [spots[:, 0] + centre[0], np.full(len(spots), 0.2), spots[:, 1] + centre[1]], 1
    )
    sizes = generator.uniform(5.0, 9.0, len(spots))
    wood = repeated(tree(), turned_about_y(generator.uniform(0, 6, len(spots)), sizes), places)
    dome = Tower(centre, (7.5, 7.5), 2, 2.0, 0.1, 0.0, 0.9, "white")
    return [lawn, wood, shell(dome), rooms(dome, generator)]


def roads(columns: int, rows: int) -> list[QuadMesh]:
    """The ground below everything, and the broken lines in the middle of the streets."""
    x = (np.arange(-1, columns * 4 + 2) / 4 - columns / 2) * PITCH
    z = 30.0 - (np.arange(-4, rows * 4 + 2) / 4) * PITCH
    grid = np.stack([*np.broadcast_arrays(x[None], np.zeros((1, 1)), z[:, None])], axis=-1)
    ground = from_grid(grid, number_of("asphalt"))
    v, u = np.linspace(0, 2.4, 4).reshape(-1, 1), np.array([[-0.09, 0.09]])
    dash = from_grid(np.stack([u + 0 * v, 0.02 + 0 * (u + v), -v + 0 * u], -1), number_of("line"))
    streets = (np.arange(columns + 1) - columns / 2) * PITCH
    steps = 30.0 - np.arange(0, int(rows * PITCH), 5.0)
    at = np.stack([*np.meshgrid(streets, [0.0], steps, indexing="ij")], axis=-1).reshape(-1, 3)
    dashes = repeated(dash, np.tile(np.eye(3), (len(at), 1, 1)), at)
    return [ground, dashes]


def build(faces: int) -> Usd.Stage:
    """A stage with about so many base faces: blocks are added in rows from near to far."""
    generator = np.random.default_rng(18)
    stage = new_stage(DOCUMENTATION, 1.0)
    palette = list(COLOURS.values())
    total = 0

    def add(path: str, mesh: QuadMesh) -> None:
        nonlocal total
        add_quad_mesh(stage, f"/World/{path}", mesh, palette, double_sided=True)
        total += len(mesh.faces)

    pavement = slab((0.5 * BLOCK + 3.0, 0.5 * BLOCK + 3.0), 0.12, "paving")
    row = 0
    widest = 0
    while total < faces:
        across = 4 + 2 * ((row + 1) // 2)
        widest = max(widest, across)
        for column in range(across):
            if total >= faces:
                break
            centre = ((column + 0.5 - across / 2) * PITCH, -row * PITCH)
            group = f"Block{row:02}_{column:02}"
            UsdGeom.Xform.Define(stage, f"/World/{group}")
            add(f"{group}/Pavement", pavement.placed(np.eye(3), (centre[0], 0.0, centre[1])))
            for name, mesh in zip(("Trees", "Lamps", "Cars"), street_life(centre, generator)):
                add(f"{group}/{name}", mesh)
            kind = generator.uniform()
            if kind < 0.10 and row > 0:
                parts = park(centre, generator)
                for name, mesh in zip(("Lawn", "Wood", "Dome", "DomeRooms"), parts):
                    add(f"{group}/{name}", mesh)
            elif kind < 0.28:
                storeys = int(generator.integers(4, 8))
                parts = court(centre, storeys, str(generator.choice(WALLS)), generator)
                for name, mesh in zip(("Court", "Yard", "Rooms"), parts):
                    add(f"{group}/{name}", mesh)
            else:
                for number, tower in enumerate(towers_of_block(centre, row / 8, generator)):
                    add(f"{group}/Tower{number}", shell(tower))
                    add(f"{group}/Rooms{number}", rooms(tower, generator))
        row += 1
    for name, mesh in zip(("Ground", "Lines"), roads(widest, row)):
        add(name, mesh)
    UsdGeom.Xform.Define(stage, "/World/Lights")
    add_distant_light(stage, "/World/Lights/Sun", (0.55, -0.50, -0.66), 3.4, (1.0, 0.90, 0.74))
    add_distant_light(stage, "/World/Lights/Sky", (-0.5, -0.8, -0.2), 1.0, (0.50, 0.65, 1.0))
    camera = add_camera(stage, "/World/Camera", (26.0, 62.0, 92.0), (-6.0, 18.0, -60.0), 27.0, 1.0)
    camera.CreateClippingRangeAttr((0.5, 5000.0))
    return stage


def main() -> int:
    """Writes the file and says how large the scene is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path, metavar="OUT", help="a .usdc or .usda file")
    parser.add_argument(
        "--faces", type=int, default=1_800_000, metavar="N", help="about so many base faces"
    )
    options = parser.parse_args()
    return write_stage(build(options.faces), options.out)


if __name__ == "__main__":
    sys.exit(main())
