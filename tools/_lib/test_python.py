"""Stages that are pytest suites: Hydra, commands, images, scenes and the ABI."""

import os

from . import build, sdk, sdk_setup
from .console import CommandError
from .paths import BUILD, ROOT, TESTS
from .test_stage import Outcome, Settings, run_with_report


def hydra(_: Settings) -> Outcome:
    """The plugin inside OpenUSD."""
    return _pytest("hydra", build.plugin_runtime(quiet=True))


def blender(_: Settings) -> Outcome:
    """The add-on inside Blender."""
    return _pytest("blender", build.plugin_runtime(quiet=True))


def commands(_: Settings) -> Outcome:
    """The commands of tools/."""
    return _pytest("commands", build.usd_runtime(quiet=True))


def viewer(_: Settings) -> Outcome:
    """The window of tools/view, on a display without a screen."""
    try:
        sdk_setup.install_packages(lambda _: None, "apt-packages-xvfb.txt")
        sdk_setup.set_up_viewer(sdk.locate(), lambda _: None)
    except sdk_setup.SetupError as failure:
        raise CommandError(str(failure)) from failure
    return _pytest("viewer", build.plugin_runtime(quiet=True))


def images(_: Settings) -> Outcome:
    """Pictures against baselines."""
    return _pytest("images", build.plugin_runtime(quiet=True))


def scenes(_: Settings) -> Outcome:
    """The scenes of usd_scenes and their generators."""
    return _pytest("scenes", build.usd_runtime(quiet=True))


def abi(_: Settings) -> Outcome:
    """The hand-written Hydra declarations against the runtime's binary."""
    return _pytest("abi", build.usd_runtime(quiet=True))


def update_baselines() -> int:
    """Makes baselines of pictures and dumps of scenes anew. Returns the exit code."""
    sdk.ensure()
    runtime = build.plugin_runtime()
    pictures = runtime.run("-m", "pytest", str(TESTS / "images"), "--update-baselines", cwd=ROOT)
    runtime.environment["HDCC_UPDATE_DUMPS"] = "1"
    dumps = runtime.run("-m", "pytest", str(TESTS / "hydra" / "test_dump.py"), cwd=ROOT)
    return pictures.returncode or dumps.returncode


def _pytest(suite: str, runtime: build.Runtime) -> Outcome:
    folder = TESTS / suite
    if not folder.is_dir():
        raise CommandError(f"there is no folder tests/{suite}")
    report = BUILD / "reports" / f"{suite}.xml"
    jobs = str(len(os.sched_getaffinity(0)))
    return run_with_report(
        [str(runtime.python), "-m", "pytest", str(folder), "-n", jobs, f"--junitxml={report}"],
        report,
        cwd=ROOT,
        env=runtime.environment,
    )
