"""What the tests of the window share: a display without a screen."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from _lib import sdk

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(sdk.locate().viewer))


@pytest.fixture(scope="session")
def display() -> Iterator[str]:
    """The name of a display of our own."""
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x960x24", "-nolisten", "tcp"],
        pass_fds=[write],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    assert number, "Xvfb did not start"
    yield f":{number}"
    server.terminate()
    server.wait()


View = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def view(display: str, tmp_path: Path) -> View:
    """Runs tools/view in the test's folder."""

    def run(*arguments: object, **variables: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "DISPLAY": display, **variables}
        return subprocess.run(
            [str(ROOT / "tools" / "view"), *map(str, arguments)],
            cwd=tmp_path,
            env=environment,
            text=True,
            capture_output=True,
            timeout=300,
            check=False,
        )

    return run
