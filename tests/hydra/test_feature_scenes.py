"""What the surfaces of usd_scenes/features are: values that follow from the scenes themselves."""

import numpy as np
import pytest
from pxr import UsdGeom
from scene_kit import Shot, open_scene
from subdivision_kit import Cage, cage_of, limit_points

#: Of a scene's units: what a tangent plane is off between two pixels.
TOLERANCE = 2e-3
LARGE = (640, 360)


def gaps(shot: Shot, path: str, cage: Cage, steps: int) -> list[float]:
    """How far points of a cage's limit surface that face the camera are from what is seen.

    Infinite where their face is not seen.
    """
    holes = UsdGeom.Mesh(shot.stage.GetPrimAtPath(path)).GetHoleIndicesAttr().Get(shot.frame) or ()
    found = []
    for limit in limit_points(cage, steps):
        if limit.face in holes or not shot.faces_camera(path, limit.point, limit.normal):
            continue
        point = shot.world(path, limit.point)
        found.append(shot.gap(point) if shot.shows_face(limit.face, point) else np.inf)
    return found


def expect_limit(shot: Shot, path: str, cage: Cage | None = None, *, steps: int = 3) -> None:
    """Expects that a mesh shows the limit surface of its cage, face by face."""
    found = gaps(shot, path, cage or cage_of(shot.stage, path, shot.frame), steps)
    assert len(found) >= 20, path
    assert max(found) < TOLERANCE, (path, max(found))


def expect_other_limit(shot: Shot, path: str, cage: Cage, *, steps: int = 3) -> None:
    """Expects that a mesh shows another limit surface than that of a cage."""
    assert max(gaps(shot, path, cage, steps)) > 5 * TOLERANCE, path


def expect_cube(shot: Shot, path: str, half: float = 1.0) -> None:
    """Expects that a mesh shows a cube with flat sides, of which faces are seen."""
    seen = shot.of(path)
    assert np.allclose(np.abs(shot.local(path)[seen]).max(axis=-1), half, atol=1e-4)
    assert len(np.unique(shot["elementId"][seen])) == 3


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


def levels_of_rows(shot: Shot) -> dict[int, float]:
    """The level of each row of the road's faces that is seen, counted from near to far."""
    rows, levels = shot["elementId"][shot.hit] // 4, shot["hdcc:level"][shot.hit]
    found = {int(row): np.unique(levels[rows == row]) for row in np.unique(rows)}
    return {row: float(values.mean()) for row, values in found.items()}


def test_near_patches_are_finer_than_far_ones() -> None:
    shot = Shot("adaptive", more_aovs=["hdcc:level"], level=8)
    found = levels_of_rows(shot)
    levels = np.array(list(found.values()))
    assert len(levels) > 30 and levels[0] >= levels[-1] + 3
    assert (np.diff(levels) <= 0).all()
    # Rows begin at z = 6 and are 3 deep; the camera is at z = 9. Bumps are equal, and a level makes
    # their error a quarter, which leaves what levels are whole for.
    distances = 3 + 3 * np.array(list(found))
    assert np.ptp(levels + np.log(distances) / np.log(4)) < 1.25


def test_without_the_metric_all_patches_have_one_level() -> None:
    shot = Shot("adaptive", more_aovs=["hdcc:level"], adaptive=False, level=3)
    assert (shot["hdcc:level"][shot.hit] == 3).all()


def test_four_times_the_error_is_a_level_less() -> None:
    shots = [
        Shot("adaptive", more_aovs=["hdcc:level"], pixelError=error, level=8)
        for error in (0.25, 1.0)
    ]
    fine, coarse = map(levels_of_rows, shots)
    assert {row: level - 1 for row, level in fine.items()} == coarse


def test_faces_of_subsets_have_their_materials() -> None:
    shot = Shot("subsets", more_aovs=["hdcc:material", "primvars:displayColor"])
    names = list(shot.view.engine.GetRenderStats()["materials"])
    jug = shot.stage.GetPrimAtPath("/World/Jug")
    colors = np.array(jug.GetAttribute("primvars:displayColor").Get())
    expected = {f"/World/Materials/{name}": i for i, name in enumerate(("Clay", "Glaze", "Gold"))}
    assert set(names) == set(expected)
    faces = np.zeros(40, int)
    for index, name in ((1, "Band"), (2, "Rim")):
        faces[shot.stage.GetPrimAtPath(f"/World/Jug/{name}").GetAttribute("indices").Get()] = index
    hit = shot.hit
    numbers = shot["hdcc:material"][hit].astype(int)
    materials = np.array([expected[name] for name in names])[numbers]
    assert (materials == faces[shot["elementId"][hit]]).all()
    assert np.allclose(shot["primvars:displayColor"][hit], colors[materials], atol=1e-3)
    assert (shot["hdcc:material"][~hit] == -1).all()
    assert set(materials) == {0, 1, 2}
