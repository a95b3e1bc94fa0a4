"""Finds the plugin that was built, before anything imports pxr."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

_REPOSITORY = Path(__file__).resolve().parents[2]

if "HDCC_BUILD_DIR" in os.environ or "PXR_PLUGINPATH_NAME" not in os.environ:
    _build = _REPOSITORY / os.environ.get("HDCC_BUILD_DIR", "build/release")
    os.environ["PXR_PLUGINPATH_NAME"] = str(_build / "plugin/hdCC/resources")

_RESOURCES = Path(os.environ["PXR_PLUGINPATH_NAME"])


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
