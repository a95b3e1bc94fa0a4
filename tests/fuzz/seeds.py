"""Writes the inputs that fuzzing begins with: meshes that are as they should be, and nearly so.

    python3 tests/fuzz/seeds.py FOLDER

The bytes mean what surfaceFuzz.cpp reads them as.
"""

import functools
import random
import sys
from collections.abc import Callable
from pathlib import Path

Face = tuple[int, ...]
Point = tuple[float, float, float]
Encode = Callable[..., bytes]

CUBE_POINTS = [
    ((i & 1) * 2 - 1.0, (i >> 1 & 1) * 2 - 1.0, (i >> 2 & 1) * 2 - 1.0) for i in range(8)
]
CUBE_FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def coordinate(value: float) -> int:
    """The byte that is read as a number: sixteenths around 127."""
    return min(max(round(value * 16) + 127, 0), 254)


def encode(
    points: list[Point],
    faces: list[Face],
    flags: int = 16,
    creases: tuple[tuple[Face, float], ...] = (),
    corners: tuple[tuple[int, float], ...] = (),
    holes: tuple[int, ...] = (),
    level: int = 2,
    other: int = 0,
) -> bytes:
    """A mesh and a packet of rays that looks at it, with packets and another kind of tracer."""
    data = [len(points)]
    for point in points:
        data += [coordinate(x) for x in point]
    data += [flags, len(faces)]
    for face in faces:
        data += [len(face), *face]
    data.append(len(creases))
    for vertices, sharpness in creases:
        data += [len(vertices), *vertices, coordinate(sharpness)]
    data.append(len(corners))
    for vertex, sharpness in corners:
        data += [vertex, coordinate(sharpness)]
    data += [len(holes), *holes, level + 4 * other]
    data += [63, coordinate(2.5), coordinate(3), coordinate(4)] + [127] * 64
    return bytes(data)


def sheet(size: int) -> tuple[list[Point], list[Face]]:
    """An open sheet of quads."""
    points = [(x - size / 2, y - size / 2, (x * y % 3) * 0.3) for y in range(size + 1)
              for x in range(size + 1)]  # fmt: skip
    corner = [y * (size + 1) + x for y in range(size) for x in range(size)]
    return points, [(a, a + 1, a + size + 2, a + size + 1) for a in corner]


def triangulated(faces: list[Face]) -> list[Face]:
    """Faces cut into triangles from their first corner on."""
    return [(face[0], face[i - 1], face[i]) for face in faces for i in range(2, len(face))]


def loop_seeds(encode: Encode) -> dict[str, bytes]:
    """Triangles under the Loop scheme."""
    points, quads = sheet(3)
    triangles = triangulated(quads)
    cube = triangulated(CUBE_FACES)
    loop = 4
    return {
        "loop": encode(CUBE_POINTS, cube, flags=16 + loop),
        "loop-sheet": encode(points, triangles, flags=16 + loop, level=3),
        "loop-edge-only": encode(points, triangles, flags=8 + loop, holes=(5,)),
        "loop-no-boundary": encode(points, triangles, flags=loop),
        "loop-creases": encode(
            CUBE_POINTS, cube, 16 + loop, (((0, 2, 3), 2.5), ((3, 7), 7.9)), ((5, 1.5),)
        ),
        "loop-chaikin": encode(CUBE_POINTS, cube, 48 + loop, (((0, 1, 5), 3), ((5, 4), 1))),
        "loop-darts": encode(points, triangles, 16 + loop, (((5, 6), 7.9), ((9, 10), 0.5))),
        "loop-fin": encode(CUBE_POINTS, [(0, 1, 2), (1, 0, 4), (0, 1, 7)], flags=16 + loop),
        "loop-bow-tie": encode(CUBE_POINTS, [(0, 1, 3), (0, 4, 6)], flags=16 + loop),
        "loop-pillow": encode(CUBE_POINTS, [(0, 1, 3), (3, 1, 0)], flags=144 + loop),
    }


def seeds(encode: Encode) -> dict[str, bytes]:
    """Meshes by name."""
    points, faces = sheet(3)
    pyramid = [(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)]
    return {
        "cube": encode(CUBE_POINTS, CUBE_FACES),
        "creases": encode(CUBE_POINTS, CUBE_FACES, creases=(((0, 1, 5, 4, 0)[:4], 2.5),)),
        "infinite": encode(CUBE_POINTS, CUBE_FACES, creases=(((0, 1, 5), 7.9), ((1, 3), 7.9))),
        "corners": encode(CUBE_POINTS, CUBE_FACES, corners=((0, 1.5), (7, 7.9))),
        "holes": encode(CUBE_POINTS, CUBE_FACES, holes=(1, 3)),
        "chaikin": encode(CUBE_POINTS, CUBE_FACES, 16 + 32, (((0, 1, 5), 3), ((5, 4), 1))),
        "sheet": encode(points, faces),
        "edge-only": encode(points, faces, flags=8, level=3),
        "no-boundary": encode(points, faces, flags=0),
        "bilinear": encode(points, faces, flags=6),
        "polygons": encode(CUBE_POINTS[:5], pyramid, flags=7),
        "triangles": encode(CUBE_POINTS[:5], pyramid, flags=16 + 64 + 128),
        "bow-tie": encode(CUBE_POINTS, [(0, 1, 3, 2), (0, 4, 6, 7)]),
        "three-on-an-edge": encode(CUBE_POINTS, [(0, 1, 3, 2), (0, 1, 5, 4), (1, 0, 6, 7)]),
        "collapsed": encode(CUBE_POINTS, [(0, 1, 3, 3), (0, 0, 5, 4), (1, 3, 1, 7)]),
        **loop_seeds(encode),
    }


def noise(count: int) -> dict[str, bytes]:
    """Bytes that are mostly small, so that they read as crowded topology."""
    chance = random.Random(1)
    made = {}
    for i in range(count):
        length = chance.choice([120, 300, 500])
        made[f"noise{i}"] = bytes(
            chance.randrange(256) if chance.random() < 0.4 else chance.randrange(40)
            for _ in range(length)
        )
    return made


def main() -> None:
    """Writes all seeds."""
    if len(sys.argv) != 2:
        raise SystemExit("usage: seeds.py FOLDER")
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    inputs = noise(40)
    for other, kind in enumerate(("single", "algorithm1", "tessellated")):
        for name, data in seeds(functools.partial(encode, other=other)).items():
            inputs[f"{name}-{kind}"] = data
    for name, data in inputs.items():
        (folder / name).write_bytes(data)


if __name__ == "__main__":
    main()
