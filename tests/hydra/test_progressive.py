"""Rendering in the background: pictures come in passes, and edits do not wait for them."""

import gc
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hydra_kit import ALL_AOVS, PLUGIN, View, add_cube, assert_same
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
from pxr import Gf, Sdf, Tf, Usd, UsdAppUtils, UsdGeom


def is_made_of_blocks(plane: np.ndarray, size: int = 16) -> bool:
    rows, columns = plane.shape
    blocks = plane.reshape(rows // size, size, columns // size, size)
    return bool((blocks == blocks[:, :1, :, :1]).all())


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_ends_with_the_picture_rendered_in_one_go(threads: int) -> None:
    view = make_view(threads=threads, size=(75, 41))
    assert_same(converge(view), expected(view, size=(75, 41)))


@pytest.mark.parametrize("tracer", ["single", "algorithm1", "tessellated"])
def test_other_tracers_end_with_the_same_too(tracer: str) -> None:
    view = make_view(tracer=tracer)
    assert_same(converge(view), expected(view, tracer=tracer))


def test_crops_are_rendered_in_passes_too() -> None:
    window = {"display": (32, 32)}
    view = make_view()
    view.set_data_window(5, 7, 16, 12, **window)
    whole = View(view.stage, samples=QUICK)
    whole.set_data_window(5, 7, 16, 12, **window)
    assert_same(converge(view), whole.render())


def test_first_comes_a_picture_in_blocks() -> None:
    view = make_view(samples=ENDLESS, size=(160, 160))
    assert not draw(view)
    assert samples_done(view) == 0
    preview = view.read()
    assert is_made_of_blocks(preview["cameraDepth"])
    assert is_made_of_blocks(preview["primId"])
    assert len(np.unique(preview["cameraDepth"])) > 20
    whole = expected(view, 1, size=(160, 160))
    assert (preview["primId"] == whole["primId"]).mean() > 0.85


def test_then_come_better_ones() -> None:
    view = make_view(samples=ENDLESS)
    wait_for_samples(view, 1)
    assert_same(view.read(), expected(view, 1), [name for name in ALL_AOVS if name != "color"])
    wait_for_samples(view, 8)
    average = expected(view, 64)["color"]
    assert np.abs(view.read()["color"] - average).mean() < 0.02
    assert not view.engine.IsConverged()


def test_draws_do_not_wait_for_the_picture() -> None:
    view = make_view(samples=ENDLESS, size=(512, 512))
    for _ in range(20):
        assert not draw(view)


def test_nothing_is_drawn_behind_the_applications_back() -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    before = view.read()
    time.sleep(0.2)
    assert_same(view.read(), before)
    assert samples_done(view) == 0
    draw(view)
    assert samples_done(view) > 0


def test_nothing_changes_once_converged() -> None:
    view = make_view()
    first = converge(view)
    assert draw(view)
    assert_same(view.read(), first)


def test_statistics_follow_the_passes() -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    early = view.engine.GetRenderStats()
    assert early["pixelsTotal"] == 32 * 32
    assert early["fractionDone"] < 0.01
    wait_for_samples(view, 2)
    view.set("samples", QUICK)
    converge(view)
    late = view.engine.GetRenderStats()
    assert late["fractionDone"] == 1 and late["percentDone"] == 100
    assert late["pixelsDone"] == late["pixelsTotal"] == 32 * 32
    assert late["numCompletedSamples"] == QUICK
    assert late["rays"]["primary"] == 32 * 32 * QUICK
    whole = View(view.stage, samples=QUICK)
    whole.execute()
    once = whole.engine.GetRenderStats()
    for key in ("faces", "patches", "rays", "packet"):
        assert late[key] == once[key], key
    assert list(late["levels"]["histogram"]) == list(once["levels"]["histogram"])


def test_statistics_may_be_asked_from_another_thread() -> None:
    view = make_view(samples=40)
    fractions: list[float] = []
    is_over = threading.Event()

    def ask() -> None:
        while not is_over.is_set():
            fractions.append(view.engine.GetRenderStats()["fractionDone"])

    asker = threading.Thread(target=ask)
    draw(view)
    asker.start()
    converge(view)
    is_over.set()
    asker.join()
    assert fractions == sorted(fractions)
    assert view.engine.GetRenderStats()["fractionDone"] == 1


# ---- Edits while a frame renders ----


def move_cube(view: View) -> None:
    attribute = view.stage.GetPrimAtPath("/Cube").GetAttribute("xformOp:translate")
    attribute.Set(attribute.Get() + Gf.Vec3d(-0.4, 0, 0))


def move_points(view: View) -> None:
    mesh = UsdGeom.Mesh.Get(view.stage, "/Grid")
    mesh.GetPointsAttr().Set([(x * 0.7, y, z) for x, y, z in mesh.GetPointsAttr().Get()])


def retopologize(view: View) -> None:
    UsdGeom.Mesh.Get(view.stage, "/Grid").GetHoleIndicesAttr().Set([0, 5, 6])


def add_prim(view: View) -> None:
    add_cube(view.stage, "/Another", half=0.3).AddTranslateOp().Set(Gf.Vec3d(-1, -1, 1))


def remove_prim(view: View) -> None:
    view.stage.RemovePrim("/Cube")


def remove_all(view: View) -> None:
    for path in ("/Cube", "/Grid"):
        view.stage.RemovePrim(path)


def hide_prim(view: View) -> None:
    UsdGeom.Imageable(view.stage.GetPrimAtPath("/Cube")).MakeInvisible()


def change_purpose(view: View) -> None:
    UsdGeom.Imageable(view.stage.GetPrimAtPath("/Cube")).CreatePurposeAttr("proxy")


def change_light(view: View) -> None:
    view.stage.GetPrimAtPath("/Light").GetAttribute("inputs:intensity").Set(0.5)


def remove_light(view: View) -> None:
    view.stage.RemovePrim("/Light")


def move_camera(view: View) -> None:
    view.stage.GetPrimAtPath("/Camera").GetAttribute("xformOp:translate").Set(Gf.Vec3d(0.5, 0, 5))


@pytest.mark.parametrize(
    "edit",
    [
        move_cube,
        move_points,
        retopologize,
        add_prim,
        remove_prim,
        remove_all,
        hide_prim,
        change_purpose,
        change_light,
        remove_light,
        move_camera,
    ],
    ids=lambda edit: edit.__name__,
)
def test_edit_ends_the_frame_that_renders(edit: Any) -> None:
    view = make_view(samples=ENDLESS)
    wait_for_samples(view, 1)
    before = view.read()
    edit(view)
    assert not draw(view)
    assert (view.read()["color"] != before["color"]).any()
    wait_for_samples(view, 1)
    view.set("samples", QUICK)
    assert_same(converge(view), expected(view))


def test_every_drawing_shows_the_latest_edit() -> None:
    view = make_view(samples=ENDLESS, size=(160, 160))
    cube = view.stage.GetPrimAtPath("/Cube").GetAttribute("xformOp:translate")
    middles = []
    for i in range(15):
        cube.Set(Gf.Vec3d(-1.4 + 0.2 * i, 0, 1))
        assert not draw(view)
        assert samples_done(view) == 0
        columns = np.argwhere(view.read(["cameraDepth"])["cameraDepth"] < 3.9)[:, 1]
        middles.append(columns.mean())
    assert middles == sorted(middles)
    assert middles[-1] - middles[0] == pytest.approx(2.8 / 4 * 160, abs=16)


def test_sizes_change_in_mid_frame() -> None:
    view = make_view(samples=ENDLESS)
    for size in ((8, 8), (200, 100), (1, 1), (33, 17)):
        view.set_size(*size)
        assert not draw(view)
        assert view.read()["primId"].reshape(-1).size == size[0] * size[1]
    view.set("samples", QUICK)
    assert_same(converge(view), expected(view, size=(33, 17)))


def test_aovs_change_in_mid_frame() -> None:
    view = make_view(samples=ENDLESS)
    for aov in ("depth", "normal", "primId", "color", "primvars:displayColor", "color"):
        view.engine.SetRendererAov(aov)
        assert not draw(view)
        wait_for_samples(view, 1)
    view.set("aovs", "normal color primvars:displayColor")
    assert not draw(view)
    view.set("aovs", " ".join(ALL_AOVS))
    view.set("samples", QUICK)
    assert_same(converge(view), expected(view))


def test_primvar_is_synced_in_mid_frame() -> None:
    view = make_view(samples=ENDLESS, aovs=["color"])
    wait_for_samples(view, 1)
    view.set("aovs", "color primvars:st")
    st = UsdGeom.PrimvarsAPI(view.stage.GetPrimAtPath("/Grid")).CreatePrimvar(
        "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.constant
    )
    st.Set([Gf.Vec2f(0.25, 0.75)])
    assert not draw(view)
    wait_for_samples(view, 1)
    assert (view.read(["primvars:st"])["primvars:st"][0, 0] == (0.25, 0.75)).all()


def test_settings_change_in_mid_frame() -> None:
    view = make_view(samples=ENDLESS)
    for name, value in (("level", 2), ("tracer", "tessellated"), ("seed", 3), ("adaptive", False)):
        view.set(name, value)
        assert not draw(view)
        wait_for_samples(view, 1)
    view.set("samples", QUICK)
    options = {"level": 2, "tracer": "tessellated", "seed": 3, "adaptive": False}
    assert_same(converge(view), expected(view, **options))


def test_broken_camera_converges_in_mid_frame(warnings: Any) -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    view.engine.SetCameraPath("/Nowhere")
    assert draw(view)
    assert view.engine.GetRenderStats()["fractionDone"] == 1
    with pytest.raises(Tf.ErrorException, match="no frame"):
        view.read()
    view.engine.SetCameraPath("/Camera")
    view.set("samples", QUICK)
    assert_same(converge(view), expected(view))


def test_application_stops_being_interactive_in_mid_frame() -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    view.set("samples", QUICK)
    view.engine.SetRendererSetting("enableInteractive", False)
    view.execute()
    assert_same(view.read(), expected(view))
    view.engine.SetRendererSetting("enableInteractive", True)
    assert_same(converge(view), expected(view))


# ---- Ends ----


def test_engine_ends_in_mid_frame() -> None:
    for _ in range(10):
        view = make_view(samples=ENDLESS)
        draw(view)
        del view
        gc.collect()


def test_stage_ends_before_the_engine() -> None:
    view = make_view(samples=ENDLESS)
    draw(view)
    view.stage = None
    gc.collect()
    del view
    gc.collect()


def test_many_engines_render_side_by_side() -> None:
    views = [make_view(samples=ENDLESS) for _ in range(4)]
    for view in views:
        assert not draw(view)
    for view in views:
        wait_for_samples(view, 2)
    for view in views:
        view.set("samples", QUICK)
    reference = expected(views[0])
    for view in views:
        assert_same(converge(view), reference)


def test_recorder_converges_at_once(tmp_path: Path) -> None:
    recorder = UsdAppUtils.FrameRecorder(PLUGIN, False)
    recorder.SetImageWidth(32)
    stage = make_scene()
    path = tmp_path / "frame.exr"
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/Camera"))
    assert recorder.Record(stage, camera, Usd.TimeCode.Default(), str(path))
    assert path.is_file()
