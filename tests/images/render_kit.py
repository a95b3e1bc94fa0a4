"""Renders scenes of usd_scenes as their baselines are rendered."""

import subprocess
from pathlib import Path

import numpy as np
from _lib import pictures, record_options, render_process
from picture_kit import layers

ROOT = Path(__file__).resolve().parents[2]

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


def _arguments(scene: Path, picture: Path, *more: str) -> list[str]:
    """Those of tools/record for a baseline, and more."""
    arguments = [str(scene), str(picture), "--quiet", *OPTIONS, *MORE_OPTIONS.get(scene.stem, ())]
    for name in AOVS:
        arguments += ["--aov", name]
    return [*arguments, *more]


def record(scene: Path, picture: Path, *more: str) -> subprocess.CompletedProcess[str]:
    """Runs tools/record as for a baseline, with more options."""
    command = [str(ROOT / "tools" / "record"), *_arguments(scene, picture, *more)]
    return subprocess.run(command, text=True, capture_output=True, timeout=300, check=False)


def render(scene: Path, picture: Path, *more: str) -> None:
    """Does the same in this process, which takes a tenth of the time."""
    options = record_options.parse(_arguments(scene, picture, *more))
    with pictures.Workshop(options.picture) as workshop:
        options.workshop = str(workshop.path)
        render_process.record(options)


def settings(*options: str) -> list[str]:
    """Render settings as tools/record takes them."""
    return [word for option in options for word in ("--set", option)]


def name_of(scene: Path) -> str:
    """The scene's folder and name: what its test and its baseline are called."""
    return "-".join(scene.relative_to(ROOT / "usd_scenes").with_suffix("").parts)


def compared(scene: Path, picture: Path) -> dict[str, np.ndarray]:
    """The layers of a picture that its scene decides."""
    found = layers(picture)
    if scene.stem in COINCIDENT:
        del found["elementId"]
    return found
