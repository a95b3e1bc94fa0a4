"""The suite `embree`: our tracer beside Embree, over the same rays, by turns."""

import argparse
import sys
from pathlib import Path
from typing import Any

from . import bench_measure, bench_programs, bench_scenes
from .bench_measure import Contender, Row, Session
from .bench_programs import Program
from .console import warning

#: Ways to hand the surface to Embree, and the most bytes that a face takes at level 4.
MODES = {"subdivision": 9_500, "grid": 9_000, "quad": 48_000}
#: Embree's interfaces; the fastest of them counts.
INTERFACES = ("1", "16", "16-coherent", "1M", "1M-coherent", "Np", "Np-coherent")
SETS = ("primary", "shadow", "reflection")
#: Names of rows, as the contract has them.
TRACERS = {"subdivision": "embree-subdiv", "grid": "embree-grid", "quad": "embree-quad"}


def run(options: argparse.Namespace) -> list[Row]:
    """All modes at level 4, and primary rays at level 5 against the subdivision mode."""
    bench_programs.require_embree()
    rows = []
    for scene in bench_scenes.scenes(options):
        with bench_measure.session(scene, options) as own:
            if options.level is None:
                rows += measure(own, 4, tuple(MODES), SETS, options)
                rows += measure(own, 5, ("subdivision",), ("primary",), options)
            else:
                rows += measure(own, options.level, tuple(MODES), SETS, options)
    return rows


def measure(
    own: Session,
    level: int,
    modes: tuple[str, ...],
    sets: tuple[str, ...],
    options: argparse.Namespace,
) -> list[Row]:
    """Rows of one scene at one level: for each mode that fits, one a set of rays."""
    rays = own.make_rays(options.size, level)
    rows = []
    for mode in modes:
        if not fits(own, mode, level):
            continue
        with bench_programs.embree(own.cages, mode, level) as peer:
            measured = _measure_mode(own, peer, rays, mode, level, sets, options)
        # Ours was traced beside every mode; the rows of one time are enough.
        rows += [row for row in measured if not rows or row["tracer"] != "packet"]
    return rows


def fits(own: Session, mode: str, level: int) -> bool:
    """Whether Embree's structures fit into memory that is free; says so if they do not."""
    # Faces that are holes have no patches.
    needed = own.memory["patches"] * MODES[mode] * 4.0 ** (level - 4)
    free = available_bytes()
    if needed < 0.9 * free:
        return True
    warning(
        f"{own.scene.name}, level {level}: {TRACERS[mode]} is left out: "
        f"it needs {needed / 1e9:.1f} GB, and {free / 1e9:.1f} GB are free"
    )
    return False


def available_bytes() -> int:
    """Memory that can be had without swapping."""
    for line in Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) * 1024
    return sys.maxsize


def _measure_mode(
    own: Session,
    peer: Program,
    rays: Path,
    mode: str,
    level: int,
    sets: tuple[str, ...],
    options: argparse.Namespace,
) -> list[Row]:
    built = peer.ask("build", own.threads)
    memory = peer.ask("memory")
    peer.ask("load-rays", rays)
    ours = own.tracer("packet", level)
    theirs = [Contender(name, peer, ("trace", name)) for name in INTERFACES]
    bench_measure.take_turns([ours, *theirs], sets, options.runs, own.threads)
    bench_measure.check_same_hits(own.scene.name, [ours, *theirs], sets, bench_measure.SAME_SCENE)
    rows = []
    for name in sets:
        best = max(theirs, key=lambda contender, name=name: contender.rate(name))
        our_row = bench_measure.make_row(own, level, ours, ours, [name])
        row = bench_measure.make_row(own, level, best, ours, [name])
        row["tracer"] = TRACERS[mode]
        row["seconds"]["build"] = built["seconds"]
        row["bytes"] = bench_measure.bytes_of(memory["bytes"], memory["faces"], built["peak_rss"])
        for each in (our_row, row):
            each["kind"] = name
        row |= _more(memory, theirs, best, ours, name)
        row["bytes_ratio"] = row["bytes"]["structures"] / our_row["bytes"]["structures"]
        row["ours"] = our_row["mrays_per_second"][name]
        rows += [our_row, row]
    return rows


def _more(
    memory: dict[str, Any], theirs: list[Contender], best: Contender, ours: Contender, name: str
) -> dict[str, Any]:
    """What only rows of Embree have."""
    hits = best.runs[name][0]["hits"] - ours.runs[name][0]["hits"]
    return {
        "about": memory["about"],
        "interface": best.tracer,
        "interfaces": {contender.tracer: contender.rate(name) for contender in theirs},
        "hit_difference": hits,
    }
