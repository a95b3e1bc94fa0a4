"""Names of pictures: formats by extension, frame numbers, files that appear only when whole."""

import os
import re
import shutil
import tempfile
from pathlib import Path

from .console import CommandError

LAYERED_FORMATS = (".exr",)
DISPLAY_FORMATS = (".png", ".jpg", ".jpeg", ".tif", ".tiff")

_PLACEHOLDER = re.compile(r"^[^#]*?(#+(?:\.#+)?)[^#]*$")


def is_layered(picture: str) -> bool:
    """True if the format keeps linear floats and any number of AOVs."""
    return Path(picture).suffix.lower() in LAYERED_FORMATS


def check_format(picture: str) -> None:
    """Refuses a picture whose extension names no format that we write."""
    suffix = Path(picture).suffix.lower()
    if suffix not in LAYERED_FORMATS + DISPLAY_FORMATS:
        known = " ".join(LAYERED_FORMATS + DISPLAY_FORMATS)
        raise CommandError(f"{picture}: unknown picture format (known: {known})", 2)


def check_folder(file: str) -> None:
    """Refuses a file that could not be created for want of its folder or of rights."""
    folder = os.path.dirname(file) or "."
    if not os.path.isdir(folder):
        raise CommandError(f"{file}: there is no folder {folder}")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise CommandError(f"{file}: the folder {folder} cannot be written to")
    if os.path.isdir(file):
        raise CommandError(f"{file}: is a folder")
    try:
        os.lstat(file)
    except FileNotFoundError:
        pass
    except OSError as failure:
        raise _cannot_write(file, failure) from failure


def _cannot_write(file: str, failure: OSError) -> CommandError:
    return CommandError(f"{file}: cannot be written: {failure.strerror}")


def frame_placeholder(name: str) -> str | None:
    """The one placeholder ### or ###.### of a file name; None if there is none."""
    match = _PLACEHOLDER.match(Path(name).name)
    if "#" in name and (not match or "#" in str(Path(name).parent)):
        raise CommandError(f"{name}: only the name may hold a placeholder, one ### or ###.###", 2)
    return match.group(1) if match else None


def name_of_frame(name: str, frame: float) -> str:
    """Puts the frame number where the placeholder is; a name without one stays."""
    placeholder = frame_placeholder(name)
    if placeholder is None:
        return name
    digits = len(placeholder.partition(".")[2])
    return name.replace(placeholder, f"{frame:0{len(placeholder)}.{digits}f}")


class Workshop:
    """A folder beside a file in which it is made, so that a rename can publish it whole.

    The folder goes away with whatever is left in it when the with block ends, also after a crash
    of the process that wrote into it.
    """

    def __init__(self, file: str) -> None:
        folder = Path(file).resolve().parent
        try:
            self.path = Path(tempfile.mkdtemp(prefix=".hdcc-", dir=folder))
        except OSError as failure:
            raise _cannot_write(file, failure) from failure

    def __enter__(self) -> "Workshop":
        return self

    def __exit__(self, *_: object) -> None:
        shutil.rmtree(self.path, ignore_errors=True)


def publish(made: Path, file: str) -> None:
    """Gives a finished file its name, in one step."""
    try:
        os.replace(made, file)
    except OSError as failure:
        raise _cannot_write(file, failure) from failure
