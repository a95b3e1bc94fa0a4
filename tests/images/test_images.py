"""Every scene of usd_scenes against its baseline, and the tracers against each other."""

from pathlib import Path

import numpy as np
import pytest
from compare import differences
from picture_kit import layers
from render_kit import COINCIDENT, ROOT, SCENES, UNSEEN, compared, name_of, record, render

BASELINES = Path(__file__).parent / "baselines"
#: Pictures that were compared are kept here, to be looked at.
MADE = ROOT / "build" / "images"
TRACERS = ("packet", "algorithm1", "single", "tessellated")
MOST_BYTES = 200_000


def test_there_are_scenes() -> None:
    assert SCENES


@pytest.mark.parametrize("scene", SCENES, ids=name_of)
def test_baseline(scene: Path, update_baselines: bool) -> None:
    baseline = BASELINES / f"{name_of(scene)}.exr"
    if update_baselines:
        BASELINES.mkdir(exist_ok=True)
        _record(scene, baseline)
        return
    assert baseline.is_file(), "no baseline; tools/test --update-baselines makes it: look at it"
    MADE.mkdir(parents=True, exist_ok=True)
    made = MADE / baseline.name
    _record(scene, made)
    found = differences(compared(scene, made), compared(scene, baseline))
    assert not found, "\n".join([*found, f"see {made} and {baseline}"])


def _record(scene: Path, picture: Path) -> None:
    finished = record(scene, picture)
    assert finished.returncode == 0, finished.stderr


@pytest.mark.parametrize("scene", SCENES, ids=name_of)
def test_tracers_agree(scene: Path, tmp_path: Path, update_baselines: bool) -> None:
    """All tracers hit the same surface, but for a rounding error at a silhouette."""
    if update_baselines:
        pytest.skip("makes no baseline")
    pictures = {}
    for tracer in TRACERS:
        picture = tmp_path / f"{tracer}.exr"
        render(scene, picture, "--set", f"hdcc:tracer={tracer}", "--set", "hdcc:samples=1")
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
    finished = record(ROOT / "usd_scenes" / "bad" / f"{name}.usda", tmp_path / "out.exr")
    assert finished.returncode == 1
    assert "</World/Camera>" in finished.stderr
    assert not list(tmp_path.iterdir())


def test_baselines_belong_to_scenes_and_are_small() -> None:
    names = {name_of(scene) for scene in SCENES}
    for baseline in BASELINES.glob("*"):
        assert baseline.stem in names, f"{baseline.name} has no scene"
        assert baseline.stat().st_size < MOST_BYTES, f"{baseline.name} is too large"
