"""The render engine: Blender's own Hydra engine with hdCC behind it."""

from pathlib import Path
from typing import Any

import bpy

from .settings import as_render_settings

#: Where OpenUSD finds the plugin: a part of the add-on as it is packaged.
PLUGIN = Path(__file__).parent / "plugin" / "hdCC" / "resources"


class CCRenderEngine(bpy.types.HydraRenderEngine):
    """Hands the scene to hdCC, for pictures and for viewports."""

    bl_idname = "HDCC"
    bl_label = "hdCC"
    bl_info = "Ray traces subdivision surfaces as they are"
    bl_use_preview = True
    bl_use_gpu_context = False
    bl_delegate_id = "HdCCRendererPlugin"

    def get_render_settings(self, engine_type: str) -> dict[str, Any]:
        """Called by Blender before it renders, with 'VIEWPORT', 'PREVIEW' or 'FINAL'."""
        scene = bpy.context.scene
        settings = as_render_settings(scene, engine_type == "VIEWPORT")
        if engine_type != "VIEWPORT":
            settings["aovToken:Combined"] = "color"
            settings["aovToken:Depth"] = "cameraDepth"
        return settings

    def update_render_passes(
        self, scene: bpy.types.Scene, render_layer: bpy.types.ViewLayer
    ) -> None:
        """Called by Blender to know what a picture consists of."""
        if render_layer.use_pass_combined:
            self.register_pass(scene, render_layer, "Combined", 4, "RGBA", "COLOR")
        if render_layer.use_pass_z:
            self.register_pass(scene, render_layer, "Depth", 1, "Z", "VALUE")


def register() -> None:
    """Shows the engine in the list of engines."""
    from pxr import Plug

    if PLUGIN.is_dir():
        Plug.Registry().RegisterPlugins(str(PLUGIN))
    bpy.utils.register_class(CCRenderEngine)


def unregister() -> None:
    """Takes it from the list."""
    bpy.utils.unregister_class(CCRenderEngine)
