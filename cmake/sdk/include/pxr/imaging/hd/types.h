#ifndef PXR_IMAGING_HD_TYPES_H
#define PXR_IMAGING_HD_TYPES_H

#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <cstddef>
#include <cstdint>

PXR_NAMESPACE_OPEN_SCOPE

/// A set of flags that says what of a prim has changed. Their meaning depends on the kind of prim.
using HdDirtyBits = uint32_t;

/// The type of a buffer's element, as Hydra's computations describe their inputs and outputs.
enum HdType {
    HdTypeInvalid = -1,
    HdTypeBool = 0,
    HdTypeUInt8,
    HdTypeUInt16,
    HdTypeInt8,
    HdTypeInt16,
    HdTypeInt32,
    HdTypeInt32Vec2,
    HdTypeInt32Vec3,
    HdTypeInt32Vec4,
    HdTypeUInt32,
    HdTypeUInt32Vec2,
    HdTypeUInt32Vec3,
    HdTypeUInt32Vec4,
    HdTypeFloat,
    HdTypeFloatVec2,
    HdTypeFloatVec3,
    HdTypeFloatVec4,
    HdTypeFloatMat3,
    HdTypeFloatMat4,
    HdTypeDouble,
    HdTypeDoubleVec2,
    HdTypeDoubleVec3,
    HdTypeDoubleVec4,
    HdTypeDoubleMat3,
    HdTypeDoubleMat4,
    HdTypeHalfFloat,
    HdTypeHalfFloatVec2,
    HdTypeHalfFloatVec3,
    HdTypeHalfFloatVec4,
    HdTypeInt32_2_10_10_10_REV,
    HdTypeCount
};

/// An element type and how many of it make one value.
struct HdTupleType {
    HdType type;
    size_t count;

    bool operator==(HdTupleType const &o) const { return type == o.type && count == o.count; }
    bool operator!=(HdTupleType const &o) const { return !(*this == o); }
};

/// The type that a value holds, as Hydra sees it, and its components.
HD_API HdTupleType HdGetValueTupleType(VtValue const &);
HD_API void const *HdGetValueData(VtValue const &);
HD_API HdType HdGetComponentType(HdType);
HD_API size_t HdGetComponentCount(HdType t);
HD_API size_t HdDataSizeOfType(HdType);
HD_API size_t HdDataSizeOfTupleType(HdTupleType);

/// The pixel formats of render buffers.
enum HdFormat {
    HdFormatInvalid = -1,

    // Eight bits a component, read as 0..1 or -1..1.
    HdFormatUNorm8 = 0,
    HdFormatUNorm8Vec2,
    HdFormatUNorm8Vec3,
    HdFormatUNorm8Vec4,
    HdFormatSNorm8,
    HdFormatSNorm8Vec2,
    HdFormatSNorm8Vec3,
    HdFormatSNorm8Vec4,

    // Floating point.
    HdFormatFloat16,
    HdFormatFloat16Vec2,
    HdFormatFloat16Vec3,
    HdFormatFloat16Vec4,
    HdFormatFloat32,
    HdFormatFloat32Vec2,
    HdFormatFloat32Vec3,
    HdFormatFloat32Vec4,

    // Integers.
    HdFormatInt16,
    HdFormatInt16Vec2,
    HdFormatInt16Vec3,
    HdFormatInt16Vec4,
    HdFormatUInt16,
    HdFormatUInt16Vec2,
    HdFormatUInt16Vec3,
    HdFormatUInt16Vec4,
    HdFormatInt32,
    HdFormatInt32Vec2,
    HdFormatInt32Vec3,
    HdFormatInt32Vec4,

    // Depth and stencil together.
    HdFormatFloat32UInt8,

    HdFormatCount
};

/// The format of one component, the number of components, and the bytes of a pixel.
HD_API HdFormat HdGetComponentFormat(HdFormat f);
HD_API size_t HdGetComponentCount(HdFormat f);
HD_API size_t HdDataSizeOfFormat(HdFormat f);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
