#ifndef PXR_IMAGING_PX_OSD_MESH_TOPOLOGY_H
#define PXR_IMAGING_PX_OSD_MESH_TOPOLOGY_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/pxOsd/api.h"
#include "pxr/imaging/pxOsd/subdivTags.h"
#include "pxr/pxr.h"

#include <cstdint>
#include <iosfwd>

PXR_NAMESPACE_OPEN_SCOPE

/// Faces, holes, scheme and tags of a mesh.
class PxOsdMeshTopology {
  public:
    using ID = uint64_t;

    PXOSD_API PxOsdMeshTopology();
    PXOSD_API PxOsdMeshTopology(TfToken const &scheme, TfToken const &orientation,
                                VtIntArray const &faceVertexCounts,
                                VtIntArray const &faceVertexIndices);
    PXOSD_API PxOsdMeshTopology(TfToken const &scheme, TfToken const &orientation,
                                VtIntArray const &faceVertexCounts,
                                VtIntArray const &faceVertexIndices, VtIntArray const &holeIndices);
    PXOSD_API PxOsdMeshTopology(TfToken const &scheme, TfToken const &orientation,
                                VtIntArray const &faceVertexCounts,
                                VtIntArray const &faceVertexIndices, VtIntArray const &holeIndices,
                                PxOsdSubdivTags const &subdivTags);

    TfToken const GetScheme() const { return _scheme; }
    TfToken const &GetOrientation() const { return _orientation; }
    VtIntArray const &GetFaceVertexCounts() const { return _faceVertexCounts; }
    VtIntArray const &GetFaceVertexIndices() const { return _faceVertexIndices; }
    VtIntArray const &GetHoleIndices() const { return _holeIndices; }
    PxOsdSubdivTags const &GetSubdivTags() const { return _subdivTags; }

    PXOSD_API ID ComputeHash() const;
    PXOSD_API bool operator==(PxOsdMeshTopology const &other) const;

  private:
    TfToken _scheme;
    TfToken _orientation;
    VtIntArray _faceVertexCounts;
    VtIntArray _faceVertexIndices;
    VtIntArray _holeIndices;
    PxOsdSubdivTags _subdivTags;

    // The library remembers here that the topology is known to be valid. A copy made by us starts
    // over, which costs a second validation and nothing else.
    struct _Validated {
        _Validated() = default;
        _Validated(_Validated const &) {}
        _Validated &operator=(_Validated const &) {
            value = false;
            return *this;
        }
        bool value = false;
    };
    mutable _Validated _validated;
};

PXOSD_API std::ostream &operator<<(std::ostream &out, PxOsdMeshTopology const &);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
