"""Writes a herd of drakes: instances of one mesh, as many as are asked for."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from dragon import PALETTE, drake
from pxr import Sdf, Usd, UsdGeom, Vt
from stage_kit import add_camera, add_distant_light, add_quad_mesh, new_stage, write_stage

DOCUMENTATION = """A herd: instances of one drake of 12 thousand base faces, as far as one sees.

For benchmarks. Written by generators/herd.py."""

#: Between neighbours of the grid that they stand on, before each strays from it.
DISTANCE, STRAY = 10.0, 3.0


def places(count: int, random: np.random.Generator) -> np.ndarray:
    """Points on the ground, from the camera's feet away from it."""
    wide = int(np.ceil(np.sqrt(count)))
    across, away = np.arange(count) % wide - wide // 2, np.arange(count) // wide
    points = np.stack([across, np.zeros(count), -away], axis=-1) * DISTANCE
    return points + random.uniform(-STRAY, STRAY, points.shape) * (1, 0, 1)


def add_herd(stage: Usd.Stage, count: int) -> None:
    """A point instancer with its prototype below it."""
    random = np.random.default_rng(7)
    herd = UsdGeom.PointInstancer.Define(stage, "/World/Herd")
    add_quad_mesh(stage, "/World/Herd/Drake", drake(), list(PALETTE.values()))
    herd.CreatePrototypesRel().SetTargets([Sdf.Path("/World/Herd/Drake")])
    herd.CreateProtoIndicesAttr(Vt.IntArray.FromNumpy(np.zeros(count, np.int32)))
    points = places(count, random).astype(np.float32)
    herd.CreatePositionsAttr(Vt.Vec3fArray.FromNumpy(points))
    half = random.uniform(0, np.pi, count)
    turns = np.zeros((count, 4), np.float16)  # i j k and the real part
    turns[:, 1], turns[:, 3] = np.sin(half), np.cos(half)
    herd.CreateOrientationsAttr(Vt.QuathArray.FromNumpy(turns))
    sizes = np.repeat(random.uniform(0.6, 1.2, (count, 1)), 3, axis=1).astype(np.float32)
    herd.CreateScalesAttr(Vt.Vec3fArray.FromNumpy(sizes))


def build(count: int) -> Usd.Stage:
    """The whole stage."""
    stage = new_stage(DOCUMENTATION)
    add_herd(stage, count)
    add_distant_light(stage, "/World/Sun", (0.5, -0.8, -0.6), 3.0, (1.0, 0.94, 0.85))
    camera = add_camera(stage, "/World/Camera", (0, 40, 30), (0, 0, -60), 28.0)
    camera.GetClippingRangeAttr().Set((0.1, 100000.0))
    return stage


def main() -> int:
    """Writes the file and says how large the scene is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path, metavar="OUT", help="a .usdc or .usda file")
    parser.add_argument("--count", type=int, default=1000, help="instances; default: 1000")
    options = parser.parse_args()
    return write_stage(build(options.count), options.out)


if __name__ == "__main__":
    sys.exit(main())
