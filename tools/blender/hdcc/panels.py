"""Where people set the engine up: panels in the render and the light properties."""

from typing import ClassVar

import bpy

from .engine import CCRenderEngine

#: Blender's own panels that make sense for any engine name the engines that they are for.
_SHARED_WITH = "BLENDER_RENDER"
#: Those of them that are about things that hdCC does not have.
_LEFT_OUT = {"RENDER_PT_simplify", "VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes"}


class _RenderPanel:
    """What panels of the render properties share."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES: ClassVar[set[str]] = {CCRenderEngine.bl_idname}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Shown if hdCC is the scene's engine."""
        return context.engine in cls.COMPAT_ENGINES


class HDCC_PT_sampling(_RenderPanel, bpy.types.Panel):
    """Samples a pixel."""

    bl_label = "Sampling"

    def draw(self, context: bpy.types.Context) -> None:
        """Called by Blender."""
        self.layout.use_property_split = True
        for name in ("samples", "preview_samples", "seed"):
            self.layout.prop(context.scene.hdcc, name)


class HDCC_PT_subdivision(_RenderPanel, bpy.types.Panel):
    """How finely surfaces are cut."""

    bl_label = "Subdivision"

    def draw(self, context: bpy.types.Context) -> None:
        """Called by Blender."""
        settings = context.scene.hdcc
        self.layout.use_property_split = True
        self.layout.prop(settings, "level")
        self.layout.prop(settings, "adaptive")
        row = self.layout.row()
        row.enabled = settings.adaptive
        row.prop(settings, "pixel_error")


_PANELS = (HDCC_PT_sampling, HDCC_PT_subdivision)


def _shared_panels() -> list[type]:
    return [
        panel
        for panel in bpy.types.Panel.__subclasses__()
        if _SHARED_WITH in getattr(panel, "COMPAT_ENGINES", ()) and panel.__name__ not in _LEFT_OUT
    ]


def register() -> None:
    """Shows the panels, and Blender's own ones that fit."""
    for panel in _PANELS:
        bpy.utils.register_class(panel)
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.add(CCRenderEngine.bl_idname)


def unregister() -> None:
    """Takes them away."""
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.discard(CCRenderEngine.bl_idname)
    for panel in reversed(_PANELS):
        bpy.utils.unregister_class(panel)
