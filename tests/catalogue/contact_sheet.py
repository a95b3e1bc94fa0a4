#!/usr/bin/env python3.11
"""Makes the contact sheet of the catalogue anew: its scene, and its picture for the docs."""

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from _lib import build  # noqa: E402

SCENE = ROOT / "usd_scenes" / "features" / "catalogue.usda"
PICTURE = ROOT / "docs" / "catalogue.jpg"
#: A pixel a dot of the labels.
WIDTH = 1024
#: What keeps the picture small; tools/record writes larger files, of a better quality.
QUALITY = 60

COMPRESS = """
import sys
import OpenImageIO as oiio
picture = oiio.ImageBuf(sys.argv[1])
colour = oiio.ImageBufAlgo.channels(picture, (0, 1, 2))
colour.specmod().attribute("Compression", sys.argv[3])
if not colour.write(sys.argv[2]):
    sys.exit(colour.geterror())
"""


def main() -> None:
    """Writes both files; a step that fails ends it."""
    programs = build.build_target("cc_catalogue", more_sources=("tests",))
    subprocess.run([programs / "tests" / "catalogue" / "cc_catalogue", SCENE], check=True)
    with tempfile.TemporaryDirectory() as folder:
        rendered = Path(folder) / "catalogue.png"
        record = [ROOT / "tools" / "record", SCENE, rendered, "--imageWidth", str(WIDTH)]
        subprocess.run(record, check=True)
        compress = ["-c", COMPRESS, str(rendered), str(PICTURE), f"jpeg:{QUALITY}"]
        build.usd_runtime().run(*compress).check_returncode()


if __name__ == "__main__":
    main()
