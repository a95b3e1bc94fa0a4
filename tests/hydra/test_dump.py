"""What Sync hands the core, as text.

The dumps of small scenes are kept in dumps/. After a change that is meant,

    tools/test --update-baselines

writes them anew; read the diff.
"""

import os
import re
from pathlib import Path

import pytest
from hydra_kit import View, add_cube, add_grid, make_stage
from interactive_kit import draw, make_view
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdRender

FEATURES = Path(__file__).resolve().parents[2] / "usd_scenes/features"
DUMPS = Path(__file__).parent / "dumps"
LARGEST_SCENE = 8_000
SCENES = sorted(path for path in FEATURES.glob("*.usda") if path.stat().st_size < LARGEST_SCENE)


def dump(view: View, path: Path) -> str:
    view.set("dump", str(path))
    view.execute()
    text = path.read_text()
    view.set("dump", "")
    return text


def dump_stage(stage: Usd.Stage, path: Path) -> str:
    return dump(View(stage), path)


def rounded(text: str) -> str:
    """The same text, but for what sines and roots of another processor may differ by, and numbers
    that OpenUSD gives prototypes by chance."""
    text = re.sub(r"/__Prototype_\d+", "/__Prototype", text)
    return re.sub(r"-?\d+\.\d+(e-?\d+)?", lambda number: f"{float(number[0]):.6g}", text)


def first_camera(stage: Usd.Stage) -> str:
    return next(str(prim.GetPath()) for prim in stage.Traverse() if prim.IsA(UsdGeom.Camera))


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_scene(scene: Path, tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(scene))
    view = View(stage, camera=first_camera(stage), aovs=["color", "primvars:st"])
    view.params.frame = Usd.TimeCode(stage.GetStartTimeCode())
    text = dump(view, tmp_path / "dump.txt")
    kept = DUMPS / f"{scene.stem}.txt"
    if "HDCC_UPDATE_DUMPS" in os.environ:
        kept.write_text(text)
    assert rounded(text) == rounded(kept.read_text())


def test_every_small_scene_has_a_dump_and_no_other() -> None:
    assert {path.stem for path in DUMPS.glob("*.txt")} == {path.stem for path in SCENES}


def test_edits_end_where_a_fresh_load_begins(tmp_path: Path) -> None:
    stage = make_stage()
    grid = add_grid(stage)
    view = View(stage)
    before = dump(view, tmp_path / "before.txt")
    grid.GetHoleIndicesAttr().Set([3])
    grid.AddTranslateOp().Set(Gf.Vec3d(1, 0, 0))
    add_cube(stage)
    after = dump(view, tmp_path / "after.txt")
    assert after != before
    assert "holeIndices [1]\n        3\n" in after
    assert after == dump_stage(stage, tmp_path / "fresh.txt")
    stage.RemovePrim("/Cube")
    grid.GetHoleIndicesAttr().Set([])
    grid.GetPrim().GetAttribute("xformOp:translate").Set(Gf.Vec3d(0, 0, 0))
    assert dump(view, tmp_path / "back.txt") == before


def test_frames_in_the_background_are_dumped(tmp_path: Path) -> None:
    path = tmp_path / "dump.txt"
    view = make_view(dump=str(path))
    draw(view)
    assert "mesh </Cube>" in path.read_text()


def test_no_dump_without_a_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    View(make_stage()).execute()
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_missing_is_refused(tmp_path: Path) -> None:
    view = View(make_stage())
    with pytest.raises(Tf.ErrorException, match="hdcc:dump cannot be .*a folder that is there"):
        view.set("dump", str(tmp_path / "missing/dump.txt"))


def test_a_file_that_cannot_be_written_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "taken").mkdir()
    view = View(make_stage(), dump=str(tmp_path / "taken"))
    with pytest.raises(Tf.ErrorException, match="taken: the dump cannot be written: "):
        view.execute()
    assert not (tmp_path / "taken.partial").exists()
    assert view.engine.IsConverged()


def test_scenes_write_no_files(tmp_path: Path, warnings: object) -> None:
    path = tmp_path / "dump.txt"
    stage = make_stage()
    settings = UsdRender.Settings.Define(stage, "/Settings").GetPrim()
    settings.CreateAttribute("hdcc:dump", Sdf.ValueTypeNames.String).Set(str(path))
    view = View(stage)
    view.engine.SetActiveRenderSettingsPrimPath("/Settings")
    view.execute()
    assert "</Settings>: a scene cannot set hdcc:dump" in warnings.read()
    assert not path.exists()
