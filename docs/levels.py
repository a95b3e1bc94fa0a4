"""Makes docs/levels.jpg: the hero scene by its levels, fans in cyan.

.sdk/venv/bin/python docs/levels.py
"""

import subprocess
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

ROOT = Path(__file__).resolve().parents[1]
#: Of the levels from 0 up, linear.
COLORS = [
    (0.2, 0.2, 0.25), (0.1, 0.1, 0.6), (0.1, 0.5, 0.9), (0.1, 0.7, 0.2), (0.8, 0.8, 0.1),
    (0.9, 0.4, 0.1), (0.8, 0, 0), (1, 0, 1), (1, 1, 1),
]  # fmt: skip
FAN = (0, 1, 1)


def record(picture: Path) -> None:
    """Renders the AOVs that the figure is made of."""
    aovs = [word for name in ("hdcc:level", "hdcc:fan", "normal") for word in ("--aov", name)]
    record = [str(ROOT / "tools" / "record"), str(ROOT / "usd_scenes" / "hero.usda"), str(picture)]
    subprocess.run([*record, *aovs, "--set", "hdcc:samples=1", "--quiet"], check=True)


def figure(picture: Path) -> np.ndarray:
    """Colours by level, shaded by the normal."""
    image = oiio.ImageInput.open(str(picture))
    names = image.spec().channelnames
    pixels = image.read_image("float")
    image.close()
    level = pixels[..., names.index("hdcc:level.X")].astype(int)
    fan = pixels[..., names.index("hdcc:fan.X")] > 0
    shade = 0.4 + 0.6 * np.abs(pixels[..., [names.index("normal.Z")]])
    colors = np.array(COLORS)[np.clip(level, 0, None)] * shade * (level >= 0)[..., None]
    return np.where(fan[..., None], FAN, colors)


def main() -> None:
    """Writes the figure."""
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "levels.exr"
        record(picture)
        pixels = (255 * figure(picture)).astype(np.uint8)
    path = str(ROOT / "docs" / "levels.jpg")
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, "uint8")
    spec.attribute("Compression", "jpeg:85")
    output = oiio.ImageOutput.create(path)
    output.open(path, spec)
    output.write_image(pixels)
    output.close()


if __name__ == "__main__":
    main()
