"""Rays that slip through closed surfaces: counted, not timed."""

import argparse
from collections.abc import Sequence

from . import bench_programs
from .bench_measure import COUNTS, KINDS, Row, bytes_of

TRACERS = ("packet", "single")
LEVELS = (0, 1, 2, 3, 4, 5, 6)
#: Rows whose levels are those of cameras anywhere, up to the row's.
ADAPTIVE_TRACERS = {"adaptive": "packet", "adaptive single": "single"}
ADAPTIVE_LEVELS = (2, 4, 5, 7)
#: At these levels patches are split by steps, which takes far longer: they get fewer of the rays.
SPLIT_LEVELS, SPLIT_SHARE = (5, 6, 7, 8), 0.1


def run(options: argparse.Namespace) -> list[Row]:
    """A row for each level and tracer, over all ways to place the closed cages."""
    levels = LEVELS if options.level is None else (options.level,)
    adaptive_levels = ADAPTIVE_LEVELS if options.level is None else (options.level,)
    parts = [(level, tracer) for level in levels for tracer in TRACERS]
    parts += [(level, tracer) for level in adaptive_levels for tracer in ADAPTIVE_TRACERS]
    rays = min(options.rays, 100_000) if options.quick else options.rays
    whole = sum(_share(level) for level, _ in parts)
    with bench_programs.watertight() as program:
        placements = range(0, program.ask("placements")["count"], 4 if options.quick else 1)
        return [
            _count(
                program,
                level,
                tracer,
                placements,
                round(rays * _share(level) / whole / len(placements)),
                options.threads,
            )
            for level, tracer in parts
        ]


def _share(level: int) -> float:
    return SPLIT_SHARE if level in SPLIT_LEVELS else 1.0


def _count(
    program: bench_programs.Program,
    level: int,
    tracer: str,
    placements: Sequence[int],
    rays: int,
    threads: int,
) -> Row:
    row = _empty_row(level, tracer, threads)
    for placement in placements:
        # Each has its own seed.
        count = max(1, rays)
        is_adaptive = int(tracer in ADAPTIVE_TRACERS)
        kind = ADAPTIVE_TRACERS.get(tracer, tracer)
        words = (kind, placement, level, count, placement, threads, is_adaptive)
        answer = program.ask("count", *words)
        row["cages"] = answer["cages"]
        row["rays"]["primary"] += answer["rays"]
        row["escapes"] += answer["escapes"]
        if answer["escapes"] and not row["first_escape"]:
            row["first_escape"] = f"{answer['placement']}: {answer['first_escape']}"
    return row


def _empty_row(level: int, tracer: str, threads: int) -> Row:
    return {
        "scene": "closed cages",
        "level": level,
        "threads": threads,
        "tracer": tracer,
        "ratio": 1.0,
        "faces": 0,
        "patches": 0,
        "seconds": {"sync": 0.0, "build": 0.0, "trace": 0.0},
        "rays": dict.fromkeys(KINDS, 0),
        "mrays_per_second": dict.fromkeys(KINDS, 0.0),
        "bytes": bytes_of(0, 0, 0),
        "levels": {"min": level, "max": level, "histogram": [0] * (level + 1)},
        "packet": dict.fromkeys(COUNTS, 0.0),
        "cages": 0,
        "escapes": 0,
        "first_escape": "",
    }
