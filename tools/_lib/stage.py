"""Opens the stage of a recording and finds in it what the command line names."""

import math
from dataclasses import dataclass
from itertools import islice

from pxr import CameraUtil, Gf, Sdf, Tf, Usd, UsdAppUtils, UsdGeom, UsdRender, UsdUtils

from .console import CommandError, warning
from .record_options import MAX_IMAGE_SIZE, RecordOptions

#: An hour of film is less.
_MOST_FRAMES = 100_000


def open_stage(options: RecordOptions) -> Usd.Stage:
    """Opens the scene with its session layer, masked if asked to."""
    root = _open_layer(options.scene)
    session = Sdf.Layer.CreateAnonymous()
    if options.session_layer:
        session = _open_layer(options.session_layer)
    if not options.mask:
        return Usd.Stage.Open(root, session)
    mask = Usd.StagePopulationMask()
    for path in options.mask:
        mask.Add(prim_path(path))
    stage = Usd.Stage.OpenMasked(root, session, mask)
    for path in options.mask:
        if not stage.GetPrimAtPath(path):
            warning(f"--mask: there is no prim {path} in {options.scene}")
    return stage


def _open_layer(file: str) -> Sdf.Layer:
    try:
        layer = Sdf.Layer.FindOrOpen(file)
    except Tf.ErrorException as failure:
        reasons = " ".join(error.commentary.strip() for error in failure.args)
        raise CommandError(f"{file}: cannot be read: {' '.join(reasons.split())}") from failure
    if not layer:
        raise CommandError(f"{file}: is not a USD file")
    return layer


def prim_path(text: str) -> Sdf.Path:
    """The path of a prim, which the text must be."""
    if not Sdf.Path.IsValidPathString(text):
        raise CommandError(f"'{text}' is not a prim path")
    return Sdf.Path(text)


def frames_of(options: RecordOptions, stage: Usd.Stage) -> list[Usd.TimeCode]:
    """The frames to render, in order."""
    if options.frames:
        try:
            spec = UsdAppUtils.framesArgs.FrameSpecIterator(options.frames)
            frames = [Usd.TimeCode(frame) for frame in islice(spec, _MOST_FRAMES + 1)]
        except Tf.ErrorException as failure:
            reason = "is not a range of frames"
            raise CommandError(f"--frames {options.frames}: {reason}", 2) from failure
        if not frames:
            raise CommandError(f"--frames {options.frames}: holds no frame", 2)
        if len(frames) > _MOST_FRAMES:
            raise CommandError(f"--frames {options.frames}: holds more than {_MOST_FRAMES}", 2)
        return frames
    if options.default_time:
        return [Usd.TimeCode.Default()]
    return [Usd.TimeCode(stage.GetStartTimeCode())]


def find_settings_prim(options: RecordOptions, stage: Usd.Stage) -> UsdRender.Settings | None:
    """The UsdRenderSettings prim that the options or the stage's metadata name, if any."""
    path = options.render_settings or ""
    if options.render_pass:
        path = _settings_of_pass(stage, options.render_pass)
    from_metadata = not path
    if from_metadata:
        path = stage.GetMetadata("renderSettingsPrimPath") or ""
    if not path:
        return None
    is_path = Sdf.Path.IsValidPathString(path)
    settings = UsdRender.Settings(stage.GetPrimAtPath(path) if is_path else Usd.Prim())
    if settings:
        return settings
    if not from_metadata:
        raise CommandError(f"there is no RenderSettings prim at {path}")
    warning(f"{path}: the stage's renderSettingsPrimPath names no RenderSettings prim")
    return None


def _settings_of_pass(stage: Usd.Stage, path: str) -> str:
    render_pass = UsdRender.Pass(stage.GetPrimAtPath(prim_path(path)))
    if not render_pass:
        raise CommandError(f"there is no RenderPass prim at {path}")
    targets = render_pass.GetRenderSourceRel().GetTargets()
    if not targets:
        raise CommandError(f"{path}: the render pass has no render source")
    return str(targets[0])


def find_camera(
    options: RecordOptions, stage: Usd.Stage, settings: UsdRender.SettingsBase | None
) -> UsdGeom.Camera | None:
    """The camera that the options name, or the settings prim's, or the primary, or the first.

    None means that the stage has no camera.
    """
    if options.camera:
        camera = UsdAppUtils.GetCameraAtPath(stage, prim_path(options.camera))
        if not camera:
            raise CommandError(f"there is no camera '{options.camera}' in {options.scene}")
        return camera
    if settings and (targets := settings.GetCameraRel().GetTargets()):
        camera = UsdGeom.Camera(stage.GetPrimAtPath(targets[0]))
        if camera:
            return camera
        warning(f"{settings.GetPath()}: its camera {targets[0]} is no camera")
    primary = UsdAppUtils.GetCameraAtPath(stage, Sdf.Path(UsdUtils.GetPrimaryCameraName()))
    return primary or _first_camera(stage)


def _first_camera(stage: Usd.Stage) -> UsdGeom.Camera | None:
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdGeom.Camera):
            return UsdGeom.Camera(prim)
    return None


@dataclass(frozen=True)
class Framing:
    """What of the camera's window a picture shows."""

    #: of the whole picture, in pixels, and of the part that is rendered, from the upper left
    size: tuple[int, int]
    data_window: Gf.Rect2i
    pixel_aspect: float = 1.0
    conform: CameraUtil.ConformWindowPolicy = CameraUtil.Fit


@dataclass
class View:
    """What a frame shows: through a camera prim, or a made-up one if path is empty."""

    camera: Gf.Camera
    path: Sdf.Path
    width: int
    height: int
    #: if it is not all of the camera's window, with square pixels
    framing: Framing | None = None


def view_at(
    options: RecordOptions,
    stage: Usd.Stage,
    camera: UsdGeom.Camera | None,
    settings: UsdRender.Settings | None,
    time: Usd.TimeCode,
) -> View:
    """The view of a frame, and the size of its picture."""
    path = camera.GetPath() if camera else Sdf.Path.emptyPath
    seen = camera.GetCamera(time) if camera else camera_on_stage(stage, time, options.purposes)
    resolution = settings.GetResolutionAttr() if settings else None
    if options.image_width is None and resolution and resolution.HasAuthoredValue():
        width, height = resolution.Get(time)
        check_size(width, height, f"{settings.GetPath()}: its resolution")
        return View(seen, path, width, height)
    width = options.image_width or 960
    aspect = seen.aspectRatio
    if not aspect > 1e-4:
        aspect = 1.0
    # Rounded, as 16:9 in floats is a little more than it should be.
    height = max(round(width / aspect), 1)
    check_size(width, height, f"{path}: its aspect ratio {aspect:g}")
    return View(seen, path, width, height)


def check_size(width: int, height: int, source: str) -> None:
    """Refuses a picture that is empty or too large."""
    if not (1 <= width <= MAX_IMAGE_SIZE and 1 <= height <= MAX_IMAGE_SIZE):
        raise CommandError(
            f"{source} makes a picture of {width} x {height} pixels; "
            f"either way 1 to {MAX_IMAGE_SIZE} are allowed"
        )


def camera_on_stage(stage: Usd.Stage, time: Usd.TimeCode, purposes: list[str]) -> Gf.Camera:
    """A camera of 50 mm in front of the stage's bounds, far enough to see all of them.

    Front is +z in a stage with y up, -y in one with z up; usdrecord frames a stage so.
    """
    included = [UsdGeom.Tokens.default_, *(name for name in purposes if name != "default")]
    cache = UsdGeom.BBoxCache(time, included, useExtentsHint=True)
    bounds = cache.ComputeWorldBound(stage.GetPseudoRoot()).ComputeAlignedRange()
    if bounds.IsEmpty():
        bounds = Gf.Range3d(Gf.Vec3d(0), Gf.Vec3d(0))
    size = bounds.GetSize()
    up_is_y = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y
    across, tall, deep = size if up_is_y else (size[0], size[2], size[1])

    camera = Gf.Camera()
    radius = Gf.Vec2d(across / 2, tall / 2).GetLength()
    half_angle = math.radians(camera.GetFieldOfView(Gf.Camera.FOVHorizontal) / 2)
    distance = radius / math.tan(half_angle) + deep / 2
    if distance < camera.clippingRange.min:
        distance += camera.clippingRange.min
    camera.transform = _looking_at(bounds.GetMidpoint(), distance, up_is_y)
    return camera


def _looking_at(center: Gf.Vec3d, distance: float, up_is_y: bool) -> Gf.Matrix4d:
    if up_is_y:
        return Gf.Matrix4d().SetTranslate(center + Gf.Vec3d(0, 0, distance))
    matrix = Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d.XAxis(), 90))
    return matrix.SetTranslateOnly(center - Gf.Vec3d(0, distance, 0))
