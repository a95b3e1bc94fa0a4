"""Copies of the declarations, changed for one purpose or another, and a compiler to read them."""

import re
import shutil
import subprocess
from pathlib import Path

from _lib import sdk as sdk_module

DECLARATIONS = sdk_module.INPUTS / "include"
HERE = Path(__file__).parent

_API = re.compile(r"\b(?:HD|HF|PXOSD|CAMERAUTIL)_API\s+([^;{}]+);")
_ENUM = re.compile(r"\benum\s+(\w+)[^{;]*\{([^}]*)\}")
_COMMENT = re.compile(r"//[^\n]*")


class Headers:
    """A copy of the declarations in a folder of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        shutil.copytree(DECLARATIONS, folder)

    def plant(self, file: str, old: str, new: str) -> None:
        """Puts a mistake into a header, which must have the text exactly once."""
        path = self.folder / "pxr" / "imaging" / file
        text = path.read_text()
        assert text.count(old) == 1, f"{file} has {text.count(old)} times: {old}"
        path.write_text(text.replace(old, new))

    def without_purity(self, folder: Path) -> Path:
        """A copy in which no function is pure, so that virtual tables name all functions."""
        return self._changed(folder, lambda text: text.replace(") = 0;", ");").replace(
            ") const = 0;", ") const;"))  # fmt: skip

    def with_bodies(self, folder: Path) -> Path:
        """A copy in which imported functions have bodies, so that a compiler emits their names.

        They are protected symbols then, and nothing else is.
        Constructors are left out, since their bodies would need those of bases and members, and
        virtual functions too, for which there are the virtual tables.
        """
        return self._changed(folder, lambda text: _API.sub(_give_body, _COMMENT.sub("", text)))

    def enumerators(self) -> dict[str, list[str]]:
        """The names in each enum at namespace scope."""
        found = {}
        for path in sorted((self.folder / "pxr" / "imaging").rglob("*.h")):
            for name, body in _ENUM.findall(_COMMENT.sub("", path.read_text())):
                found[name] = re.findall(r"\b(Hd\w+|CameraUtil\w+)\b", body)
        return found

    def _changed(self, folder: Path, change) -> Path:
        shutil.copytree(self.folder, folder)
        for path in (folder / "pxr" / "imaging").rglob("*.h"):
            path.write_text(change(path.read_text()))
        return folder


def _give_body(declaration: re.Match[str]) -> str:
    """An imported function's declaration with a body, if it is one of those that get one."""
    text = declaration[1]
    before_parameters = text.partition("(")[0].split()
    is_constructor = len(before_parameters) == 1 or before_parameters == ["explicit", "~"]
    if "virtual" in before_parameters or text.endswith("override") or is_constructor:
        return declaration[0]
    return f'__attribute__((visibility("protected"))) {text} {{ __builtin_unreachable(); }}'


def compile_library(
    sdk: sdk_module.Sdk, source: Path, include: Path, output: Path, *options: str
) -> None:
    """Compiles a source file into a shared library, with the given declarations first."""
    flags = ["-std=c++17", "-fPIC", "-shared", "-w", "-O0", "-fno-lto"]
    flags += [f"-DMFB_{name}=abi" for name in ("PACKAGE_NAME", "ALT_PACKAGE_NAME")]
    flags += ["-DMFB_PACKAGE_MODULE=Abi", f"-I{include}", f"-isystem{sdk.include}"]
    subprocess.run(["g++", *flags, str(source), "-o", str(output), *options], check=True)
