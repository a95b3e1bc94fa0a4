"""Every scene of usd_scenes against its baseline, and the tracers against each other."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
from compare import differences
from picture_kit import layers

ROOT = Path(__file__).resolve().parents[2]
BASELINES = Path(__file__).parent / "baselines"
#: Pictures that were compared are kept here, to be looked at.
MADE = ROOT / "build" / "images"

ALL_SCENES = sorted((ROOT / "usd_scenes").rglob("*.usda"))
#: Their cameras see nothing: there is no picture to make.
UNSEEN = ("absurd_camera", "zero_clip_range")
SCENES = [scene for scene in ALL_SCENES if scene.stem not in UNSEEN]
AOVS = ("primId", "instanceId", "elementId", "cameraDepth")
OPTIONS = ("--imageWidth", "160", "--set", "hdcc:samples=8", "--set", "hdcc:level=4")
#: One level for all, which all tracers have.
OPTIONS += ("--set", "hdcc:adaptive=false")
#: Options of scenes that need others; the last one given holds.
MORE_OPTIONS: dict[str, tuple[str, ...]] = {
    "hero": ("--imageWidth", "180"),
    "catalogue": ("--imageWidth", "144"),
    "primvars": ("--aov", "primvars:st"),
}
#: Scenes in which surfaces coincide: which of them a ray meets first is up to rounding.
COINCIDENT = ("degenerate_faces",)
TRACERS = ("packet", "algorithm1", "single", "tessellated")
MOST_BYTES = 200_000


def _record(scene: Path, picture: Path, *more: str) -> subprocess.CompletedProcess[str]:
    command = [str(ROOT / "tools" / "record"), str(scene), str(picture), "--quiet", *OPTIONS]
    command += MORE_OPTIONS.get(scene.stem, ())
    for name in AOVS:
        command += ["--aov", name]
    return subprocess.run(
        [*command, *more], text=True, capture_output=True, timeout=300, check=False
    )


def _render(scene: Path, picture: Path, *more: str) -> None:
    """Renders a scene as its baseline is rendered."""
    finished = _record(scene, picture, *more)
    assert finished.returncode == 0, finished.stderr


def _name(scene: Path) -> str:
    """The scene's folder and name: what its test and its baseline are called."""
    return "-".join(scene.relative_to(ROOT / "usd_scenes").with_suffix("").parts)


def _compared(scene: Path, picture: Path) -> dict[str, np.ndarray]:
    """The layers of a picture that its scene decides."""
    found = layers(picture)
    if scene.stem in COINCIDENT:
        del found["elementId"]
    return found


def test_there_are_scenes() -> None:
    assert SCENES


@pytest.mark.parametrize("scene", SCENES, ids=_name)
def test_baseline(scene: Path, update_baselines: bool) -> None:
    baseline = BASELINES / f"{_name(scene)}.exr"
    if update_baselines:
        BASELINES.mkdir(exist_ok=True)
        _render(scene, baseline)
        return
    assert baseline.is_file(), "no baseline; tools/test --update-baselines makes it: look at it"
    MADE.mkdir(parents=True, exist_ok=True)
    made = MADE / baseline.name
    _render(scene, made)
    found = differences(_compared(scene, made), _compared(scene, baseline))
    assert not found, "\n".join([*found, f"see {made} and {baseline}"])


@pytest.mark.parametrize("scene", SCENES, ids=_name)
def test_tracers_agree(scene: Path, tmp_path: Path, update_baselines: bool) -> None:
    """All tracers hit the same surface, but for a rounding error at a silhouette."""
    if update_baselines:
        pytest.skip("makes no baseline")
    pictures = {}
    for tracer in TRACERS:
        picture = tmp_path / f"{tracer}.exr"
        _render(scene, picture, "--set", f"hdcc:tracer={tracer}", "--set", "hdcc:samples=1")
        pictures[tracer] = layers(picture)
    ids = {"primId", "instanceId", "elementId"}
    if scene.stem in COINCIDENT:
        ids.remove("elementId")
    packet = pictures.pop("packet")
    for tracer, other in pictures.items():
        for name in ids:
            assert np.mean(packet[name] != other[name]) <= 0.0005, (tracer, name)
        same = packet["elementId"] == other["elementId"]
        depths = packet["cameraDepth"][same], other["cameraDepth"][same]
        assert np.allclose(*depths, rtol=1e-4), tracer


@pytest.mark.parametrize("name", UNSEEN)
def test_cameras_that_see_nothing_are_refused(name: str, tmp_path: Path) -> None:
    finished = _record(ROOT / "usd_scenes" / "bad" / f"{name}.usda", tmp_path / "out.exr")
    assert finished.returncode == 1
    assert "</World/Camera>" in finished.stderr
    assert not list(tmp_path.iterdir())


def test_baselines_belong_to_scenes_and_are_small() -> None:
    names = {_name(scene) for scene in SCENES}
    for baseline in BASELINES.glob("*"):
        assert baseline.stem in names, f"{baseline.name} has no scene"
        assert baseline.stat().st_size < MOST_BYTES, f"{baseline.name} is too large"
