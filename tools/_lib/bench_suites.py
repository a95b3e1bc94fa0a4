"""The suites that do the paper's evaluation again, and those of what it leaves out."""

import argparse
import os
import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from . import (
    bench_columns,
    bench_edits,
    bench_embree,
    bench_instances,
    bench_measure,
    bench_programs,
    bench_scenes,
    bench_watertight,
)
from .bench_columns import Columns
from .bench_measure import Row, Session
from .console import CommandError, warning

#: Our tracers; the first is what others are measured against.
PACKET, TESSELLATED = "packet", "tessellated"
#: Packets with levels as the paper chooses them, and as ours do.
ADAPTIVE = ("adaptive-distance", "adaptive")
#: What pictures of any level are compared with.
REFERENCE_LEVEL = 8
TRACERS = (PACKET, "algorithm1", "single")
ALL_SETS = tuple(bench_measure.KIND_OF_RAYS)


@dataclass(frozen=True)
class Suite:
    """A kind of measurement: run(options) returns rows with the keys of --stats and more."""

    about: str
    run: Callable[[argparse.Namespace], list[Row]]
    columns: Columns
    takes_scene: bool = True


def _levels(options: argparse.Namespace, otherwise: Sequence[int] = (4,)) -> Sequence[int]:
    return otherwise if options.level is None else (options.level,)


def _compare(
    own: Session,
    level: int,
    tracers: Sequence[str],
    sets: Sequence[str],
    options: argparse.Namespace,
    textures: Sequence[str] = (),
) -> list[Row]:
    """Rows of our tracers over the same rays, all against the first."""
    own.make_rays(options.size, level)
    contenders = [own.tracer(name, level) for name in tracers]
    contenders += [own.tracer(name, level, "texture") for name in textures]
    bench_measure.take_turns(contenders, sets, options.runs, own.threads)
    bench_measure.check_same_hits(own.scene.name, contenders, sets)
    rows = [bench_measure.make_row(own, level, each, contenders[0], sets) for each in contenders]
    for name, row in zip(tracers, rows):
        found = own.program.ask("compare", name, level, "primary")
        row["differences"] = {"hits": found["hits"], "distances": found["distances"]}
    return rows


def _run_table(
    options: argparse.Namespace,
    tracers: Sequence[str],
    sets: Sequence[str],
    textures: Sequence[str] = (),
) -> list[Row]:
    rows = []
    for scene in bench_scenes.scenes(options):
        with bench_measure.session(scene, options) as own:
            for level in _levels(options):
                rows += _compare(own, level, tracers, sets, options, textures)
    return rows


def table1(options: argparse.Namespace) -> list[Row]:
    """What packets do on their way to the hits of primary rays."""
    return _run_table(options, (PACKET, "algorithm1"), ("primary",))


def table2(options: argparse.Namespace) -> list[Row]:
    """Ray casting."""
    tracers = (PACKET, "algorithm1", "algorithm1-texture", "single")
    return _run_table(options, tracers, ("primary",), textures=(PACKET,))


def table3(options: argparse.Namespace) -> list[Row]:
    """Primary rays and shadow rays to two lights."""
    return _run_table(options, TRACERS, ("primary", "shadow"))


def table4(options: argparse.Namespace) -> list[Row]:
    """As table3, over the levels, on small pictures of the forest."""
    options = argparse.Namespace(**{**vars(options), "size": min(options.size, 512)})
    rows = []
    for scene in bench_scenes.scenes(options, ("forest",)):
        with bench_measure.session(scene, options) as own:
            for level in _levels(options, (1, 2, 3, 4)):
                rows += _compare(own, level, TRACERS, ("primary", "shadow"), options)
    return rows


def table5(options: argparse.Namespace) -> list[Row]:
    """As table3, with one mirrored bounce and the shadow rays of what it hits."""
    return _run_table(options, TRACERS, ALL_SETS)


def table6(options: argparse.Namespace) -> list[Row]:
    """Adaptive levels against the same level for all, up to the same finest one, on the city."""
    rows = []
    for scene in bench_scenes.scenes(options, ("city",)):
        with bench_measure.session(scene, options) as own:
            for level in _levels(options, range(2, REFERENCE_LEVEL + 1)):
                rows += _compare_adaptive(own, level, options)
    return rows


def _compare_adaptive(own: Session, level: int, options: argparse.Namespace) -> list[Row]:
    own.make_rays(options.size, level)
    contenders = [own.tracer(name, level) for name in (PACKET, *ADAPTIVE)]
    bench_measure.take_turns(contenders, ("primary", "shadow"), options.runs, own.threads)
    rows = []
    for each in contenders:
        row = bench_measure.make_row(own, level, each, contenders[0], ("primary", "shadow"))
        row["ratios"] = {
            kind: bench_measure.ratio(contenders[0], each, sets)
            for kind, sets in (("primary", ("primary",)), ("all", ("primary", "shadow")))
        }
        found = own.program.ask("compare", each.tracer, level, "primary", REFERENCE_LEVEL)
        row["differences"] = {"hits": found["hits"], "distances": found["distances"]}
        row["picture_difference"] = found["picture"]
        row["error_pixels"] = found["error_pixels"]
        rows.append(row)
    return rows


def table7(options: argparse.Namespace) -> list[Row]:
    """Against the same surface tessellated beforehand, over the levels."""
    rows = []
    for scene in bench_scenes.scenes(options, ("creature",)):
        with bench_measure.session(scene, options) as own:
            for level in _levels(options, (1, 2, 3, 4)):
                rows += measure_tessellated(own, level, options)
    return rows


def measure_tessellated(own: Session, level: int, options: argparse.Namespace) -> list[Row]:
    """Rows of packets and of quads made beforehand; none, and a warning, if those do not fit."""
    try:
        tessellated = own.program.ask("tessellate", level, own.threads)
    except CommandError as failure:
        warning(f"{own.scene.name}, level {level}: {TESSELLATED} is left out: {failure}")
        return []
    tracers = (PACKET, TESSELLATED)
    ours, theirs = _compare(own, level, tracers, ("primary", "shadow"), options)
    memory = own.program.ask("memory")
    own.program.ask("drop-tessellation")
    theirs["bytes"] = bench_measure.bytes_of(
        memory["tessellation_bytes"], memory["faces"], memory["peak_rss"]
    )
    theirs["bytes_ratio"] = memory["tessellation_bytes"] / max(ours["bytes"]["structures"], 1)
    theirs["seconds"]["build"] = ours["seconds"]["build"] + tessellated["seconds"]
    return [ours, theirs]


def build(options: argparse.Namespace) -> list[Row]:
    """Points in memory to the first ray: first, and after an edit of all points."""
    bench_programs.require_embree()
    rows = []
    for scene in bench_scenes.scenes(options):
        with bench_measure.session(scene, options) as own:
            rows += _measure_build(own, 4 if options.level is None else options.level, options)
    return rows


def _measure_build(own: Session, level: int, options: argparse.Namespace) -> list[Row]:
    ours = bench_measure.empty_row(own, level, PACKET)
    if not bench_embree.fits(own, "subdivision", level):
        _time_builds([(ours, own.program, (own.threads,))], own.threads, options.runs)
        return [ours]
    theirs = bench_measure.empty_row(own, level, bench_embree.TRACERS["subdivision"])
    with bench_programs.embree(own.cages, "subdivision", level) as peer:
        programs = [(ours, own.program, (own.threads,)), (theirs, peer, ())]
        _time_builds(programs, own.threads, options.runs)
        memory = peer.ask("memory")
    theirs["bytes"] = bench_measure.bytes_of(memory["bytes"], memory["faces"], memory["peak_rss"])
    theirs["ratio"] = theirs["seconds"]["build"] / ours["seconds"]["build"]
    theirs["edit_ratio"] = theirs["seconds"]["edit"] / ours["seconds"]["edit"]
    return [ours, theirs]


def _time_builds(
    programs: Sequence[tuple[Row, bench_programs.Program, tuple[object, ...]]],
    threads: int,
    runs: int,
) -> None:
    """Medians of both times into the rows; programs take turns."""
    for step in ("build", "edit"):
        times: dict[int, list[float]] = {}
        for _ in range(runs):
            for index, (_, program, edit_words) in enumerate(programs):
                words = (threads,) if step == "build" else edit_words
                times.setdefault(index, []).append(program.ask(step, *words)["seconds"])
        for index, (row, _, _) in enumerate(programs):
            row["seconds"][step] = statistics.median(times[index])


def memory(options: argparse.Namespace) -> list[Row]:
    """Bytes a base face, by part, after tracing at several levels."""
    rows = []
    for scene in bench_scenes.scenes(options, (*bench_scenes.CAGES, *bench_scenes.SIZES)):
        with bench_measure.session(scene, options) as own:
            own.make_rays(min(options.size, 64), 2)
            for level in _levels(options, (2, 4, 6)):
                own.program.ask("trace", PACKET, level, "primary", own.threads)
                own.memory = own.program.ask("memory")
                rows.append(_memory_row(own, level))
    return rows


def _memory_row(own: Session, level: int) -> Row:
    row = bench_measure.empty_row(own, level, PACKET)
    faces = max(own.memory["faces"], 1)
    parts = {name: own.memory[f"{key}_bytes"] / faces for name, key in _PARTS.items()}
    parts["others"] = row["bytes"]["per_face"] - sum(parts.values())
    row["parts"] = parts
    row["bytes"]["peak_rss"] = own.memory["peak_rss"]
    return row


_PARTS = {"patches": "patch", "points": "point", "bvh": "bvh"}


def threads(options: argparse.Namespace) -> list[Row]:
    """The same rays with one thread and with more; by the clock on the wall."""
    most = options.threads if options.threads > 1 else len(os.sched_getaffinity(0))
    rows = []
    for scene in bench_scenes.scenes(options):
        with bench_measure.session(scene, options) as own:
            for level in _levels(options):
                own.make_rays(options.size, level)
                rows += _measure_threads(own, level, most, options)
    return rows


def _measure_threads(own: Session, level: int, most: int, options: argparse.Namespace) -> list[Row]:
    rows = []
    for name in ("primary", "shadow", "reflection"):
        times: dict[int, list[float]] = {}
        rays = 0
        for _ in range(options.runs):
            for count in _thread_counts(most):
                answer = own.program.ask("trace", PACKET, level, name, count)
                times.setdefault(count, []).append(answer["wall_seconds"])
                rays = answer["rays"]
        for count, seconds in times.items():
            row = bench_measure.empty_row(own, level, PACKET)
            row["kind"], row["threads"] = name, count
            row["seconds"]["trace"] = statistics.median(seconds)
            row["rays"][name] = rays
            row["mrays_per_second"][name] = 1e-6 * rays / row["seconds"]["trace"]
            row["ratio"] = statistics.median(a / b for a, b in zip(times[1], seconds))
            rows.append(row)
    return rows


def _thread_counts(most: int) -> list[int]:
    """1, 2, 4 and so on, and the most."""
    counts = [1]
    while counts[-1] * 2 < most:
        counts.append(counts[-1] * 2)
    return [*counts, most] if most > 1 else counts


#: All suites, in one place.
SUITES = {
    "table1": Suite("what packets do", table1, bench_columns.TABLE1),
    "table2": Suite("ray casting by tracer", table2, bench_columns.TABLE2),
    "table3": Suite("with shadows of 2 lights", table3, bench_columns.TABLE3),
    "table4": Suite("levels 1 to 4 on the forest", table4, bench_columns.TABLE4),
    "table5": Suite("with shadows and a mirrored bounce", table5, bench_columns.TABLE5),
    "table6": Suite("adaptive levels on the city", table6, bench_columns.TABLE6),
    "table7": Suite("against pre-tessellation", table7, bench_columns.TABLE7),
    "embree": Suite("against Embree", bench_embree.run, bench_columns.EMBREE),
    "build": Suite("from points to the first ray", build, bench_columns.BUILD),
    "memory": Suite("bytes a face", memory, bench_columns.MEMORY),
    "threads": Suite("one thread and more", threads, bench_columns.THREADS),
    "instances": Suite(
        "one mesh, up to a million times",
        bench_instances.run,
        bench_columns.INSTANCES,
        takes_scene=False,
    ),
    "edits": Suite("from an edit to the first picture of it", bench_edits.run, bench_columns.EDITS),
    "watertight": Suite(
        "rays that slip through closed surfaces",
        bench_watertight.run,
        bench_columns.WATERTIGHT,
        takes_scene=False,
    ),
}
