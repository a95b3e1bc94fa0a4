"""The options of tools/view. They travel to the process with the window as JSON."""

import argparse
import os
import re
from dataclasses import asdict, dataclass, field

from .console import CommandError, OneLineParser
from .record_options import MAX_IMAGE_SIZE, check_aov, setting_pair

_DEFAULT_SIZE = (960, 540)


@dataclass
class ViewOptions:
    """What the command line asks for."""

    scene: str
    camera: str | None
    aov: str
    frame: float | None
    size: tuple[int, int]
    camera_light: bool
    settings: list[tuple[str, str]]
    screenshot: str | None
    session_layer: str | None = None
    mask: list[str] = field(default_factory=list)

    def as_dict(self) -> dict[str, object]:
        """All of it, for JSON."""
        return asdict(self)


def parse(arguments: list[str]) -> ViewOptions:
    """Reads the command line; raises CommandError if it makes no sense."""
    parsed = _make_parser().parse_args(arguments)
    check_aov(parsed.aov)
    if not os.path.isfile(parsed.scene):
        raise CommandError(f"'{parsed.scene}': no such file")
    if parsed.screenshot and not os.path.isdir(os.path.dirname(parsed.screenshot) or "."):
        raise CommandError(f"{parsed.screenshot}: there is no such folder")
    return ViewOptions(**vars(parsed))


def _make_parser() -> OneLineParser:
    parser = OneLineParser(
        prog="tools/view",
        description="Shows a USD scene in a window, rendered with hdCC.",
        epilog="See docs/viewer.md for the mouse and the menus.",
    )
    add = parser.add_argument
    add("scene", metavar="SCENE", help="a USD file")
    add("--camera", metavar="PATH", help="a camera of the scene; else its first, or one of ours")
    add("--aov", metavar="NAME", default="color", help="what to show first")
    add("--frame", metavar="FRAME", type=float, help="time code to begin with")
    add(
        "--size",
        metavar="WxH",
        type=_size,
        default=_DEFAULT_SIZE,
        help="of the picture, in pixels (default: {}x{})".format(*_DEFAULT_SIZE),
    )
    add(
        "--disableCameraLight",
        dest="camera_light",
        action="store_false",
        help="no light at the camera",
    )
    add(
        "--set",
        metavar="KEY=VALUE",
        dest="settings",
        type=setting_pair,
        action="append",
        default=[],
        help="a render setting; may be repeated",
    )
    add("--screenshot", metavar="FILE", help="write a picture of the window once converged, end")
    return parser


def _size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    size = (int(found[1]), int(found[2])) if found else (0, 0)
    if not all(1 <= pixels <= MAX_IMAGE_SIZE for pixels in size):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form WIDTHxHEIGHT")
    return size
