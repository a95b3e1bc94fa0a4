"""Stages under AddressSanitizer and UndefinedBehaviorSanitizer: they share a build."""

import math
import os
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

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
#: Seconds of all cores together; HDCC_FUZZ_SECONDS asks for another time.
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
    cores = len(os.sched_getaffinity(0))
    seconds = int(os.environ.get("HDCC_FUZZ_SECONDS", str(SECONDS))) / cores
    with ThreadPoolExecutor(cores) as pool:
        runs = list(pool.map(lambda i: _fuzz(1 + i, math.ceil(seconds), failures), range(cores)))
    LOG.write_text("".join(run.output for run in runs))
    return next((run for run in runs if run.failed), runs[0])


def _fuzz(seed: int, seconds: int, failures: Path) -> Outcome:
    """One process. A seed has the same inputs on every fresh clone; a longer run goes beyond."""
    return run_once(
        [
            str(_BUILT / "tests" / "fuzz" / "cc_fuzz"),
            str(CORPUS),
            f"-max_total_time={seconds}",
            f"-seed={seed}",
            f"-artifact_prefix={failures}/",
            "-max_len=800",
            "-len_control=0",
            "-timeout=30",
            "-print_final_stats=1",
        ],
        env=_environment(),
    )


def _environment() -> dict[str, str]:
    return {**os.environ, **_ENVIRONMENT}


def _build(target: str) -> Outcome:
    try:
        sdk_setup.install_packages(lambda _: None, "apt-packages-clang.txt")
    except sdk_setup.SetupError as failure:
        raise CommandError(str(failure)) from failure
    return build_preset("sanitize", target)
