"""Stages that read the sources: clang-format, clang-tidy and ruff."""

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from . import sdk
from .paths import BUILD, ROOT
from .test_stage import Outcome, Settings, run_once

_CPP_SUFFIXES = (".h", ".cpp")
_CPP_FOLDERS = ("core", "hdCC", "tests")
_TIDY_FOLDERS = ("core", "hdCC")
_FORMAT = "[-Wclang-format-violations]"
_PYTHON_COMMANDS = ("tools/setup", "tools/record", "tools/test", "tools/bench", "tools/view")


def check_format(settings: Settings) -> Outcome:
    """C++ is formatted as .clang-format says."""
    files = _cpp_files(settings.changed_only)
    if not files:
        return Outcome(passed=1)
    program = str(sdk.locate().program("clang-format"))
    check = run_once([program, "--dry-run", "-Werror", "-ferror-limit=1", *files], cwd=ROOT)
    wrong = sorted({line.split(":")[0] for line in check.output.splitlines() if _FORMAT in line})
    failed = len(wrong) or check.failed
    output = "".join(f"{file}: not formatted; tools/test --fix mends it\n" for file in wrong)
    return Outcome(len(files) - failed, failed, output=output or check.output)


def check_python(settings: Settings) -> Outcome:
    """Python is formatted and free of what ruff finds."""
    files = _python_files(settings.changed_only)
    if not files:
        return Outcome(passed=1)
    program = str(sdk.locate().program("ruff"))
    check = run_once([program, "check", "--quiet", "--output-format=concise", *files], cwd=ROOT)
    layout = run_once([program, "format", "--check", "--output-format=concise", *files], cwd=ROOT)
    return Outcome(
        passed=check.passed + layout.passed,
        failed=check.failed + layout.failed,
        output=check.output + layout.output,
    )


def check_cpp(_: Settings) -> Outcome:
    """clang-tidy finds nothing; every source file counts as a test."""
    database = BUILD / "release" / "compile_commands.json"
    if not database.is_file():
        return Outcome(failed=1, output=f"{database} is missing: run the build stage first\n")
    wanted = [str(ROOT / folder) + "/" for folder in _TIDY_FOLDERS]
    entries = json.loads(database.read_text())
    files = sorted(e["file"] for e in entries if e["file"].startswith(tuple(wanted)))
    with ThreadPoolExecutor(max(1, len(os.sched_getaffinity(0)))) as pool:
        outcomes = list(pool.map(_tidy, files))
    return Outcome(
        passed=sum(outcome.passed for outcome in outcomes),
        failed=sum(outcome.failed for outcome in outcomes) + int(not files),
        output="\n".join(outcome.output for outcome in outcomes if outcome.failed),
    )


def _tidy(file: str) -> Outcome:
    program = str(sdk.locate().program("clang-tidy"))
    # The compiler's own warnings are g++'s business, which knows its standard library.
    silent = ["--extra-arg=-Wno-deprecated-declarations"]
    # The precompiled header is g++'s; the headers in it are read instead.
    silent.append("--extra-arg=-Wno-ignored-gch")
    # Kernels are compiled for one target after the other, from the same source: one is enough.
    one_target = "--extra-arg=-DHWY_COMPILE_ONLY_STATIC"
    command = [program, "--quiet", *silent, one_target, "-p", str(BUILD / "release"), file]
    return run_once(command, cwd=ROOT)


def fix() -> int:
    """Formats all sources in place. Returns the exit code."""
    found = sdk.ensure()
    commands = [
        [str(found.program("clang-format")), "-i", *_cpp_files(False)],
        [str(found.program("ruff")), "check", "--fix", "--quiet", *_python_files(False)],
        [str(found.program("ruff")), "format", "--quiet", *_python_files(False)],
    ]
    codes = [subprocess.run(command, cwd=ROOT, check=False).returncode for command in commands]
    return max(codes)


def _cpp_files(changed_only: bool) -> list[str]:
    return [
        file
        for file in _files(changed_only)
        if file.endswith(_CPP_SUFFIXES) and file.startswith(_CPP_FOLDERS)
    ]


def _python_files(changed_only: bool) -> list[str]:
    return [
        file for file in _files(changed_only) if file.endswith(".py") or file in _PYTHON_COMMANDS
    ]


def _files(changed_only: bool) -> list[str]:
    """Files of the checkout, those that git ignores left out, relative to its root."""
    listing = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    if changed_only:
        listing = ["git", "ls-files", "-z", "--modified", "--others", "--exclude-standard"]
    files = _git_lines(listing)
    if changed_only:
        files += _git_lines(["git", "diff", "-z", "--cached", "--name-only", "HEAD"])
    return sorted({file for file in files if (ROOT / file).is_file()})


def _git_lines(command: list[str]) -> list[str]:
    finished = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
    if finished.returncode != 0:
        print("note: no git checkout; looking at all files", file=sys.stderr)
        return _files_on_disk()
    return [line for line in finished.stdout.split("\0") if line]


def _files_on_disk() -> list[str]:
    folders = (*_CPP_FOLDERS, "tools", "usd_scenes")
    found = (path for folder in folders for path in Path(ROOT / folder).rglob("*"))
    return [str(path.relative_to(ROOT)) for path in found if path.is_file()]
