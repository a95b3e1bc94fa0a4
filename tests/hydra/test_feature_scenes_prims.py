"""Prims beside meshes, instances and who is shown in usd_scenes/features, by values."""

import numpy as np
import pytest
from hydra_kit import assert_same
from limit_kit import LARGE, expect_limit
from pxr import UsdGeom, UsdImagingGL
from scene_kit import AOVS, Shot
from subdivision_kit import cage_of, limit_points

COLOR = "primvars:displayColor"


def attribute(shot: Shot, path: str, name: str) -> np.ndarray:
    return np.array(shot.stage.GetPrimAtPath(path).GetAttribute(name).Get(), float)


def same_prim(shot: Shot, point: tuple[float, float, float]) -> np.ndarray:
    """Pixels that show the prim that is seen at a point of the world."""
    prim = shot.at("primId", point)
    assert prim >= 0
    return np.asarray(shot["primId"] == prim)


@pytest.fixture(scope="module")
def points() -> Shot:
    return Shot("points", more_aovs=[COLOR])


@pytest.mark.parametrize(
    ("path", "somewhere"), [("/World/Spiral", (-1, 0.35, -2.15)), ("/World/Row", (4, 0.4, 2))]
)
def test_points_are_spheres_of_their_widths(
    points: Shot, path: str, somewhere: tuple[float, float, float]
) -> None:
    centres = attribute(points, path, "points")
    radii = np.broadcast_to(attribute(points, path, "widths") / 2, len(centres))
    seen = same_prim(points, somewhere)
    index = points["elementId"][seen]
    out = points.local(path)[seen] - centres[index]
    assert np.allclose(np.linalg.norm(out, axis=-1), radii[index], atol=1e-4)
    assert np.allclose(points["normal"][seen], out / radii[index][:, None], atol=2e-3)
    assert len(np.unique(index)) > 0.9 * len(centres)


def test_points_have_their_colours(points: Shot) -> None:
    seen = same_prim(points, (-1, 0.35, -2.15))
    colors = attribute(points, "/World/Spiral", COLOR)
    assert np.allclose(points[COLOR][seen], colors[points["elementId"][seen]], atol=1e-3)


def test_clusters_of_points_are_stretched_spheres(points: Shot) -> None:
    path = "/World/Clusters"
    centres = attribute(points, f"{path}/Cluster", "points")
    radii = attribute(points, f"{path}/Cluster", "widths") / 2
    places, scales, colors = (
        attribute(points, path, name) for name in ("positions", "scales", COLOR)
    )
    seen = same_prim(points, (3, 0.5, -1.5))
    cluster, index = points["instanceId"][seen], points["elementId"][seen]
    assert set(cluster) == {0, 1, 2} and set(index) == set(range(5))
    local = (points.positions[seen] - places[cluster]) / scales[cluster]
    distance = np.linalg.norm(local - centres[index], axis=-1)
    assert np.allclose(distance, radii[index], atol=1e-4)
    assert np.allclose(points[COLOR][seen], colors[cluster], atol=1e-3)


def test_spheres_shadow_the_floor(points: Shot) -> None:
    light = UsdGeom.Xformable(points.stage.GetPrimAtPath("/World/Key"))
    along = -np.array(light.ComputeLocalToWorldTransform(points.frame))[2, :3]
    last = attribute(points, "/World/Row", "points")[-1]
    shadowed, lit = last - along * last[1] / along[1], (3.5, 0, 3.2)
    for place in (shadowed, lit):
        assert np.allclose(points.positions[points.pixel(place)], place, atol=0.1)
    assert (points.at("color", shadowed)[:3] < 0.5 * points.at("color", lit)[:3]).all()


#: What the four points of a segment weigh, for powers of the parameter from the third down.
BASES = {
    "bezier": np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 3, 0, 0], [1, 0, 0, 0]]),
    "bspline": np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 0, 3, 0], [1, 4, 1, 0]]) / 6,
    "catmullRom": np.array([[-1, 3, -3, 1], [2, -5, 4, -1], [-1, 0, 1, 0], [0, 2, 0, 0]]) / 2,
}
STEPS = np.linspace(0, 1, 65)


def on_segments(points: np.ndarray, basis: str, wrap: str) -> np.ndarray:
    """Points of a cubic curve, segment by segment."""
    if wrap == "periodic":
        points = np.concatenate([points, points[:3]])
    elif wrap == "pinned":
        before, after = 2 * points[0] - points[1], 2 * points[-1] - points[-2]
        points = np.concatenate([[before], points, [after]])
    step = 3 if basis == "bezier" else 1
    powers = np.stack([STEPS**3, STEPS**2, STEPS, np.ones_like(STEPS)], -1)
    firsts = range(0, len(points) - 3, step)
    return np.array([powers @ BASES[basis] @ points[i : i + 4] for i in firsts])


def ends_to_segments(values: np.ndarray) -> np.ndarray:
    """Values of the ends of segments, linear between."""
    pairs = np.stack([values[:-1], values[1:]], 1)
    return np.array([(1 - t) * pairs[:, 0] + t * pairs[:, 1] for t in STEPS]).swapaxes(0, 1)


def nearest(places: np.ndarray, curve: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For each place the index of the nearest of a curve's points, and its distance."""
    distances = np.linalg.norm(places[:, None] - curve[None], axis=-1)
    return distances.argmin(axis=1), distances.min(axis=1)


@pytest.fixture(scope="module")
def curves() -> Shot:
    return Shot("curves", more_aovs=[COLOR])


def seen_at(shot: Shot, path: str) -> np.ndarray:
    """Pixels of a prim of curves: those inside its extent and above the floor."""
    seen = shot.of(path) & (shot.positions[..., 1] > 0.01)
    prims, counts = np.unique(shot["primId"][seen], return_counts=True)
    return np.asarray(seen & (shot["primId"] == prims[counts.argmax()]))


def test_a_periodic_curve_is_a_tube_of_one_width(curves: Shot) -> None:
    path = "/World/Knot"
    seen = seen_at(curves, path)
    curve = on_segments(attribute(curves, path, "points"), "bspline", "periodic").reshape(-1, 3)
    _, distance = nearest(curves.local(path)[seen][::4], curve)
    assert len(distance) > 500 and np.allclose(distance, 0.225, atol=0.45 / 40)
    assert (curves["elementId"][seen] == 0).all()


def test_a_linear_curve_gets_thinner_from_end_to_end(curves: Shot) -> None:
    path = "/World/Zigzag"
    seen = seen_at(curves, path)
    curve = ends_to_segments(attribute(curves, path, "points")).reshape(-1, 3)
    widths = ends_to_segments(attribute(curves, path, "widths")).reshape(-1)
    distances = np.linalg.norm(curves.local(path)[seen][:, None] - curve, axis=-1)
    outside = (distances - widths / 2).min(axis=1)
    assert len(outside) > 500 and np.abs(outside).max() < 0.012


def test_a_ribbon_is_flat_and_faces_its_normals(curves: Shot) -> None:
    path = "/World/Ribbon"
    seen = seen_at(curves, path)
    curve = on_segments(attribute(curves, path, "points"), "bezier", "nonperiodic")
    normals = ends_to_segments(attribute(curves, path, "normals")).reshape(-1, 3)
    colors = ends_to_segments(attribute(curves, path, COLOR)).reshape(-1, 3)
    index, distance = nearest(curves.local(path)[seen], curve.reshape(-1, 3))
    out = curves.local(path)[seen] - curve.reshape(-1, 3)[index]
    faced = normals[index] / np.linalg.norm(normals[index], axis=-1)[:, None]
    assert len(distance) > 500 and distance.max() < 0.225 + 0.45 / 40
    assert np.abs((out * faced).sum(axis=-1)).max() < 0.02
    assert np.abs((curves["normal"][seen] * faced).sum(axis=-1)).min() > 0.98
    assert np.allclose(curves[COLOR][seen], colors[index], atol=0.01)


def test_hairs_taper_along_their_own_curves(curves: Shot) -> None:
    path = "/World/Tuft"
    seen = seen_at(curves, path)
    hairs = attribute(curves, path, "points").reshape(200, 5, 3)
    widths, colors = (
        attribute(curves, path, name).reshape(200, 5, -1) for name in ("widths", COLOR)
    )
    places, shown = curves.local(path)[seen], curves[COLOR][seen]
    elements = curves["elementId"][seen]
    assert len(np.unique(elements)) > 100
    for hair in np.unique(elements):
        here = elements == hair
        curve = on_segments(hairs[hair], "catmullRom", "pinned").reshape(-1, 3)
        index, distance = nearest(places[here], curve)
        radii = ends_to_segments(widths[hair]).reshape(-1) / 2
        assert np.allclose(distance, radii[index], atol=0.003), hair
        expected = ends_to_segments(colors[hair]).reshape(-1, 3)[index]
        assert np.allclose(shown[here], expected, atol=0.01), hair


@pytest.fixture(scope="module")
def implicits() -> Shot:
    return Shot("implicits", more_aovs=[COLOR])


def test_implicit_cubes_and_planes_are_flat(implicits: Shot) -> None:
    cube = implicits.local("/World/Cube")[implicits.of("/World/Cube")]
    assert len(cube) > 500 and np.allclose(np.abs(cube).max(axis=-1), 0.8, atol=1e-4)
    seen = implicits.of("/World/Plane")
    plane = implicits.local("/World/Plane")[seen]
    assert np.allclose(plane[:, 2], 0, atol=1e-4)
    assert np.allclose(implicits["normal"][seen], (0, 0, 1), atol=1e-3)
    assert np.allclose(np.ptp(plane[:, :2], axis=0), 1.6, atol=0.1)


#: How far from the middle of each prim's axis its surface is at a height, for a radius.
ROUND = {
    "Cone": lambda y: (1 - y) / 2,
    "Cylinder": lambda y: 0.8 + 0 * y,
    "Capsule": lambda y: np.sqrt(np.maximum(0.25 - np.maximum(np.abs(y) - 0.5, 0) ** 2, 0)),
}


@pytest.mark.parametrize("name", ROUND)
def test_round_implicit_prims_are_a_little_slimmer(implicits: Shot, name: str) -> None:
    """Ten points on a circle make a spline of at most (4 + 2 cos 36 degrees) / 6 of its radius."""
    path = f"/World/{name}"
    seen = implicits.of(path)
    place = implicits.local(path)[seen]
    middle = np.abs(place[:, 1]) < 0.3
    share = (np.hypot(place[:, 0], place[:, 2]) / ROUND[name](place[:, 1]))[middle]
    assert len(share) > 200
    assert share.min() > 0.9 and share.max() < 0.95
    assert abs(np.median(share) - (4 + 2 * np.cos(np.pi / 5)) / 6) < 0.02
    standing = place[:, 1] > -0.9
    colors = attribute(implicits, path, COLOR)
    assert np.allclose(implicits[COLOR][seen][standing], colors[0], atol=1e-3)


def test_implicit_spheres_are_round(implicits: Shot) -> None:
    path = "/World/Sphere"
    seen = same_prim(implicits, (-6.25, 0, 0.9))
    radii = np.linalg.norm(implicits.local(path)[seen], axis=-1)
    assert len(radii) > 1000 and radii.min() > 0.91 and radii.max() < 1
    normals = (implicits.local(path)[seen] / radii[:, None] * implicits["normal"][seen]).sum(
        axis=-1
    )
    assert normals.min() > 0.98


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
    toward_camera = np.array(shot.frustum.position) - shot.positions
    toward_camera /= np.linalg.norm(toward_camera, axis=-1)[..., None]
    facing = (shot["normal"] * toward_camera).sum(axis=-1)[shot.hit]
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
