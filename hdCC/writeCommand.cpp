#include "hdCC/writeCommand.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/image/displayTransform.h"
#include "core/image/imageFile.h"

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/matrix4f.h"
#include "pxr/base/gf/vec4i.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/vt/dictionary.h"

#include "hdCC/renderParam.h"
#include "hdCC/renderSettings.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCommandDescriptor HdCCWriteCommandDescriptor() {
    HdCommandArgDescriptors args;
    for (char const *name : {"path", "aovs", "layers", "types", "colorCorrection", "ocioDisplay",
                             "ocioView", "ocioColorSpace", "ocioLook"}) {
        args.emplace_back(TfToken(name), VtValue(std::string()));
    }
    args.emplace_back(TfToken("metadata"), VtValue(VtDictionary()));
    args.emplace_back(TfToken("window"), VtValue(GfVec4i(0)));
    args.emplace_back(TfToken("pixelAspect"), VtValue(1.0));
    return HdCommandDescriptor(TfToken("write"), "Write the last frame to a picture file", args);
}

template <class T>
static T _Get(HdCommandArgs const &args, char const *name, T const &otherwise) {
    const auto found = args.find(name);
    return found != args.end() && found->second.IsHolding<T>() ? found->second.UncheckedGet<T>()
                                                               : otherwise;
}

static std::string _Text(HdCommandArgs const &args, char const *name) {
    const std::string token = _Get(args, name, TfToken()).GetString();
    return token.empty() ? _Get(args, name, std::string()) : token;
}

static bool _ToColorCorrection(std::string const &name, cc::ColorCorrection *mode) {
    if (name.empty() || name == "disabled") {
        *mode = cc::ColorCorrection::Disabled;
    } else if (name == "sRGB") {
        *mode = cc::ColorCorrection::SRGB;
    } else if (name == "openColorIO") {
        *mode = cc::ColorCorrection::OpenColorIO;
    } else {
        return false;
    }
    return true;
}

static std::string _MakePlane(cc::Film const &film, std::string const &name,
                              cc::ImagePlane *plane) {
    cc::Aov aov;
    if (!cc::AovFromName(name, &aov)) {
        return TfStringPrintf("there is no AOV '%s'", name.c_str());
    }
    if (!film.Has(aov)) {
        return TfStringPrintf(
            "the AOV '%s' is not in the last frame; name it in hdcc:aovs "
            "before rendering",
            cc::NameOf(aov).c_str());
    }
    const cc::AovLayout layout = film.Layout(aov);
    plane->name = cc::NameOf(aov);
    plane->components = layout.components;
    plane->isInteger = layout.isInteger;
    plane->pixels = layout.isInteger ? static_cast<const void *>(film.Ints(aov))
                                     : static_cast<const void *>(film.Floats(aov));
    plane->isPrecise = aov.kind == cc::Aov::Primvar;
    plane->isColor = aov.kind == cc::Aov::Color;
    return std::string();
}

/// A plane a name, with the layer and type that stand at the same place among those given; `-` is
/// the usual one.
static std::string _MakePlanes(cc::Film const &film, HdCommandArgs const &args,
                               std::vector<cc::ImagePlane> *planes) {
    constexpr char kSeparators[] = " ,\t\n";
    std::vector<std::string> names = TfStringTokenize(_Text(args, "aovs"), kSeparators);
    if (names.empty()) {
        names.push_back("color");
    }
    const std::vector<std::string> layers = TfStringTokenize(_Text(args, "layers"), kSeparators);
    const std::vector<std::string> types = TfStringTokenize(_Text(args, "types"), kSeparators);
    for (size_t i = 0; i < names.size(); ++i) {
        cc::ImagePlane plane;
        const std::string error = _MakePlane(film, names[i], &plane);
        if (!error.empty()) {
            return error;
        }
        if (i < layers.size() && layers[i] != "-") {
            plane.name = layers[i];
        }
        if (i < types.size() && types[i] != "-") {
            plane.isHalf = types[i] == "half";
        }
        planes->push_back(plane);
    }
    return std::string();
}

/// @param metadata  texts, numbers and matrices by name
static cc::ImageHeader _MakeHeader(HdCommandArgs const &args) {
    cc::ImageHeader header;
    const GfVec4i window = _Get(args, "window", GfVec4i(0));
    header.x = window[0];
    header.y = window[1];
    header.fullWidth = window[2];
    header.fullHeight = window[3];
    header.pixelAspect = float(_Get(args, "pixelAspect", 1.0));
    for (auto const &[name, value] : _Get(args, "metadata", VtDictionary())) {
        if (value.IsHolding<std::string>()) {
            header.texts.emplace_back(name, value.UncheckedGet<std::string>());
        } else if (value.IsHolding<GfMatrix4d>()) {
            const GfMatrix4f matrix(value.UncheckedGet<GfMatrix4d>());
            header.matrices.emplace_back(name, std::array<float, 16>{});
            std::copy_n(matrix.GetArray(), 16, header.matrices.back().second.begin());
        } else if (value.CanCast<double>()) {
            header.numbers.emplace_back(name, VtValue::Cast<double>(value).GetWithDefault(0.0));
        }
    }
    return header;
}

/// Points the colour plane at a copy that is converted for display.
static std::string _Convert(cc::Film const &film, HdCommandArgs const &args,
                            std::vector<cc::ImagePlane> *planes, std::vector<float> *display) {
    cc::ColorCorrection mode;
    const std::string name = _Text(args, "colorCorrection");
    if (!_ToColorCorrection(name, &mode)) {
        return TfStringPrintf(
            "colorCorrection cannot be '%s'; allowed: disabled, sRGB, "
            "openColorIO",
            name.c_str());
    }
    const auto color = std::find_if(planes->begin(), planes->end(),
                                    [](cc::ImagePlane const &p) { return p.isColor; });
    if (color == planes->end()) {
        return std::string();
    }
    const float *const pixels = film.Floats(cc::Aov::Color);
    display->assign(pixels, pixels + size_t(4) * film.Width() * film.Height());
    color->pixels = display->data();
    const cc::OpenColorIOOptions options{_Text(args, "ocioDisplay"), _Text(args, "ocioView"),
                                         _Text(args, "ocioColorSpace"), _Text(args, "ocioLook")};
    return cc::ApplyDisplayTransform(mode, options, display->data(), film.Width(), film.Height());
}

std::string HdCCWriteFrame(HdCCFrame const *frame, HdCommandArgs const &args) {
    const std::string path = _Text(args, "path");
    if (path.empty()) {
        return "write: no path is given";
    }
    if (!frame) {
        return TfStringPrintf("%s: no frame has been rendered", path.c_str());
    }
    std::vector<cc::ImagePlane> planes;
    std::vector<float> display;
    std::string error = _MakePlanes(frame->film, args, &planes);
    if (error.empty() && cc::IsDisplayFormat(path)) {
        error = _Convert(frame->film, args, &planes, &display);
    }
    if (!error.empty()) {
        return TfStringPrintf("%s: %s", path.c_str(), error.c_str());
    }
    return cc::WriteImage(path, frame->film.Width(), frame->film.Height(), planes,
                          _MakeHeader(args));
}

PXR_NAMESPACE_CLOSE_SCOPE
