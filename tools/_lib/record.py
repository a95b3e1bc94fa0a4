"""tools/record: renders pictures of a USD scene through Hydra."""

import json
import os
import selectors
import signal
import subprocess
import sys
from contextlib import ExitStack

from . import build, diagnostics, pictures, record_options
from .console import error, exit_code_of
from .progress import ProgressBar
from .record_options import RecordOptions


def main(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    return exit_code_of(lambda: _run(arguments))


def _run(arguments: list[str]) -> int:
    options = record_options.parse(arguments)
    signal.signal(signal.SIGTERM, _stop)
    return _record(options)


def _stop(*_: object) -> None:
    raise KeyboardInterrupt


def _record(options: RecordOptions) -> int:
    runtime = build.plugin_runtime(quiet=options.quiet)
    with pictures.Workshop(options.picture) as workshop:
        options.workshop = str(workshop.path)
        return _render(options, runtime)


def _render(options: RecordOptions, runtime: build.Runtime) -> int:
    """Runs the process that renders, and shows what it says until it ends."""
    bar = ProgressBar(not options.quiet, runtime.python)
    with ExitStack() as stack:
        stack.callback(bar.close)
        progress_read, progress_write = os.pipe()
        stack.callback(os.close, progress_read)
        options.progress_fd = progress_write if sys.stderr.isatty() and not options.quiet else -1
        child = subprocess.Popen(
            [str(runtime.python), "-m", "_lib.render_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=runtime.environment,
            pass_fds=[progress_write],
        )
        os.close(progress_write)
        stack.callback(_end, child)
        child.stdin.write(json.dumps(options.as_dict()).encode())
        child.stdin.close()
        _relay(child, progress_read, bar)
        bar.close()
        return _exit_code(child.wait())


def _relay(child: subprocess.Popen, progress_fd: int, bar: ProgressBar) -> None:
    """Shows messages and progress until all pipes are closed at the other end."""
    results_fd, messages_fd = child.stdout.fileno(), child.stderr.fileno()
    with selectors.DefaultSelector() as selector:
        for fd in (results_fd, messages_fd, progress_fd):
            selector.register(fd, selectors.EVENT_READ)
        while selector.get_map():
            for key, _ in selector.select():
                data = os.read(key.fd, 65536)
                if not data:
                    selector.unregister(key.fd)
                elif key.fd == progress_fd:
                    _show_progress(data, bar)
                else:
                    bar.clear()
                    text = data.decode(errors="replace")
                    if key.fd == results_fd:
                        print(text, end="", flush=True)
                    else:
                        _show_messages(text)


def _show_messages(text: str) -> None:
    for line in diagnostics.translate(text):
        print(line, file=sys.stderr, flush=True)


def _show_progress(data: bytes, bar: ProgressBar) -> None:
    last = data.decode().splitlines()[-1].split()
    if len(last) != 3:
        return
    fraction, done, count = float(last[0]), int(last[1]), int(last[2])
    label = "rendering" if count == 1 else f"frame {done + 1} of {count}"
    bar.show((done + fraction) / count, label)


def _exit_code(code: int) -> int:
    if code >= 0:
        return code
    name = signal.Signals(-code).name
    error(f"the renderer was ended by {name}; no picture was written")
    return 128 - code


def _end(child: subprocess.Popen) -> None:
    if child.poll() is None:
        child.kill()
        child.wait()
