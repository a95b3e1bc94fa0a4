"""Render buffers of every format."""

import ctypes
import os
from pathlib import Path

from pxr import UsdImagingGL


def test_every_format_holds_what_it_is_given() -> None:
    UsdImagingGL.Engine.GetRendererPlugins()  # loads OpenUSD
    library = Path(os.environ["PXR_PLUGINPATH_NAME"]).parents[2] / "tests/hdCCBufferFormats.so"
    check = ctypes.CDLL(str(library)).HdCCCheckBufferFormats
    check.restype = ctypes.c_char_p
    assert check() is None
