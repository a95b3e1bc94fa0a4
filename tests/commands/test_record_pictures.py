"""What tools/record writes: pictures, layers, frames and statistics."""

import json
import os
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from command_kit import ROOT, cube
from picture_kit import layers

AOVS = [
    "depth",
    "cameraDepth",
    "primId",
    "instanceId",
    "elementId",
    "normal",
    "Neye",
    "primvars:displayColor",
]
FAST = ["--set", "hdcc:samples=1", "--set", "hdcc:level=3"]


def test_a_picture_of_each_format(record, scene: Path) -> None:
    for suffix in ("exr", "png", "jpg", "tif"):
        result = record(scene, f"out.{suffix}", "-w", "60", *FAST)
        assert result.returncode == 0, result.stderr
        assert result.stderr == ""
        picture = layers(scene.parent / f"out.{suffix}")
        assert picture["color"].shape[:2] == (40, 60)
        assert picture["color"][20, 30, :3].max() > 0.05
    assert sorted(p.name for p in scene.parent.iterdir()) == [
        "cube.usda",
        "out.exr",
        "out.jpg",
        "out.png",
        "out.tif",
    ]


def test_the_camera_gives_the_height(record, scene: Path) -> None:
    assert record(scene, "out.exr", "-w", "30", "--camera", "Square", *FAST).returncode == 0
    assert layers(scene.parent / "out.exr")["color"].shape[:2] == (30, 30)


def test_settings_prim_gives_camera_and_resolution(record, scene: Path) -> None:
    result = record(scene, "out.exr", "-rs", "/World/Settings", "--quiet")
    assert result.returncode == 0, result.stderr
    assert result.stdout == ""
    assert layers(scene.parent / "out.exr")["color"].shape[:2] == (30, 40)


def test_aovs_go_into_one_file(record, scene: Path) -> None:
    scene.write_text(cube(holes="0"))
    asked = [word for name in AOVS for word in ("--aov", name)]
    result = record(scene, "out.exr", "-w", "60", *asked, *FAST)
    assert result.returncode == 0, result.stderr
    picture = layers(scene.parent / "out.exr")
    assert sorted(picture) == sorted(["color", *AOVS])
    # Through the hole at the centre one sees the far side, face 2, and past the cube nothing.
    assert picture["elementId"][20, 30, 0] == 2
    assert not np.any(picture["elementId"] == 0)
    assert picture["cameraDepth"][20, 30, 0] > 5.2
    assert picture["cameraDepth"][0, 0, 0] == 0
    assert picture["depth"][0, 0, 0] == 1
    assert 0 < picture["depth"][20, 30, 0] < 1
    assert np.linalg.norm(picture["normal"][20, 30]) == pytest.approx(1, abs=0.01)


def test_color_correction_is_for_display_formats(record, scene: Path) -> None:
    for name, mode in [("raw.png", "disabled"), ("srgb.png", "sRGB"), ("linear.exr", "sRGB")]:
        result = record(scene, name, "-w", "60", "-color", mode, *FAST)
        assert result.returncode == 0, result.stderr
    raw, srgb, linear = (
        layers(scene.parent / name)["color"][20, 30, :3]
        for name in ("raw.png", "srgb.png", "linear.exr")
    )
    assert np.allclose(raw, np.clip(linear, 0, 1), atol=0.006)
    low = linear <= 0.0031308
    expected = np.where(low, 12.92 * linear, 1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)
    assert np.allclose(srgb, np.clip(expected, 0, 1), atol=0.012)


def test_frames_are_numbered(record, scene: Path) -> None:
    result = record(
        scene, "out.###.exr", "-f", "1:3x2", "-w", "60", "--stats", "stats.#.json", *FAST
    )
    assert result.returncode == 0, result.stderr
    names = sorted(p.name for p in scene.parent.iterdir())
    assert names == ["cube.usda", "out.001.exr", "out.003.exr", "stats.1.json", "stats.3.json"]
    near, far = (layers(scene.parent / f"out.{n}.exr")["color"] for n in ("001", "003"))
    assert np.count_nonzero(near[:, :, 3]) > 2 * np.count_nonzero(far[:, :, 3])


def test_a_stage_without_camera_is_framed(record, scene: Path) -> None:
    record(scene, "out.exr", "-w", "60", "--mask", "/World/Cube", *FAST)
    alpha = layers(scene.parent / "out.exr")["color"][:, :, 3]
    assert alpha[alpha.shape[0] // 2, 30] == 1
    assert alpha[0].max() == 0


def test_purposes(record, scene: Path) -> None:
    shown = 'def Mesh "Cube"\n    {\n        uniform token purpose = "render"'
    scene.write_text(cube().replace('def Mesh "Cube"\n    {', shown))
    hits = []
    for purposes in (["proxy"], ["proxy,render"]):
        result = record(scene, "out.exr", "-w", "60", "--purposes", *purposes, *FAST)
        assert result.returncode == 0, result.stderr
        hits.append(np.count_nonzero(layers(scene.parent / "out.exr")["color"][:, :, 3]))
    assert hits[0] == 0
    assert hits[1] > 0


def test_camera_light_can_be_disabled(record, scene: Path) -> None:
    result = record(scene, "out.exr", "-w", "60", "--disableCameraLight", *FAST)
    assert result.returncode == 0, result.stderr
    with_light = record(scene, "lit.exr", "-w", "60", *FAST)
    assert with_light.returncode == 0
    dark, lit = (layers(scene.parent / n)["color"][20, 30, :3] for n in ("out.exr", "lit.exr"))
    assert lit.max() > dark.max()


def test_stats_have_the_keys_of_the_contract(record, scene: Path) -> None:
    result = record(scene, "out.png", "-w", "64", "--stats", "stats.json", *FAST)
    assert result.returncode == 0, result.stderr
    stats = json.loads((scene.parent / "stats.json").read_text())
    assert {key: sorted(v) if isinstance(v, dict) else None for key, v in stats.items()} == {
        "faces": None,
        "patches": None,
        "seconds": ["build", "sync", "trace"],
        "rays": ["primary", "reflection", "shadow"],
        "mrays_per_second": ["primary", "reflection", "shadow"],
        "bytes": ["peak_rss", "per_face", "structures"],
        "levels": ["histogram", "max", "min"],
        "packet": [
            "active_lanes",
            "early_hit",
            "final_intersections",
            "interval_culls",
            "leaf_intersections",
            "subdivisions_irregular",
            "subdivisions_regular",
            "traversals",
        ],
    }
    assert stats["faces"] == 6
    assert stats["rays"]["primary"] >= 64 * 42
    assert stats["seconds"]["trace"] > 0
    assert sum(stats["levels"]["histogram"]) == stats["patches"]


def test_broken_mesh_is_a_warning_with_its_path(record, scene: Path) -> None:
    scene.write_text(cube(broken=True))
    result = record(scene, "out.exr", "-w", "60", *FAST)
    assert result.returncode == 0, result.stderr
    lines = result.stderr.splitlines()
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith("warning: ")
    assert "/World/Broken" in lines[0]
    assert layers(scene.parent / "out.exr")["color"][20, 30, 3] == 1


def test_numbers_of_settings_may_be_written_as_people_do(record, scene: Path) -> None:
    for text in ("4", "4.0", "4e0"):
        result = record(scene, "out.png", "-w", "60", "--set", f"hdcc:samples={text}")
        assert result.returncode == 0, result.stderr


def test_settings_prim_of_the_stage_may_be_missing(record, scene: Path) -> None:
    for path in ("/World/Nothing", "no path"):
        metadata = f'(\n    renderSettingsPrimPath = "{path}"'
        scene.write_text(cube().replace("(", metadata, 1))
        result = record(scene, "out.exr", "-w", "60", *FAST)
        assert result.returncode == 0, result.stderr
        # OpenUSD has its own say about what is no path.
        lines = result.stderr.splitlines()
        assert all(line.startswith("warning: ") for line in lines)
        assert path in lines[0]


@pytest.mark.parametrize("resolution", ["0, 30", "40, -1", "40, 100000", "2147483647, 1"])
def test_resolution_without_meaning_is_refused(record, scene: Path, resolution: str) -> None:
    scene.write_text(cube().replace("resolution = (40, 30)", f"resolution = ({resolution})"))
    result = record(scene, "out.exr", "-rs", "/World/Settings", *FAST)
    assert result.returncode == 1
    (line,) = result.stderr.splitlines()
    assert line.startswith("error: /World/Settings: its resolution")
    assert not (scene.parent / "out.exr").exists()


def test_camera_without_shape_is_refused(record, scene: Path) -> None:
    scene.write_text(cube().replace("horizontalAperture = 24", "horizontalAperture = 0.01"))
    result = record(scene, "out.exr", "--camera", "Square", *FAST)
    assert result.returncode == 1
    (line,) = result.stderr.splitlines()
    assert line.startswith("error: /World/Square: its aspect ratio")


def test_mask_of_what_is_not_there_is_warned_about(record, scene: Path) -> None:
    result = record(scene, "out.exr", "-w", "60", "--mask", "/World/Cube,/Nothing", *FAST)
    assert result.returncode == 0, result.stderr
    (line,) = result.stderr.splitlines()
    assert line.startswith("warning: ")
    assert "/Nothing" in line


def test_the_same_seed_gives_the_same_bits(record, scene: Path) -> None:
    for name, threads in (("one.exr", 1), ("two.exr", 2)):
        result = record(scene, name, "-w", "60", "--set", f"hdcc:threads={threads}")
        assert result.returncode == 0, result.stderr
    one, two = (layers(scene.parent / name)["color"] for name in ("one.exr", "two.exr"))
    assert np.array_equal(one, two)


def test_an_old_picture_survives_a_failure(record, scene: Path) -> None:
    old = scene.parent / "out.png"
    old.write_bytes(b"old")
    assert record(scene, "out.png", "--camera", "Nobody").returncode != 0
    assert old.read_bytes() == b"old"


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_interrupting_leaves_no_half_file(scene: Path, ending: signal.Signals) -> None:
    heavy = ["-w", "2000", "--set", "hdcc:samples=100000"]
    process = subprocess.Popen(
        [str(ROOT / "tools" / "record"), str(scene), "out.png", *heavy],
        cwd=scene.parent,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
        # What is started in the background of a shell is deaf to this signal otherwise.
        preexec_fn=lambda: signal.signal(ending, signal.SIG_DFL),
    )
    _wait_for(lambda: any(p.name.startswith(".hdcc-") for p in scene.parent.iterdir()))
    time.sleep(0.5)
    process.send_signal(ending)
    _, errors = process.communicate(timeout=60)
    assert process.returncode != 0
    assert errors.splitlines()[-1].startswith("error: ")
    assert [p.name for p in scene.parent.iterdir()] == ["cube.usda"]


def _wait_for(condition) -> None:
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)
