"""The options of tools/record: usdrecord's, under usdrecord's names, and a few of our own.

They are parsed with the standard library alone, so that --help and mistakes are answered before
anything is set up. The result travels to the process that renders as JSON.
"""

import argparse
import os
import re
from dataclasses import asdict, dataclass, field

from . import pictures
from .console import CommandError, OneLineParser

RENDERER = "CC"
RENDERER_PLUGIN = "HdCCRendererPlugin"

COMPLEXITIES = ("low", "medium", "high", "veryhigh")
COLOR_MODES = ("disabled", "sRGB", "openColorIO")
PURPOSES = ("default", "render", "proxy", "guide")
#: cc::NameOf(Aov) in core/render/film.h
AOVS = (
    "color",
    "depth",
    "cameraDepth",
    "primId",
    "instanceId",
    "elementId",
    "normal",
    "Neye",
    "hdcc:material",
    "hdcc:level",
    "hdcc:fan",
    "hdcc:cost",
    "primvars:NAME",
)
MAX_IMAGE_SIZE = 32768

#: Spaces and commas would separate names of AOVs.
_PRIMVAR_AOV = re.compile(r"primvars:[^\s,]+")
_NUMBER = r"-?\d+(?:\.\d*)?"
_FRAME_SPEC = re.compile(rf"{_NUMBER}(?::{_NUMBER}(?:x{_NUMBER})?)?")


@dataclass
class RecordOptions:
    """What the command line asks for."""

    scene: str
    picture: str
    mask: list[str]
    purposes: list[str]
    session_layer: str | None
    camera_light: bool
    dome_light_visible: bool
    camera: str | None
    default_time: bool
    frames: str | None
    complexity: str
    color_mode: str
    renderer: str
    image_width: int | None
    render_settings: str | None
    render_pass: str | None
    aovs: list[str]
    settings: list[tuple[str, str]]
    stats: str | None
    quiet: bool
    #: set by the parent: where pictures are made, and the pipe that progress goes to
    workshop: str = ""
    progress_fd: int = -1
    color_mode_given: bool = field(default=False)
    purposes_given: bool = field(default=False)

    def as_dict(self) -> dict:
        """Plain values, for JSON; RecordOptions(**values) brings them back."""
        return asdict(self)


def parse(arguments: list[str]) -> RecordOptions:
    """Parses and checks the command line as far as that needs no OpenUSD."""
    options = _to_options(_make_parser().parse_args(arguments))
    _check_files(options)
    _check_aovs(options)
    _check_other_renderer(options)
    return options


def _make_parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="tools/record",
        allow_abbrev=False,
        description="Renders pictures of a USD scene through Hydra, on the CPU, with no display.",
        epilog="Options of usdrecord keep their names and meanings. docs/commands.md tells more.",
    )
    parser.add_argument("scene", metavar="SCENE", help="USD file to render")
    parser.add_argument(
        "picture",
        metavar="OUT",
        help="picture to write, .exr .png .jpg or .tif; with --frames it holds one frame "
        "placeholder, ### or ###.###, of any number of hash marks",
    )
    _add_scene_options(parser)
    _add_view_options(parser)
    _add_render_options(parser)
    _add_output_options(parser)
    return parser


def _add_scene_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("scene")
    group.add_argument(
        "--mask",
        metavar="PRIMPATH[,PRIMPATH...]",
        type=_words,
        default=[],
        help="load only these prims, their ancestors and descendants",
    )
    group.add_argument(
        "--sessionLayer", metavar="FILE", help="session layer in place of an empty one"
    )
    group.add_argument(
        "--purposes",
        metavar="PURPOSE[,PURPOSE...]",
        type=_purposes,
        help="purposes shown besides default: render, proxy, guide (default: proxy, or "
        "what the settings prim includes)",
    )
    group.add_argument(
        "--renderSettingsPrimPath",
        "-rs",
        metavar="PRIMPATH",
        help="UsdRenderSettings prim: its hdcc: attributes become settings, its products are "
        "rendered, camera and resolution are taken unless given here (default: the stage's "
        "metadata, without products)",
    )
    group.add_argument(
        "--renderPassPrimPath",
        "-rp",
        metavar="PRIMPATH",
        help="UsdRenderPass prim whose render source is the settings prim",
    )


def _add_view_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("view")
    group.add_argument(
        "--camera",
        "-cam",
        metavar="NAME",
        help="camera, by prim name or path (default: the settings prim's, the one named main_cam, "
        "the first of the stage, or else a view of the whole stage)",
    )
    group.add_argument(
        "--imageWidth",
        "-w",
        metavar="PIXELS",
        type=_width,
        help="width; the camera's aspect ratio gives the height (default: 960)",
    )
    time = group.add_mutually_exclusive_group()
    time.add_argument(
        "--defaultTime",
        "-d",
        action="store_true",
        help="render the default time (default: the stage's start time)",
    )
    time.add_argument(
        "--frames",
        "-f",
        metavar="FRAMESPEC[,FRAMESPEC...]",
        type=_frames,
        help="frames to render: 7, 1:10, 10:1, 1:10x2, 1:2x0.5",
    )


def _add_render_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("rendering")
    group.add_argument(
        "--renderer",
        "-r",
        metavar="NAME",
        default=RENDERER,
        help=f"Hydra renderer, by name or plugin id (default: {RENDERER})",
    )
    group.add_argument(
        "--complexity",
        "-c",
        choices=COMPLEXITIES,
        default=COMPLEXITIES[0],
        help="level of refinement (default: low; CC shows the limit surface at any)",
    )
    group.add_argument(
        "--colorCorrectionMode",
        "-color",
        choices=COLOR_MODES,
        help="colour of 8-bit pictures; EXR stays linear (default: sRGB)",
    )
    group.add_argument(
        "--disableCameraLight", action="store_true", help="add no light at the camera"
    )
    group.add_argument(
        "--enableDomeLightVisibility",
        action="store_true",
        help="show the dome light in the background",
    )
    group.add_argument(
        "--disableGpu",
        action="store_true",
        help="accepted for usdrecord's sake: no GPU is ever used",
    )
    group.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        type=setting_pair,
        default=[],
        help="a render setting, such as hdcc:level=5; may be repeated",
    )


def _add_output_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("output")
    group.add_argument(
        "--aov",
        metavar="NAME",
        action="append",
        default=[],
        help="AOV kept beside color in a multi-layer EXR; may be repeated: " + " ".join(AOVS),
    )
    group.add_argument(
        "--stats",
        metavar="FILE",
        help="write what the frame took as JSON; with --frames it holds a placeholder as OUT does",
    )
    group.add_argument("--quiet", action="store_true", help="print warnings and errors only")


def _to_options(parsed: argparse.Namespace) -> RecordOptions:
    return RecordOptions(
        scene=parsed.scene,
        picture=parsed.picture,
        mask=parsed.mask,
        purposes=parsed.purposes or ["proxy"],
        session_layer=parsed.sessionLayer,
        camera_light=not parsed.disableCameraLight,
        dome_light_visible=parsed.enableDomeLightVisibility,
        camera=parsed.camera,
        default_time=parsed.defaultTime,
        frames=parsed.frames,
        complexity=parsed.complexity,
        color_mode=parsed.colorCorrectionMode or "sRGB",
        renderer=parsed.renderer,
        image_width=parsed.imageWidth,
        render_settings=parsed.renderSettingsPrimPath,
        render_pass=parsed.renderPassPrimPath,
        aovs=[name for name in dict.fromkeys(parsed.aov) if name != "color"],
        settings=parsed.set,
        stats=parsed.stats,
        quiet=parsed.quiet,
        color_mode_given=parsed.colorCorrectionMode is not None,
        purposes_given=parsed.purposes is not None,
    )


def _check_files(options: RecordOptions) -> None:
    layers = [file for file in (options.scene, options.session_layer) if file is not None]
    for layer in layers:
        if not os.path.isfile(layer):
            raise CommandError(f"'{layer}': no such file")
    pictures.check_format(options.picture)
    if options.stats:
        others = {os.path.realpath(file) for file in (*layers, options.picture)}
        if os.path.realpath(options.stats) in others:
            raise CommandError(f"{options.stats}: --stats would write over this file", 2)
    for file in filter(None, (options.picture, options.stats)):
        pictures.check_folder(file)
        placeholder = pictures.frame_placeholder(file)
        if options.frames and not placeholder:
            raise CommandError(f"{file}: --frames needs a placeholder ### in this name", 2)
        if placeholder and not options.frames:
            raise CommandError(f"{file}: a placeholder ### needs --frames", 2)
        if options.frames and _digits(options.frames) > len(placeholder.partition(".")[2]):
            raise CommandError(f"{file}: the placeholder has too few digits for --frames", 2)
    if options.render_settings and options.render_pass:
        raise CommandError("give --renderSettingsPrimPath or --renderPassPrimPath, not both", 2)


def _check_aovs(options: RecordOptions) -> None:
    for name in options.aovs:
        check_aov(name)
    if options.aovs and not pictures.is_layered(options.picture):
        raise CommandError(f"--aov needs an EXR; {options.picture} holds color only", 2)


def check_aov(name: str) -> None:
    """Refuses what is no AOV of hdCC."""
    if name not in AOVS and not _PRIMVAR_AOV.fullmatch(name):
        raise CommandError(f"unknown AOV '{name}' (known: {' '.join(AOVS)})", 2)


def _check_other_renderer(options: RecordOptions) -> None:
    if options.renderer in (RENDERER, RENDERER_PLUGIN):
        return
    if options.aovs or options.settings or options.stats:
        raise CommandError(f"--aov, --set and --stats need the renderer {RENDERER}", 2)


def _digits(frames: str) -> int:
    """Digits after the point that tell the frames apart: those of starts and strides."""
    starts = [spec.split(":")[0] for spec in frames.split(",")]
    strides = [spec.partition("x")[2] for spec in frames.split(",")]
    return max(len(number.partition(".")[2].rstrip("0")) for number in starts + strides)


def _words(text: str) -> list[str]:
    return text.replace(",", " ").split()


def _purposes(text: str) -> list[str]:
    for purpose in _words(text):
        if purpose not in PURPOSES:
            raise argparse.ArgumentTypeError(
                f"unknown purpose '{purpose}' (known: {' '.join(PURPOSES)})"
            )
    return _words(text)


def _width(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= MAX_IMAGE_SIZE:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number from 1 to {MAX_IMAGE_SIZE}")
    return int(text)


def _frames(text: str) -> str:
    if not all(_FRAME_SPEC.fullmatch(spec) for spec in text.split(",")):
        raise argparse.ArgumentTypeError(f"'{text}' is not a frame, a range or a list of them")
    return text


def setting_pair(text: str) -> tuple[str, str]:
    """A render setting and its value, written KEY=VALUE."""
    key, equals, value = text.partition("=")
    if not key or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form KEY=VALUE")
    return key, value
