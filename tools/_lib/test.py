"""tools/test: all tests, from build to images."""

import argparse
import sys
import time

from . import test_lint, test_programs, test_python, test_sanitize
from .console import CommandError, OneLineParser, exit_code_of
from .test_stage import Outcome, Settings, Stage

#: All stages, in the order in which they run. A stage waits for what it needs to have passed.
STAGES = (
    Stage("set-up", test_programs.set_up, quick=True),
    Stage("format", test_lint.check_format, needs=("set-up",), quick=True),
    Stage("ruff", test_lint.check_python, needs=("set-up",), quick=True),
    Stage("build", test_programs.build_all, needs=("set-up",), quick=True),
    Stage("units", test_programs.run_units, needs=("build",), quick=True),
    Stage("hydra", test_python.hydra, needs=("build",), quick=True),
    Stage("abi", test_python.abi, needs=("set-up",)),
    Stage("blender", test_python.blender, needs=("build",)),
    Stage("commands", test_python.commands, needs=("build",)),
    Stage("viewer", test_python.viewer, needs=("build",)),
    Stage("images", test_python.images, needs=("build",)),
    Stage("scenes", test_python.scenes, needs=("set-up",)),
    Stage("clang-tidy", test_lint.check_cpp, needs=("build",)),
    Stage("sanitize", test_sanitize.units, needs=("set-up",)),
    Stage("fuzz", test_sanitize.fuzz, needs=("set-up",)),
)


def main(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    return exit_code_of(lambda: _run_command(arguments))


def _run_command(arguments: list[str]) -> int:
    options = _parse(arguments)
    if options.fix:
        return test_lint.fix()
    if options.update_baselines:
        return test_python.update_baselines()
    return _run_all(_chosen(options), Settings(changed_only=options.part == "quick"))


def _parse(arguments: list[str]) -> argparse.Namespace:
    parser = OneLineParser(
        prog="tools/test",
        allow_abbrev=False,
        description="Runs all tests, set-up and build included. See docs/testing.md.",
    )
    parser.add_argument(
        "part",
        nargs="?",
        choices=["quick"],
        help="what to run at every edit: format of changed files, build, units and Hydra tests",
    )
    parser.add_argument(
        "--only", metavar="STAGE", action="append", help=f"of {' '.join(s.name for s in STAGES)}"
    )
    parser.add_argument("--fix", action="store_true", help="format sources in place, and stop")
    parser.add_argument(
        "--update-baselines",
        action="store_true",
        help="render the baselines of the image tests anew, and stop: look at them before they "
        "are committed",
    )
    return parser.parse_args(arguments)


def _chosen(options: argparse.Namespace) -> list[Stage]:
    if options.only:
        known = {stage.name: stage for stage in STAGES}
        for name in options.only:
            if name not in known:
                raise CommandError(f"unknown stage '{name}' (known: {' '.join(known)})", 2)
        return [stage for stage in STAGES if stage.name in options.only]
    return [stage for stage in STAGES if stage.quick or options.part != "quick"]


def _run_all(stages: list[Stage], settings: Settings) -> int:
    """Runs stages one after another; prints a line for each and the sum as the last line."""
    broken: set[str] = set()
    passed = failed = 0
    for stage in stages:
        begin = time.monotonic()
        missing = broken.intersection(stage.needs)
        if missing:
            outcome = Outcome(failed=1, output=f"not run: {', '.join(sorted(missing))} failed")
        else:
            outcome = _run(stage, settings)
        if outcome.failed:
            broken.add(stage.name)
        passed += outcome.passed
        failed += outcome.failed
        _print_outcome(stage, outcome, time.monotonic() - begin)
    print(f"{passed} passed, {failed} failed", flush=True)
    return 0 if passed and not failed else 1


def _run(stage: Stage, settings: Settings) -> Outcome:
    try:
        return stage.run(settings)
    except CommandError as failure:
        return Outcome(failed=1, output=str(failure))
    except SystemExit as failure:
        return Outcome(failed=1, output=f"ended with exit code {failure.code}")


def _print_outcome(stage: Stage, outcome: Outcome, seconds: float) -> None:
    if outcome.failed and outcome.output:
        print(outcome.output.rstrip(), flush=True)
    state = "FAILED" if outcome.failed else "ok"
    counts = f"{outcome.passed} passed"
    if outcome.failed:
        counts += f", {outcome.failed} failed"
    if outcome.skipped:
        counts += f", {outcome.skipped} skipped"
    print(f"{state:6}  {stage.name:10}  {seconds:6.1f} s  {counts}", flush=True)
    sys.stdout.flush()
