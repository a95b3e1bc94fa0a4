"""How long edits take to be seen while a frame renders."""

import argparse
import json
import subprocess

from . import bench_scenes, build
from .bench_measure import Row
from .console import CommandError
from .paths import SCENES

WIDTH = 960
HERO = bench_scenes.Scene("hero", SCENES / "hero.usda")
#: Edits of each kind.
COUNT, QUICK_COUNT = 30, 3


def run(options: argparse.Namespace) -> list[Row]:
    """A row for each kind of edit."""
    (scene,) = bench_scenes.scenes(options) if options.scene else [HERO]
    runtime = build.plugin_runtime()
    words = {
        "name": scene.name,
        "scene": str(scene.file),
        "width": min(WIDTH, options.size),
        "threads": options.threads,
        "count": QUICK_COUNT if options.quick else COUNT,
    }
    finished = subprocess.run(
        [str(runtime.python), "-m", "_lib.bench_edits_process"],
        input=json.dumps(words),
        env=runtime.environment,
        capture_output=True,
        text=True,
        check=False,
    )
    if finished.returncode != 0:
        lines = finished.stderr.strip().splitlines()
        raise CommandError(lines[-1].removeprefix("error: ") if lines else "the renderer failed")
    rows: list[Row] = json.loads(finished.stdout)
    return rows
