"""Render products: what tools/record makes of a UsdRenderSettings prim."""

from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest
from command_kit import cube
from picture_kit import layers

PRODUCTS = """
def Scope "Render"
{
    def RenderSettings "Settings"
    {
        rel camera = </World/Square>
        uniform int2 resolution = (48, 36)
        int hdcc:samples = 1
        rel products = [PRODUCTS]
SETTINGS
    }
    def RenderVar "Color"
    {
        uniform string sourceName = "color"
    }
    def RenderVar "Precise"
    {
        uniform string sourceName = "color"
        uniform token dataType = "color4f"
        string driver:parameters:aov:name = "precise"
    }
    def RenderVar "Depth"
    {
        uniform string sourceName = "cameraDepth"
        string driver:parameters:aov:name = "z"
        string driver:parameters:aov:format = "half"
    }
    def RenderVar "Face"
    {
        uniform string sourceName = "elementId"
        uniform token dataType = "int"
    }
    def RenderVar "Primvar"
    {
        uniform string sourceName = "displayColor"
        uniform token sourceType = "primvar"
    }
    def RenderVar "Light"
    {
        uniform string sourceName = "C.*[LO]"
        uniform token sourceType = "lpe"
    }
    def RenderVar "Unknown"
    {
        uniform string sourceName = "occlusion"
    }
BODY
}
"""


def product(name: str, body: str, variables: str = "Color") -> str:
    targets = ", ".join(f"</Render/{variable}>" for variable in variables.split())
    return f"""
    def RenderProduct "{name}"
    {{
        rel orderedVars = [{targets}]
        {body}
    }}
"""


@pytest.fixture
def products(record, scene: Path):
    """Renders a scene with these products; returns what the command said."""

    def run(bodies: dict[str, str], *options: str, settings: str = "", text: str = ""):
        parts = [
            product(name, *(body if isinstance(body, tuple) else (body,)))
            for name, body in bodies.items()
        ]
        render = PRODUCTS.replace("BODY", "".join(parts)).replace("SETTINGS", settings)
        targets = ", ".join(f"</Render/{name}>" for name in bodies)
        scene.write_text((text or cube()) + render.replace("[PRODUCTS]", f"[{targets}]"))
        return record(scene, "out.exr", "-rs", "/Render/Settings", *options)

    return run


def header(picture: Path) -> oiio.ImageSpec:
    source = oiio.ImageInput.open(str(picture))
    assert source, oiio.geterror()
    return source.spec()


def name(file: str) -> str:
    return f'uniform token productName = "{file}"'


def test_each_product_is_a_file(products, scene: Path) -> None:
    result = products(
        {"A": (name("a.exr"), "Color Face"), "B": (name("b.exr"), "Color"), "C": ("", "Depth")}
    )
    assert result.returncode == 0, result.stderr
    folder = scene.parent
    assert sorted(layers(folder / "a.exr")) == ["color", "elementId"]
    assert sorted(layers(folder / "b.exr")) == ["color"]
    assert sorted(layers(folder / "out.exr")) == ["z"]
    assert (layers(folder / "a.exr")["color"] == layers(folder / "b.exr")["color"]).all()
    assert [line.split()[0] for line in result.stdout.splitlines()] == ["a.exr", "b.exr", "out.exr"]
    assert not list(folder.glob(".hdcc-*"))


def test_full_paths_are_where_they_say(products, scene: Path, tmp_path: Path) -> None:
    other = tmp_path / "elsewhere"
    other.mkdir()
    result = products({"A": name(str(other / "a.exr"))})
    assert result.returncode == 0, result.stderr
    assert [path.name for path in other.iterdir()] == ["a.exr"]


def test_variables_name_layers_and_types(products, scene: Path) -> None:
    result = products({"A": (name("a.exr"), "Color Precise Depth Face Primvar")})
    assert result.returncode == 0, result.stderr
    spec = header(scene.parent / "a.exr")
    types = {spec.channelnames[i]: str(spec.channelformat(i)) for i in range(spec.nchannels)}
    colour = {f"precise.{channel}": "float" for channel in "RGBA"}
    primvar = {f"primvars:displayColor.{axis}": "float" for axis in "XYZ"}
    expected = dict.fromkeys("RGBA", "half") | colour | primvar
    assert types == expected | {"z.Z": "half", "elementId.X": "float"}
    picture = layers(scene.parent / "a.exr")
    assert np.allclose(picture["color"], picture["precise"], atol=1e-3)
    assert np.allclose(picture["primvars:displayColor"][18, 24], (1, 0.5, 0.25))


def test_products_have_their_own_resolution_and_camera(products, scene: Path) -> None:
    body = name("small.exr") + "\nuniform int2 resolution = (24, 24)"
    result = products({"Small": body, "Large": name("large.exr")})
    assert result.returncode == 0, result.stderr
    assert layers(scene.parent / "small.exr")["color"].shape[:2] == (24, 24)
    assert layers(scene.parent / "large.exr")["color"].shape[:2] == (36, 48)


def test_the_width_given_comes_before_the_resolution(products, scene: Path) -> None:
    assert products({"A": name("a.exr")}, "-w", "24").returncode == 0
    assert layers(scene.parent / "a.exr")["color"].shape[:2] == (18, 24)


@pytest.mark.parametrize(
    ("window", "corner", "size"),
    [
        ("(0.25, 0.5, 0.75, 1)", (12, 0), (24, 18)),
        ("(0, 0, 0.5, 0.5)", (0, 18), (24, 18)),
        ("(-0.25, -0.5, 1.25, 1.5)", (-12, -18), (72, 72)),
    ],
)
def test_crops_are_parts_of_the_whole(products, scene: Path, window: str, corner, size) -> None:
    body = name("crop.exr") + f"\nuniform float4 dataWindowNDC = {window}"
    result = products({"Crop": (body, "Color Face"), "Whole": (name("whole.exr"), "Color Face")})
    assert result.returncode == 0, result.stderr
    spec = header(scene.parent / "crop.exr")
    assert (spec.x, spec.y) == corner
    assert (spec.width, spec.height) == size
    assert (spec.full_x, spec.full_y, spec.full_width, spec.full_height) == (0, 0, 48, 36)
    crop, whole = (layers(scene.parent / f"{each}.exr")["elementId"] for each in ("crop", "whole"))
    x0, y0 = max(corner[0], 0), max(corner[1], 0)
    x1, y1 = min(corner[0] + size[0], 48), min(corner[1] + size[1], 36)
    inside = crop[y0 - corner[1] : y1 - corner[1], x0 - corner[0] : x1 - corner[0]]
    assert (inside != whole[y0:y1, x0:x1]).mean() < 0.005


@pytest.mark.parametrize(
    ("policy", "aspect", "wide", "tall"),
    [
        # Of the cube in pixels: a square camera, and a picture of 48 x 36.
        ("expandAperture", 1.0, 1.0, 1.0),
        ("cropAperture", 1.0, 48 / 36, 48 / 36),
        ("adjustApertureWidth", 1.0, 1.0, 1.0),
        ("adjustApertureHeight", 1.0, 48 / 36, 48 / 36),
        ("adjustPixelAspectRatio", 1.0, 48 / 36, 1.0),
        ("expandAperture", 0.75, 48 / 36, 1.0),
        ("expandAperture", 0.5, 48 / 36, 48 / 36 * 0.5),
    ],
)
def test_aspect_ratios_conform(products, scene, policy, aspect, wide, tall) -> None:
    body = (
        name("a.exr")
        + f'\nuniform token aspectRatioConformPolicy = "{policy}"'
        + f"\nuniform float pixelAspectRatio = {aspect}"
    )
    result = products({"Plain": (name("plain.exr"), "Face"), "A": (body, "Face")})
    assert result.returncode == 0, result.stderr

    def extent(file: str) -> tuple[int, int]:
        hit = layers(scene.parent / file)["elementId"][:, :, 0] >= 0
        return int(hit.any(0).sum()), int(hit.any(1).sum())

    plain, found = extent("plain.exr"), extent("a.exr")
    assert abs(found[0] - plain[0] * wide) <= 2
    assert abs(found[1] - plain[1] * tall) <= 2
    is_adjusted = policy == "adjustPixelAspectRatio"
    expected = 36 / 48 if is_adjusted else aspect
    written = header(scene.parent / "a.exr").get_float_attribute("PixelAspectRatio")
    assert written == pytest.approx(expected)


def test_headers_say_what_products_say(products, scene: Path) -> None:
    body = (
        name("a.exr")
        + '\nstring driver:parameters:shot = "sq 12"'
        + "\nfloat driver:parameters:gain = 2.5"
        + '\nstring[] driver:parameters:list = ["a"]'
    )
    result = products({"A": body})
    assert result.returncode == 0
    assert result.stderr.count("/Render/A.driver:parameters:list: no header holds") == 1
    spec = header(scene.parent / "a.exr")
    assert spec.get_string_attribute("shot") == "sq 12"
    assert spec.get_float_attribute("gain") == 2.5
    assert spec.get_string_attribute("Software") == "hdCC"
    assert spec.get_string_attribute("camera") == "/World/Square"
    # The camera is at z = 9.
    assert np.reshape(spec.getattribute("worldToCamera"), (4, 4))[3].tolist() == [0, 0, -9, 1]


def partly_covered(picture: Path) -> int:
    alpha = layers(picture)["color"][:, :, 3]
    return int(((alpha > 0.02) & (alpha < 0.98)).sum())


def test_blur_can_be_disabled(products, scene: Path) -> None:
    rest = "double3 xformOp:translate = (0, 0, 9)"
    moves = "double3 xformOp:translate.timeSamples = { 1: (0, 0, 9), 2: (3, 0, 9) }"
    text = cube().replace(
        rest, f"{moves}\ndouble shutter:close = 1\nfloat fStop = 4\nfloat focusDistance = 4"
    )
    bodies = {
        "both": "",
        "still": "uniform bool disableMotionBlur = 1",
        "sharp": "uniform bool disableDepthOfField = 1",
        "none": "uniform bool instantaneousShutter = 1\nuniform bool disableDepthOfField = 1",
    }
    bodies = {each: name(f"{each}.exr") + "\n" + body for each, body in bodies.items()}
    result = products(bodies, "--set", "hdcc:samples=16", text=text)
    assert result.returncode == 0, result.stderr
    both, still, sharp, none = (partly_covered(scene.parent / f"{each}.exr") for each in bodies)
    assert none < 0.2 * still
    assert none < 0.2 * sharp
    assert max(still, sharp) < both


@pytest.mark.parametrize(
    ("bodies", "message"),
    [
        ({"A": ("", "Light")}, "/Render/Light: variables of the type lpe are not supported"),
        ({"A": ("", "Unknown")}, "/Render/Unknown: there is no AOV 'occlusion'"),
        ({"A": ("", "Missing")}, "/Render/A: its variable /Render/Missing is no RenderVar"),
        (
            {"A": 'uniform token productType = "deepRaster"'},
            "/Render/A: products of the type deepRaster are not supported",
        ),
        ({"A": name("a.tga")}, "a.tga: unknown picture format"),
        ({"A": name("none/a.exr")}, "none/a.exr: there is no folder"),
        ({"A": name("a.exr"), "B": name("a.exr")}, "/Render/A: another product is a.exr, too"),
        ({"A": "uniform float pixelAspectRatio = 0"}, "/Render/A: its pixelAspectRatio 0 is not"),
        (
            {"A": "uniform float4 dataWindowNDC = (0.5, 0, 0.5, 1)"},
            "/Render/A: its dataWindowNDC holds no pixel",
        ),
        (
            {"A": "uniform float4 dataWindowNDC = (nan, 0, 0.5, 1)"},
            "/Render/A: its dataWindowNDC makes no sense",
        ),
        ({"A": "uniform int2 resolution = (0, 5)"}, "/Render/A: its resolution makes a picture"),
        (
            {"A": 'uniform token aspectRatioConformPolicy = "stretch"'},
            "/Render/A: there is no aspectRatioConformPolicy 'stretch'",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(products, scene: Path, bodies: dict, message: str) -> None:
    result = products(bodies)
    assert result.returncode != 0
    (line,) = result.stderr.splitlines()
    assert message in line
    assert not list(scene.parent.glob("*.exr"))


def test_a_target_that_is_no_product_is_refused(products) -> None:
    result = products({}, settings="prepend rel products = [</World/Cube>]")
    assert result.returncode != 0
    assert "is no RenderProduct" in result.stderr
