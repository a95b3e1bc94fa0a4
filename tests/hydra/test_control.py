"""Pausing and stopping frames that render in the background."""

import ctypes
import os
import time
from pathlib import Path
from typing import Any

import pytest
from hydra_kit import CENTER_AOVS, View, assert_same
from interactive_kit import (
    ENDLESS,
    QUICK,
    converge,
    draw,
    expected,
    make_scene,
    make_view,
    samples_done,
    wait_for_samples,
)
from pxr import UsdImagingGL


def fraction_done(view: View) -> float:
    return float(view.engine.GetRenderStats()["fractionDone"])


def assert_rests(view: View) -> None:
    draw(view)
    before = fraction_done(view)
    time.sleep(0.05)
    draw(view)
    assert fraction_done(view) == before


def move_camera(view: View) -> None:
    camera = view.stage.GetPrimAtPath("/Camera").GetAttribute("xformOp:translate")
    camera.Set(camera.Get() + type(camera.Get())(0.3, 0, 0))


def test_is_supported() -> None:
    view = make_view()
    assert view.engine.IsPauseRendererSupported()
    assert view.engine.IsStopRendererSupported()


def test_paused_frame_rests_and_goes_on() -> None:
    view = make_view(samples=200)
    wait_for_samples(view, 1)
    assert view.engine.PauseRenderer()
    assert_rests(view)
    assert not view.engine.IsConverged()
    assert view.engine.ResumeRenderer()
    assert_same(converge(view), expected(view, 200))


def test_frame_paused_again_and_again_ends_the_same() -> None:
    view = make_view(samples=60, size=(75, 41))
    draw(view)
    while not view.engine.IsConverged():
        view.engine.PauseRenderer()
        view.engine.ResumeRenderer()
        time.sleep(0.001)
        draw(view)
    assert_same(view.read(), expected(view, 60, size=(75, 41)))


def test_edit_of_a_paused_frame_shows_a_coarse_picture() -> None:
    view = make_view()
    draw(view)
    view.engine.PauseRenderer()
    move_camera(view)
    assert not draw(view)
    time.sleep(0.05)
    assert not draw(view)
    assert samples_done(view) == 0
    view.engine.ResumeRenderer()
    assert_same(converge(view), expected(view))


def test_pause_before_the_first_frame() -> None:
    view = make_view()
    view.engine.PauseRenderer()
    assert not draw(view)
    assert_rests(view)
    view.engine.ResumeRenderer()
    assert_same(converge(view), expected(view))


def test_stopped_frame_is_converged() -> None:
    view = make_view(samples=ENDLESS)
    wait_for_samples(view, 1)
    assert view.engine.StopRenderer()
    assert draw(view)
    assert 0 < fraction_done(view) < 1
    assert_rests(view)
    assert view.engine.IsConverged()
    assert_same(view.read(), expected(view, 1), CENTER_AOVS)


def test_stopped_frame_is_restarted() -> None:
    view = make_view(samples=200)
    wait_for_samples(view, 1)
    view.engine.StopRenderer()
    assert draw(view)
    assert view.engine.RestartRenderer()
    assert not view.engine.IsConverged()
    assert_same(converge(view), expected(view, 200))


def test_edit_ends_a_stop() -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    view.engine.StopRenderer()
    assert draw(view)
    move_camera(view)
    assert not draw(view)
    view.set("samples", QUICK)
    assert_same(converge(view), expected(view))


def test_stop_and_restart_of_what_is_done_change_nothing() -> None:
    view = make_view()
    picture = converge(view)
    for control in ("Stop", "Restart", "Pause", "Resume"):
        assert getattr(view.engine, f"{control}Renderer")()
        assert draw(view)
    assert_same(view.read(), picture)


@pytest.mark.parametrize("control", ["Pause", "Stop"])
def test_recorders_are_not_held(control: str) -> None:
    view = View(make_scene(), samples=QUICK)
    getattr(view.engine, f"{control}Renderer")()
    assert_same(view.render(), expected(view))


@pytest.mark.parametrize("control", ["Pause", "Stop"])
def test_engine_ends_while_held(control: str) -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    getattr(view.engine, f"{control}Renderer")()
    del view


def test_broken_frame_converges_while_paused(warnings: Any) -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    view.engine.PauseRenderer()
    view.engine.SetCameraPath("/Nowhere")
    assert draw(view)
    warnings.read()


def test_render_thread() -> None:
    UsdImagingGL.Engine.GetRendererPlugins()  # loads OpenUSD
    library = Path(os.environ["PXR_PLUGINPATH_NAME"]).parents[2] / "tests/hdCCRenderThread.so"
    check = ctypes.CDLL(str(library)).HdCCCheckRenderThread
    check.restype = ctypes.c_char_p
    assert check() is None
