"""Makes the figures of levels: docs/levels.jpg, the hero scene, and docs/levels-city.jpg, the city.

.sdk/venv/bin/python docs/levels.py
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from _lib import bench_measure, bench_scenes  # noqa: E402

#: Of the levels from 0 up, linear.
COLORS = [
    (0.2, 0.2, 0.25), (0.1, 0.1, 0.6), (0.1, 0.5, 0.9), (0.1, 0.7, 0.2), (0.8, 0.8, 0.1),
    (0.9, 0.4, 0.1), (0.8, 0, 0), (1, 0, 1), (1, 1, 1),
]  # fmt: skip
FAN = (0, 1, 1)
#: The paper's, of the coarse, medium and fine level of the city.
CITY_FINEST = 4
CITY_COLORS = {2: (0.1, 0.2, 0.9), 3: (0.1, 0.6, 0.1), 4: (0.8, 0.1, 0.1)}
CITY_SIZE = 640


def record(picture: Path) -> None:
    """Renders the AOVs that the figure is made of."""
    aovs = [word for name in ("hdcc:level", "hdcc:fan", "normal") for word in ("--aov", name)]
    record = [str(ROOT / "tools" / "record"), str(ROOT / "usd_scenes" / "hero.usda"), str(picture)]
    subprocess.run([*record, *aovs, "--set", "hdcc:samples=1", "--quiet"], check=True)


def coloured(
    colors: np.ndarray, level: np.ndarray, fan: np.ndarray, facing: np.ndarray
) -> np.ndarray:
    """Colours by level, darker where the surface turns away; fans and nothing as they are."""
    shade = (0.4 + 0.6 * facing) * (level >= 0)
    return np.where(fan[..., None], FAN, colors[np.clip(level, 0, None)] * shade[..., None])


def hero(picture: Path) -> np.ndarray:
    """The hero by its levels."""
    image = oiio.ImageInput.open(str(picture))
    names = image.spec().channelnames
    pixels = image.read_image("float")
    image.close()
    level = pixels[..., names.index("hdcc:level.X")].astype(int)
    fan = pixels[..., names.index("hdcc:fan.X")] > 0
    return coloured(np.array(COLORS), level, fan, np.abs(pixels[..., names.index("normal.Z")]))


def city(folder: Path) -> np.ndarray:
    """The city by distance, side by side: as its camera sees it, and the same from above."""
    options = argparse.Namespace(scene="city", threads=2)
    (scene,) = bench_scenes.scenes(options, ("city",))
    colors = np.zeros((CITY_FINEST + 1, 3))
    for level, color in CITY_COLORS.items():
        colors[level] = color
    views = []
    with bench_measure.session(scene, options) as session:
        for view in ("camera", "above"):
            file = folder / view
            words = (file, CITY_SIZE, "adaptive-distance", CITY_FINEST, view)
            session.program.ask("draw-levels", *words)
            shown = np.fromfile(file, np.float32).reshape(CITY_SIZE, CITY_SIZE, 3)
            level = shown[..., 0].astype(int)
            views.append(coloured(colors, level, shown[..., 1] > 0, shown[..., 2]))
    return np.concatenate(views, axis=1)


def write(name: str, colors: np.ndarray) -> None:
    """Writes a picture into docs."""
    pixels = (255 * colors).astype(np.uint8)
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, "uint8")
    spec.attribute("Compression", "jpeg:85")
    output = oiio.ImageOutput.create(name)
    output.open(str(ROOT / "docs" / name), spec)
    output.write_image(pixels)
    output.close()


def main() -> None:
    """Writes the figures."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        record(folder / "levels.exr")
        write("levels.jpg", hero(folder / "levels.exr"))
        write("levels-city.jpg", city(folder))


if __name__ == "__main__":
    main()
