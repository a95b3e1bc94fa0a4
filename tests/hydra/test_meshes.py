"""What a mesh prim can say: purpose, sides, orientation, colour, refinement."""

from typing import Any

import numpy as np
import pytest
from hydra_kit import (
    CENTER_AOVS,
    View,
    add_cube,
    add_grid,
    assert_same,
    make_stage,
    render,
    shows_something,
)
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

PURPOSES = ("default", "render", "proxy", "guide")


@pytest.mark.parametrize("purpose", PURPOSES)
@pytest.mark.parametrize("shown", [(), ("render",), ("proxy",), ("guide",)])
def test_purposes(purpose: str, shown: tuple[str, ...]) -> None:
    stage = make_stage()
    add_grid(stage).CreatePurposeAttr(purpose)
    view = View(stage)
    view.params.showRender = "render" in shown
    view.params.showProxy = "proxy" in shown
    view.params.showGuides = "guide" in shown
    assert shows_something(view.render()) == (purpose == "default" or purpose in shown)


def test_purpose_edit() -> None:
    stage = make_stage()
    mesh = add_grid(stage)
    view = View(stage)
    view.params.showGuides = False
    assert shows_something(view.render())
    mesh.CreatePurposeAttr("guide")
    assert not shows_something(view.render())
    view.params.showGuides = True
    assert shows_something(view.render())


@pytest.mark.parametrize("double_sided", [False, True])
def test_both_sides_are_seen_and_face_the_viewer(double_sided: bool) -> None:
    stage = make_stage()
    mesh = add_grid(stage, half=3.0, doubleSided=double_sided)
    front = render(stage)
    mesh.AddRotateYOp().Set(180.0)
    back = render(stage)
    assert (front["primId"] == back["primId"]).all()
    assert np.allclose(back["Neye"][16, 16], (0, 0, 1), atol=1e-3)
    assert np.allclose(back["color"], front["color"], atol=1e-3)


@pytest.mark.parametrize("style", ["BACK", "BACK_UNLESS_DOUBLE_SIDED"])
def test_the_application_cannot_hide_back_faces(style: str) -> None:
    from pxr import UsdImagingGL

    stage = make_stage()
    add_grid(stage).AddRotateYOp().Set(180.0)
    view = View(stage)
    view.params.cullStyle = getattr(UsdImagingGL.CullStyle, f"CULL_STYLE_{style}")
    assert shows_something(view.render())


def test_left_handed_mesh_is_the_mirrored_right_handed_one() -> None:
    def picture(orientation: str, flip: bool) -> dict[str, np.ndarray]:
        stage = make_stage()
        mesh = add_cube(stage)
        mesh.CreateOrientationAttr(orientation)
        # Off the pixels' centres: rays that meet an edge exactly may take either face.
        mesh.AddTranslateOp().Set(Gf.Vec3d(0.013, 0.007, 0))
        if flip:
            faces = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(6, 4)
            faces[:, 1:] = faces[:, :0:-1].copy()
            mesh.GetFaceVertexIndicesAttr().Set(Vt.IntArray(faces.ravel().tolist()))
        return render(stage)

    left, right = picture("leftHanded", flip=True), picture("rightHanded", flip=False)
    assert (left["primId"] == right["primId"]).all()
    assert (left["elementId"] == right["elementId"]).all()
    assert np.allclose(left["cameraDepth"], right["cameraDepth"], atol=1e-5)
    assert np.allclose(left["normal"], right["normal"], atol=2e-3)


@pytest.mark.parametrize("complexity", [1.0, 1.1, 1.3])
def test_complexity_never_shows_the_cage(complexity: float) -> None:
    stage = make_stage()
    add_cube(stage)
    view = View(stage)
    view.params.complexity = complexity
    assert_same(view.render(), render(stage))
    assert view.read()["primId"][5, 5] == -1  # a corner of the cage


@pytest.mark.parametrize("scheme", ["catmullClark", "bilinear", "none"])
def test_schemes(scheme: str) -> None:
    stage = make_stage()
    add_cube(stage).CreateSubdivisionSchemeAttr(scheme)
    corner = render(stage)["primId"][9, 9]
    assert corner == (-1 if scheme == "catmullClark" else 0)


def triangulate(mesh: UsdGeom.Mesh) -> None:
    """Cuts the quads of a mesh in two."""
    quads = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 4)
    triangles = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    mesh.GetFaceVertexCountsAttr().Set(Vt.IntArray([3] * len(triangles)))
    mesh.GetFaceVertexIndicesAttr().Set(Vt.IntArray(triangles.ravel().tolist()))


def test_loop_subdivides_triangles(warnings: Any) -> None:
    stage = make_stage()
    mesh = add_cube(stage)
    mesh.CreateSubdivisionSchemeAttr("loop")
    triangulate(mesh)
    picture = render(stage)
    assert warnings.read() == ""
    assert picture["primId"][9, 9] == -1 and picture["primId"][16, 16] == 0
    assert set(np.unique(picture["elementId"])) <= set(range(-1, 12))
    mesh.GetSubdivisionSchemeAttr().Set("catmullClark")
    other = render(stage)
    assert not np.allclose(picture["cameraDepth"], other["cameraDepth"], atol=1e-3)


def test_loop_leaves_meshes_of_other_faces_out_with_a_warning(warnings: Any) -> None:
    stage = make_stage()
    add_grid(stage, "/A")
    expected = render(stage)
    add_cube(stage, "/Loop").CreateSubdivisionSchemeAttr("loop")
    picture = render(stage)
    said = warnings.read()
    assert "</Loop>: 6 of 6 faces are no triangles" in said
    assert_same(picture, expected)


RED, GREEN, BLUE, WHITE = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0)
# A 2 x 2 grid on a 32 x 32 picture: centres of its faces, lower row first.
FACE_PIXELS = ((24, 8), (24, 24), (8, 8), (8, 24))


def colors(interpolation: str, values: list[Any], indices: list[int] | None = None) -> np.ndarray:
    """Colour without shading, at the centres of the four faces."""
    stage = make_stage()
    mesh = add_grid(stage, size=2)
    primvar = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, interpolation
    )
    primvar.Set(Vt.Vec3fArray([Gf.Vec3f(*value) for value in values]))
    if indices is not None:
        primvar.SetIndices(Vt.IntArray(indices))
    picture = render(stage)["color"]
    white = make_stage()
    add_grid(white, size=2, displayColor=[WHITE])
    reference = render(white)["color"]
    return np.array([picture[p][:3] / reference[p][:3] for p in FACE_PIXELS])


def test_color_constant() -> None:
    assert np.allclose(colors("constant", [(0.2, 0.4, 0.6)]), (0.2, 0.4, 0.6), atol=3e-3)


def test_color_uniform() -> None:
    faces = [RED, GREEN, BLUE, WHITE]
    assert np.allclose(colors("uniform", faces), faces, atol=3e-3)


def test_color_uniform_indexed() -> None:
    assert np.allclose(
        colors("uniform", [RED, BLUE], [0, 1, 1, 0]), [RED, BLUE, BLUE, RED], atol=3e-3
    )


@pytest.mark.parametrize("interpolation", ["vertex", "varying"])
def test_color_at_points(interpolation: str) -> None:
    # Red grows with x: linear both ways, for a vertex primvar on an evenly spaced grid.
    points = [(x / 2, 0.0, 0.0) for _ in range(3) for x in range(3)]
    found = colors(interpolation, points)
    expected = [(8.5 / 32, 0, 0), (24.5 / 32, 0, 0)] * 2
    assert np.allclose(found, expected, atol=0.02)


def test_color_vertex_indexed() -> None:
    found = colors("vertex", [(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [0, 1, 2] * 3)
    assert np.allclose(found[:, 0], [8.5 / 32, 24.5 / 32] * 2, atol=0.02)


def test_color_face_varying() -> None:
    found = colors("faceVarying", [c for c in (RED, GREEN, BLUE, WHITE) for _ in range(4)])
    assert np.allclose(found, [RED, GREEN, BLUE, WHITE], atol=3e-3)


def test_color_face_varying_indexed() -> None:
    found = colors("faceVarying", [RED, BLUE], [0] * 4 + [1] * 8 + [0] * 4)
    assert np.allclose(found, [RED, BLUE, BLUE, RED], atol=3e-3)


@pytest.mark.parametrize(
    ("rule", "linear"),
    [
        ("none", ()),
        ("cornersOnly", ("lone",)),
        ("cornersPlus1", ("lone",)),
        (None, ("lone",)),
        ("cornersPlus2", ("lone", "bend")),
        ("boundaries", ("lone", "bend", "edge")),
        ("all", ("lone", "bend", "edge")),
    ],
)
def test_color_face_varying_rules(rule: str | None, linear: tuple[str, ...]) -> None:
    stage = make_stage()
    mesh = add_grid(stage, size=2)
    if rule is not None:
        mesh.CreateFaceVaryingLinearInterpolationAttr(rule)
    primvar = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, "faceVarying"
    )
    # The first face has values of its own. White, but black in the middle and above it.
    points = [Gf.Vec3f(0 if point in (4, 7) else 1) for point in range(9)]
    primvar.Set(Vt.Vec3fArray([*points, *points]))
    face_vertices = mesh.GetFaceVertexIndicesAttr().Get()
    indices = [p + (9 if i < 4 else 0) for i, p in enumerate(face_vertices)]
    primvar.SetIndices(Vt.IntArray(indices))
    found = render(stage)["color"]
    white = make_stage()
    add_grid(white, size=2, displayColor=[WHITE])
    shade = (found / render(white)["color"])[..., 0]
    places = {"lone": (16, 15), "bend": (15, 16), "edge": (0, 16)}
    assert tuple(name for name, at in places.items() if shade[at] < 0.15) == linear


@pytest.mark.parametrize("orientation", ["rightHanded", "leftHanded"])
def test_color_face_varying_stays_at_its_corners(orientation: str) -> None:
    stage = make_stage()
    mesh = add_grid(stage, size=1)
    mesh.CreateOrientationAttr(orientation)
    primvar = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, "faceVarying"
    )
    # Counter-clockwise from the lower left, as the face's vertices.
    primvar.Set([RED, GREEN, BLUE, WHITE])
    picture = render(stage)["color"][..., :3]
    corners = (picture[31, 0], picture[31, 31], picture[0, 31], picture[0, 0])
    for found, expected in zip(corners, (RED, GREEN, BLUE, WHITE), strict=True):
        assert np.allclose(found / found.max(), expected, atol=0.1)


def test_color_of_a_parent_is_inherited() -> None:
    stage = make_stage()
    parent = UsdGeom.Xform.Define(stage, "/World")
    primvars = UsdGeom.PrimvarsAPI(parent)
    primvars.CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "constant").Set([RED])
    add_grid(stage, "/World/Grid")
    assert render(stage)["color"][16, 16, 1] == 0


def test_color_edit_leaves_the_surface_alone() -> None:
    stage = make_stage()
    mesh = add_cube(stage)
    view = View(stage)
    before = view.render()
    mesh.CreateDisplayColorAttr([RED])
    after = view.render()
    assert (before["color"] != after["color"]).any()
    assert_same(after, before, CENTER_AOVS)


def test_skinned_points() -> None:
    stage = Usd.Stage.CreateInMemory()
    add_skinned_grid(stage)
    picture = render(stage)
    assert np.allclose(picture["cameraDepth"][16, 16], 4, atol=1e-3)


def add_skinned_grid(stage: Usd.Stage) -> None:
    """A grid that a single joint moves towards the camera by one unit."""
    from hydra_kit import add_camera, add_distant_light
    from pxr import UsdSkel

    add_camera(stage)
    add_distant_light(stage)
    UsdSkel.Root.Define(stage, "/Root")
    skeleton = UsdSkel.Skeleton.Define(stage, "/Root/Skeleton")
    skeleton.CreateJointsAttr(["joint"])
    skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1)])
    skeleton.CreateRestTransformsAttr([Gf.Matrix4d(1)])
    animation = UsdSkel.Animation.Define(stage, "/Root/Animation")
    animation.CreateJointsAttr(["joint"])
    animation.CreateTranslationsAttr([(0, 0, 1)])
    animation.CreateRotationsAttr([Gf.Quatf(1)])
    animation.CreateScalesAttr([Gf.Vec3h(1)])
    mesh = add_grid(stage, "/Root/Grid")
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateSkeletonRel().SetTargets(["/Root/Skeleton"])
    binding.CreateJointIndicesPrimvar(True, 1).Set([0])
    binding.CreateJointWeightsPrimvar(True, 1).Set([1.0])
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(
        ["/Root/Animation"]
    )
