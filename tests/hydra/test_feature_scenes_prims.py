"""Prims beside meshes in usd_scenes/features: points, curves and implicit prims, by values."""

import numpy as np
import pytest
from pxr import UsdGeom
from scene_kit import COLOR, Shot, attribute


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
    middle = place[np.abs(place[:, 1]) < 0.3]
    share = np.hypot(middle[:, 0], middle[:, 2]) / ROUND[name](middle[:, 1])
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
