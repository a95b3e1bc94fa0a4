"""The process that edits a stage while it is rendered: reads what to do as JSON from stdin."""

import json
import os
import random
import statistics
import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from pxr import Gf, Usd, UsdGeom, UsdLux, Vt

from . import render_stats
from .console import CommandError, error
from .engine import make_engine, render_params, set_camera_light, show_view
from .stage import View, open_stage

Edit = Callable[[], object]

#: So many that frames do not end before the next edit.
_ENDLESS = 2**31 - 1


class EditedStage:
    """A stage in an engine that renders all the time."""

    def __init__(self, scene: str, width: int, threads: int) -> None:
        # What open_stage and render_params ask for.
        self.scene, self.mask, self.session_layer = scene, [], None
        self.complexity, self.purposes = "low", ["proxy"]
        self.random = random.Random(1)
        self.stage = open_stage(self)
        self.engine = make_engine()
        self.engine.SetRendererSetting("hdcc:samples", _ENDLESS)
        self.engine.SetRendererSetting("hdcc:threads", threads)
        self.engine.SetRendererAov("color")
        self.camera = next(
            (UsdGeom.Camera(prim) for prim in self.stage.Traverse() if prim.IsA(UsdGeom.Camera)),
            None,
        )
        meshes = [UsdGeom.Mesh(prim) for prim in self.stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
        if not self.camera or not meshes:
            raise CommandError(f"{scene}: there is no camera or no mesh")
        self.mesh = max(meshes, key=lambda mesh: len(mesh.GetPointsAttr().Get() or ()))
        self.params = render_params(Usd.TimeCode(self.stage.GetStartTimeCode()), self)
        seen = self.camera.GetCamera(self.params.frame)
        size = (width, max(round(width / seen.aspectRatio), 1))
        show_view(self.engine, View(seen, self.camera.GetPath(), *size))
        set_camera_light(self.engine, seen, True)
        self.light = UsdLux.DistantLight.Define(self.stage, "/BenchLight")
        self.points = self.mesh.GetPointsAttr().Get(self.params.frame)
        self.draw()

    def draw(self) -> None:
        """Shows the newest picture; after an edit, the first one of what is new."""
        self.engine.Render(self.stage.GetPseudoRoot(), self.params)

    def time(self, prepare: Callable[[], Edit]) -> float:
        """Milliseconds until an edit can be seen, at some moment of the frame before."""
        edit = prepare()
        for _ in range(self.random.randint(1, 6)):
            time.sleep(0.015)
            self.draw()
        begin = time.perf_counter()
        edit()
        self.draw()
        return 1000 * (time.perf_counter() - begin)

    def some(self) -> float:
        return self.random.uniform(0.001, 0.01)

    # ---- Edits, ready to be made ----

    def move_camera(self) -> Edit:
        step = _own_step(self.camera)
        return partial(step.Set, Gf.Vec3d(self.some(), 0, 0))

    def move_mesh(self) -> Edit:
        return partial(_own_step(self.mesh).Set, Gf.Vec3d(self.some(), 0, 0))

    def move_points(self) -> Edit:
        scale = 1 + self.some()
        moved = Vt.Vec3fArray([point * scale for point in self.points])
        return partial(self.mesh.GetPointsAttr().Set, moved)

    def change_topology(self) -> Edit:
        faces = len(self.mesh.GetFaceVertexCountsAttr().Get())
        hole = Vt.IntArray([self.random.randrange(faces)])
        return partial(self.mesh.GetHoleIndicesAttr().Set, hole)

    def paint(self) -> Edit:
        primvar = self.mesh.GetDisplayColorPrimvar()
        if not primvar or not primvar.HasValue():
            primvar = self.mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.constant)
            primvar.Set([Gf.Vec3f(0.5)])
        scale = 1 - self.some()
        return partial(primvar.Set, Vt.Vec3fArray([color * scale for color in primvar.Get()]))

    def change_light(self) -> Edit:
        return partial(self.light.GetIntensityAttr().Set, self.some())

    def change_setting(self) -> Edit:
        seed = self.random.randrange(10**6)
        return partial(self.engine.SetRendererSetting, "hdcc:seed", seed)


def _own_step(prim: UsdGeom.Xformable) -> UsdGeom.XformOp:
    """An operation that only we use."""
    for operation in prim.GetOrderedXformOps():
        if operation.GetOpName().endswith(":bench"):
            return operation
    return prim.AddTranslateOp(opSuffix="bench")


def measure(words: dict[str, Any]) -> list[dict[str, Any]]:
    """A row for each kind of edit; kinds take turns."""
    edited = EditedStage(words["scene"], words["width"], words["threads"])
    edits = {
        "camera": edited.move_camera,
        "transform": edited.move_mesh,
        "points": edited.move_points,
        "topology": edited.change_topology,
        "colour": edited.paint,
        "light": edited.change_light,
        "setting": edited.change_setting,
    }
    for edit in edits.values():
        edited.time(edit)  # the first of each kind may author attributes
    times: dict[str, list[float]] = {name: [] for name in edits}
    for _ in range(words["count"]):
        for name, edit in edits.items():
            times[name].append(edited.time(edit))
    edited.engine.StopRenderer()
    stats = render_stats.select(edited.engine.GetRenderStats())
    return [
        {
            **stats,
            "scene": words["name"],
            "level": stats["levels"]["max"],
            "threads": words["threads"],
            "tracer": "packet",
            "ratio": 1.0,
            "edit": name,
            "milliseconds": {"median": statistics.median(taken), "worst": max(taken)},
        }
        for name, taken in times.items()
    ]


def main() -> int:
    """Prints the rows as JSON."""
    try:
        print(json.dumps(measure(json.load(sys.stdin))))
    except CommandError as failure:
        error(str(failure))
        return failure.exit_code
    return 0


if __name__ == "__main__":
    exit_code = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(exit_code)
