"""What a scene says about its render: hdCC's own render settings, under Blender's names."""

from typing import Any

import bpy


class CCSettings(bpy.types.PropertyGroup):
    """Settings of a scene, as `scene.hdcc`."""

    samples: bpy.props.IntProperty(
        name="Samples", description="Samples a pixel", default=64, min=1, soft_max=1024
    )
    preview_samples: bpy.props.IntProperty(
        name="Viewport", description="Samples a pixel in viewports", default=4, min=1, soft_max=64
    )
    level: bpy.props.IntProperty(
        name="Finest Level",
        description="Surfaces are cut to 2^level segments along an edge of the cage at most",
        default=6,
        min=0,
        max=8,
    )
    adaptive: bpy.props.BoolProperty(
        name="Adaptive",
        description="Cut surfaces as finely as the camera needs, and no finer",
        default=True,
    )
    pixel_error: bpy.props.FloatProperty(
        name="Pixel Error",
        description="How far surfaces may be from where they belong, in pixels",
        default=0.25,
        min=0.001,
        max=1000.0,
        soft_max=4.0,
    )
    seed: bpy.props.IntProperty(name="Seed", description="Another seed is other noise", default=0)


def as_render_settings(scene: bpy.types.Scene, is_viewport: bool) -> dict[str, Any]:
    """The settings under hdCC's names (docs/hydra.md)."""
    chosen = scene.hdcc
    return {
        "hdcc:samples": chosen.preview_samples if is_viewport else chosen.samples,
        "hdcc:level": chosen.level,
        "hdcc:adaptive": chosen.adaptive,
        "hdcc:pixelError": chosen.pixel_error,
        "hdcc:seed": chosen.seed,
    }


def register() -> None:
    """Gives every scene the settings."""
    bpy.utils.register_class(CCSettings)
    bpy.types.Scene.hdcc = bpy.props.PointerProperty(type=CCSettings)


def unregister() -> None:
    """Takes them away."""
    del bpy.types.Scene.hdcc
    bpy.utils.unregister_class(CCSettings)
