#include "hdCC/pickCommand.h"

#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/usd/sdf/path.h"

#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCommandDescriptor HdCCPickCommandDescriptor() {
    HdCommandArgDescriptors args;
    args.emplace_back(TfToken("x"), VtValue(0));
    args.emplace_back(TfToken("y"), VtValue(0));
    return HdCommandDescriptor(TfToken("pick"), "Tell what a pixel of the last frame shows", args);
}

/// Returns false if there is no such whole number.
static bool _ReadNumber(HdCommandArgs const &args, char const *name, int *number) {
    const auto found = args.find(name);
    if (found == args.end()) {
        return false;
    }
    const VtValue cast = VtValue::Cast<int>(found->second);
    *number = cast.GetWithDefault(0);
    return !cast.IsEmpty();
}

std::string HdCCPick(HdCCRenderParam *param, HdCommandArgs const &args) {
    param->SetPicked(VtDictionary());
    const std::shared_ptr<const HdCCFrame> frame = param->GetFrame();
    int x = 0, y = 0;
    if (!_ReadNumber(args, "x", &x) || !_ReadNumber(args, "y", &y)) {
        return "pick: x and y must be whole numbers";
    }
    if (!frame) {
        return "pick: no frame has been rendered";
    }
    cc::Film const &film = frame->film;
    if (x < 0 || y < 0 || x >= film.Width() || y >= film.Height()) {
        return TfStringPrintf("pick: there is no pixel %d, %d in a frame of %d x %d", x, y,
                              film.Width(), film.Height());
    }
    for (const cc::Aov::Kind kind :
         {cc::Aov::PrimId, cc::Aov::InstanceId, cc::Aov::ElementId, cc::Aov::CameraDepth}) {
        if (!film.Has(kind)) {
            return TfStringPrintf(
                "pick: the AOV '%s' is not in the last frame; name it in hdcc:aovs before "
                "rendering",
                cc::NameOf(kind).c_str());
        }
    }
    // Rows of films count from the bottom.
    const size_t pixel = size_t(film.Height() - 1 - y) * film.Width() + x;
    const SdfPath prim = param->FindPrim(film.Ints(cc::Aov::PrimId)[pixel]);
    if (!prim.IsEmpty()) {
        VtDictionary picked;
        picked["path"] = VtValue(prim.GetString());
        picked["instance"] = VtValue(film.Ints(cc::Aov::InstanceId)[pixel]);
        picked["element"] = VtValue(film.Ints(cc::Aov::ElementId)[pixel]);
        picked["depth"] = VtValue(film.Floats(cc::Aov::CameraDepth)[pixel]);
        param->SetPicked(picked);
    }
    return std::string();
}

PXR_NAMESPACE_CLOSE_SCOPE
