"""What changes over time in usd_scenes/features: values that follow from the scenes themselves."""

import numpy as np
import pytest
from hydra_kit import assert_same
from limit_kit import LARGE, expect_limit, expect_other_limit
from pxr import Usd
from scene_kit import AOVS, Shot
from subdivision_kit import Cage, cage_of

SKIN = "/World/Arm/Skin"


def skinned(stage: Usd.Stage, frame: float) -> Cage:
    """The cage of the arm, with its points moved as linear blend skinning says."""
    bent = (5 - frame) / 4
    cage = cage_of(stage, SKIN)
    muscle = stage.GetPrimAtPath(f"{SKIN}/Muscle")
    weights = stage.GetPrimAtPath(SKIN).GetAttribute("primvars:skel:jointWeights").Get()
    for vertex, offset in zip(
        muscle.GetAttribute("pointIndices").Get(), muscle.GetAttribute("offsets").Get()
    ):
        cage.points[vertex] = cage.points[vertex] + bent * np.array(offset)
    angle, elbow = np.radians(75 * bent), np.array([0.0, 2.0, 0.0])
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    for vertex, point in enumerate(cage.points):
        share = weights[2 * vertex + 1]
        cage.points[vertex] = (1 - share) * point + share * (turn @ (point - elbow) + elbow)
    return cage


@pytest.mark.parametrize("frame", [1, 3, 5])
def test_skins_follow_their_joints_and_blend_shapes(frame: float) -> None:
    shot = Shot("skel", frame=frame, size=LARGE)
    expect_limit(shot, SKIN, skinned(shot.stage, frame), steps=2)
    if frame < 5:
        expect_other_limit(shot, SKIN, cage_of(shot.stage, SKIN), steps=2)


@pytest.mark.parametrize("scene", ["skel", "topology", "time"])
def test_one_view_shows_frames_as_views_of_their_own_do(scene: str) -> None:
    shot = Shot(scene, frame=1)
    for frame in (3, 2, 1):
        shot.go_to(frame)
        assert_same(shot.picture, Shot(scene, frame=frame).picture, AOVS)


@pytest.mark.parametrize(("frame", "faces"), [(1, 6), (2, 8), (3, 4)])
def test_topology_changes(frame: float, faces: int) -> None:
    shot = Shot("topology", frame=frame, size=LARGE, more_aovs=["primvars:displayColor"])
    path = "/World/Changing"
    cage = cage_of(shot.stage, path, shot.frame)
    assert len(cage.faces) == faces
    expect_limit(shot, path, cage)
    expect_limit(shot, "/World/Resting", steps=2)
    seen = shot.of(path)
    colors = np.array(shot.stage.GetPrimAtPath(path).GetAttribute("primvars:displayColor").Get())
    elements = shot["elementId"][seen]
    assert elements.max() < faces and len(np.unique(elements)) >= 3
    assert np.allclose(shot["primvars:displayColor"][seen], colors[elements % 3], atol=1e-3)


@pytest.mark.parametrize("frame", [1, 2, 4])
def test_frames_of_an_animation(frame: float) -> None:
    shot = Shot("time", frame=frame, size=LARGE, more_aovs=["primvars:displayColor"])
    for name in ("Growing", "Turning", "Blinking"):
        expect_limit(shot, f"/World/{name}")
    blinking = shot.at("primvars:displayColor", (3, 0, 0))
    share = (frame - 1) / 3
    red_to_green = (1 - share) * np.array([0.9, 0.2, 0.2]) + share * np.array([0.2, 0.8, 0.3])
    assert np.allclose(blinking, red_to_green, atol=1e-3)


def test_what_is_invisible_at_a_frame_is_not_there() -> None:
    shot = Shot("time", frame=3)
    assert shot.at("primId", (3, 0, 0)) == -1
    shot.go_to(4)
    assert shot.at("primId", (3, 0, 0)) >= 0
