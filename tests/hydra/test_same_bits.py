"""The same picture, bit for bit, whatever the threads and from run to run."""

import pytest
from hydra_kit import View, add_cube, add_distant_light, add_grid, assert_same, make_stage, render
from pxr import Gf, Usd


def make_scene() -> Usd.Stage:
    stage = make_stage(light=False)
    add_distant_light(stage, shadows=True).AddRotateXOp().Set(-35.0)
    add_grid(stage, "/Floor", size=7, bump=0.5, holeIndices=[3, 24])
    for i in range(12):
        cube = add_cube(stage, f"/Cubes/Cube{i}", half=0.4)
        cube.AddTranslateOp().Set(Gf.Vec3d(i % 4 - 1.5, i // 4 - 1.0, 1.0 + 0.1 * i))
    return stage


@pytest.mark.parametrize("tracer", ["packet", "algorithm1", "single", "tessellated"])
def test_threads_do_not_matter(tracer: str) -> None:
    stage = make_scene()
    one = render(stage, threads=1, tracer=tracer, size=(97, 61))
    for threads in (2, 3, 0):
        assert_same(render(stage, threads=threads, tracer=tracer, size=(97, 61)), one)


def test_runs_do_not_matter() -> None:
    stage = make_scene()
    view = View(stage)
    first = view.render()
    view.set("seed", 1)
    view.execute()
    view.set("seed", 0)
    assert_same(view.render(), first)
    assert_same(render(make_scene()), first)


def test_seed_matters() -> None:
    stage = make_scene()
    assert (render(stage, seed=0)["color"] != render(stage, seed=1)["color"]).any()
