"""Finds the plugin that was built, before anything imports pxr."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

_REPOSITORY = Path(__file__).resolve().parents[2]
_BUILD = Path(os.environ.get("HDCC_BUILD_DIR", "build/release"))
_RESOURCES = _REPOSITORY / _BUILD / "plugin/hdCC/resources"

os.environ["PXR_PLUGINPATH_NAME"] = str(_RESOURCES)


def pytest_sessionstart() -> None:
    if not (_RESOURCES / "plugInfo.json").is_file():
        pytest.exit(f"there is no plugin at {_RESOURCES}; build it, or set HDCC_BUILD_DIR", 2)


@pytest.fixture
def warnings(capfd: pytest.CaptureFixture[str]) -> Iterator["WarningLog"]:
    """What the renderer says: OpenUSD prints warnings on stderr."""
    yield WarningLog(capfd)


class WarningLog:
    """Text that has come since it was last read."""

    def __init__(self, capture: pytest.CaptureFixture[str]) -> None:
        self._capture = capture

    def read(self) -> str:
        return self._capture.readouterr().err
