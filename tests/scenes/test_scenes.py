"""Scenes and their generators, under plain usd-core: no part of the renderer is involved."""

import json
import os
import subprocess
from pathlib import Path

import pytest
from _lib import bench_scenes, sdk

ROOT = Path(__file__).resolve().parents[2]
INSPECT = Path(__file__).with_name("inspect_stage.py")
#: Scenes with something wrong in them on purpose, and all others.
BAD_SCENES = sorted((ROOT / "usd_scenes" / "bad").glob("*.usda"))
SCENES = sorted(set((ROOT / "usd_scenes").rglob("*.usda")) - set(BAD_SCENES))
#: Generators are those files that can be run.
GENERATORS = sorted(
    path
    for path in (ROOT / "usd_scenes" / "generators").glob("*.py")
    if "__main__" in path.read_text()
)
BENCH_GENERATORS = {command[0] for command in bench_scenes.GENERATED.values()}


def _run(*arguments: object) -> str:
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    finished = subprocess.run(
        [str(sdk.locate().usd_core_python), *map(str, arguments)],
        text=True,
        capture_output=True,
        env=environment,
        timeout=600,
        check=False,
    )
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


def _inspect(file: Path) -> dict:
    return json.loads(_run(INSPECT, file))


def test_there_are_scenes_and_generators() -> None:
    assert SCENES
    assert BAD_SCENES
    assert GENERATORS


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_scene(scene: Path) -> None:
    found = _inspect(scene)
    assert found["default_prim"]
    assert found["cameras"] >= 1
    assert found["meshes"] >= 1
    assert not found["problems"], "\n".join(found["problems"])


@pytest.mark.parametrize("scene", BAD_SCENES, ids=lambda path: path.stem)
def test_bad_scene_opens(scene: Path) -> None:
    _inspect(scene)


@pytest.mark.parametrize("generator", GENERATORS, ids=lambda path: path.stem)
def test_generator(generator: Path, tmp_path: Path) -> None:
    is_large = generator.name in BENCH_GENERATORS
    out = tmp_path / f"{generator.stem}.usd{'c' if is_large else 'a'}"
    _run(generator, out)
    found = _inspect(out)
    assert found["cameras"] >= 1
    assert found["faces"] > 0
    assert not found["problems"], "\n".join(found["problems"][:10])
    for kept in SCENES:
        if kept.name == out.name:
            assert out.read_text() == kept.read_text(), f"{kept} is not what its generator makes"


@pytest.mark.parametrize("script", sorted(BENCH_GENERATORS))
def test_bench_knows_its_generators(script: str) -> None:
    assert script in {path.name for path in GENERATORS}
