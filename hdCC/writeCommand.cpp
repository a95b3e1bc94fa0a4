#include "hdCC/writeCommand.h"

#include <algorithm>
#include <vector>

#include "core/image/displayTransform.h"
#include "core/image/imageFile.h"

#include "pxr/base/tf/stringUtils.h"

#include "hdCC/renderParam.h"
#include "hdCC/renderSettings.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCommandDescriptor HdCCWriteCommandDescriptor() {
    HdCommandArgDescriptors args;
    for (char const *name : {"path", "aovs", "colorCorrection", "ocioDisplay", "ocioView",
                             "ocioColorSpace", "ocioLook"}) {
        args.emplace_back(TfToken(name), VtValue(std::string()));
    }
    return HdCommandDescriptor(TfToken("write"), "Write the last frame to a picture file", args);
}

static std::string _Text(HdCommandArgs const &args, char const *name) {
    const auto found = args.find(name);
    if (found == args.end()) {
        return std::string();
    }
    if (found->second.IsHolding<TfToken>()) {
        return found->second.UncheckedGet<TfToken>().GetString();
    }
    return found->second.GetWithDefault(std::string());
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

static std::string _MakePlanes(cc::Film const &film, std::string const &names,
                               std::vector<cc::ImagePlane> *planes) {
    std::vector<cc::Aov> aovs;
    const std::string error = HdCCParseAovs(names.empty() ? "color" : names, &aovs);
    if (!error.empty()) {
        return error;
    }
    for (cc::Aov const &aov : aovs) {
        if (!film.Has(aov)) {
            return TfStringPrintf(
                "the AOV '%s' is not in the last frame; name it in hdcc:aovs "
                "before rendering",
                cc::NameOf(aov).c_str());
        }
        const cc::AovLayout layout = film.Layout(aov);
        const void *const pixels = layout.isInteger ? static_cast<const void *>(film.Ints(aov))
                                                    : static_cast<const void *>(film.Floats(aov));
        const bool isPrecise = aov.kind == cc::Aov::Primvar;
        planes->push_back(
            {cc::NameOf(aov), layout.components, layout.isInteger, pixels, isPrecise});
    }
    return std::string();
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
                                    [](cc::ImagePlane const &p) { return p.name == "color"; });
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
    std::string error = _MakePlanes(frame->film, _Text(args, "aovs"), &planes);
    if (error.empty() && cc::IsDisplayFormat(path)) {
        error = _Convert(frame->film, args, &planes, &display);
    }
    if (!error.empty()) {
        return TfStringPrintf("%s: %s", path.c_str(), error.c_str());
    }
    return cc::WriteImage(path, frame->film.Width(), frame->film.Height(), planes);
}

PXR_NAMESPACE_CLOSE_SCOPE
