"""Hole faces: invisible to every ray, and still shaping their neighbours."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import ALL_AOVS, CENTER_AOVS, add_distant_light, add_grid, make_stage, render
from pxr import Gf

SIZE = 5
HOLE = 12


def near(mask: np.ndarray) -> np.ndarray:
    """Pixels that are set or touch one that is."""
    padded = np.pad(mask, 1)
    rows, columns = mask.shape
    return np.any(
        [padded[y : y + rows, x : x + columns] for y in range(3) for x in range(3)], axis=0
    )


def render_grid(**attributes: Any) -> dict[str, np.ndarray]:
    stage = make_stage()
    add_grid(stage, size=SIZE, bump=0.6, **attributes)
    return render(stage, size=(64, 64))


@pytest.mark.parametrize("repeats", [1, 3])
def test_hole_is_in_no_aov_and_leaves_neighbours_alone(repeats: int) -> None:
    intact = render_grid()
    holed = render_grid(holeIndices=[HOLE] * repeats)
    gone = intact["elementId"] == HOLE
    assert gone.sum() > 100
    background = {"depth": 1, "primId": -1, "instanceId": -1, "elementId": -1, "normal": 0}
    for name, value in background.items():
        assert (holed[name][gone] == value).all(), name
    assert (holed["cameraDepth"][gone] == 0).all() and (holed["Neye"][gone] == 0).all()
    for name in CENTER_AOVS:
        assert (holed[name][~gone] == intact[name][~gone]).all(), name
    # Colour has samples all over a pixel, so only pixels away from the hole must be the same.
    away = ~near(gone)
    assert (holed["color"][away] == intact["color"][away]).all()
    assert (holed["color"][~near(~gone)] == 0).all()


def test_what_is_behind_a_hole_is_seen() -> None:
    stage = make_stage()
    add_grid(stage, "/Front", size=SIZE, holeIndices=[HOLE])
    add_grid(stage, "/Back").AddTranslateOp().Set(Gf.Vec3d(0, 0, -1))
    picture = render(stage)
    seen = picture["primId"] == 1
    assert seen[16, 16] and not seen[2, 2]
    assert np.allclose(picture["cameraDepth"][seen], 6, atol=1e-4)


def test_light_falls_through_a_hole() -> None:
    def picture(holes: list[int], *, shadows: bool) -> np.ndarray:
        stage = make_stage(light=False)
        add_distant_light(stage, shadows=shadows)
        # The blocker is behind the camera, out of sight but in the light's way.
        blocker = add_grid(stage, "/Blocker", size=SIZE, holeIndices=holes)
        blocker.AddTranslateOp().Set(Gf.Vec3d(0, 0, 7))
        add_grid(stage, "/Floor")
        return render(stage, samples=1)["color"][..., 0]

    lit = picture([], shadows=False)
    assert (picture([], shadows=True)[16, 16] < 0.5 * lit[16, 16]).all()
    through = picture([HOLE], shadows=True)
    assert through[16, 16] == lit[16, 16]
    assert through[2, 2] < 0.5 * lit[2, 2]


def test_only_holes_is_an_empty_mesh() -> None:
    empty = render(make_stage())
    stage = make_stage()
    add_grid(stage, size=2, holeIndices=[0, 1, 2, 3])
    picture = render(stage)
    for name in ALL_AOVS:
        assert (picture[name] == empty[name]).all(), name
