"""Stages under AddressSanitizer and UndefinedBehaviorSanitizer: they share a build."""

import os
import shutil
import sys

from . import sdk_setup
from .console import CommandError
from .paths import BUILD, ROOT
from .test_googletest import run_sharded
from .test_programs import build_preset, unit_program
from .test_stage import Outcome, Settings, run_once

_BUILT = BUILD / "sanitize"
#: Inputs that were tried are kept here, and are where the next run begins.
CORPUS = _BUILT / "corpus"
#: What libFuzzer said, with its count of inputs.
LOG = _BUILT / "cc_fuzz.log"
#: Seconds; HDCC_FUZZ_SECONDS asks for another time.
SECONDS = 60

_ENVIRONMENT = {
    "ASAN_OPTIONS": "allocator_may_return_null=1:strict_string_checks=1",
    "UBSAN_OPTIONS": "print_stacktrace=1",
}


def units(_: Settings) -> Outcome:
    """The unit tests of core."""
    built = _build("cc_unit")
    return built if built.failed else run_sharded(unit_program("sanitize"), _environment())


def fuzz(_: Settings) -> Outcome:
    """libFuzzer on topology, tags, points and rays."""
    built = _build("cc_fuzz")
    if built.failed:
        return built
    failures = _BUILT / "failures"
    shutil.rmtree(failures, ignore_errors=True)
    failures.mkdir()
    CORPUS.mkdir(exist_ok=True)
    seeds = run_once([sys.executable, str(ROOT / "tests" / "fuzz" / "seeds.py"), str(CORPUS)])
    if seeds.failed:
        return seeds
    seconds = os.environ.get("HDCC_FUZZ_SECONDS", str(SECONDS))
    fuzzed = run_once(
        [
            str(_BUILT / "tests" / "fuzz" / "cc_fuzz"),
            str(CORPUS),
            f"-max_total_time={seconds}",
            # The same inputs on every fresh clone; a longer run goes beyond them.
            "-seed=1",
            f"-artifact_prefix={failures}/",
            "-max_len=800",
            "-len_control=0",
            "-timeout=30",
            "-print_final_stats=1",
        ],
        env=_environment(),
    )
    LOG.write_text(fuzzed.output)
    return fuzzed


def _environment() -> dict[str, str]:
    return {**os.environ, **_ENVIRONMENT}


def _build(target: str) -> Outcome:
    try:
        sdk_setup.install_packages(lambda _: None, "apt-packages-clang.txt")
    except sdk_setup.SetupError as failure:
        raise CommandError(str(failure)) from failure
    return build_preset("sanitize", target)
