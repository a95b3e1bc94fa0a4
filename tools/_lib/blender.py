"""tools/blender/package: the add-on for Blender, with the plugin in it."""

import shutil
import subprocess
import tempfile
import zipfile
from pathlib import Path

from . import build
from .console import CommandError, OneLineParser, error
from .paths import BUILD, TOOLS

ADD_ON = TOOLS / "blender" / "hdcc"
#: Libraries of the plugin that Blender does not have; it has all others loaded.
_OWN_LIBRARIES = ("libosdCPU.so.", "libhwy.so.")


def main(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = OneLineParser(prog="tools/blender/package", description=__doc__, allow_abbrev=False)
    parser.add_argument(
        "out", nargs="?", type=Path, default=BUILD / "blender" / "hdcc.zip", metavar="OUT"
    )
    try:
        out = parser.parse_args(arguments).out
        package(out)
    except CommandError as failure:
        error(str(failure))
        return failure.exit_code
    print(out)
    return 0


def package(out: Path) -> None:
    """Writes the add-on, with the plugin and its libraries."""
    if out.suffix != ".zip":
        raise CommandError(f"{out} is no .zip file", 2)
    folder = build.build_target("hdCC")
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent) as scratch:
        root = Path(scratch) / ADD_ON.name
        shutil.copytree(ADD_ON, root, ignore=shutil.ignore_patterns("__pycache__"))
        _install_plugin(folder, root)
        made = Path(scratch) / "made.zip"
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
            for file in sorted(root.rglob("*")):
                if file.is_file():
                    archive.write(file, file.relative_to(root))
        made.replace(out)


def _install_plugin(folder: Path, root: Path) -> None:
    prefix = root / "installed"
    command = ["cmake", "--install", str(folder), "--prefix", str(prefix)]
    installed = subprocess.run(command, capture_output=True, text=True, check=False)
    if installed.returncode != 0:
        raise CommandError(f"the plugin could not be installed: {installed.stderr.strip()}")
    (prefix / "plugin" / "usd").rename(root / "plugin")
    shutil.rmtree(prefix)
    for library in _libraries(root / "plugin" / "hdCC.so"):
        shutil.copy2(library, root / "plugin" / library.name)


def _libraries(plugin: Path) -> list[Path]:
    """Where the libraries are that have to come along."""
    listed = subprocess.run(["ldd", str(plugin)], capture_output=True, text=True, check=False)
    found = []
    for line in listed.stdout.splitlines():
        name, _, rest = line.strip().partition(" => ")
        if name.startswith(_OWN_LIBRARIES) and rest:
            found.append(Path(rest.split(" ")[0]))
    return found
