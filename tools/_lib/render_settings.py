"""Render settings from the command line. Those of a UsdRenderSettings prim reach the delegate
through Hydra."""

from pxr import Tf, UsdImagingGL

from .console import CommandError
from .diagnostics import captured_messages


def apply(engine: UsdImagingGL.Engine, settings: list[tuple[str, str]]) -> None:
    """Sets what --set asks for; anything unknown or refused ends the command.

    Values stay text: it is the delegate that knows their types and ranges.
    """
    known = {setting.key for setting in engine.GetRendererSettingsList()}
    for key, text in settings:
        if key not in known:
            raise CommandError(
                f"unknown render setting '{key}' (known: {' '.join(sorted(known))})", 2
            )
        refusal = _set(engine, key, text)
        if refusal:
            raise CommandError(refusal, 2)


def _set(engine: UsdImagingGL.Engine, key: str, text: str) -> str:
    """Sets a value. Returns why the delegate refused it, or an empty string."""
    with captured_messages() as messages:
        try:
            engine.SetRendererSetting(key, text)
        except Tf.ErrorException as failure:
            messages.extend(error.commentary for error in failure.args)
    return "; ".join(messages)
