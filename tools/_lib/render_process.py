"""The process that renders for tools/record: reads its options as JSON from stdin.

It runs apart from the command itself so that OpenUSD's plugin path is set for it alone, and so
that the command can still clean up and say what happened if it crashes.
"""

import json
import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from pxr import Tf, Usd, UsdRender

from . import pictures, render_stats
from .console import CommandError, error
from .products import Product, products_of, view_of, without_blur
from .record_options import RecordOptions
from .recorder import EngineRecorder, Recorder, make_recorder
from .stage import View, find_camera, find_settings_prim, frames_of, open_stage, view_at


def main() -> int:
    """Renders all frames; the exit code is 0 only if every picture was written."""
    values = json.load(sys.stdin)
    values["settings"] = [tuple(setting) for setting in values["settings"]]
    try:
        record(RecordOptions(**values))
    except CommandError as failure:
        error(str(failure))
        return failure.exit_code
    except Tf.ErrorException as failure:
        for item in failure.args:
            error(" ".join(item.commentary.split()))
        return 1
    return 0


def record(options: RecordOptions) -> None:
    """Renders all frames; raises CommandError if one fails."""
    stage = open_stage(options)
    settings = find_settings_prim(options, stage)
    _take_purposes(options, settings)
    frames = frames_of(options, stage)
    recorder = make_recorder(options, settings)
    for done, when in enumerate(frames):
        with _reported_progress(recorder, options.progress_fd, done, len(frames)):
            products = products_of(options, settings, when)
            for product in products:
                _record_product(options, recorder, stage, product, when)
            if not products:
                camera = find_camera(options, stage, settings)
                view = view_at(options, stage, camera, settings, when)
                _record_frame(options, recorder, stage, view, when)


def _take_purposes(options: RecordOptions, settings: UsdRender.Settings | None) -> None:
    """Those that the settings prim includes, unless the command line names some."""
    included = settings.GetIncludedPurposesAttr() if settings else None
    if included and included.HasAuthoredValue() and not options.purposes_given:
        options.purposes = [str(purpose) for purpose in included.Get()]


def _record_frame(
    options: RecordOptions, recorder: Recorder, stage: Usd.Stage, view: View, when: Usd.TimeCode
) -> None:
    picture = pictures.name_of_frame(options.picture, _number_of(when))
    with _made_whole(options, recorder, picture, view, when) as made:
        recorder.record(stage, view, when, made)


def _record_product(
    options: RecordOptions,
    recorder: EngineRecorder,
    stage: Usd.Stage,
    product: Product,
    when: Usd.TimeCode,
) -> None:
    view = view_of(options, stage, product, when)
    with (
        without_blur(stage, product, view),
        _made_whole(options, recorder, product.file, view, when) as made,
    ):
        recorder.record_product(stage, view, when, made, product)


@contextmanager
def _made_whole(
    options: RecordOptions, recorder: Recorder, picture: str, view: View, when: Usd.TimeCode
) -> Iterator[Path]:
    """Gives a file that the body makes the picture's name, and says what came of it."""
    begin = time.perf_counter()
    with ExitStack() as stack:
        workshop = Path(options.workshop)
        if Path(picture).resolve().parent != workshop.parent:
            workshop = stack.enter_context(pictures.Workshop(picture)).path
        made = workshop / Path(picture).name
        try:
            yield made
        except CommandError as failure:
            raise CommandError(str(failure).replace(str(made), picture)) from failure
        pictures.publish(made, picture)
    if options.stats:
        stats = pictures.name_of_frame(options.stats, _number_of(when))
        render_stats.write(recorder.stats(), stats)
    if not options.quiet:
        seconds = time.perf_counter() - begin
        camera = "all of the stage" if view.path.isEmpty else view.path
        print(f"{picture}  {view.width}x{view.height}  {camera}  {seconds:.2f} s", flush=True)


def _number_of(when: Usd.TimeCode) -> float:
    return 0.0 if when.IsDefault() else when.GetValue()


@contextmanager
def _reported_progress(recorder: Recorder, fd: int, done: int, count: int) -> Iterator[None]:
    """Writes lines `fraction done count` to a pipe while the body runs; -1 means to nowhere."""
    if fd < 0:
        yield
        return
    finished = threading.Event()

    def report() -> None:
        while not finished.wait(0.1):
            fraction = min(max(recorder.fraction_done(), 0.0), 1.0)
            os.write(fd, f"{fraction} {done} {count}\n".encode())

    thread = threading.Thread(target=report, daemon=True)
    thread.start()
    try:
        yield
    finally:
        finished.set()
        thread.join()


if __name__ == "__main__":
    exit_code = main()
    sys.stdout.flush()
    sys.stderr.flush()
    # Pictures are on the disk. Taking OpenUSD's libraries down would cost time, and their threads
    # now and then abort the process while they end.
    os._exit(exit_code)
