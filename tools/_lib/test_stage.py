"""What a stage of the test suite is, and how counts are read off the tools it runs."""

import subprocess
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Settings:
    """How the suite was asked to run."""

    #: look at the format of changed files only
    changed_only: bool = False


@dataclass
class Outcome:
    """What a stage came to; output is shown if something failed."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0
    output: str = ""


@dataclass(frozen=True)
class Stage:
    """A part of the suite."""

    name: str
    run: Callable[[Settings], Outcome]
    needs: tuple[str, ...] = ()
    quick: bool = False


def run_once(command: list[str], **options) -> Outcome:
    """Runs a command that counts as one test."""
    finished = _run(command, **options)
    passed = finished.returncode == 0
    return Outcome(passed=int(passed), failed=int(not passed), output=finished.stdout)


def run_with_report(command: list[str], report: Path, **options) -> Outcome:
    """Runs a command that writes a JUnit report. A run without any test has failed."""
    report.parent.mkdir(parents=True, exist_ok=True)
    report.unlink(missing_ok=True)
    finished = _run(command, **options)
    outcome = Outcome(output=finished.stdout)
    if report.is_file():
        _count(report, outcome)
    if finished.returncode != 0 and not outcome.failed:
        outcome.failed = 1
    if not outcome.passed and not outcome.failed:
        outcome.failed = 1
        outcome.output += "\nno test ran"
    return outcome


def _run(command: list[str], **options) -> subprocess.CompletedProcess:
    return subprocess.run(
        command,
        text=True,
        errors="replace",
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
        **options,
    )


def _count(report: Path, outcome: Outcome) -> None:
    for case in ElementTree.parse(report).iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            outcome.failed += 1
        elif case.find("skipped") is not None or case.get("status") in ("notrun", "disabled"):
            outcome.skipped += 1
        else:
            outcome.passed += 1
