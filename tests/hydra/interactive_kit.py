"""Drives frames that render in the background."""

import time
from typing import Any

from hydra_kit import (
    Picture,
    View,
    add_cube,
    add_distant_light,
    add_grid,
    make_stage,
    render,
)
from pxr import Gf, Usd

#: So many that a frame does not end before a test has looked at it.
ENDLESS = 2**31 - 1
#: Converges in a moment.
QUICK = 5


def make_scene() -> Usd.Stage:
    stage = make_stage(light=False)
    add_distant_light(stage, shadows=True).AddRotateXYZOp().Set(Gf.Vec3f(30, 20, 0))
    add_grid(stage, bump=0.5)
    add_cube(stage, half=0.5).AddTranslateOp().Set(Gf.Vec3d(0.3, 0.2, 1))
    return stage


def make_view(stage: Usd.Stage | None = None, samples: int = QUICK, **options: Any) -> View:
    return View(stage or make_scene(), interactive=True, samples=samples, **options)


def draw(view: View) -> bool:
    """Has the engine render once. Returns whether the picture is converged."""
    view.engine.Render(view.stage.GetPseudoRoot(), view.params)
    return bool(view.engine.IsConverged())


def converge(view: View) -> Picture:
    deadline = time.monotonic() + 300
    while not draw(view):
        assert time.monotonic() < deadline, "the picture does not converge"
        time.sleep(0.001)
    return view.read()


def expected(view: View, samples: int = QUICK, **options: Any) -> Picture:
    return render(view.stage, samples=samples, **options)


def samples_done(view: View) -> int:
    return int(view.engine.GetRenderStats()["numCompletedSamples"])


def wait_for_samples(view: View, least: int) -> None:
    deadline = time.monotonic() + 300
    while samples_done(view) < least:
        assert time.monotonic() < deadline, "no more samples come"
        draw(view)
        time.sleep(0.001)
