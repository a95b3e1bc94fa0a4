"""Render settings from the command line. Those of a UsdRenderSettings prim reach the delegate
through Hydra."""

from typing import Any

from pxr import Tf, UsdImagingGL

from .console import CommandError
from .diagnostics import captured_messages

_WORDS_OF_TRUTH = {"1": True, "true": True, "on": True, "0": False, "false": False, "off": False}


def apply(engine: UsdImagingGL.Engine, settings: list[tuple[str, str]]) -> None:
    """Sets what --set asks for; anything unknown or refused ends the command."""
    known = {setting.key: setting.defValue for setting in engine.GetRendererSettingsList()}
    for key, text in settings:
        if key not in known:
            raise CommandError(
                f"unknown render setting '{key}' (known: {' '.join(sorted(known))})", 2
            )
        refusal = _set(engine, key, _parse(text, known[key]))
        if refusal:
            raise CommandError(refusal, 2)


def _set(engine: UsdImagingGL.Engine, key: str, value: Any) -> str:
    """Sets a value. Returns why the delegate refused it, or an empty string."""
    with captured_messages() as messages:
        try:
            engine.SetRendererSetting(key, value)
        except Tf.ErrorException as failure:
            messages.extend(error.commentary for error in failure.args)
    if messages:
        return "; ".join(messages)
    taken = engine.GetRendererSetting(key)
    is_taken = abs(taken - value) <= 1e-6 * abs(value) if _is_number(value) else taken == value
    return "" if is_taken else f"render setting {key}: the renderer refused '{value}'"


def _parse(text: str, default: Any) -> Any:
    """Reads a value of the default's type; the delegate judges what cannot be read."""
    kind = type(default)
    try:
        if kind is bool:
            return _WORDS_OF_TRUTH[text.lower()]
        if kind in (int, float):
            return kind(text)
    except (KeyError, ValueError):
        return text
    return text


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
