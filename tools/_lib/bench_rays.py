"""The suite `rays`: how fast each tracer traces the same primary rays."""

import argparse
import json
import statistics
import subprocess
from pathlib import Path
from typing import Any

from . import bench_scenes, build
from .console import CommandError
from .paths import BUILD

OURS = "packet"
TRACERS = (OURS, "single")

#: What cc_bench counts and rows report as an average over packets.
_COUNTS = (
    "traversals",
    "leaf_intersections",
    "subdivisions_regular",
    "subdivisions_irregular",
    "early_hit",
    "interval_culls",
    "final_intersections",
    "active_lanes",
)


def run(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Measures every tracer on every scene; returns a row for each."""
    runtime = build.usd_runtime()
    folder = build.build_target(
        "cc_bench", preset="release", more_sources=("tests/CMakeLists.txt", "tests/bench")
    )
    rows = []
    for scene in bench_scenes.scenes(options.scene):
        exported = _export(scene, runtime)
        measured = _measure(folder / "tests" / "bench" / "cc_bench", exported, options)
        rows.extend(make_rows(scene.name, measured))
    return rows


def _export(scene: bench_scenes.Scene, runtime: build.Runtime) -> Path:
    exported = BUILD / "bench" / f"{scene.name}.cages"
    exported.parent.mkdir(parents=True, exist_ok=True)
    finished = runtime.run("-m", "_lib.bench_export", str(scene.file), str(exported))
    if finished.returncode != 0:
        raise CommandError(f"{scene.name}: cannot be exported")
    return exported


def _measure(program: Path, exported: Path, options: argparse.Namespace) -> dict[str, Any]:
    command = [str(program), str(exported)]
    for name in ("level", "threads", "size", "runs"):
        command += [f"--{name}", str(getattr(options, name))]
    for tracer in TRACERS:
        command += ["--tracer", tracer]
    finished = subprocess.run(command, text=True, stdout=subprocess.PIPE, check=False)
    if finished.returncode != 0:
        raise CommandError(f"cc_bench failed on {exported.name}")
    return json.loads(finished.stdout)


def make_rows(scene: str, measured: dict[str, Any]) -> list[dict[str, Any]]:
    """Turns what cc_bench printed into rows; times are medians over the runs."""
    _check_same_hits(scene, measured["runs"])
    ours = _rate(_runs_of(OURS, measured))
    return [_row(scene, tracer, measured, ours) for tracer in TRACERS]


def _check_same_hits(scene: str, runs: list[dict[str, Any]]) -> None:
    """Tracers that see different surfaces cannot be compared."""
    counts = [run["hits"] for run in runs]
    if max(counts) - min(counts) > 1e-4 * max(counts):
        raise CommandError(f"{scene}: the tracers disagree: {min(counts)} to {max(counts)} hits")


def _runs_of(tracer: str, measured: dict[str, Any]) -> list[dict[str, Any]]:
    return [run for run in measured["runs"] if run["tracer"] == tracer]


def _rate(runs: list[dict[str, Any]]) -> float:
    """Median Mrays/s."""
    return statistics.median(1e-6 * run["rays"] / run["seconds"] for run in runs)


def _row(scene: str, tracer: str, measured: dict[str, Any], ours: float) -> dict[str, Any]:
    runs = _runs_of(tracer, measured)
    level, faces, patches = measured["level"], measured["faces"], measured["patches"]
    rate = _rate(runs)
    return {
        "scene": scene,
        "level": level,
        "threads": measured["threads"],
        "tracer": tracer,
        "ratio": ours / rate,
        "faces": faces,
        "patches": patches,
        "seconds": {
            "sync": 0.0,
            "build": measured["build_seconds"],
            "trace": statistics.median(run["seconds"] for run in runs),
        },
        "rays": {"primary": runs[0]["rays"], "shadow": 0, "reflection": 0},
        "mrays_per_second": {"primary": rate, "shadow": 0.0, "reflection": 0.0},
        "bytes": {
            "structures": measured["bytes"],
            "per_face": measured["bytes"] / faces if faces else 0.0,
            "peak_rss": measured["peak_rss"],
        },
        "levels": {"min": level, "max": level, "histogram": [0] * level + [patches]},
        "packet": {name: runs[0][name] / max(runs[0]["packets"], 1) for name in _COUNTS},
    }
