"""Render products: the pictures that a UsdRenderSettings prim asks for, and what each holds."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pxr import CameraUtil, Gf, Sdf, Usd, UsdRender

from . import pictures
from .console import CommandError, warning
from .record_options import AOVS, RENDERER, RENDERER_PLUGIN, RecordOptions
from .stage import Framing, View, check_size, find_camera, view_at

_PARAMETERS = "driver:parameters:"
_AOV_PARAMETERS = "driver:parameters:aov:"
#: Names under which colour is the picture's own R, G, B, A and not a layer.
_BEAUTY = ("color", "rgba", "Ci", "beauty")
#: What aspectRatioConformPolicy says of the camera's window; the last is done without one.
_CONFORM = {
    "expandAperture": CameraUtil.Fit,
    "cropAperture": CameraUtil.Crop,
    "adjustApertureWidth": CameraUtil.MatchVertically,
    "adjustApertureHeight": CameraUtil.MatchHorizontally,
    "adjustPixelAspectRatio": CameraUtil.DontConform,
}
_HALF = ("half", "color3h", "color4h", "normal3h", "vector3h", "point3h", "half2", "half3", "half4")


@dataclass(frozen=True)
class Var:
    """An AOV in a file: the layer that it is, and the type of its channels; `-` for the usual."""

    aov: str
    layer: str = "-"
    type: str = "-"


@dataclass(frozen=True)
class Product:
    """A picture of a frame: what a RenderProduct asks for, or a RenderSettings without any."""

    prim: Usd.Prim
    file: str
    #: whichever says what camera it is seen through
    camera_of: UsdRender.SettingsBase
    vars: tuple[Var, ...]
    metadata: dict[str, Any] = field(default_factory=dict)
    #: the settings that the frame is made by
    #: none if neither says how large the picture is
    resolution: tuple[int, int] | None = None
    pixel_aspect: float = 1.0
    conform: str = "expandAperture"
    data_window: tuple[float, float, float, float] = (0, 0, 1, 1)
    motion_blur: bool = True
    depth_of_field: bool = True


def products_of(
    options: RecordOptions, settings: UsdRender.Settings | None, when: Usd.TimeCode
) -> list[Product]:
    """The products of the settings prim that the command line names: that prim itself, if it has
    none. Nothing if there is no such prim, or another renderer sees to it."""
    is_named = options.render_settings or options.render_pass
    if not settings or not is_named or options.renderer not in (RENDERER, RENDERER_PLUGIN):
        return []
    stage = settings.GetPrim().GetStage()
    prims = []
    for path in settings.GetProductsRel().GetForwardedTargets():
        prim = stage.GetPrimAtPath(path)
        if not UsdRender.Product(prim):
            raise CommandError(f"{settings.GetPath()}: its product {path} is no RenderProduct")
        prims.append(prim)
    prims = prims or [settings.GetPrim()]
    products = [_read(options, settings, prim, when) for prim in prims]
    files = [product.file for product in products]
    for product in products:
        if files.count(product.file) > 1:
            raise CommandError(f"{product.prim.GetPath()}: another product is {product.file}, too")
    return products


def _read(
    options: RecordOptions, settings: UsdRender.Settings, prim: Usd.Prim, when: Usd.TimeCode
) -> Product:
    kind = _get(prim, "productType", when) or UsdRender.Tokens.raster
    if kind != UsdRender.Tokens.raster:
        raise CommandError(f"{prim.GetPath()}: products of the type {kind} are not supported")

    def get(name: str) -> Any:
        """An attribute of the product, or where it has no opinion of the settings."""
        own = prim.GetAttribute(name)
        return (own if own.HasAuthoredValue() else settings.GetPrim().GetAttribute(name)).Get(when)

    own = UsdRender.SettingsBase(prim)
    conform = get("aspectRatioConformPolicy")
    if conform not in _CONFORM:
        known = " ".join(_CONFORM)
        reason = f"there is no aspectRatioConformPolicy '{conform}' (known: {known})"
        raise CommandError(f"{prim.GetPath()}: {reason}")
    is_sized = any(
        each.GetAttribute("resolution").HasAuthoredValue() for each in (prim, settings.GetPrim())
    )
    blurs = not (get("disableMotionBlur") or get("instantaneousShutter"))
    return Product(
        prim=prim,
        file=_file_of(options, prim, when),
        camera_of=own if own.GetCameraRel().GetForwardedTargets() else settings,
        vars=_vars_of(options, prim, when),
        metadata=_metadata_of(prim, when),
        resolution=tuple(get("resolution")) if is_sized else None,
        pixel_aspect=get("pixelAspectRatio"),
        conform=conform,
        data_window=tuple(get("dataWindowNDC")),
        motion_blur=blurs,
        depth_of_field=not get("disableDepthOfField"),
    )


def _get(prim: Usd.Prim, name: str, when: Usd.TimeCode) -> str:
    """An attribute as text; empty if there is none."""
    attribute = prim.GetAttribute(name)
    value = attribute.Get(when) if attribute else None
    return "" if value is None else str(value)


def _file_of(options: RecordOptions, prim: Usd.Prim, when: Usd.TimeCode) -> str:
    """The product's name, in OUT's folder unless it is a full path; OUT if it has none."""
    name = _get(prim, "productName", when)
    file = str(Path(options.picture).parent / name) if name else options.picture
    frame = 0.0 if when.IsDefault() else when.GetValue()
    pictures.check_format(file)
    file = pictures.name_of_frame(file, frame)
    pictures.check_folder(file)
    return file


def _vars_of(options: RecordOptions, prim: Usd.Prim, when: Usd.TimeCode) -> tuple[Var, ...]:
    ordered = prim.GetRelationship("orderedVars")
    found = []
    for path in ordered.GetForwardedTargets() if ordered else ():
        var = UsdRender.Var(prim.GetStage().GetPrimAtPath(path))
        if not var:
            raise CommandError(f"{prim.GetPath()}: its variable {path} is no RenderVar")
        found.append(_read_var(var, when))
    found = found or [Var("color")]
    found += [Var(name) for name in options.aovs if name not in {var.aov for var in found}]
    return tuple(found)


def _read_var(var: UsdRender.Var, when: Usd.TimeCode) -> Var:
    prim = var.GetPrim()
    source, kind = var.GetSourceNameAttr().Get(when) or "", var.GetSourceTypeAttr().Get(when)
    if kind == UsdRender.Tokens.primvar:
        aov = f"primvars:{source}" if source else ""
    elif kind == UsdRender.Tokens.raw:
        aov = "color" if source in _BEAUTY else source
    else:
        raise CommandError(f"{prim.GetPath()}: variables of the type {kind} are not supported")
    is_known = aov.startswith("primvars:") or aov in AOVS
    if not is_known:
        known = " ".join(AOVS)
        raise CommandError(f"{prim.GetPath()}: there is no AOV '{source}' (known: {known})")
    layer = _get(prim, _AOV_PARAMETERS + "name", when).replace(" ", "_") or "-"
    is_plain = aov == "color" and layer in _BEAUTY
    return Var(aov, "color" if is_plain else layer, _type_of(var, when))


def _type_of(var: UsdRender.Var, when: Usd.TimeCode) -> str:
    data_type = _get(var.GetPrim(), _AOV_PARAMETERS + "format", when)
    if not data_type and var.GetDataTypeAttr().HasAuthoredValue():
        data_type = var.GetDataTypeAttr().Get(when)
    if not data_type:
        return "-"
    return "half" if data_type in _HALF else "float"


def _metadata_of(prim: Usd.Prim, when: Usd.TimeCode) -> dict[str, Any]:
    """What the product says to the driver, for the file's header."""
    metadata: dict[str, Any] = {}
    for attribute in prim.GetAuthoredPropertiesInNamespace(_PARAMETERS[:-1]):
        name = attribute.GetName()
        if name.startswith(_AOV_PARAMETERS) or not isinstance(attribute, Usd.Attribute):
            continue
        value = attribute.Get(when)
        if (isinstance(value, (str, int, float)) and not isinstance(value, bool)) or isinstance(
            value, Gf.Matrix4d
        ):
            metadata[name[len(_PARAMETERS) :]] = value
        elif value is not None:
            warning(f"{attribute.GetPath()}: no header holds values of this type; it is left out")
    return metadata


def view_of(options: RecordOptions, stage: Usd.Stage, product: Product, when: Usd.TimeCode) -> View:
    """The view of a product, and the size of its picture. Options come before what it says."""
    camera = find_camera(options, stage, product.camera_of)
    view = view_at(options, stage, camera, None, when)
    seen, width, height = view.camera, view.width, view.height
    if product.resolution:
        width, height = product.resolution
        where = f"{product.prim.GetPath()}: its resolution"
        check_size(width, height, where)
        if options.image_width:
            height = max(round(options.image_width * height / width), 1)
            width = options.image_width
            check_size(width, height, where)
        view = View(seen, view.path, width, height)
    view.framing = _framing_of(product, (width, height), seen)
    check_size(*view.framing.data_window.GetSize(), f"{product.prim.GetPath()}: its data window")
    return view


def _framing_of(product: Product, size: tuple[int, int], camera: Gf.Camera) -> Framing:
    """What a product shows in a picture of a size."""
    width, height = size
    where = product.prim.GetPath()
    pixel_aspect = product.pixel_aspect
    if product.conform == "adjustPixelAspectRatio":
        pixel_aspect = camera.aspectRatio * height / width
    if not (pixel_aspect > 0 and math.isfinite(pixel_aspect)):
        raise CommandError(f"{where}: its pixelAspectRatio {pixel_aspect:g} is not above 0")
    left, bottom, right, top = product.data_window
    if not all(map(math.isfinite, product.data_window)) or abs(right) > 100 or abs(top) > 100:
        raise CommandError(f"{where}: its dataWindowNDC makes no sense")
    # Pixels whose centres are inside; NDC count from below, pixels from above.
    x0, x1 = math.ceil(left * width - 0.5), math.ceil(right * width - 0.5)
    y0, y1 = height - math.ceil(top * height - 0.5), height - math.ceil(bottom * height - 0.5)
    if x1 <= x0 or y1 <= y0:
        raise CommandError(f"{where}: its dataWindowNDC holds no pixel")
    window = Gf.Rect2i(Gf.Vec2i(x0, y0), x1 - x0, y1 - y0)
    return Framing(size, window, pixel_aspect, _CONFORM[product.conform])


@contextmanager
def without_blur(stage: Usd.Stage, product: Product, view: View) -> Iterator[None]:
    """Closes the camera's shutter, or takes its lens away, if the product says so."""
    values: dict[str, Any] = {}
    if not product.motion_blur:
        values |= {"shutter:open": 0.0, "shutter:close": 0.0}
    if not product.depth_of_field:
        values |= {"fStop": 0.0}
    if not values or view.path.isEmpty:
        yield
        return
    layer = Sdf.Layer.CreateAnonymous()
    session = stage.GetSessionLayer()
    session.subLayerPaths.insert(0, layer.identifier)
    try:
        with Usd.EditContext(stage, layer):
            for name, value in values.items():
                stage.OverridePrim(view.path).GetAttribute(name).Set(value)
        yield
    finally:
        session.subLayerPaths.remove(layer.identifier)
