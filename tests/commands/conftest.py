"""What the tests of the commands share: how to run a command, and a scene to run it on."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from command_kit import ROOT, cube


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A small scene in a file."""
    file = tmp_path / "cube.usda"
    file.write_text(cube())
    return file


Run = Callable[..., subprocess.CompletedProcess]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Runs a command of tools/ in the test's folder, as somebody with their own set-up would."""

    def run_command(name: str, *arguments: object) -> subprocess.CompletedProcess:
        environment = {**os.environ, "PYTHONPATH": ""}
        return subprocess.run(
            [str(ROOT / "tools" / name), *map(str, arguments)],
            cwd=tmp_path,
            env=environment,
            text=True,
            capture_output=True,
            timeout=300,
            check=False,
        )

    return run_command


@pytest.fixture
def record(run: Run) -> Run:
    """Runs tools/record."""

    def run_record(*arguments: object) -> subprocess.CompletedProcess:
        return run("record", *arguments)

    return run_record
