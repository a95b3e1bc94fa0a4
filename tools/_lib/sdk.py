"""Where the assembled SDK is, and whether it is what this checkout asks for.

`ensure()` is what other commands call: it returns at once when the SDK is current, and assembles
it when it is not. Only the standard library is imported here, and little of it.
"""

import hashlib
import os
import subprocess
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
INPUTS = ROOT / "cmake" / "sdk"
FOLDER_VARIABLE = "HDCC_SDK_DIR"


@dataclass(frozen=True)
class Sdk:
    """The SDK's folder and what lies in it."""

    folder: Path

    @property
    def venv(self) -> Path:
        """The virtual environment of the runtime, the tests and the formatters."""
        return self.folder / "venv"

    @property
    def python(self) -> Path:
        """The Python whose `pxr` is the runtime's."""
        return self.venv / "bin" / "python"

    @property
    def site_packages(self) -> Path:
        """Where the virtual environment keeps its packages."""
        return self.venv / "lib" / "python3.11" / "site-packages"

    @property
    def runtime(self) -> Path:
        """The folder of the runtime's shared libraries."""
        return self.site_packages / "bpy" / "lib"

    @property
    def usd_core(self) -> Path:
        """A virtual environment with another OpenUSD, never to be mixed with the runtime's."""
        return self.folder / "usd-core"

    @property
    def usd_core_python(self) -> Path:
        """The Python whose `pxr` is the other OpenUSD's."""
        return self.usd_core / "bin" / "python"

    @property
    def viewer(self) -> Path:
        """The packages of the viewer's window."""
        return self.folder / "viewer"

    @property
    def prefix(self) -> Path:
        """What CMAKE_PREFIX_PATH should hold: headers, libraries and CMake packages."""
        return self.folder / "prefix"

    @property
    def include(self) -> Path:
        """The one include folder."""
        return self.prefix / "include"

    @cached_property
    def stamp(self) -> Path:
        """The file that says what the SDK was assembled from."""
        return self.folder / "stamp"

    def program(self, name: str) -> Path:
        """A program of the virtual environment, such as clang-format."""
        return self.venv / "bin" / name


def locate() -> Sdk:
    """The SDK of this checkout, or the shared one that HDCC_SDK_DIR names."""
    chosen = os.environ.get(FOLDER_VARIABLE)
    return Sdk(Path(chosen).expanduser().absolute() if chosen else ROOT / ".sdk")


def input_files() -> list[Path]:
    """The files that decide what an SDK is made of."""
    files = [path for path in INPUTS.rglob("*") if path.is_file()]
    return sorted([*files, *Path(__file__).parent.glob("sdk*.py")])


def fingerprint(files: list[Path], *more: str) -> str:
    """A hash of files' names and contents, and of anything else that matters."""
    digest = hashlib.sha256("\0".join(more).encode())
    for path in files:
        content = path.read_bytes()
        digest.update(f"{path.relative_to(ROOT)}\0{len(content)}\0".encode())
        digest.update(content)
    return digest.hexdigest()


def wanted_stamp(sdk: Sdk) -> str:
    """The stamp of an SDK that is current. A virtual environment cannot move, so place counts."""
    return fingerprint(input_files(), str(sdk.folder))


def is_current(sdk: Sdk) -> bool:
    """True if the SDK is complete and made of what this checkout asks for."""
    try:
        return sdk.stamp.read_text() == wanted_stamp(sdk) and sdk.python.exists()
    except OSError:
        return False


def ensure(quiet: bool = False) -> Sdk:
    """Returns the SDK, assembled if it is not current. Raises SystemExit if that fails."""
    sdk = locate()
    if is_current(sdk):
        return sdk
    command = [sys.executable, str(ROOT / "tools" / "setup"), *(["--quiet"] if quiet else [])]
    finished = subprocess.run(command, stdout=sys.stderr, check=False)
    if finished.returncode != 0:
        raise SystemExit(finished.returncode)
    return sdk
