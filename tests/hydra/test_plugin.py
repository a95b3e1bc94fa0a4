"""The plugin as applications see it: its name, settings, commands and statistics."""

import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hydra_kit import PLUGIN, View, add_cube, add_grid, make_stage, render
from pxr import Sdf, Tf, Usd, UsdImagingGL, UsdRender

DEFAULTS = {
    "hdcc:tracer": "packet",
    "hdcc:adaptive": True,
    "hdcc:pixelError": 0.25,
    "hdcc:secondaryError": 0.0,
    "hdcc:alpha": 0.0,
    "hdcc:level": 4,
    "hdcc:integrator": "raycast",
    "hdcc:samples": 16,
    "hdcc:seed": 0,
    "hdcc:threads": 0,
    "hdcc:aovs": "",
    "hdcc:dump": "",
}


def make_engine() -> UsdImagingGL.Engine:
    parameters = UsdImagingGL.Engine.Parameters()
    parameters.gpuEnabled = False
    parameters.rendererPluginId = PLUGIN
    return UsdImagingGL.Engine(parameters)


def test_is_discovered() -> None:
    assert PLUGIN in UsdImagingGL.Engine.GetRendererPlugins()
    assert UsdImagingGL.Engine.GetRendererDisplayName(PLUGIN) == "CC"
    assert make_engine().GetCurrentRendererId() == PLUGIN


def test_settings_are_listed() -> None:
    engine = make_engine()
    listed = {setting.key: setting.defValue for setting in engine.GetRendererSettingsList()}
    assert listed == DEFAULTS
    assert {key: engine.GetRendererSetting(key) for key in DEFAULTS} == DEFAULTS


@pytest.mark.parametrize(
    ("key", "value", "taken"),
    [
        ("hdcc:adaptive", False, False),
        ("hdcc:adaptive", "false", False),
        ("hdcc:adaptive", "true", True),
        ("hdcc:adaptive", 0, False),
        ("hdcc:adaptive", "1", True),
        ("hdcc:pixelError", 2, 2.0),
        ("hdcc:pixelError", "0.5", 0.5),
        ("hdcc:alpha", 12, 12.0),
        ("hdcc:level", 8, 8),
        ("hdcc:level", 3.0, 3),
        ("hdcc:level", "5", 5),
        ("hdcc:samples", 1, 1),
        ("hdcc:seed", -7, -7),
        ("hdcc:tracer", "single", "single"),
        ("hdcc:tracer", "algorithm1", "algorithm1"),
        ("hdcc:tracer", "tessellated", "tessellated"),
        ("hdcc:aovs", "normal, cameraDepth", "normal, cameraDepth"),
    ],
)
def test_setting_is_taken(key: str, value: Any, taken: Any) -> None:
    engine = make_engine()
    engine.SetRendererSetting(key, value)
    assert engine.GetRendererSetting(key) == taken
    assert type(engine.GetRendererSetting(key)) is type(taken)


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [
        ("hdcc:adaptive", 2, "true or false"),
        ("hdcc:adaptive", "yes", "true or false"),
        ("hdcc:adaptive", "", "true or false"),
        ("hdcc:pixelError", 0, "0.001 to 1000"),
        ("hdcc:pixelError", -1.0, "a number from"),
        ("hdcc:pixelError", float("nan"), "a number from"),
        ("hdcc:pixelError", "fine", "a number from"),
        ("hdcc:pixelError", True, "a number from"),
        ("hdcc:alpha", -1, "0 to 1000000000"),
        ("hdcc:alpha", float("inf"), "a number from"),
        ("hdcc:level", 9, "0 to 8"),
        ("hdcc:level", -1, "0 to 8"),
        ("hdcc:level", 2.5, "integer"),
        ("hdcc:level", float("nan"), "integer"),
        ("hdcc:level", "four", "integer"),
        ("hdcc:level", "", "integer"),
        ("hdcc:level", True, "integer"),
        ("hdcc:level", 2**40, "0 to 8"),
        ("hdcc:samples", 0, "from 1 up"),
        ("hdcc:threads", -1, "0 to 1024"),
        ("hdcc:threads", 100_000, "0 to 1024"),
        ("hdcc:tracer", "fast", "packet, algorithm1, single, tessellated"),
        ("hdcc:tracer", 1, "packet, algorithm1, single, tessellated"),
        ("hdcc:integrator", "path", "raycast"),
        ("hdcc:aovs", "normal beauty", "AOVs"),
    ],
)
def test_bad_value_is_refused(key: str, value: Any, allowed: str) -> None:
    engine = make_engine()
    with pytest.raises(Tf.ErrorException) as refusal:
        engine.SetRendererSetting(key, value)
    assert key in str(refusal.value)
    assert allowed in str(refusal.value)
    assert engine.GetRendererSetting(key) == DEFAULTS[key]


def test_unknown_key_is_refused() -> None:
    engine = make_engine()
    with pytest.raises(Tf.ErrorException, match="hdcc:smaples.*hdcc:samples"):
        engine.SetRendererSetting("hdcc:smaples", 4)
    assert engine.GetRendererSetting("hdcc:smaples") is None
    engine.SetRendererSetting("enableInteractive", False)


def make_stage_with_settings(**attributes: Any) -> Usd.Stage:
    stage = make_stage()
    add_grid(stage)
    prim = UsdRender.Settings.Define(stage, "/Render/Final").GetPrim()
    for name, value in attributes.items():
        kind = Sdf.ValueTypeNames.Int if isinstance(value, int) else Sdf.ValueTypeNames.Token
        prim.CreateAttribute(f"hdcc:{name}", kind).Set(value)
    return stage


def test_render_settings_prim_is_heeded() -> None:
    stage = make_stage_with_settings(level=2, tracer="single")
    other = UsdRender.Settings.Define(stage, "/Render/Other").GetPrim()
    other.CreateAttribute("hdcc:level", Sdf.ValueTypeNames.Int).Set(7)
    view = View(stage)
    view.engine.SetActiveRenderSettingsPrimPath(Sdf.Path("/Render/Final"))
    view.execute()
    assert view.engine.GetRendererSetting("hdcc:level") == 2
    assert view.engine.GetRendererSetting("hdcc:tracer") == "single"

    stage.GetPrimAtPath("/Render/Final").GetAttribute("hdcc:level").Set(1)
    view.execute()
    assert view.engine.GetRendererSetting("hdcc:level") == 1

    view.engine.SetActiveRenderSettingsPrimPath(Sdf.Path("/Render/Other"))
    view.execute()
    assert view.engine.GetRendererSetting("hdcc:level") == 7
    assert view.engine.GetRendererSetting("hdcc:tracer") == "packet"


def test_render_settings_prim_yields_to_the_application() -> None:
    view = View(make_stage_with_settings(level=2), level=6)
    view.engine.SetActiveRenderSettingsPrimPath(Sdf.Path("/Render/Final"))
    view.execute()
    assert view.engine.GetRendererSetting("hdcc:level") == 6


def test_bad_render_settings_prim_warns(warnings: Any) -> None:
    view = View(make_stage_with_settings(level=9, bogus=1))
    view.engine.SetActiveRenderSettingsPrimPath(Sdf.Path("/Render/Final"))
    view.execute()
    said = warnings.read()
    assert "</Render/Final>" in said
    assert "hdcc:bogus" in said and "hdcc:level cannot be '9'" in said
    assert view.engine.GetRendererSetting("hdcc:level") == 4


def test_write_command_is_described() -> None:
    command, other = make_engine().GetRendererCommandDescriptors()
    assert command.commandName == "write"
    assert other.commandName == "pick"


def test_write_says_what_went_wrong(tmp_path: Path) -> None:
    stage = make_stage()
    add_grid(stage)
    view = View(stage, aovs=["color"])

    def fails(match: str, **args: str) -> None:
        with pytest.raises(Tf.ErrorException, match=match):
            view.engine.InvokeRendererCommand("write", args)

    fails("no frame", path=str(tmp_path / "a.exr"))
    view.execute()
    fails("no path")
    fails("'normal' is not in the last frame", path=str(tmp_path / "a.exr"), aovs="normal")
    fails("no AOV 'beauty'", path=str(tmp_path / "a.exr"), aovs="beauty")
    fails("a.exr", path=str(tmp_path / "missing" / "a.exr"))
    fails("'gamma'", path=str(tmp_path / "a.png"), colorCorrection="gamma")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(Tf.ErrorException, match="no renderer command paint"):
        view.engine.InvokeRendererCommand("paint")


@pytest.mark.parametrize("mode", ["disabled", "sRGB"])
def test_write_makes_display_pictures(tmp_path: Path, mode: str) -> None:
    stage = make_stage()
    add_grid(stage)
    view = View(stage, aovs=["color"])
    view.execute()
    path = tmp_path / "a.png"
    args = {"path": str(path), "colorCorrection": mode}
    assert view.engine.InvokeRendererCommand("write", args)
    assert path.read_bytes()[:4] == b"\x89PNG"


STATS = {
    "seconds": {"sync", "build", "trace"},
    "rays": {"primary", "shadow", "reflection"},
    "mrays_per_second": {"primary", "shadow", "reflection"},
    "bytes": {"structures", "per_face", "peak_rss"},
    "levels": {"min", "max", "histogram"},
    "packet": {
        "traversals",
        "leaf_intersections",
        "subdivisions_regular",
        "subdivisions_irregular",
        "early_hit",
        "interval_culls",
        "final_intersections",
        "active_lanes",
    },
}


def test_stats() -> None:
    stage = make_stage()
    add_cube(stage)
    view = View(stage, level=3)
    empty = view.engine.GetRenderStats()
    assert empty["faces"] == 0 and empty["fractionDone"] == 0
    view.execute()
    stats = view.engine.GetRenderStats()
    for group, names in STATS.items():
        assert set(stats[group]) == names
    assert stats["faces"] == 6
    assert stats["patches"] >= 6
    assert stats["fractionDone"] == 1 and stats["percentDone"] == 100
    assert stats["pixelsDone"] == stats["pixelsTotal"] == 32 * 32
    assert stats["levels"]["min"] == stats["levels"]["max"] == 3
    assert list(stats["levels"]["histogram"]) == [0, 0, 0, stats["patches"]]
    assert stats["rays"]["primary"] >= 32 * 32
    assert stats["mrays_per_second"]["primary"] > 0
    assert 0 < stats["seconds"]["trace"] < 60
    assert stats["bytes"]["structures"] > 0
    assert stats["packet"]["traversals"] > 0
    assert stats["rendererName"] == "hdCC"
    assert stats["numCompletedSamples"] == 4
    assert stats["polyCounts"] == 6
    assert stats["cameraRays"] == stats["rays"]["primary"]
    assert stats["occlusionRays"] == stats["rays"]["shadow"]
    assert stats["totalMemory"] == stats["bytes"]["structures"]
    assert stats["peakMemory"] > stats["totalMemory"]
    loading = stats["seconds"]["sync"] + stats["seconds"]["build"]
    assert stats["loadClockTime"] == pytest.approx(loading)
    assert stats["totalClockTime"] == pytest.approx(loading + stats["seconds"]["trace"])
    assert empty.keys() == stats.keys()


def test_progress_can_be_asked_from_another_thread() -> None:
    stage = make_stage()
    add_grid(stage, bump=0.5)
    view = View(stage, size=(512, 512), samples=64)
    fractions: list[float] = []
    rendering = threading.Event()
    rendering.set()

    def poll() -> None:
        while rendering.is_set():
            fractions.append(view.engine.GetRenderStats()["fractionDone"])
            time.sleep(0.002)

    thread = threading.Thread(target=poll)
    thread.start()
    view.execute()
    rendering.clear()
    thread.join()
    assert fractions == sorted(fractions)
    assert len([f for f in fractions if 0 < f < 1]) >= 2
    assert view.engine.GetRenderStats()["fractionDone"] == 1


def test_tracers_agree() -> None:
    stage = make_stage()
    add_cube(stage)
    packet = render(stage, tracer="packet")
    for tracer in ("algorithm1", "single", "tessellated"):
        other = render(stage, tracer=tracer)
        assert (packet["primId"] == other["primId"]).all()
        assert abs(packet["cameraDepth"] - other["cameraDepth"]).max() < 1e-4


def test_tessellation_is_counted_while_it_is_used() -> None:
    stage = make_stage()
    add_cube(stage)
    view = View(stage, level=4)

    def structures(tracer: str) -> int:
        view.set("tracer", tracer)
        view.execute()
        return view.engine.GetRenderStats()["bytes"]["structures"]

    packet = structures("packet")
    # A quad has a point of 12 bytes and more, and the cube 6 times 16 x 16 of them.
    assert structures("tessellated") > packet + 12 * 6 * 256
    assert structures("packet") == structures("algorithm1") == packet


def _depths_on_simd_target(target: str, folder: Path) -> tuple[np.ndarray, str]:
    """What another process sees of the cube with HDCC_SIMD_TARGET set, and what it warns of."""
    code = (
        "from hydra_kit import *\n"
        "stage = make_stage(); add_cube(stage)\n"
        f"np.save({str(folder / 'depth.npy')!r}, render(stage)['cameraDepth'])\n"
        "render(stage)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=Path(__file__).parent,
        env={**os.environ, "HDCC_SIMD_TARGET": target},
        capture_output=True,
        text=True,
        check=True,
    )
    return np.load(folder / "depth.npy"), done.stderr


def test_the_simd_target_can_be_chosen(tmp_path: Path) -> None:
    stage = make_stage()
    add_cube(stage)
    here = render(stage)["cameraDepth"]
    depths, said = _depths_on_simd_target("SSE4", tmp_path)
    assert "SIMD" not in said
    assert np.allclose(depths, here, atol=1e-6)


def test_an_unknown_simd_target_is_warned_about_once(tmp_path: Path) -> None:
    _, said = _depths_on_simd_target("MMX", tmp_path)
    assert said.count("'MMX'") == 1
    assert "HDCC_SIMD_TARGET" in said and "SSE4" in said


def test_needs_no_gpu_and_no_display() -> None:
    code = (
        "from hydra_kit import *\n"
        "stage = make_stage(); add_cube(stage); assert shows_something(render(stage))\n"
    )
    environment = {"PATH": "/usr/bin:/bin"}
    folder = Path(__file__).parent
    for name in ("PXR_PLUGINPATH_NAME", "PYTHONPATH", "LD_LIBRARY_PATH"):
        if name in os.environ:
            environment[name] = os.environ[name]
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
