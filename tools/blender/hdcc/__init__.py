"""hdCC as a render engine of Blender: see docs/blender.md."""

from . import engine, panels, settings


def register() -> None:
    """Called by Blender when the add-on is switched on."""
    settings.register()
    engine.register()
    panels.register()


def unregister() -> None:
    """Called by Blender when the add-on is switched off."""
    panels.unregister()
    engine.unregister()
    settings.unregister()
