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


RULES = {
    "None": "none",
    "CornersOnly": "cornersOnly",
    "CornersPlus1": "cornersPlus1",
    "CornersPlus2": "cornersPlus2",
    "Boundaries": "boundaries",
    "All": "all",
}


@pytest.fixture(scope="module")
def face_varying() -> Shot:
    return Shot("face_varying", size=(160, 90), more_aovs=["primvars:displayColor"])


def red(shot: Shot, name: str, x: float, y: float, side: tuple[int, int]) -> float:
    """The red of the value at a point of a sheet, as one comes to it from a side."""
    near = shot.close_up("primvars:displayColor", shot.world(f"/World/{name}", (x, y, 0)))
    column, row = side
    return float(near[4 if row < 0 else 3, 4 if column > 0 else 3, 0])


@pytest.mark.parametrize(
    ("place", "side", "values"),
    [
        # The white face's corner at the centre: an island of one face. Its value is 0.09 beside
        # 0.9 and 0.9, from which a crease makes (4 * 0.09 + 0.9 + 0.9) / 6.
        ((0, 0), (-1, 1), (0.36, 0.09, 0.09, 0.09, 0.09, 0.09)),
        # Where red, yellow and white meet, yellow has two faces: 0.95 between 0.095 and 0.095.
        ((0, 1), (1, 1), (0.665, 0.665, 0.95, 0.95, 0.95, 0.95)),
        # Red bends around the white face: 0.09 between 0.9 and 0.9.
        ((-1, 1), (-1, 1), (0.36, 0.36, 0.36, 0.09, 0.09, 0.09)),
        # The middle of an edge of the sheet, 0.9 between 0.09 and 0.09.
        ((-1, 2), (-1, -1), (0.63, 0.63, 0.63, 0.63, 0.9, 0.9)),
        # The middle of the green island: 0.015 beside 0.15, with 0.015 at the diagonals.
        ((-1, -1), (1, 1), (*[(16 * 0.015 + 16 * 0.15 + 4 * 0.015) / 36] * 5, 0.015)),
    ],
    ids=["island", "junction", "bend", "edge", "middle"],
)
def test_face_varying_rules(
    face_varying: Shot, place: tuple[float, float], side: tuple[int, int], values: tuple[float, ...]
) -> None:
    for (name, rule), value in zip(RULES.items(), values):
        prim = face_varying.stage.GetPrimAtPath(f"/World/{name}")
        assert prim.GetAttribute("faceVaryingLinearInterpolation").Get() == rule
        assert red(face_varying, name, *place, side) == pytest.approx(value, abs=3e-3), rule


@pytest.fixture(scope="module")
def primvars() -> Shot:
    return Shot("primvars", size=LARGE, more_aovs=["primvars:st"])


def values_and_places(shot: Shot, name: str) -> tuple[np.ndarray, np.ndarray]:
    """The values that a sheet shows, and how far right and up on it, from 0 to 3.

    Sheets are bent, but their points are evenly spaced in x and y, which subdivision keeps.
    """
    seen = shot.of(f"/World/{name}")
    return shot["primvars:st"][seen], 1.5 * (shot.local(f"/World/{name}")[seen][:, :2] + 1)


def test_constant_and_uniform_primvars(primvars: Shot) -> None:
    values, _ = values_and_places(primvars, "Constant")
    assert len(values) > 5000 and np.allclose(values, (0.75, 0.25))
    values, places = values_and_places(primvars, "Uniform")
    inside = (abs(places - np.round(places)) > 0.01).all(axis=1)
    columns, rows = np.floor(places[inside]).T
    faces = 3 * rows + columns
    assert np.allclose(values[inside], np.stack([faces / 8, 1 - faces / 8], -1))


@pytest.mark.parametrize("name", ["Varying", "Vertex", "Polygons"])
def test_even_primvars_of_points_stay_even(primvars: Shot, name: str) -> None:
    values, places = values_and_places(primvars, name)
    assert len(values) > 5000 and np.allclose(values, places / 3, atol=1e-3)


def test_face_varying_primvars_begin_anew_on_each_face(primvars: Shot) -> None:
    values, places = values_and_places(primvars, "FaceVarying")
    inside = (abs(places - np.round(places)) > 0.01).all(axis=1)
    assert np.allclose(values[inside], places[inside] % 1, atol=2e-3)


def test_a_seam_parts_primvars(primvars: Shot) -> None:
    values, places = values_and_places(primvars, "Seam")
    inside = abs(places[:, 0] - 2) > 0.01
    across, up = places[inside].T
    # Half of the picture for two columns; then a column that begins elsewhere.
    first, last = (primvar_of(primvars, "Seam")[i][0] for i in (18, 19))
    beyond = first + (across - 2) * (last - first)
    assert abs(first - 1 / 3) > 0.1
    expected = np.stack([np.where(across < 2, across / 6, beyond), up / 3], -1)
    assert np.allclose(values[inside], expected, atol=1e-3)


def primvar_of(shot: Shot, name: str) -> np.ndarray:
    """The values of a sheet's primvars:st as authored, without indices."""
    primvar = UsdGeom.PrimvarsAPI(shot.stage.GetPrimAtPath(f"/World/{name}")).GetPrimvar("st")
    return np.array(primvar.Get(), float)


@pytest.mark.parametrize("name", ["Indexed", "Scalar"])
def test_primvars_of_points_are_as_smooth_as_the_surface(primvars: Shot, name: str) -> None:
    path = f"/World/{name}"
    primvar = UsdGeom.PrimvarsAPI(primvars.stage.GetPrimAtPath(path)).GetPrimvar("st")
    values = np.array(primvar.ComputeFlattened(), float).reshape(16, -1)
    cage = cage_of(primvars.stage, path)
    cage.points = [np.concatenate(both) for both in zip(cage.points, values)]
    limits = limit_points(cage, 1)
    assert len(limits) == 9
    for limit in limits:
        shown = primvars.close_up("primvars:st", primvars.world(path, limit.point[:3]))[4, 4]
        assert np.allclose(shown[: values.shape[1]], limit.point[3:], atol=2e-3), limit


def test_a_sheet_without_the_primvar_shows_nothing_of_it(primvars: Shot) -> None:
    values, _ = values_and_places(primvars, "Another")
    assert len(values) > 5000 and (values == 0).all()
