#ifndef PXR_IMAGING_HD_AOV_H
#define PXR_IMAGING_HD_AOV_H

#include "pxr/base/gf/vec3i.h"
#include "pxr/base/tf/hashmap.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <iosfwd>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

class HdRenderBuffer;

using HdAovSettingsMap = TfHashMap<TfToken, VtValue, TfToken::HashFunctor>;

/// What a delegate proposes for an output: its pixels, and the value of a pixel that nothing hit.
struct HdAovDescriptor {
    HdAovDescriptor() = default;
    HdAovDescriptor(HdFormat f, bool ms, VtValue const &c)
        : format(f), multiSampled(ms), clearValue(c) {}

    HdFormat format = HdFormatInvalid;
    bool multiSampled = false;
    VtValue clearValue;
    HdAovSettingsMap aovSettings;
};

using HdAovDescriptorList = std::vector<HdAovDescriptor>;

/// What a render buffer is asked to be.
struct HdRenderBufferDescriptor {
    HdRenderBufferDescriptor() = default;
    HdRenderBufferDescriptor(GfVec3i const &d, HdFormat f, bool ms)
        : dimensions(d), format(f), multiSampled(ms) {}

    bool operator==(HdRenderBufferDescriptor const &o) const {
        return dimensions == o.dimensions && format == o.format && multiSampled == o.multiSampled;
    }
    bool operator!=(HdRenderBufferDescriptor const &o) const { return !(*this == o); }

    GfVec3i dimensions{0};
    HdFormat format = HdFormatInvalid;
    bool multiSampled = false;
};

/// An output of a render pass: its name, and the buffer that takes its pixels.
///
/// The buffer may be given by pointer or by path; the pointer is set by the time a pass executes.
struct HdRenderPassAovBinding {
    TfToken aovName;
    HdRenderBuffer *renderBuffer = nullptr;
    SdfPath renderBufferId;
    VtValue clearValue;
    HdAovSettingsMap aovSettings;
};

using HdRenderPassAovBindingVector = std::vector<HdRenderPassAovBinding>;

HD_API std::ostream &operator<<(std::ostream &out, HdRenderPassAovBinding const &desc);
HD_API bool operator==(HdRenderPassAovBinding const &lhs, HdRenderPassAovBinding const &rhs);
HD_API bool operator!=(HdRenderPassAovBinding const &lhs, HdRenderPassAovBinding const &rhs);

/// Whether an output of this name holds depths.
HD_API bool HdAovHasDepthSemantic(TfToken const &aovName);

/// An output's name with its prefix taken off: 'primvars:st' is the primvar 'st'.
struct HdParsedAovToken {
    HD_API HdParsedAovToken();
    HD_API HdParsedAovToken(TfToken const &aovName);

    TfToken name;
    bool isPrimvar : 1;
    bool isLpe : 1;
    bool isShader : 1;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
