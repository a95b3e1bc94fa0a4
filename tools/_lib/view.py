"""tools/view: shows a USD scene in a window."""

import json
import os
import subprocess
import sys

from . import build, diagnostics, sdk, sdk_setup, view_options
from .console import CommandError, exit_code_of

_DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")


def main(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    return exit_code_of(lambda: _run(arguments))


def _run(arguments: list[str]) -> int:
    options = view_options.parse(arguments)
    if not any(os.environ.get(name) for name in _DISPLAYS):
        raise CommandError("there is no display: DISPLAY is not set")
    return _view(options)


def _view(options: view_options.ViewOptions) -> int:
    """Runs the process with the window, and shows what it says until it ends."""
    runtime = build.plugin_runtime()
    _set_up()
    packages = str(sdk.locate().viewer)
    runtime.environment["PYTHONPATH"] += os.pathsep + packages
    child = subprocess.Popen(
        [str(runtime.python), "-m", "_lib.viewer.process"],
        stdin=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        env=runtime.environment,
    )
    try:
        child.stdin.write(json.dumps(options.as_dict()))
        child.stdin.close()
        for text in child.stderr:
            for line in diagnostics.translate(text):
                print(line, file=sys.stderr, flush=True)
        code = child.wait()
    finally:
        if child.poll() is None:
            child.kill()
            child.wait()
    return code if code >= 0 else 128 - code


def _set_up() -> None:
    """Installs what only the window needs."""
    try:
        sdk_setup.set_up_viewer(sdk.locate(), sdk_setup.reporter(quiet=False))
    except sdk_setup.SetupError as failure:
        raise CommandError(str(failure)) from failure
