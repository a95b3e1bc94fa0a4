"""Stages that build with CMake and run what was built."""

import os
from pathlib import Path

from . import build, sdk
from .console import CommandError
from .paths import BUILD, ROOT
from .test_stage import Outcome, Settings, run_with_report


def set_up(_: Settings) -> Outcome:
    """The SDK is assembled."""
    sdk.ensure()
    return Outcome(passed=1)


def build_all(_: Settings) -> Outcome:
    """Everything compiles, without warnings."""
    return build_preset("release", "all")


def run_units(_: Settings) -> Outcome:
    """The unit tests."""
    return _ctest(BUILD / "release", dict(os.environ))


def run_sanitized_units(_: Settings) -> Outcome:
    """The unit tests of core under AddressSanitizer and UndefinedBehaviorSanitizer."""
    built = build_preset("sanitize", "cc_unit")
    if built.failed:
        return built
    environment = dict(os.environ)
    environment["ASAN_OPTIONS"] = "detect_leaks=0:strict_string_checks=1"
    environment["UBSAN_OPTIONS"] = "print_stacktrace=1"
    return _ctest(BUILD / "sanitize", environment)


def build_preset(preset: str, target: str) -> Outcome:
    try:
        build.build_target(target, preset=preset, quiet=True, more_sources=("tests",))
    except CommandError as failure:
        return Outcome(failed=1, output=str(failure))
    return Outcome(passed=1)


def _ctest(folder: Path, environment: dict[str, str]) -> Outcome:
    report = folder / "ctest.xml"
    jobs = str(len(os.sched_getaffinity(0)))
    command = ["ctest", "--test-dir", str(folder), "--output-on-failure", "-j", jobs]
    return run_with_report(
        [*command, "--no-tests=error", "--output-junit", str(report)],
        report,
        cwd=ROOT,
        env=environment,
    )
