"""Adaptive levels: pictures of them against pictures of finer levels."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from picture_kit import layers
from render_kit import ROOT, SCENES, compared, name_of, render, settings

IDS = ("primId", "instanceId", "elementId")
#: The farthest that anything may be off in a picture, in pixels: 0.25 is asked for.
MOST_PIXELS = 0.3
FRAMES = 48


@pytest.fixture(autouse=True)
def _compares_levels(update_baselines: bool) -> None:
    if update_baselines:
        pytest.skip("makes no baseline")


def _is_beside_edge(ids: np.ndarray) -> np.ndarray:
    """Pixels next to another prim or face, or to nothing."""
    height, width = ids.shape
    beside = np.zeros(ids.shape, bool)
    padded = np.pad(ids, 1, mode="edge")
    for row in range(3):
        for column in range(3):
            beside |= padded[row : row + height, column : column + width] != ids
    return beside


def _adaptive(scene: Path, picture: Path, *more: str) -> dict[str, np.ndarray]:
    options = ("hdcc:adaptive=true", "hdcc:samples=1", "hdcc:level=6", *more)
    render(scene, picture, *settings(*options))
    return compared(scene, picture)


@pytest.mark.parametrize("metric", ["hdcc:pixelError=0.25", "hdcc:alpha=200"])
@pytest.mark.parametrize("scene", SCENES, ids=name_of)
def test_adaptive_levels_show_the_surface(scene: Path, metric: str, tmp_path: Path) -> None:
    """They show what the finest level shows, but at silhouettes and edges of faces."""
    adaptive = _adaptive(scene, tmp_path / "adaptive.exr", metric)
    finest = _adaptive(scene, tmp_path / "finest.exr", "hdcc:adaptive=false")
    names = sorted({*IDS} & set(finest))
    beside = np.any([_is_beside_edge(finest[name][..., 0]) for name in names], axis=0)
    for name in names:
        is_other = adaptive[name][..., 0] != finest[name][..., 0]
        assert not (is_other & ~beside).any(), name
        # A quarter of a pixel at most, and mostly far less.
        assert is_other.sum() <= 2 + 0.02 * beside.sum(), name


@pytest.mark.parametrize("metric", ["hdcc:pixelError=0.25", "hdcc:alpha=200"])
@pytest.mark.parametrize("name", ["hero", "features/catalogue", "features/loop"])
def test_adaptive_levels_are_those_of_single_rays(name: str, metric: str, tmp_path: Path) -> None:
    scene = ROOT / "usd_scenes" / f"{name}.usda"
    packet = _adaptive(scene, tmp_path / "packet.exr", metric)
    single = _adaptive(scene, tmp_path / "single.exr", metric, "hdcc:tracer=single")
    for layer, plane in packet.items():
        assert np.array_equal(plane, single[layer]), layer


def test_levels_by_distance_are_three(tmp_path: Path) -> None:
    """Coarse, medium and fine, the finer the nearer, with fans where they meet."""
    scene = ROOT / "usd_scenes" / "hero.usda"
    picture = tmp_path / "levels.exr"
    aovs = ("--aov", "hdcc:level", "--aov", "hdcc:fan")
    options = ("hdcc:adaptive=true", "hdcc:samples=1", "hdcc:level=6", "hdcc:alpha=10")
    render(scene, picture, *aovs, *settings(*options))
    found = layers(picture)
    level, depth = found["hdcc:level"][..., 0], found["cameraDepth"][..., 0]
    assert set(np.unique(level)) == {4, 5, 6}
    depths = [np.median(depth[level == n]) for n in (6, 5, 4)]
    assert depths == sorted(depths)
    fans = found["hdcc:fan"][..., 0] == 1
    assert fans.any()
    assert not (fans & (level == 6)).any(), "fans are on the coarser side"


def _spread(mask: np.ndarray, pixels: float) -> np.ndarray:
    """Pixels within a distance of those of a mask."""
    height, width = mask.shape
    reach = int(np.ceil(pixels))
    padded = np.pad(mask, reach)
    spread = np.zeros(mask.shape, bool)
    for row in range(-reach, reach + 1):
        for column in range(-reach, reach + 1):
            if np.hypot(row, column) <= pixels:
                spread |= padded[reach + row :, reach + column :][:height, :width]
    return spread


def test_silhouettes_are_within_the_error(tmp_path: Path) -> None:
    """Eight times as large, a picture shows where silhouettes are to an eighth of a pixel."""
    larger = 8
    words = settings("hdcc:adaptive=true", "hdcc:samples=1", "hdcc:level=8")
    words += ["--imageWidth", str(160 * larger)]
    pictures = []
    for metric in (f"hdcc:pixelError={0.25 * larger}", "hdcc:adaptive=false"):
        picture = tmp_path / f"{len(pictures)}.exr"
        render(ROOT / "usd_scenes" / "hero.usda", picture, *words, "--set", metric)
        pictures.append(layers(picture)["primId"][..., 0])
    is_off = pictures[0] != pictures[1]
    assert is_off.sum() > 100, "this asks for nothing"
    for prims in pictures:
        # A pixel beside a silhouette has its centre up to half of a diagonal away from it.
        near = _spread(_is_beside_edge(prims), MOST_PIXELS * larger + np.sqrt(0.5))
        assert not (is_off & ~near).any()


DOLLY = """#usda 1.0
(
    subLayers = [@./city.usdc@]
    startTimeCode = 1
    endTimeCode = {frames}
)
over "World"
{{
    over "Camera"
    {{
        double3 xformOp:translate:dolly.timeSamples = {{ 1: (0, 0, 0), {frames}: (0, 0, -6) }}
        uniform token[] xformOpOrder = ["xformOp:transform", "xformOp:translate:dolly"]
    }}
}}
"""


@pytest.fixture(scope="module")
def dolly(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A slow way down a street of a small city."""
    folder = tmp_path_factory.mktemp("dolly")
    generator = ROOT / "usd_scenes" / "generators" / "city.py"
    command = [sys.executable, str(generator), str(folder / "city.usdc"), "--faces", "20000"]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    scene = folder / "dolly.usda"
    scene.write_text(DOLLY.format(frames=FRAMES))
    return scene


def _frames(scene: Path, folder: Path, *options: str) -> list[dict[str, np.ndarray]]:
    words = settings("hdcc:samples=1", *options)
    words += ["--frames", f"1:{FRAMES}", "--aov", "hdcc:level", "--aov", "Neye"]
    render(scene, folder / "f.####.exr", *words)
    return [layers(folder / f"f.{frame:04}.exr") for frame in range(1, FRAMES + 1)]


def _off_surface(picture: dict[str, np.ndarray], finest: dict[str, np.ndarray]) -> np.ndarray:
    """How far hits are from the surface, across it, in pixels."""
    depth = finest["cameraDepth"][..., 0]
    height, width = depth.shape
    # The camera of the city: 27 mm before a square of 36 mm.
    across, up = ((np.arange(n) + 0.5) / n - 0.5 for n in (width, height))
    directions = np.stack(
        [*np.meshgrid(36 / 27 * across, -36 / 27 * up), np.full(depth.shape, -1.0)], axis=-1
    )
    slope = np.abs(np.sum(finest["Neye"] * directions, axis=-1))
    return (picture["cameraDepth"][..., 0] - depth) * slope * (width * 27 / 36) / depth


def _is_beside_jump(depth: np.ndarray) -> np.ndarray:
    """Pixels next to others that are much nearer or further away."""
    padded = np.pad(depth, 1, mode="edge")
    beside = np.zeros(depth.shape, bool)
    height, width = depth.shape
    for row in range(3):
        for column in range(3):
            other = padded[row : row + height, column : column + width]
            beside |= ~(np.abs(other - depth) <= 0.02 * depth)
    return beside


def test_nothing_pops_in_a_dolly(dolly: Path, tmp_path: Path) -> None:
    """From frame to frame levels change, and the picture as it does at the finest level."""
    for name in ("adaptive", "finest"):
        (tmp_path / name).mkdir()
    adaptive = _frames(dolly, tmp_path / "adaptive", "hdcc:adaptive=true", "hdcc:level=8")
    finest = _frames(dolly, tmp_path / "finest", "hdcc:adaptive=false", "hdcc:level=8")
    popped = edges = changed = 0
    for (a, b), (fine_a, fine_b) in zip(
        zip(adaptive, adaptive[1:]), zip(finest, finest[1:]), strict=True
    ):
        beside = np.zeros(fine_a["primId"].shape[:2], bool)
        for fine in (fine_a, fine_b):
            beside |= _is_beside_edge(fine["primId"][..., 0])
            beside |= _is_beside_jump(fine["cameraDepth"][..., 0])
        has_popped, changed_prim = (
            (first["primId"] != second["primId"])[..., 0]
            for first, second in ((a, b), (fine_a, fine_b))
        )
        has_popped ^= changed_prim
        assert not (has_popped & ~beside).any()
        popped += has_popped.sum()
        edges += beside.sum()
        with np.errstate(invalid="ignore"):
            moved = _off_surface(a, fine_a) - _off_surface(b, fine_b)
        inside = ~beside & (fine_a["primId"][..., 0] >= 0)
        assert np.abs(moved[inside]).max() <= MOST_PIXELS
        changed += (a["hdcc:level"] != b["hdcc:level"])[..., 0][inside].sum()
    assert changed > 0, "no level has changed"
    assert popped <= 0.01 * edges
