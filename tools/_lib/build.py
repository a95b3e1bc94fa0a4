"""Builds with CMake what a command needs, and does nothing, quickly, if that is there already."""

import fcntl
import hashlib
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from . import sdk
from .console import CommandError
from .paths import BUILD, ROOT, TOOLS

_SOURCES = ("CMakeLists.txt", "CMakePresets.json", "cmake", "core", "hdCC", "plugInfo")
_PLUGIN_RESOURCES = Path("plugin/hdCC/resources")


@dataclass(frozen=True)
class Runtime:
    """A Python that has OpenUSD, and the environment to run it with."""

    python: Path
    environment: dict[str, str]

    def run(self, *arguments: str, **options) -> subprocess.CompletedProcess:
        """Runs this Python; options are those of subprocess.run."""
        return subprocess.run(
            [str(self.python), *arguments], env=self.environment, check=False, **options
        )


def usd_runtime(quiet: bool = False) -> Runtime:
    """The SDK's OpenUSD without the plugin."""
    found = sdk.ensure(quiet=quiet)
    environment = dict(os.environ)
    # Whatever OpenUSD the user has set up stays out of this process.
    environment["PYTHONPATH"] = str(TOOLS)
    environment.pop("PXR_PLUGINPATH_NAME", None)
    return Runtime(found.python, environment)


def plugin_runtime(quiet: bool = False) -> Runtime:
    """The SDK's OpenUSD with the plugin, which is built first if sources have changed."""
    runtime = usd_runtime(quiet)
    folder = build_target("hdCC", quiet=quiet)
    runtime.environment["PXR_PLUGINPATH_NAME"] = str(folder / _PLUGIN_RESOURCES)
    return runtime


def build_target(
    target: str, quiet: bool = False, preset: str = "release", more_sources: tuple[str, ...] = ()
) -> Path:
    """Configures and builds a target unless its sources are those of the last build.

    Returns the build folder.
    """
    folder = BUILD / preset
    stamp = folder / f".{target}-sources"
    with _locked(BUILD / f"{preset}.lock"):
        state = _state_of(more_sources)
        if stamp.is_file() and stamp.read_text() == state:
            return folder
        if not quiet:
            print(f"building {target} ...", file=sys.stderr, flush=True)
        configure(preset)
        _run_quietly(["cmake", "--build", str(folder), "--target", target])
        stamp.write_text(state)
    return folder


def configure(preset: str) -> None:
    """Configures a preset of CMakePresets.json for the SDK."""
    prefix = sdk.locate().prefix
    _run_quietly(["cmake", "--preset", preset, f"-DCMAKE_PREFIX_PATH={prefix}"])


def _state_of(more_sources: tuple[str, ...]) -> str:
    """A hash that changes when a source file, or the SDK, does."""
    digest = hashlib.sha256(str(sdk.locate().folder).encode())
    stamp = sdk.locate().stamp
    digest.update(stamp.read_bytes() if stamp.is_file() else b"")
    for source in (*_SOURCES, *more_sources):
        for file in _files_below(str(ROOT / source)):
            status = os.stat(file)
            digest.update(f"{file}\0{status.st_mtime_ns}\0{status.st_size}\0".encode())
    return digest.hexdigest()


def _files_below(path: str) -> Iterator[str]:
    if os.path.isfile(path):
        yield path
    for folder, folders, files in os.walk(path):
        folders.sort()
        for name in sorted(files):
            yield os.path.join(folder, name)


@contextmanager
def _locked(lock: Path) -> Iterator[None]:
    """Lets one process at a time into a build folder."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _run_quietly(command: list[str]) -> None:
    """Runs a step of the build; its output is shown only if it fails."""
    try:
        finished = subprocess.run(
            command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
    except FileNotFoundError as failure:
        raise CommandError(f"{command[0]} is not installed; run tools/setup") from failure
    if finished.returncode != 0:
        sys.stderr.write(finished.stdout)
        raise CommandError(f"the build failed: {' '.join(command)}")
