"""Runs a GoogleTest program in shards, as many at a time as there are cores."""

import os
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .paths import ROOT
from .test_stage import Outcome

#: Shards a core: tests differ in length, and what is done early takes the next.
_SHARDS_PER_CORE = 4

_RUN = re.compile(r"^\[ RUN +\] (\S+)")
_RESULT = re.compile(r"^\[ +(OK|FAILED|SKIPPED) +\] (.+) \(\d+ ms\)$")


def run_sharded(program: Path, environment: dict[str, str]) -> Outcome:
    """Every test of a program runs once. A run without any test has failed."""
    cores = len(os.sched_getaffinity(0))
    count = _SHARDS_PER_CORE * cores
    with ThreadPoolExecutor(cores) as pool:
        shards = pool.map(lambda i: _run_shard(program, environment, i, count), range(count))
    outcome = Outcome()
    for shard in shards:
        outcome.passed += shard.passed
        outcome.failed += shard.failed
        outcome.skipped += shard.skipped
        outcome.output += shard.output
    if not outcome.passed and not outcome.failed:
        outcome.failed = 1
        outcome.output += "\nno test ran"
    return outcome


def _run_shard(program: Path, environment: dict[str, str], index: int, count: int) -> Outcome:
    sharding = {"GTEST_TOTAL_SHARDS": str(count), "GTEST_SHARD_INDEX": str(index)}
    finished = subprocess.run(
        [str(program)],
        cwd=ROOT,
        env={**environment, **sharding},
        text=True,
        errors="replace",
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    return read_output(finished.stdout, finished.returncode)


def read_output(output: str, exit_code: int) -> Outcome:
    """Counts the tests that a program has run. One that it died in has failed; what is kept of the
    output is that of tests that did."""
    outcome = Outcome()
    running: list[str] = []
    for line in output.splitlines():
        if _RUN.match(line):
            running = []
        running.append(line)
        result = _RESULT.match(line)
        if not result:
            continue
        if result[1] == "FAILED":
            outcome.failed += 1
            outcome.output += "\n".join(running) + "\n"
        elif result[1] == "SKIPPED":
            outcome.skipped += 1
        else:
            outcome.passed += 1
        running = []
    if exit_code != 0 and not outcome.failed:
        outcome.failed = 1
        outcome.output += "\n".join([*running, f"exit code {exit_code}"]) + "\n"
    return outcome
