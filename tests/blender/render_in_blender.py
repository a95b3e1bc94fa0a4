"""Runs inside Blender's own Python: installs the add-on from a folder and renders with it.

    python render_in_blender.py ADD_ON OUT

Writes OUT/NAME.exr for each picture, and says on standard output what the add-on registered.
"""

import json
import sys
from pathlib import Path

import bpy


def render(out: Path, name: str) -> None:
    scene = bpy.context.scene
    scene.render.filepath = str(out / f"{name}.exr")
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    bpy.ops.render.render(write_still=True)


def add_cage(cube: bpy.types.Object) -> None:
    modifier = cube.modifiers.new("Subdivision", "SUBSURF")
    modifier.render_levels = 4


def main(add_on: Path, out: Path) -> None:
    sys.path.insert(0, str(add_on.parent))
    hdcc = __import__(add_on.name)
    hdcc.register()
    scene = bpy.context.scene
    scene.render.engine = "HDCC"
    scene.render.resolution_x, scene.render.resolution_y = 192, 108
    scene.hdcc.samples = 4
    render(out, "startup")
    cube = bpy.data.objects["Cube"]
    add_cage(cube)
    render(out, "subdivided")
    cube.location.x += 2
    render(out, "moved")
    scene.hdcc.level = 0
    panels = [panel.__name__ for panel in bpy.types.Panel.__subclasses__()]
    settings = hdcc.engine.as_render_settings(scene, is_viewport=False)
    hdcc.unregister()
    print(json.dumps({"panels": panels, "settings": settings, "engine": scene.render.engine}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
