"""Compiles and runs values.cpp: what arrives through the library, as the declarations read it."""

import subprocess
from pathlib import Path

from _lib.sdk import Sdk

from .headers import HERE, Headers, compile_library

# Enums whose enumerators the library can name, so that none has to be trusted.
NAMED_ENUMS = ("HdFormat", "HdType", "HdInterpolation", "CameraUtilConformWindowPolicy")

_RUN = """
import ctypes, sys
from pxr import UsdImagingGL
probe = ctypes.CDLL(sys.argv[1])
probe.abiProblems.restype = ctypes.c_char_p
print(probe.abiProblems().decode(), end="")
"""


def check_values(sdk: Sdk, headers: Headers, work: Path) -> list[str]:
    """Members that inline functions read, and enumerators."""
    write_enumerators(headers, work)
    probe = work / "values.so"
    compile_library(
        sdk, HERE / "values.cpp", headers.folder, probe, f"-I{work}", "-Wl,-z,now",
        f"-L{sdk.prefix / 'lib'}", "-lusd_ms", "-ltbb", f"-Wl,-rpath,{sdk.prefix / 'lib'}",
    )  # fmt: skip
    command = [str(sdk.python), "-c", _RUN, str(probe)]
    finished = subprocess.run(command, capture_output=True, text=True, check=False)
    if finished.returncode != 0:
        last = (finished.stderr.strip().splitlines() or ["the start"])[-1]
        return [f"ended with {finished.returncode} in {last}"]
    return finished.stdout.splitlines()


def write_enumerators(headers: Headers, work: Path) -> None:
    """Writes a line of C++ for each enumerator that has a name at run time."""
    enums = headers.enumerators()
    names = [name for enum in NAMED_ENUMS for name in enums[enum] if not name.endswith("Count")]
    (work / "enumerators.inc").write_text("".join(f"NAMED({name})\n" for name in names))
