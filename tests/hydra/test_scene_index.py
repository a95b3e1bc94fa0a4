"""The same tests with scene indices in the engine in place of OpenUSD's older scene delegate."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent


@pytest.mark.parametrize(
    "tests",
    [
        "test_motion.py",
        "test_holes.py",
        "test_primvars.py",
        "test_cameras.py",
        "test_instances.py::test_an_invisible_instancer_shows_nothing",
    ],
)
def test_with_scene_indices(tests: str) -> None:
    finished = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:xdist", str(HERE / tests)],
        env={**os.environ, "USDIMAGINGGL_ENGINE_ENABLE_SCENE_INDEX": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr
