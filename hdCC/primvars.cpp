#include "hdCC/primvars.h"

#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/convert.h"

PXR_NAMESPACE_OPEN_SCOPE

static cc::Interpolation _ToInterpolation(HdInterpolation interpolation) {
    switch (interpolation) {
        case HdInterpolationUniform: return cc::Interpolation::Uniform;
        case HdInterpolationVarying: return cc::Interpolation::Varying;
        case HdInterpolationVertex: return cc::Interpolation::Vertex;
        case HdInterpolationFaceVarying: return cc::Interpolation::FaceVarying;
        case HdInterpolationInstance: return cc::Interpolation::Instance;
        default: return cc::Interpolation::Constant;
    }
}

static bool _Find(HdSceneDelegate *delegate, SdfPath const &id, TfToken const &name,
                  std::initializer_list<HdInterpolation> interpolations,
                  HdPrimvarDescriptor *found) {
    for (HdInterpolation interpolation : interpolations) {
        for (HdPrimvarDescriptor const &primvar :
             delegate->GetPrimvarDescriptors(id, interpolation)) {
            if (primvar.name == name) {
                *found = primvar;
                return true;
            }
        }
    }
    return false;
}

bool HdCCGetPrimvar(HdSceneDelegate *delegate, SdfPath const &id, TfToken const &name,
                    std::initializer_list<HdInterpolation> interpolations, cc::Primvar *primvar,
                    std::string *error) {
    HdPrimvarDescriptor descriptor;
    if (!_Find(delegate, id, name, interpolations, &descriptor)) {
        return false;
    }
    VtIntArray indices;
    const VtValue value = descriptor.indexed ? delegate->GetIndexedPrimvar(id, name, &indices)
                                             : delegate->Get(id, name);
    *primvar = {_ToInterpolation(descriptor.interpolation), 3, {}, {}};
    primvar->indices.assign(indices.cbegin(), indices.cend());
    if (!HdCCToNumbers(value, &primvar->arity, &primvar->values)) {
        *error = "primvars:" + name.GetString() + " has the type " + value.GetTypeName() +
                 ", which is no float, int or vector of them; it is ignored";
        *primvar = {};
    }
    return true;
}

PXR_NAMESPACE_CLOSE_SCOPE
