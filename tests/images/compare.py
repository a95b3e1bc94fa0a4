"""When two pictures count as the same."""

import numpy as np

#: Layers whose values are names: every pixel must be the same.
EXACT = ("primId", "instanceId", "elementId")
#: Colour may differ by this much anywhere; by more only in this share of pixels.
COLOR_STEP, COLOR_SHARE, COLOR_MEAN = 0.01, 0.0005, 0.0005
#: Depths may differ by this share of themselves; again but for a few pixels.
DEPTH_STEP = 1e-3

Layers = dict[str, np.ndarray]


def differences(made: Layers, expected: Layers) -> list[str]:
    """What tells two pictures apart, a line each; empty if they count as the same."""
    if sorted(made) != sorted(expected):
        return [f"layers are {sorted(made)}, not {sorted(expected)}"]
    found = []
    for name, pixels in expected.items():
        if made[name].shape != pixels.shape:
            found.append(f"{name}: {made[name].shape} in place of {pixels.shape}")
        elif name in EXACT:
            found += _exact(name, made[name], pixels)
        elif name in ("depth", "cameraDepth"):
            found += _close(name, made[name], pixels, DEPTH_STEP * np.maximum(1, np.abs(pixels)))
        else:
            found += _close(name, made[name], pixels, COLOR_STEP)
    return found


def _exact(name: str, made: np.ndarray, expected: np.ndarray) -> list[str]:
    wrong = made != expected
    if not wrong.any():
        return []
    row, column = np.argwhere(wrong.any(axis=2))[0]
    return [
        f"{name}: {np.count_nonzero(wrong)} pixels differ, first at column {column}, row {row}: "
        f"{made[row, column, 0]:g} in place of {expected[row, column, 0]:g}"
    ]


def _close(
    name: str, made: np.ndarray, expected: np.ndarray, step: np.ndarray | float
) -> list[str]:
    if not np.isfinite(made).all():
        return [f"{name}: holds values that are not finite"]
    error = np.abs(made - expected)
    wrong = (error > step).any(axis=2)
    found = []
    if wrong.mean() > COLOR_SHARE:
        found.append(
            f"{name}: {np.count_nonzero(wrong)} of {wrong.size} pixels differ, "
            f"by up to {error.max():g}"
        )
    if name == "color" and error.mean() > COLOR_MEAN:
        found.append(f"{name}: differs by {error.mean():g} on average")
    return found
