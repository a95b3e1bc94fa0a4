#include "hdCC/instancer.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCCInstancer::HdCCInstancer(HdSceneDelegate *delegate, SdfPath const &id)
    : HdInstancer(delegate, id) {}

void HdCCInstancer::Sync(HdSceneDelegate *delegate, HdRenderParam *, HdDirtyBits *dirtyBits) {
    _UpdateInstancer(delegate, dirtyBits);
    *dirtyBits = 0;
}

PXR_NAMESPACE_CLOSE_SCOPE
