#ifndef PXR_IMAGING_HD_CHANGE_TRACKER_H
#define PXR_IMAGING_HD_CHANGE_TRACKER_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/rprimCollection.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <string>

PXR_NAMESPACE_OPEN_SCOPE

/// Knows what of each prim has changed since it was last synced.
///
/// The library owns it; what is declared is the vocabulary of dirty bits, and marking.
class HdChangeTracker {
  public:
    /// What can change about geometry and instancers.
    enum RprimDirtyBits : HdDirtyBits {
        Clean = 0,
        InitRepr = 1 << 0,
        Varying = 1 << 1,
        AllDirty = ~Varying,
        DirtyPrimID = 1 << 2,
        DirtyExtent = 1 << 3,
        DirtyDisplayStyle = 1 << 4,
        DirtyPoints = 1 << 5,
        DirtyPrimvar = 1 << 6,
        DirtyMaterialId = 1 << 7,
        DirtyTopology = 1 << 8,
        DirtyTransform = 1 << 9,
        DirtyVisibility = 1 << 10,
        DirtyNormals = 1 << 11,
        DirtyDoubleSided = 1 << 12,
        DirtyCullStyle = 1 << 13,
        DirtySubdivTags = 1 << 14,
        DirtyWidths = 1 << 15,
        DirtyInstancer = 1 << 16,
        DirtyInstanceIndex = 1 << 17,
        DirtyRepr = 1 << 18,
        DirtyRenderTag = 1 << 19,
        DirtyComputationPrimvarDesc = 1 << 20,
        DirtyCategories = 1 << 21,
        DirtyVolumeField = 1 << 22,
        AllSceneDirtyBits = (1 << 23) - 1,

        // The bits above the scene's are for a delegate's own use.
        NewRepr = 1 << 23,
        CustomBitsBegin = 1 << 24,
        CustomBitsEnd = 1 << 30,
        CustomBitsMask = 0x7f << 24
    };

    HdChangeTracker(HdChangeTracker const &) = delete;
    HdChangeTracker &operator=(HdChangeTracker const &) = delete;
    HD_API virtual ~HdChangeTracker();

    HD_API void MarkRprimDirty(SdfPath const &id, HdDirtyBits bits = AllDirty);
    HD_API void MarkAllRprimsDirty(HdDirtyBits bits);
    HD_API void MarkSprimDirty(SdfPath const &id, HdDirtyBits bits);
    HD_API void MarkBprimDirty(SdfPath const &id, HdDirtyBits bits);
    HD_API void MarkInstancerDirty(SdfPath const &id, HdDirtyBits bits = AllDirty);
    HD_API HdDirtyBits GetRprimDirtyBits(SdfPath const &id) const;
    HD_API HdDirtyBits GetInstancerDirtyBits(SdfPath const &id);

    // What a set of bits says. Points, normals and widths count as primvars too, each with a bit
    // of its own.
    HD_API static bool IsExtentDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsDisplayStyleDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsSubdivTagsDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsPrimvarDirty(HdDirtyBits dirtyBits, SdfPath const &id,
                                      TfToken const &name);
    HD_API static bool IsAnyPrimvarDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsTopologyDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsDoubleSidedDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsCullStyleDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsTransformDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsVisibilityDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsPrimIdDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsInstancerDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsInstanceIndexDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static bool IsReprDirty(HdDirtyBits dirtyBits, SdfPath const &id);
    HD_API static std::string StringifyDirtyBits(HdDirtyBits dirtyBits);

  private:
    HdChangeTracker() = delete;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
