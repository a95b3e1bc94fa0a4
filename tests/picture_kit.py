"""Reads pictures as arrays: one for each layer."""

from pathlib import Path

import numpy as np
import OpenImageIO as oiio


def layers(picture: Path) -> dict[str, np.ndarray]:
    """Layers by name, rows from the top down; "color" for plain R, G, B, A."""
    image = oiio.ImageInput.open(str(picture))
    assert image, oiio.geterror()
    spec = image.spec()
    pixels = np.asarray(image.read_image(0, 0, 0, spec.nchannels, oiio.FLOAT))
    pixels = pixels.reshape(spec.height, spec.width, spec.nchannels)
    image.close()
    found: dict[str, list[int]] = {}
    for index, channel in enumerate(spec.channelnames):
        layer, dot, _ = channel.rpartition(".")
        found.setdefault(layer if dot else "color", []).append(index)
    return {name: pixels[:, :, indices] for name, indices in found.items()}
