"""The stage that feeds the core what nobody should write."""

import os
import shutil
import sys

from . import sdk_setup
from .console import CommandError
from .paths import BUILD, ROOT
from .test_programs import build_preset
from .test_stage import Outcome, Settings, run_once

#: Inputs that were tried are kept here, and are where the next run begins.
CORPUS = BUILD / "fuzz" / "corpus"
#: Seconds; HDCC_FUZZ_SECONDS asks for another time.
SECONDS = 60


def fuzz(_: Settings) -> Outcome:
    """libFuzzer on topology, tags, points and rays, under AddressSanitizer and UBSan."""
    try:
        sdk_setup.install_packages(lambda _: None, "apt-packages-fuzz.txt")
    except sdk_setup.SetupError as failure:
        raise CommandError(str(failure)) from failure
    built = build_preset("fuzz", "cc_fuzz")
    if built.failed:
        return built
    failures = BUILD / "fuzz" / "failures"
    shutil.rmtree(failures, ignore_errors=True)
    failures.mkdir()
    CORPUS.mkdir(exist_ok=True)
    seeds = run_once([sys.executable, str(ROOT / "tests" / "fuzz" / "seeds.py"), str(CORPUS)])
    if seeds.failed:
        return seeds
    seconds = os.environ.get("HDCC_FUZZ_SECONDS", str(SECONDS))
    return run_once(
        [
            str(BUILD / "fuzz" / "tests" / "fuzz" / "cc_fuzz"),
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
        env={**os.environ, "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1"},
    )
