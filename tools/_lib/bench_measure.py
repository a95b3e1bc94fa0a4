"""Lets tracers take turns over the same rays, and makes rows of what they took."""

import argparse
import statistics
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import bench_programs, build
from .bench_programs import Answer, Program
from .bench_scenes import Scene
from .console import CommandError
from .paths import BUILD

Row = dict[str, Any]

#: Sets of rays, and the kind that rows count them as.
KIND_OF_RAYS = {
    "primary": "primary",
    "shadow": "shadow",
    "reflection": "reflection",
    "reflection-shadow": "shadow",
}
KINDS = ("primary", "shadow", "reflection")
#: What cc_bench counts and rows report as an average over packets.
COUNTS = (
    "traversals",
    "leaf_intersections",
    "subdivisions_regular",
    "subdivisions_irregular",
    "box_tests",
    "early_hit",
    "interval_culls",
    "final_intersections",
    "active_lanes",
)
#: Tracers of ours see the same surface; so many of a million hits may lie on an edge.
SAME_SURFACE = 1e-4
#: A peer's surface is tessellated along other diagonals; more means that it is set up wrongly.
SAME_SCENE = 1e-3


@dataclass
class Contender:
    """Somebody who traces: asked with `words`, the set of rays, and the number of threads."""

    tracer: str
    program: Program
    words: tuple[object, ...]
    #: what the program said of each set, a run after another
    runs: dict[str, list[Answer]] = field(default_factory=dict)

    def seconds(self, sets: Sequence[str]) -> list[float]:
        """Of each run, the time for all of some sets."""
        return [sum(times) for times in zip(*([r["seconds"] for r in self.runs[s]] for s in sets))]

    def rate(self, rays: str) -> float:
        """Median Mrays/s; 0 where there are no rays."""
        runs = self.runs[rays]
        if not runs[0]["rays"]:
            return 0.0
        return statistics.median(1e-6 * run["rays"] / run["seconds"] for run in runs)


class Session:
    """An exported scene with cc_bench running on it."""

    def __init__(self, scene: Scene, cages: Path, program: Program, threads: int) -> None:
        self.scene = scene
        self.cages = cages
        self.program = program
        self.threads = threads
        self.built: Answer = program.ask("build", threads)
        self.memory: Answer = program.ask("memory")

    def tracer(self, name: str, level: int, command: str = "trace") -> Contender:
        """One of our tracers; the command `texture` adds texture coordinates at the hits."""
        label = name if command == "trace" else f"{name}+{command}"
        return Contender(label, self.program, (command, name, level))

    def make_rays(self, size: int, level: int) -> Path:
        """Makes the rays of a square picture and loads them; returns their file for others."""
        file = self.cages.with_suffix(".rays")
        self.program.ask("make-rays", file, size, level)
        self.program.ask("load-rays", file)
        return file


@contextmanager
def session(scene: Scene, options: argparse.Namespace) -> Iterator[Session]:
    """Exports a scene and starts cc_bench on it."""
    cages = BUILD / "bench" / f"{scene.name}.cages"
    cages.parent.mkdir(parents=True, exist_ok=True)
    finished = build.usd_runtime().run("-m", "_lib.bench_export", str(scene.file), str(cages))
    if finished.returncode != 0:
        raise CommandError(f"{scene.name}: cannot be exported")
    with bench_programs.ours(cages) as program:
        yield Session(scene, cages, program, options.threads)


def take_turns(
    contenders: Sequence[Contender], sets: Sequence[str], runs: int, threads: int
) -> None:
    """Traces every set `runs` times with each contender, by turns."""
    for name in sets:
        for _ in range(runs):
            for contender in contenders:
                answer = contender.program.ask(*contender.words, name, threads)
                contender.runs.setdefault(name, []).append(answer)


def check_same_hits(
    scene: str, contenders: Sequence[Contender], sets: Sequence[str], share: float = SAME_SURFACE
) -> None:
    """Tracers that see different surfaces cannot be compared."""
    for name in sets:
        hits = {contender.tracer: contender.runs[name][0]["hits"] for contender in contenders}
        if max(hits.values()) - min(hits.values()) > max(2, share * max(hits.values())):
            said = ", ".join(f"{tracer} {count}" for tracer, count in hits.items())
            raise CommandError(f"{scene}: the tracers disagree about {name} hits: {said}")


def ratio(contender: Contender, reference: Contender, sets: Sequence[str]) -> float:
    """How many times as fast as a contender the reference is: the median over pairs of runs."""
    pairs = zip(contender.seconds(sets), reference.seconds(sets))
    return statistics.median(theirs / ours if ours else 1.0 for theirs, ours in pairs)


def make_row(
    own: Session, level: int, contender: Contender, reference: Contender, sets: Sequence[str]
) -> Row:
    """A row with the keys of docs/commands.md, over all of some sets of rays."""
    row = empty_row(own, level, contender.tracer)
    row["ratio"] = ratio(contender, reference, sets)
    row["seconds"]["trace"] = statistics.median(contender.seconds(sets))
    for kind in KINDS:
        of_kind = [name for name in sets if KIND_OF_RAYS[name] == kind]
        rays = sum(contender.runs[name][0]["rays"] for name in of_kind)
        if rays:
            row["rays"][kind] = rays
            seconds = statistics.median(contender.seconds(of_kind))
            row["mrays_per_second"][kind] = 1e-6 * rays / seconds
    first = contender.runs[sets[0]][0]
    if "packets" in first:
        packets = max(first["packets"], 1)
        row["packet"] = {name: first[name] / packets for name in COUNTS}
    return row


def empty_row(own: Session, level: int, tracer: str) -> Row:
    """A row of our structures, in which nothing is traced yet."""
    memory = own.memory
    return {
        "scene": own.scene.name,
        "level": level,
        "threads": own.threads,
        "tracer": tracer,
        "ratio": 1.0,
        "faces": memory["faces"],
        "patches": memory["patches"],
        "seconds": {"sync": 0.0, "build": own.built["seconds"], "trace": 0.0},
        "rays": dict.fromkeys(KINDS, 0),
        "mrays_per_second": dict.fromkeys(KINDS, 0.0),
        "bytes": bytes_of(memory["bytes"], memory["faces"], own.built["peak_rss"]),
        "levels": {"min": level, "max": level, "histogram": [0] * level + [memory["patches"]]},
        "packet": dict.fromkeys(COUNTS, 0.0),
    }


def bytes_of(structures: int, faces: int, peak_rss: int) -> dict[str, float]:
    """The member `bytes` of a row."""
    return {
        "structures": structures,
        "per_face": structures / faces if faces else 0.0,
        "peak_rss": peak_rss,
    }
