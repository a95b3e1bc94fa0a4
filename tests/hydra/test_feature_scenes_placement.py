"""Where prims of usd_scenes/features are, and which of them are shown: instances and purposes."""

import numpy as np
import pytest
from hydra_kit import assert_same
from limit_kit import LARGE, expect_limit
from pxr import UsdGeom, UsdImagingGL
from scene_kit import AOVS, COLOR, Shot, attribute
from subdivision_kit import cage_of, limit_points


@pytest.fixture(scope="module")
def instances() -> Shot:
    return Shot("instances", size=(360, 240), more_aovs=[COLOR])


def shown(shot: Shot, places: list[tuple[float, float]]) -> tuple[list[int], list[int], np.ndarray]:
    """The prims, instances and colours that are seen at places of the plane z = 0."""
    at = [(x, y, 0.0) for x, y in places]
    prims, copies = ([int(shot.at(aov, p)) for p in at] for aov in ("primId", "instanceId"))
    return prims, copies, np.array([shot.at(COLOR, p) for p in at])


def test_instances_in_a_row(instances: Shot) -> None:
    path = "/World/Row"
    places, scales = (attribute(instances, path, name) for name in ("positions", "scales"))
    colors = attribute(instances, path, COLOR)
    visible = [0, 1, 2, 4, 5]
    prims, copies, seen = shown(instances, [(x, y) for x, y, _ in places[visible]])
    assert len(set(prims)) == 1 and prims[0] >= 0
    assert copies == [0, 1, 2, 3, 4]
    assert np.allclose(seen, colors[visible], atol=1e-3)
    # The invisible one would be in front of what is seen there; and each is as large as it says.
    assert (instances["cameraDepth"][instances.hit] > 19).all()
    sizes = [
        np.sum((instances["primId"] == prims[0]) & (instances["instanceId"] == i)) for i in copies
    ]
    areas = scales[visible][:, 0] ** 2
    assert np.allclose(np.array(sizes) / sizes[0], areas / areas[0], rtol=0.1)


def test_instancers_in_an_instancer(instances: Shot) -> None:
    columns, colors = (attribute(instances, "/World/Columns", n) for n in ("positions", COLOR))
    drums, above, _ = shown(instances, [(x, 2.8) for x, _, _ in columns])
    blobs, below, seen = shown(instances, [(x, 1.2) for x, _, _ in columns])
    assert len(set(drums)) == len(set(blobs)) == 1 and drums[0] != blobs[0]
    assert above == below == [0, 1, 2]
    assert np.allclose(seen, colors, atol=1e-3)


def test_native_instances_share_a_prim_and_keep_colours(instances: Shot) -> None:
    xs = (-4.8, -3.2, -1.6)
    blobs, first, own = shown(instances, [(x, -1.45) for x in xs])
    drums, second, given = shown(instances, [(x, -2.35) for x in xs])
    assert len(set(blobs)) == len(set(drums)) == 1 and blobs[0] != drums[0]
    assert first == second == [0, 1, 2]
    assert np.allclose(own, (0.2, 0.6, 0.25), atol=1e-3)
    expected = [attribute(instances, f"/World/Native/{n}", COLOR)[0] for n in "ABC"]
    assert np.allclose(given, expected, atol=1e-3)


def test_point_instancers_in_native_instances(instances: Shot) -> None:
    places = [
        (x + 0.6 * i * width, -2 + 0.6 * j * height)
        for x, width, height in ((1.6, 1.2, 0.8), (4.4, 0.8, 1.2))
        for j in (-1, 1)
        for i in (-1, 1)
    ]
    prims, copies, seen = shown(instances, places)
    assert len(set(prims)) == 1 and sorted(copies) == list(range(8))
    for square in (copies[:4], copies[4:]):
        assert square == list(range(square[0], square[0] + 4))
    assert np.allclose(seen, (0.75, 0.6, 0.2), atol=1e-3)


#: Where prims of the scene are, or would be, that others do not hide.
PLACES = {
    "Always": (-3.0, 0.0, 0.8),
    "Invisible": (-2.6, 0.4, 2.8),
    "Render": (0.0, 0.0, 0.8),
    "Proxy": (0.0, 0.0, 0.8),
    "Green": (3.0, 0.6, 0.5),
    "Hidden/Red": (1.9, 0.3, 2.3),
    "Guides/Ring": (4.36, 0.27, 0.0),
}


def with_purposes(*purposes: str) -> Shot:
    shot = Shot("purposes", more_aovs=[COLOR])
    params = shot.view.params
    params.showRender, params.showProxy, params.showGuides = (
        purpose in purposes for purpose in ("render", "proxy", "guide")
    )
    shot.go_to(None)
    return shot


def color_at(shot: Shot, name: str) -> tuple[float, ...] | None:
    """The colour that is seen where a prim is; None if nothing is."""
    if shot.at("primId", PLACES[name]) < 0:
        return None
    return tuple(round(float(c), 2) for c in shot.at(COLOR, PLACES[name]))


@pytest.mark.parametrize(
    "purposes", [(), ("render",), ("proxy",), ("guide",), ("render", "guide")], ids=str
)
def test_purposes_are_shown_as_asked(purposes: tuple[str, ...]) -> None:
    shot = with_purposes(*purposes)
    assert color_at(shot, "Always") == (0.8, 0.5, 0.3)
    assert color_at(shot, "Green") == (0.6, 0.7, 0.35)
    middle = {"render": (0.35, 0.6, 0.75), "proxy": (0.6, 0.6, 0.62)}
    asked = [middle[purpose] for purpose in purposes if purpose in middle]
    assert color_at(shot, "Render") == (asked[0] if asked else None)
    assert color_at(shot, "Guides/Ring") == ((0.6, 0.4, 0.7) if "guide" in purposes else None)


def test_where_both_are_shown_the_nearer_is_seen() -> None:
    both, render, proxy = (
        with_purposes(*p) for p in (("render", "proxy"), ("render",), ("proxy",))
    )
    seen = render.hit & proxy.hit
    nearest = np.minimum(render["cameraDepth"], proxy["cameraDepth"])
    assert np.allclose(both["cameraDepth"][seen], nearest[seen])
    assert (both.hit == (render.hit | proxy.hit)).all()


def test_what_is_invisible_or_in_an_invisible_group_is_not_seen() -> None:
    shot = with_purposes("render", "guide")
    colors = np.unique(np.round(shot[COLOR][shot.hit], 2), axis=0)
    for name in ("Invisible", "Hidden/Red"):
        prim = shot.stage.GetPrimAtPath(f"/World/{name}")
        color = np.array(prim.GetAttribute(COLOR).Get()[0])
        assert (np.abs(colors - color).max(axis=1) > 0.1).all(), name
        UsdGeom.Imageable(prim).GetVisibilityAttr().Set("inherited")
        UsdGeom.Imageable(prim.GetParent()).GetVisibilityAttr().Set("inherited")
        shot.go_to(None)
        assert np.allclose(shot.at(COLOR, PLACES[name]), color, atol=1e-3), name


BOWLS = ("DoubleSided", "SingleSided", "DoubleSidedReversed", "SingleSidedReversed")


def backs_and_fronts(shot: Shot, name: str) -> tuple[set[int], set[int]]:
    """Which points of a bowl's limit surface are seen, from behind and from in front."""
    path = f"/World/{name}"
    backs, fronts = set(), set()
    for index, limit in enumerate(limit_points(cage_of(shot.stage, path), 2)):
        if shot.gap(shot.world(path, limit.point)) > 0.01:
            continue
        if shot.faces_camera(path, limit.point, limit.normal):
            fronts.add(index)
        elif shot.faces_camera(path, limit.point, -limit.normal):
            backs.add(index)
    return backs, fronts


def test_insides_are_seen_whatever_a_mesh_says_of_its_sides() -> None:
    shot = Shot("double_sided", size=LARGE)
    for name in BOWLS:
        backs, fronts = backs_and_fronts(shot, name)
        assert len(backs) >= 4 and len(fronts) >= 4, name
    toward_camera = np.array(shot.frustum.position) - shot.positions[shot.hit]
    toward_camera /= np.linalg.norm(toward_camera, axis=-1)[:, None]
    facing = (shot["normal"][shot.hit] * toward_camera).sum(axis=-1)
    # At a silhouette the quad that is hit may face the viewer where the limit surface does not.
    assert facing.min() > -0.1 and np.mean(facing < 0) < 1e-4
    before = shot.picture
    shot.view.params.cullStyle = UsdImagingGL.CullStyle.CULL_STYLE_BACK_UNLESS_DOUBLE_SIDED
    shot.go_to(None)
    assert_same(shot.picture, before, AOVS)
    for name in BOWLS:
        UsdGeom.Gprim(shot.stage.GetPrimAtPath(f"/World/{name}")).GetDoubleSidedAttr().Set(True)
    shot.go_to(None)
    assert_same(shot.picture, before, AOVS)


def test_reversed_bowls_are_the_same_bowls() -> None:
    shot = Shot("double_sided", size=LARGE)
    for name in BOWLS:
        cage = cage_of(shot.stage, f"/World/{name}")
        expect_limit(shot, f"/World/{name}", cage)
