"""tools/bench: measures the renderer; prints a table and writes JSON."""

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from . import bench_scenes, bench_table, pictures
from .bench_suites import SUITES
from .console import CommandError, OneLineParser, exit_code_of


def main(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    return exit_code_of(lambda: _run(arguments))


def _run(arguments: list[str]) -> int:
    options = _parse(arguments)
    suite = SUITES[options.suite]
    rows = suite.run(options)
    print(bench_table.as_text(rows, suite.columns))
    if options.json:
        _write_json(rows, options.json)
    if options.markdown:
        bench_table.update_page(options.suite, rows, suite.columns, arguments)
    return 0


def _parse(arguments: list[str]) -> argparse.Namespace:
    suites = "; ".join(f"{name}: {suite.about}" for name, suite in SUITES.items())
    parser = OneLineParser(
        prog="tools/bench",
        allow_abbrev=False,
        description="Measures the renderer. Nothing is asserted: numbers are for people.",
    )
    parser.add_argument("suite", metavar="SUITE", help=suites)
    parser.add_argument(
        "--scene",
        metavar="F",
        help="a USD scene in place of the suite's own, seen through its first camera; or one of "
        + " ".join(bench_scenes.GENERATED),
    )
    parser.add_argument("--level", metavar="L", type=_number(0, 8), help="default: the suite's own")
    parser.add_argument(
        "--threads", metavar="N", type=_number(1, 1024), default=1, help="default: 1"
    )
    parser.add_argument(
        "--size", metavar="PIXELS", type=_number(8, 16384), default=1024, help="default: 1024"
    )
    parser.add_argument(
        "--runs", metavar="N", type=_number(1, 1000), default=5, help="medians of this; default: 5"
    )
    parser.add_argument(
        "--rays",
        metavar="N",
        type=_number(1, 1_000_000_000),
        default=10_000_000,
        help="of watertight, about; default: 10000000",
    )
    parser.add_argument(
        "--quick", action="store_true", help="256 pixels, one run, no city: to see that it works"
    )
    parser.add_argument("--json", metavar="F", help="write the rows as JSON")
    parser.add_argument(
        "--markdown", action="store_true", help="put the table into docs/performance.md"
    )
    options = parser.parse_args(arguments)
    _check(options)
    if options.quick:
        options.size, options.runs = min(options.size, 256), 1
    return options


def _check(options: argparse.Namespace) -> None:
    if options.suite not in SUITES:
        raise CommandError(f"unknown suite '{options.suite}' (known: {' '.join(SUITES)})", 2)
    if options.scene and not SUITES[options.suite].takes_scene:
        raise CommandError(f"{options.suite} has scenes of its own: leave out --scene", 2)
    if (
        options.scene
        and options.scene not in bench_scenes.GENERATED
        and not Path(options.scene).is_file()
    ):
        raise CommandError(f"{options.scene}: no such file")
    if options.json:
        pictures.check_folder(options.json)


def _number(lowest: int, highest: int):
    def read(text: str) -> int:
        if not text.isdecimal() or not lowest <= int(text) <= highest:
            raise argparse.ArgumentTypeError(f"'{text}' is not a number from {lowest} to {highest}")
        return int(text)

    return read


def _write_json(rows: list[dict[str, Any]], file: str) -> None:
    with pictures.Workshop(file) as workshop:
        made = workshop.path / "rows.json"
        made.write_text(json.dumps(rows, indent=2) + "\n")
        pictures.publish(made, file)
    print(f"rows written to {file}", file=sys.stderr)
