"""Writes hero.usda: a lantern snail meets a lamp moth at moonrise.

The lamp is inside the shell, so that every window throws its own light on the ground.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from creatures import Part, snail
from garden import backdrop, leaf, moon, moth, pebbles, single_leaf, toadstools
from pxr import Usd, UsdGeom
from stage_kit import (
    add_cage,
    add_camera,
    add_distant_light,
    add_sphere_light,
    main_of,
    new_stage,
)

DOCUMENTATION = """A lantern snail meets a lamp moth at moonrise.

All quads. The shell is one hollow surface that coils around itself; its windows are holeIndices,
and the lamp inside throws their pattern on the ground. Mouth, gills and eye sockets are holes too;
petals, hem, leaves and wings are open boundaries; the grooves of the shell are semi-sharp creases.
Written by generators/hero.py."""

# Recorders add a light of their own at the camera. Dark colours under strong lights keep it faint.
NIGHT = 0.42

MOTH = (-4.12, 3.72, 1.9)
TOADSTOOLS = [
    (2.75, -1.75, 1.75, 0.95, 0.22),
    (3.75, -2.35, 1.10, 0.62, 0.20),
    (1.85, -2.60, 0.85, 0.50, -0.15),
    (-3.85, -0.75, 0.62, 0.40, -0.14),
    (-4.35, -0.25, 0.36, 0.26, -0.06),
]
PEBBLES = [
    (-1.9, 1.75, 0.30), (-1.45, 2.05, 0.15), (-2.4, 2.3, 0.12), (1.6, 2.35, 0.22),
    (2.0, 2.05, 0.13), (3.6, 1.5, 0.34), (4.05, 1.95, 0.16), (-3.9, 1.5, 0.20),
    (-4.3, 1.9, 0.11), (0.1, 3.0, 0.12), (4.7, -0.9, 0.45), (-2.9, -1.6, 0.28),
]  # fmt: skip
FRONDS = {
    "LeafOver": ([(4.9, -0.2, -0.6), (4.75, 2.0, -0.6), (4.0, 3.75, -0.3), (2.75, 4.25, 0.2),
                  (1.75, 3.95, 0.6)], 0.52, 0.45, True, (0.25, 0.3, 0.92)),
    "LeafRight": ([(5.0, -0.2, 0.5), (4.9, 1.2, 0.8), (4.3, 2.3, 1.2), (3.6, 2.55, 1.6)],
                  0.30, 0.5, False, (0.5, 0.1, -0.85)),
    "LeafLeft": ([(-5.0, -0.2, -1.4), (-5.05, 1.3, -1.5), (-4.7, 2.3, -1.4), (-4.1, 2.75, -1.2)],
                 0.30, 0.5, True, (0.5, 0.2, 0.83)),
    "LeafLow": ([(-4.9, -0.2, -1.0), (-4.75, 0.6, -0.8), (-4.3, 1.0, -0.5), (-3.7, 1.0, -0.2)],
                0.22, 0.5, False, (0.35, 0.2, -0.9)),
}  # fmt: skip


def parts() -> dict[str, list[Part]]:
    """All prims, by the group they belong to."""
    plants = [single_leaf(name, leaf(*shape)) for name, shape in FRONDS.items()]
    return {
        "Snail": snail(),
        "Moth": moth(MOTH, 0.40),
        "Garden": [toadstools(TOADSTOOLS), pebbles(PEBBLES), *plants],
        "Backdrop": [*backdrop(), moon((-7.6, 9.0, -38.7), 4.6)],
    }


def build() -> Usd.Stage:
    """The whole stage."""
    stage = new_stage(DOCUMENTATION)
    for group, members in parts().items():
        UsdGeom.Xform.Define(stage, f"/World/{group}")
        for part in members:
            path = f"/World/{group}/{part.name}"
            if part.name != "Moon":
                part.colour.values = NIGHT * np.asarray(part.colour.values)
            add_cage(stage, path, part.cage, part.colour, part.double_sided)
    UsdGeom.Xform.Define(stage, "/World/Lights")
    light = "/World/Lights/"
    add_sphere_light(stage, light + "Lantern", (0.45, 2.2, 0.15), 0.05, 250.0, (1.0, 0.42, 0.10))
    add_sphere_light(stage, light + "MothGlow", (-3.75, 3.2, 2.3), 0.03, 30.0, (0.95, 1.0, 0.55))
    add_distant_light(stage, light + "MoonRim", (0.55, -0.62, 0.62), 5.5, (0.50, 0.76, 1.0))
    add_distant_light(stage, light + "DuskFill", (0.38, -0.42, -1.0), 1.5, (0.70, 0.62, 1.0))
    add_camera(stage, "/World/Camera", (-2.6, 2.0, 12.8), (-0.5, 2.12, 0.0), 46.0)
    return stage


if __name__ == "__main__":
    sys.exit(main_of(__doc__, build, Path(__file__).resolve().parents[1] / "hero.usda"))
