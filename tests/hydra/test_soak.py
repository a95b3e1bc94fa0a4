"""Edits of every kind, at any moment of a frame, from a seed.

    HDCC_SOAK_EDITS=20000 HDCC_SOAK_SEED=7 tools/test --only hydra

makes more of them, and others. A failure names the seed.
"""

import ctypes
import gc
import os
import random
import re
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from hydra_kit import (
    ALL_AOVS,
    Picture,
    View,
    add_cube,
    add_distant_light,
    add_grid,
    assert_same,
    make_stage,
)
from interactive_kit import converge, draw
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel
from skel_kit import skin

EDITS = int(os.environ.get("HDCC_SOAK_EDITS", "400"))
SEED = int(os.environ.get("HDCC_SOAK_SEED", "1"))
AOVS = tuple(name for name in ALL_AOVS if name != "primId")  # which depend on the order of prims
MOST_MESHES = 8
#: Vectors keep some room after an edit.
MOST_MEMORY = 1.5
SPARE_BYTES = 10_000
#: Of what OpenUSD keeps, in the main, such as paths and tokens.
MOST_GROWTH = 4 * 2**20


class Soak:
    """A view, and all that may happen to it."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        stage = make_stage(light=False)
        add_distant_light(stage, shadows=True).AddRotateXYZOp().Set(Gf.Vec3f(30, 20, 0))
        self.view = View(stage, interactive=True, samples=3)
        self.view.params.frame = Usd.TimeCode(0)
        self.size = (32, 32)
        self.settings: dict[str, object] = {}
        self.names = 0
        self.meshes: list[Sdf.Path] = []
        self.edits: tuple[Callable[[], None], ...] = (
            self.add,
            self.remove,
            self.move,
            self.move_points,
            self.retopologize,
            self.hide,
            self.paint,
            self.reparent,
            self.instance,
            self.instance_natively,
            self.divide,
            self.animate,
            self.scatter,
            self.skin,
            self.scrub,
            self.light,
            self.camera,
            self.set,
            self.resize,
            self.aov,
            self.pause,
            self.stop,
        )

    def offset(self) -> Gf.Vec3d:
        return Gf.Vec3d(*(self.random.uniform(-1.5, 1.5) for _ in range(3)))

    def any_mesh(self) -> UsdGeom.Mesh:
        if not self.meshes:
            self.add()
        return UsdGeom.Mesh.Get(self.view.stage, self.random.choice(self.meshes))

    def add(self) -> None:
        if len(self.meshes) >= MOST_MESHES:
            self.remove()
        self.names += 1
        path = f"/Mesh{self.names}"
        if self.random.random() < 0.5:
            mesh = add_cube(self.view.stage, path, half=0.6)
        else:
            mesh = add_grid(self.view.stage, path, size=self.random.randint(1, 9), bump=0.4)
        mesh.AddTranslateOp().Set(self.offset())
        self.meshes.append(mesh.GetPath())

    def remove(self) -> None:
        path = self.any_mesh().GetPath()
        self.meshes.remove(path)
        self.view.stage.RemovePrim(path)

    def move(self) -> None:
        self.any_mesh().GetPrim().GetAttribute("xformOp:translate").Set(self.offset())

    def move_points(self) -> None:
        points = self.any_mesh().GetPointsAttr()
        scale = self.random.uniform(0.8, 1.2)
        points.Set([point * scale for point in points.Get(0)])

    def retopologize(self) -> None:
        mesh = self.any_mesh()
        if self.random.random() < 0.5:
            mesh.GetHoleIndicesAttr().Set([self.random.randint(0, 5)])
        else:
            scheme = self.random.choice(("catmullClark", "bilinear", "none"))
            mesh.GetSubdivisionSchemeAttr().Set(scheme)

    def hide(self) -> None:
        token = self.random.choice(("invisible", "inherited"))
        self.any_mesh().GetVisibilityAttr().Set(token)

    def paint(self) -> None:
        color = Gf.Vec3f(*(self.random.random() for _ in range(3)))
        self.any_mesh().GetDisplayColorAttr().Set([color])

    def reparent(self) -> None:
        path, layer = self.any_mesh().GetPath(), self.view.stage.GetRootLayer()
        self.names += 1
        parent = UsdGeom.Xform.Define(self.view.stage, f"/Group{self.names}")
        parent.AddTranslateOp().Set(0.3 * self.offset())
        moved = parent.GetPath().AppendChild(path.name)
        Sdf.CopySpec(layer, path, layer, moved)
        self.meshes[self.meshes.index(path)] = moved
        self.view.stage.RemovePrim(path)
        if path.GetParentPath() != Sdf.Path.absoluteRootPath:
            self.view.stage.RemovePrim(path.GetParentPath())

    def instance(self) -> None:
        if self.random.random() < 0.2:
            self.view.stage.RemovePrim("/Instancer")
            return
        instancer = UsdGeom.PointInstancer.Define(self.view.stage, "/Instancer")
        if not self.view.stage.GetPrimAtPath("/Instancer/Cube"):
            add_cube(self.view.stage, "/Instancer/Cube", half=0.2)
            add_grid(self.view.stage, "/Instancer/Grid", size=2, half=0.3)
        prototypes = ["/Instancer/Cube", "/Instancer/Grid"]
        instancer.CreatePrototypesRel().SetTargets(prototypes)
        count = self.random.randint(0, 5)
        instancer.CreatePositionsAttr().Set([Gf.Vec3f(self.offset()) for _ in range(count)])
        indices = [self.random.randint(0, 1) for _ in range(count)]
        instancer.CreateProtoIndicesAttr().Set(indices)

    def instance_natively(self) -> None:
        stage = self.view.stage
        if not stage.GetPrimAtPath("/Class"):
            stage.CreateClassPrim("/Class")
            add_cube(stage, "/Class/Cube", half=0.3)
        path = f"/Native{self.random.randint(0, 2)}"
        if stage.GetPrimAtPath(path) and self.random.random() < 0.3:
            stage.RemovePrim(path)
            return
        prim = UsdGeom.Xform.Define(stage, path)
        operations = prim.GetOrderedXformOps()
        (operations[0] if operations else prim.AddTranslateOp()).Set(self.offset())
        prim.GetPrim().GetReferences().SetReferences([Sdf.Reference("", "/Class")])
        prim.GetPrim().SetInstanceable(self.random.random() < 0.7)

    def divide(self) -> None:
        """Into subsets of faces."""
        path = self.any_mesh().GetPath().AppendChild("part")
        if self.view.stage.RemovePrim(path) and self.random.random() < 0.5:
            return
        subset = UsdGeom.Subset.Define(self.view.stage, path)
        subset.CreateElementTypeAttr("face")
        subset.CreateFamilyNameAttr("materialBind")
        subset.CreateIndicesAttr([self.random.randint(0, 9) for _ in range(3)])

    def animate(self) -> None:
        """By samples about the frame, which a shutter may be open for."""
        close = self.view.stage.GetPrimAtPath("/Camera").GetAttribute("shutter:close")
        close.Set(self.random.choice((0.0, 0.0, 0.5, 1.0)))
        mesh = self.any_mesh()
        attribute = self.random.choice(
            (mesh.GetPointsAttr(), mesh.GetPrim().GetAttribute("xformOp:translate"))
        )
        rest = attribute.Get(0)
        if self.random.random() < 0.4:
            attribute.Clear()
            attribute.Set(rest)
            return
        offset = 0.3 * self.offset()
        for time_code in (0, 0.5, 1):
            is_point = isinstance(rest, Gf.Vec3d)
            moved = time_code * offset
            pose = rest + moved if is_point else [point + Gf.Vec3f(moved) for point in rest]
            attribute.Set(pose, time_code)

    def scatter(self) -> None:
        """Spheres."""
        if self.random.random() < 0.3:
            self.view.stage.RemovePrim("/Points")
            return
        points = UsdGeom.Points.Define(self.view.stage, "/Points")
        count = self.random.randint(0, 4)
        attribute = points.CreatePointsAttr()
        attribute.Clear()
        for time_code in self.random.choice(([Usd.TimeCode.Default()], [0, 0.5, 1])):
            attribute.Set([Gf.Vec3f(self.offset()) for _ in range(count)], time_code)
        points.CreateWidthsAttr().Set([self.random.uniform(0, 0.6) for _ in range(count)])

    def skin(self) -> None:
        """Adds a mesh whose joint and blend shape move. OpenUSD misses edits of those."""
        stage = self.view.stage
        if stage.GetPrimAtPath("/Root"):
            return
        UsdSkel.Root.Define(stage, "/Root")
        animation = skin(stage, add_cube(stage, "/Root/Cube", half=0.3))
        for time_code in (0, 0.5, 1):
            animation.GetTranslationsAttr().Set([Gf.Vec3f(self.offset())], time_code)
            weight = self.random.uniform(-0.5, 0.5)
            animation.GetBlendShapeWeightsAttr().Set([weight], time_code)

    def scrub(self) -> None:
        self.view.params.frame = Usd.TimeCode(self.random.choice((0, 0, 0.3, 1)))

    def light(self) -> None:
        light = self.view.stage.GetPrimAtPath("/Light")
        if light:
            light.GetAttribute("inputs:intensity").Set(self.random.uniform(0.2, 2))
        if self.random.random() < 0.2:
            path = "/Second"
            if not self.view.stage.RemovePrim(path):
                add_distant_light(self.view.stage, path, intensity=0.5)

    def camera(self) -> None:
        offset = Gf.Vec3d(self.random.uniform(-1, 1), 0, 5)
        self.view.stage.GetPrimAtPath("/Camera").GetAttribute("xformOp:translate").Set(offset)

    def set(self) -> None:
        name, values = self.random.choice(
            (
                ("level", (1, 3, 4)),
                ("samples", (1, 3, 1000)),
                ("seed", (0, 5)),
                ("threads", (0, 1, 3)),
                ("tracer", ("packet", "packet", "single", "algorithm1", "tessellated")),
                ("adaptive", (True, False)),
            )
        )
        self.settings[name] = self.random.choice(values)
        self.view.set(name, self.settings[name])

    def resize(self) -> None:
        self.size = (self.random.randint(1, 80), self.random.randint(1, 80))
        self.view.set_size(*self.size)

    def aov(self) -> None:
        name = self.random.choice(("color", "depth", "normal", "primId", "primvars:displayColor"))
        self.view.engine.SetRendererAov(name)

    def pause(self) -> None:
        self.view.engine.PauseRenderer()
        self.breathe()
        self.view.engine.ResumeRenderer()

    def stop(self) -> None:
        self.view.engine.StopRenderer()
        self.breathe()
        if self.random.random() < 0.5:
            self.view.engine.RestartRenderer()

    def breathe(self) -> None:
        """Leaves the frame some time, and looks at it or not."""
        if self.random.random() < 0.3:
            time.sleep(self.random.uniform(0, 0.01))
        for _ in range(self.random.choice((0, 1, 1, 3))):
            draw(self.view)

    def step(self) -> None:
        for _ in range(self.random.choice((1, 1, 1, 2, 5))):
            self.random.choice(self.edits)()
        self.breathe()

    def check(self) -> None:
        """The picture, and what the core was handed for it, are those of an engine that sees the
        stage for the first time, and so is the memory."""
        self.settings["samples"] = 3
        self.view.set("samples", 3)
        self.view.engine.SetRendererAov("color")
        self.view.engine.RestartRenderer()
        fresh_view = View(self.view.stage, size=self.size, **self.settings)
        fresh_view.params.frame = self.view.params.frame
        with tempfile.TemporaryDirectory() as folder:
            picture, text = dump(self.view, lambda: converge(self.view), Path(folder))
            fresh, fresh_text = dump(fresh_view, fresh_view.render, Path(folder))
        assert shown(text) == shown(fresh_text)
        assert_same(picture, fresh, AOVS)
        assert ((picture["primId"] >= 0) == (fresh["primId"] >= 0)).all()
        assert memory(self.view) < memory(fresh_view) * MOST_MEMORY + SPARE_BYTES


def dump(view: View, render: Callable[[], Picture], folder: Path) -> tuple[Picture, str]:
    """A picture, and the scene that it shows as text."""
    path = folder / "dump.txt"
    view.set("dump", str(path))
    picture = render()
    view.set("dump", "")
    return picture, path.read_text()


def shown(dumped: str) -> list[str]:
    """What is shown of a scene. OpenUSD names prototypes after an instance that it saw first."""
    blocks = re.split(r"\n(?! )", dumped)
    return sorted(
        re.sub(r"</Native\d/", "</Native/", block)
        for block in blocks
        if "\n    shown false" not in block
    )


def memory(view: View) -> int:
    """Bytes of structures."""
    return int(view.engine.GetRenderStats()["totalMemory"])


@pytest.mark.parametrize("part", range(4))
def test_edits_in_mid_frame(part: int) -> None:
    seed = 4 * SEED + part
    print("seed", seed)
    soak = Soak(seed)
    for i in range(EDITS // 4):
        soak.step()
        if i % 25 == 24:
            soak.check()
    soak.check()


class AllocatedMemory(ctypes.Structure):
    """What mallinfo2 of the C library tells."""

    _fields_ = [
        (name, ctypes.c_size_t)
        for name in (
            "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
            "fordblks", "keepcost",
        )
    ]  # fmt: skip


def allocated_bytes() -> int:
    """Memory that the process has allocated and not freed, in all threads."""
    ask = ctypes.CDLL("libc.so.6").mallinfo2
    ask.restype = AllocatedMemory
    told = ask()
    return int(told.uordblks + told.hblkhd)


def test_memory_comes_back() -> None:
    """Of a stage that was edited at length and emptied, the next one needs no more."""
    after = []
    for _ in range(4):
        soak = Soak(4 * SEED)
        for _ in range(EDITS // 8):
            soak.step()
        for path in soak.meshes:
            soak.view.stage.RemovePrim(path)
        soak.check()
        del soak
        gc.collect()
        after.append(allocated_bytes())
    assert after[-1] < after[1] + MOST_GROWTH, after
