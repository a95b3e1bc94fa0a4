"""Stages that build with CMake and run what was built."""

import os
from pathlib import Path

from . import build, sdk
from .console import CommandError
from .paths import BUILD
from .test_googletest import run_sharded
from .test_stage import Outcome, Settings


def set_up(_: Settings) -> Outcome:
    """The SDK is assembled."""
    sdk.ensure()
    return Outcome(passed=1)


def build_all(_: Settings) -> Outcome:
    """Everything compiles, without warnings."""
    return build_preset("release", "all")


def run_units(_: Settings) -> Outcome:
    """The unit tests."""
    return run_sharded(unit_program("release"), dict(os.environ))


def build_preset(preset: str, target: str) -> Outcome:
    """Compiles a target, and says so only if it fails."""
    try:
        build.build_target(target, preset=preset, quiet=True, more_sources=("tests",))
    except CommandError as failure:
        return Outcome(failed=1, output=str(failure))
    return Outcome(passed=1)


def unit_program(preset: str) -> Path:
    """Where the unit tests are."""
    return BUILD / preset / "tests" / "unit" / "cc_unit"
