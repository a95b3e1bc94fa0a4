"""Writes a large scene for benchmarks: a herd of lantern snails, no two alike, in deep rows.

Every snail has cages of its own, so nothing can be instanced.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from creatures import HERO_POSE, Part, ShellShape, SnailPose, snail
from garden import ground, pebbles, sky, toadstools
from pxr import Usd, UsdGeom
from stage_kit import (
    add_cage,
    add_camera,
    add_distant_light,
    add_sphere_light,
    new_stage,
    place,
    write_stage,
)

DOCUMENTATION = """A herd of lantern snails, each with cages of its own, from near to far.

For benchmarks: many holes, boundaries and extraordinary vertices, and faces of a few pixels beside
faces of a few hundred. Written by generators/herd.py."""

FEWEST_FACES = 10_000
SPACING = 7.0


def pose(generator: np.random.Generator) -> SnailPose:
    """The hero's pose with another neck: the head goes elsewhere, and neck and eyes follow."""
    spine = np.array(HERO_POSE.spine)
    shift = generator.uniform((-0.35, -0.7, -1.1), (0.35, 0.35, 0.5))
    follow = np.clip((np.arange(len(spine)) - 5.0) / 4.0, 0.0, 1.0) ** 1.5
    spine[:, :3] += follow[:, None] * shift
    tail = np.clip((4.0 - np.arange(len(spine))) / 4.0, 0.0, 1.0) ** 2
    spine[:, 2] += tail * generator.uniform(-1.6, 0.6)
    spine[:, 3:] *= generator.uniform(0.88, 1.12)
    reach = generator.uniform(-0.2, 0.2, size=(3, 3))
    return SnailPose(
        spine=spine,
        left_eye=np.array(HERO_POSE.left_eye) + shift + reach[0],
        right_eye=np.array(HERO_POSE.right_eye) + shift + reach[1],
        gaze=np.array(HERO_POSE.gaze) + shift + 4.0 * reach[2],
    )


def shell(generator: np.random.Generator) -> ShellShape:
    """A shell with other proportions and another number of windows."""
    return ShellShape(
        radius=generator.uniform(1.5, 2.0),
        growth=generator.uniform(1.9, 2.25),
        turns=generator.uniform(2.2, 2.8),
        cells_per_turn=int(generator.integers(18, 30)),
        end_angle=generator.uniform(-75.0, -50.0),
        apex=generator.uniform(0.2, 0.5),
        bulge=generator.uniform(0.3, 0.5),
    )


def standing_place(index: int, generator: np.random.Generator) -> tuple[float, float, float]:
    """The index-th place of rows that get longer with distance."""
    row, first = 0, 0
    while index >= first + row + 2:
        first, row = first + row + 2, row + 1
    column = index - first - (row + 1) / 2.0
    jitter = generator.uniform(-0.12, 0.12, size=2)
    return (SPACING * (column + jitter[0]), 0.0, -SPACING * (0.85 * row + jitter[1]))


def add_parts(stage: Usd.Stage, group: str, parts: list[Part], shade: float = 0.5) -> int:
    """Writes parts under a group; returns how many faces they have."""
    for part in parts:
        part.colour.values = shade * np.asarray(part.colour.values)
        add_cage(stage, f"{group}/{part.name}", part.cage, part.colour, part.double_sided)
    return sum(len(part.cage.faces) for part in parts)


def undergrowth(generator: np.random.Generator) -> list[Part]:
    """Toadstools and pebbles in the foreground."""
    spots = generator.uniform((-9.0, -6.0), (9.0, 4.5), size=(28, 2))
    stools = [(x, z, 0.5, generator.uniform(0.25, 0.4), 0.1) for x, z in spots[:10]]
    stones = [(x, z, generator.uniform(0.1, 0.4)) for x, z in spots[10:]]
    return [toadstools(stools), pebbles(stones)]


def build(faces: int) -> Usd.Stage:
    """A stage with about so many base faces."""
    generator = np.random.default_rng(64)
    stage = new_stage(DOCUMENTATION)
    UsdGeom.Xform.Define(stage, "/World/Backdrop")
    floor = ground(60, 60)
    floor.cage.points = floor.cage.points * np.array([3.0, 0.6, 4.0]) - (0.0, 0.15, 15.0)
    far = sky()
    far.cage.points = far.cage.points * 2.6
    total = add_parts(stage, "/World/Backdrop", [floor, far, *undergrowth(generator)])
    count = 0
    while total < faces or count == 0:
        group = UsdGeom.Xform.Define(stage, f"/World/Snail{count:04}")
        heading = (0.0, generator.uniform(-40.0, 40.0) + (180.0 if count % 3 == 2 else 0.0), 0.0)
        place(group, np.round(standing_place(count, generator), 3), np.round(heading, 2))
        total += add_parts(stage, str(group.GetPath()), snail(pose(generator), shell(generator)))
        count += 1
    light = "/World/Lights/"
    UsdGeom.Xform.Define(stage, "/World/Lights")
    add_distant_light(stage, light + "Moon", (0.6, -0.6, 0.35), 4.0, (0.55, 0.75, 1.0))
    add_distant_light(stage, light + "Fill", (0.3, -0.5, -1.0), 1.5, (0.8, 0.65, 0.9))
    add_sphere_light(stage, light + "NearLamp", (-2.0, 3.2, 4.0), 0.1, 120.0, (1.0, 0.6, 0.25))
    add_sphere_light(stage, light + "FarLamp", (3.0, 9.0, -24.0), 0.3, 2200.0, (1.0, 0.55, 0.2))
    add_camera(stage, "/World/Camera", (0.0, 5.2, 15.0), (0.0, 1.6, -6.0), 36.0)
    return stage


def face_number(text: str) -> int:
    """The argument of --faces."""
    number = int(text)
    if number < FEWEST_FACES:
        raise argparse.ArgumentTypeError(f"a herd has at least {FEWEST_FACES} faces")
    return number


def main() -> int:
    """Writes the file and says how large the scene is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path, metavar="OUT", help="a .usdc or .usda file")
    parser.add_argument(
        "--faces", type=face_number, default=100_000, metavar="N", help="about so many base faces"
    )
    options = parser.parse_args()
    return write_stage(build(options.faces), options.out)


if __name__ == "__main__":
    sys.exit(main())
