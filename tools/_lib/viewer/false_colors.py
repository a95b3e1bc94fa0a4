"""Planes of AOVs as pictures that people can read."""

import numpy as np

#: Of linear colour, behind what does not cover a pixel.
_BACKGROUND = 0.05
#: Levels 0 to 8, from coarse to fine.
_LEVELS = np.array(
    [
        (59, 76, 192), (98, 130, 234), (141, 176, 254), (184, 208, 249), (221, 221, 221),
        (245, 196, 173), (244, 154, 123), (222, 96, 77), (180, 4, 38),
    ],
    np.uint8,
)  # fmt: skip
_IDS = ("primId", "instanceId", "elementId", "hdcc:material")


def to_rgb(name: str, plane: np.ndarray) -> np.ndarray:
    """A plane, of height x width x components, as bytes of red, green and blue for a screen."""
    if name == "color":
        return _screen(plane[..., :3] + _BACKGROUND * (1 - plane[..., 3:4]))
    if name in ("depth", "cameraDepth"):
        return _depths(plane[..., 0], clear=1.0 if name == "depth" else 0.0)
    if name in _IDS:
        return _ids(plane[..., 0])
    if name in ("normal", "Neye"):
        seen = np.any(plane != 0, axis=-1, keepdims=True)
        return _bytes(np.where(seen, plane / 2 + 0.5, 0))
    if name == "hdcc:level":
        level = plane[..., 0].astype(int)
        return np.where((level >= 0)[..., None], _LEVELS[np.clip(level, 0, 8)], 0).astype(np.uint8)
    if name == "hdcc:fan":
        return _bytes(np.stack([plane[..., 0] == 1, 0.5 * (plane[..., 0] == 1),
                                0.25 * (plane[..., 0] == 0)], axis=-1))  # fmt: skip
    if name == "hdcc:cost":
        return _heat(plane[..., 0])
    return _screen(_three(plane))


def _bytes(values: np.ndarray) -> np.ndarray:
    return (np.clip(np.nan_to_num(values), 0, 1) * 255 + 0.5).astype(np.uint8)


def _screen(linear: np.ndarray) -> np.ndarray:
    """By the transfer curve of sRGB."""
    linear = np.clip(np.nan_to_num(linear), 0, 1)
    return _bytes(
        np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    )


def _three(plane: np.ndarray) -> np.ndarray:
    """Primvars of one number are grey, of two have no blue."""
    if plane.shape[-1] == 1:
        return np.repeat(plane, 3, axis=-1)
    missing = max(3 - plane.shape[-1], 0)
    return np.pad(plane, ((0, 0), (0, 0), (0, missing)))[..., :3]


def _depths(depth: np.ndarray, clear: float) -> np.ndarray:
    """White is near, dark grey is far, black is nothing."""
    seen = depth != clear
    if not seen.any():
        return np.zeros((*depth.shape, 3), np.uint8)
    near, far = depth[seen].min(), depth[seen].max()
    grey = 1 - 0.8 * (depth - near) / max(far - near, 1e-12)
    return _bytes(np.repeat(np.where(seen, grey, 0)[..., None], 3, axis=-1))


def _ids(ids: np.ndarray) -> np.ndarray:
    """Each number has a hue of its own, a golden angle from the one before."""
    ids = ids.astype(np.int64)
    hue = (ids * 0.61803398875) % 1.0
    value = np.where(ids >= 0, 0.95 - 0.15 * (ids % 3), 0)
    offsets = np.array([0, 2 / 3, 1 / 3])
    ramp = np.clip(np.abs(((hue[..., None] + offsets) % 1.0) * 6 - 3) - 1, 0, 1)
    return _bytes(value[..., None] * (0.35 + 0.65 * ramp))


def _heat(cost: np.ndarray) -> np.ndarray:
    """Black, red, yellow, white; white is what one pixel in a hundred costs."""
    share = cost / max(float(np.percentile(cost, 99)), 1e-12)
    return _bytes(np.stack([3 * share, 3 * share - 1, 3 * share - 2], axis=-1))
