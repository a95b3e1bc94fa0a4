"""What the faces of usd_scenes/features have on them: primvars, materials and levels."""

import numpy as np
import pytest
from limit_kit import LARGE
from pxr import UsdGeom
from scene_kit import Shot
from subdivision_kit import cage_of, limit_points


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
