"""What instances cost: whole processes that render one mesh many times."""

import argparse
import json
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from . import bench_scenes
from .bench_measure import Row
from .console import CommandError
from .paths import ROOT

WIDTH = 960


def run(options: argparse.Namespace) -> list[Row]:
    """A row for each number of instances: medians over the runs."""
    counts = bench_scenes.HERDS[:2] if options.quick else bench_scenes.HERDS
    return [_measure(count, options) for count in counts]


def _measure(count: int, options: argparse.Namespace) -> Row:
    scene = bench_scenes.herd(count)
    runs = [_render(scene.file, options) for _ in range(options.runs)]
    row = dict(runs[0])
    row["scene"], row["instances"] = "herd", count
    row["level"], row["threads"], row["tracer"], row["ratio"] = (
        row["levels"]["max"],
        options.threads,
        "packet",
        1.0,
    )
    row["seconds"] = {
        name: statistics.median(each["seconds"][name] for each in runs)
        for name in runs[0]["seconds"]
    }
    row["mrays_per_second"]["primary"] = statistics.median(
        each["mrays_per_second"]["primary"] for each in runs
    )
    return row


def _render(scene: Path, options: argparse.Namespace) -> Row:
    """The statistics of one process, and how long it took."""
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder) / "stats.json"
        command = [str(ROOT / "tools" / "record"), str(scene), str(Path(folder) / "out.exr")]
        command += ["--imageWidth", str(min(WIDTH, options.size)), "--stats", str(stats), "--quiet"]
        command += ["--set", "hdcc:samples=1", "--set", f"hdcc:threads={options.threads}"]
        begin = time.monotonic()
        finished = subprocess.run(command, capture_output=True, text=True, check=False)
        seconds = time.monotonic() - begin
        if finished.returncode != 0:
            raise CommandError(finished.stderr.strip())
        row = json.loads(stats.read_text())
    row["seconds"]["process"] = seconds
    return row
