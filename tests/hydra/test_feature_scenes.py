"""What the surfaces of usd_scenes/features are: values that follow from the scenes themselves."""

import numpy as np
import pytest
from limit_kit import LARGE, TOLERANCE, expect_cube, expect_limit, expect_other_limit
from pxr import UsdGeom
from scene_kit import Shot, open_scene
from subdivision_kit import cage_of, limit_points

CREASED = {
    "Smooth": 3,
    "Sharp0_5": 3,
    "Sharp1": 3,
    "Sharp2": 3,
    "Sharp3_5": 4,
    "Infinite": 3,
    "OneAnEdge": 3,
    "CornerSoft": 3,
    "CornerInfinite": 3,
    "Dart": 3,
    "Above10": 3,
}


@pytest.fixture(scope="module")
def creases() -> Shot:
    return Shot("creases", size=LARGE)


@pytest.mark.parametrize("name", CREASED)
def test_creases_and_corners_are_as_sharp_as_they_say(creases: Shot, name: str) -> None:
    expect_limit(creases, f"/World/{name}", steps=CREASED[name])


def test_creases_that_are_all_infinite_are_edges(creases: Shot) -> None:
    expect_cube(creases, "/World/AllEdges")


def test_each_sharpness_makes_a_surface_of_its_own(creases: Shot) -> None:
    rising = ["Smooth", "Sharp0_5", "Sharp1", "Sharp2", "Sharp3_5"]
    for name, other in zip(rising, rising[1:]):
        cage = cage_of(creases.stage, f"/World/{other}")
        expect_other_limit(creases, f"/World/{name}", cage, steps=CREASED[other])
    # The middle of the spline that an infinite crease is.
    rim = (0, 1, (23 + 23 - 1 - 1) / 48)
    names = ("Sharp2", "Sharp3_5", "Infinite")
    found = [creases.gap(creases.world(f"/World/{name}", rim)) for name in names]
    assert found[0] > 2 * found[1] > 10 * TOLERANCE and found[2] < TOLERANCE


def test_schemes() -> None:
    shot = Shot("schemes", size=LARGE)
    expect_limit(shot, "/World/CatmullClark")
    expect_cube(shot, "/World/Bilinear")
    expect_cube(shot, "/World/None")
    assert expect_loop_vertices(shot, "/World/Loop") >= 2


def loop_limit(mesh: UsdGeom.Mesh, vertex: int) -> np.ndarray:
    """Where a smooth vertex of a closed mesh of triangles ends under Loop subdivision."""
    points = np.array(mesh.GetPointsAttr().Get(), float)
    faces = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    around = set(faces[(faces == vertex).any(axis=1)].flat) - {vertex}
    count = len(around)
    beta = (5 / 8 - (3 / 8 + np.cos(2 * np.pi / count) / 4) ** 2) / count
    weight = 1 / (3 / (8 * beta) + count)
    return (1 - count * weight) * points[vertex] + weight * points[list(around)].sum(axis=0)


def expect_loop_vertices(shot: Shot, path: str, skip: tuple[int, ...] = ()) -> int:
    """Expects limits of vertices where they face the camera, and says how many there are."""
    mesh = UsdGeom.Mesh(shot.stage.GetPrimAtPath(path))
    found = 0
    for vertex in set(mesh.GetFaceVertexIndicesAttr().Get()) - set(skip):
        limit = loop_limit(mesh, vertex)
        if shot.faces_camera(path, limit, limit):
            assert shot.gap(shot.world(path, limit)) < TOLERANCE, (path, vertex)
            found += 1
    return found


@pytest.fixture(scope="module")
def loop() -> Shot:
    return Shot("loop", size=LARGE)


def test_loop_surfaces_are_smooth_where_nothing_is_sharp(loop: Shot) -> None:
    assert expect_loop_vertices(loop, "/World/Smooth") >= 4
    assert expect_loop_vertices(loop, "/World/SharpCorner", skip=(0,)) >= 3


def test_a_sharp_corner_of_a_loop_surface_stays(loop: Shot) -> None:
    tip = (0, 1.25, 0)
    assert loop.gap(loop.world("/World/SharpCorner", tip)) < TOLERANCE
    assert loop.gap(loop.world("/World/Smooth", tip)) > 0.1


def test_a_sharp_crease_of_a_loop_surface_is_a_cubic_spline(loop: Shot) -> None:
    mesh = UsdGeom.Mesh(loop.stage.GetPrimAtPath("/World/SharpCrease"))
    points = np.array(mesh.GetPointsAttr().Get(), float)
    ring = list(mesh.GetCreaseIndicesAttr().Get())[:-1]
    nearest = max(ring, key=lambda vertex: loop.world("/World/SharpCrease", points[vertex])[2])
    place = ring.index(nearest)
    ends = points[ring[place - 1]] + points[ring[(place + 1) % len(ring)]]
    crease = (4 * points[nearest] + ends) / 6
    assert loop.gap(loop.world("/World/SharpCrease", crease)) < TOLERANCE
    # A sharpness of 2.3 ends in between.
    gap = loop.gap(loop.world("/World/SemiSharpCrease", crease))
    assert 0.005 < gap < loop.gap(loop.world("/World/Smooth", crease)) - 0.02


def test_loop_sheets_end_as_their_boundary_rule_says(loop: Shot) -> None:
    mesh = UsdGeom.Mesh(loop.stage.GetPrimAtPath("/World/BoundaryEdgeAndCorner"))
    points = np.array(mesh.GetPointsAttr().Get(), float)
    faces = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    corner = points[0]
    assert loop.gap(loop.world("/World/BoundaryEdgeAndCorner", corner)) < TOLERANCE
    assert loop.at("primId", loop.world("/World/BoundaryEdgeOnly", corner)) == -1
    edges = np.sort(np.concatenate([faces[:, [i, i - 1]] for i in range(3)]), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    border = set(unique[counts == 1].flat)
    inner = [i for i, face in enumerate(faces) if not border & set(face)]
    shown = np.unique(loop["elementId"][loop.of("/World/BoundaryNone")])
    assert inner and list(shown) == inner


def test_hole_triangles_of_a_torus_show_nothing(loop: Shot) -> None:
    path = "/World/RegularTorus"
    holed = loop.picture
    mesh = UsdGeom.Mesh(loop.stage.GetPrimAtPath(path))
    assert list(mesh.GetHoleIndicesAttr().Get()) == [62, 63]
    here = loop.of(path)
    whole_stage = open_scene("loop")
    UsdGeom.Mesh(whole_stage.GetPrimAtPath(path)).GetHoleIndicesAttr().Set([])
    whole = Shot(whole_stage, size=LARGE)
    gone = whole.of(path) & np.isin(whole["elementId"], (62, 63))
    assert gone.sum() > 50
    assert not np.isin(holed["elementId"][here], (62, 63)).any()
    assert (holed["cameraDepth"][gone & loop.hit] > whole["cameraDepth"][gone & loop.hit]).all()
    assert (holed["elementId"][~gone] == whole["elementId"][~gone]).all()


@pytest.mark.parametrize(("name", "left"), [("Holes", {2, 3, 4, 5}), ("MostlyHoles", {3, 5})])
def test_one_sees_through_hole_faces_of_a_cube(name: str, left: set[int]) -> None:
    shot = Shot("cube_holes", size=LARGE)
    path = f"/World/{name}"
    assert set(shot["elementId"][shot.of(path)]) <= left
    middles = {limit.face: limit.point for limit in limit_points(cage_of(shot.stage, path), 1)}
    front, behind = (shot.world(path, middles[face]) for face in (0, 2))
    assert shot.gap(front) > 0.5
    if name == "Holes":
        assert shot.at("elementId", front) in (2, 3)
        assert shot.gap(behind) < TOLERANCE


def test_hole_faces_of_a_cube_shape_their_neighbours() -> None:
    shot = Shot("cube_holes", size=LARGE)
    expect_limit(shot, "/World/Whole")
    expect_limit(shot, "/World/Holes", steps=4)


def test_boundary_rules() -> None:
    shot = Shot("open_sheet", size=LARGE)
    expect_limit(shot, "/World/EdgeAndCorner", steps=2)
    expect_limit(shot, "/World/EdgeOnly", steps=2)
    assert set(shot["elementId"][shot.of("/World/None")]) == {4}
    cage = cage_of(shot.stage, "/World/None")
    middle = [limit.point for limit in limit_points(cage, 3) if limit.face == 4]
    assert max(shot.gap(shot.world("/World/None", point)) for point in middle) < TOLERANCE


@pytest.mark.parametrize(("vertex", "beside"), [(3, (2, 7)), (12, (8, 13))])
def test_corners_of_sheets_stay_or_get_round(vertex: int, beside: tuple[int, int]) -> None:
    shot = Shot("open_sheet", size=LARGE)
    points = np.array(shot.stage.GetPrimAtPath("/SheetCage").GetAttribute("points").Get(), float)
    corner = points[vertex]
    assert shot.gap(shot.world("/World/EdgeAndCorner", corner)) < TOLERANCE
    assert shot.gap(shot.world("/World/EdgeOnly", corner)) == np.inf
    round_corner = (4 * corner + points[beside[0]] + points[beside[1]]) / 6
    assert shot.gap(shot.world("/World/EdgeOnly", round_corner)) < TOLERANCE


def test_rules_for_triangles() -> None:
    shot = Shot("triangle_rule", size=LARGE)
    first, second = ("/World/CatmullClark", "/World/Smooth")
    cages = {path: cage_of(shot.stage, path) for path in (first, second)}
    assert cages[second].triangle_weight == 0.47 != cages[first].triangle_weight
    for path, cage in cages.items():
        expect_limit(shot, path, cage, steps=2)
    expect_other_limit(shot, first, cages[second], steps=2)
    expect_other_limit(shot, second, cages[first], steps=2)
