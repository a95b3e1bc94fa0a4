#ifndef PXR_IMAGING_HD_SCENE_DELEGATE_H
#define PXR_IMAGING_HD_SCENE_DELEGATE_H

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/range3d.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/aov.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/imaging/hd/meshTopology.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/repr.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/imaging/pxOsd/subdivTags.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

class HdBasisCurvesTopology;
class HdExtComputationContext;
struct HdModelDrawMode;
struct HdSyncRequestVector;
struct HdVolumeFieldDescriptor;

using HdIdVectorSharedPtr = std::shared_ptr<SdfPathVector>;
using HdInstancerContext = std::vector<std::pair<SdfPath, int>>;
using HdVolumeFieldDescriptorVector = std::vector<HdVolumeFieldDescriptor>;

/// How the user wants to see a prim. The refine level is what usdview calls complexity.
struct HdDisplayStyle {
    int refineLevel = 0;
    bool flatShadingEnabled = false;
    bool displacementEnabled = true;

  private:
    // Four more flags that only a rasterizer reads, and tail padding. Their order is the library's
    // affair; that a style comes back by value is why they must be here.
    bool _rasterizerOnly[6] = {};
};

/// A primvar's name, basis and role ('color', 'textureCoordinate', ...), not its value.
struct HdPrimvarDescriptor {
    HdPrimvarDescriptor() = default;
    HdPrimvarDescriptor(TfToken const &name_, HdInterpolation interpolation_,
                        TfToken const &role_ = TfToken(), bool indexed_ = false)
        : name(name_), interpolation(interpolation_), role(role_), indexed(indexed_) {}

    bool operator==(HdPrimvarDescriptor const &o) const {
        return name == o.name && role == o.role && interpolation == o.interpolation;
    }
    bool operator!=(HdPrimvarDescriptor const &o) const { return !(*this == o); }

    TfToken name;
    HdInterpolation interpolation = HdInterpolationConstant;
    TfToken role;

    /// When true, GetIndexedPrimvar gives the values and the indices into them.
    bool indexed = false;
};

using HdPrimvarDescriptorVector = std::vector<HdPrimvarDescriptor>;

/// A primvar that a computation makes, such as skinned points.
struct HdExtComputationPrimvarDescriptor : HdPrimvarDescriptor {
    HdExtComputationPrimvarDescriptor() = default;

    SdfPath sourceComputationId;
    TfToken sourceComputationOutputName;
    HdTupleType valueType;
};

using HdExtComputationPrimvarDescriptorVector = std::vector<HdExtComputationPrimvarDescriptor>;

/// An input that one computation takes from another.
struct HdExtComputationInputDescriptor {
    TfToken name;
    SdfPath sourceComputationId;
    TfToken sourceComputationOutputName;
};

using HdExtComputationInputDescriptorVector = std::vector<HdExtComputationInputDescriptor>;

/// A value that a computation makes.
struct HdExtComputationOutputDescriptor {
    TfToken name;
    HdTupleType valueType;
};

using HdExtComputationOutputDescriptorVector = std::vector<HdExtComputationOutputDescriptor>;

/// Answers what a prim needs to know of the scene.
///
/// Prims are synced by several threads at once, and all of them may ask.
class HdSceneDelegate {
  public:
    HD_API HdSceneDelegate(HdRenderIndex *parentIndex, SdfPath const &delegateID);
    HD_API virtual ~HdSceneDelegate();

    HdRenderIndex &GetRenderIndex() { return *_index; }
    SdfPath const &GetDelegateID() const { return _delegateID; }

    HD_API virtual void Sync(HdSyncRequestVector *request);
    HD_API virtual void PostSyncCleanup();
    HD_API virtual bool IsEnabled(TfToken const &option) const;

    // Meshes and what all geometry has. The topology comes without subdivision tags.
    HD_API virtual HdMeshTopology GetMeshTopology(SdfPath const &id);
    HD_API virtual HdBasisCurvesTopology GetBasisCurvesTopology(SdfPath const &id);
    HD_API virtual PxOsdSubdivTags GetSubdivTags(SdfPath const &id);
    HD_API virtual GfRange3d GetExtent(SdfPath const &id);
    HD_API virtual GfMatrix4d GetTransform(SdfPath const &id);
    HD_API virtual bool GetVisible(SdfPath const &id);
    HD_API virtual bool GetDoubleSided(SdfPath const &id);
    HD_API virtual HdCullStyle GetCullStyle(SdfPath const &id);
    HD_API virtual VtValue GetShadingStyle(SdfPath const &id);
    HD_API virtual HdDisplayStyle GetDisplayStyle(SdfPath const &id);

    // Values by name: primvars and points, with or without the indices that expand them.
    HD_API virtual VtValue Get(SdfPath const &id, TfToken const &key);
    HD_API virtual VtValue GetIndexedPrimvar(SdfPath const &id, TfToken const &key,
                                             VtIntArray *outIndices);

    // How a prim is to be drawn, and the sets it belongs to.
    HD_API virtual HdReprSelector GetReprSelector(SdfPath const &id);
    HD_API virtual TfToken GetRenderTag(SdfPath const &id);
    HD_API virtual VtArray<TfToken> GetCategories(SdfPath const &id);
    HD_API virtual std::vector<VtArray<TfToken>> GetInstanceCategories(SdfPath const &instancerId);
    HD_API virtual HdIdVectorSharedPtr GetCoordSysBindings(SdfPath const &id);
    HD_API virtual HdModelDrawMode GetModelDrawMode(SdfPath const &id);

    // Motion samples. Each call answers how many samples there are, which may be more than the
    // caller made room for; times are relative to the frame, and the second form of each bounds
    // them. The samples of the first form lie within the camera's shutter.
    HD_API virtual size_t SampleTransform(SdfPath const &id, size_t maxSampleCount,
                                          float *sampleTimes, GfMatrix4d *sampleValues);
    HD_API virtual size_t SampleTransform(SdfPath const &id, float startTime, float endTime,
                                          size_t maxSampleCount, float *sampleTimes,
                                          GfMatrix4d *sampleValues);
    HD_API virtual size_t SampleInstancerTransform(SdfPath const &instancerId,
                                                   size_t maxSampleCount, float *sampleTimes,
                                                   GfMatrix4d *sampleValues);
    HD_API virtual size_t SampleInstancerTransform(SdfPath const &instancerId, float startTime,
                                                   float endTime, size_t maxSampleCount,
                                                   float *sampleTimes, GfMatrix4d *sampleValues);
    HD_API virtual size_t SamplePrimvar(SdfPath const &id, TfToken const &key,
                                        size_t maxSampleCount, float *sampleTimes,
                                        VtValue *sampleValues);
    HD_API virtual size_t SamplePrimvar(SdfPath const &id, TfToken const &key, float startTime,
                                        float endTime, size_t maxSampleCount, float *sampleTimes,
                                        VtValue *sampleValues);
    HD_API virtual size_t SampleIndexedPrimvar(SdfPath const &id, TfToken const &key,
                                               size_t maxSampleCount, float *sampleTimes,
                                               VtValue *sampleValues, VtIntArray *sampleIndices);
    HD_API virtual size_t SampleIndexedPrimvar(SdfPath const &id, TfToken const &key,
                                               float startTime, float endTime,
                                               size_t maxSampleCount, float *sampleTimes,
                                               VtValue *sampleValues, VtIntArray *sampleIndices);

    // Instancing, and the way back from a picked instance to the scene.
    HD_API virtual VtIntArray GetInstanceIndices(SdfPath const &instancerId,
                                                 SdfPath const &prototypeId);
    HD_API virtual GfMatrix4d GetInstancerTransform(SdfPath const &instancerId);
    HD_API virtual SdfPath GetInstancerId(SdfPath const &primId);
    HD_API virtual SdfPathVector GetInstancerPrototypes(SdfPath const &instancerId);
    HD_API virtual SdfPath GetScenePrimPath(SdfPath const &rprimId, int instanceIndex,
                                            HdInstancerContext *instancerContext = nullptr);
    HD_API virtual SdfPathVector GetScenePrimPaths(
        SdfPath const &rprimId, std::vector<int> instanceIndices,
        std::vector<HdInstancerContext> *instancerContexts = nullptr);

    // Materials, buffers, lights and cameras.
    HD_API virtual SdfPath GetMaterialId(SdfPath const &rprimId);
    HD_API virtual VtValue GetMaterialResource(SdfPath const &materialId);
    HD_API virtual HdRenderBufferDescriptor GetRenderBufferDescriptor(SdfPath const &id);
    HD_API virtual VtValue GetLightParamValue(SdfPath const &id, TfToken const &paramName);
    HD_API virtual VtValue GetCameraParamValue(SdfPath const &cameraId, TfToken const &paramName);
    HD_API virtual HdVolumeFieldDescriptorVector GetVolumeFieldDescriptors(SdfPath const &volumeId);

    // Computations that make primvars.
    HD_API virtual TfTokenVector GetExtComputationSceneInputNames(SdfPath const &computationId);
    HD_API virtual HdExtComputationInputDescriptorVector GetExtComputationInputDescriptors(
        SdfPath const &computationId);
    HD_API virtual HdExtComputationOutputDescriptorVector GetExtComputationOutputDescriptors(
        SdfPath const &computationId);
    HD_API virtual HdExtComputationPrimvarDescriptorVector GetExtComputationPrimvarDescriptors(
        SdfPath const &id, HdInterpolation interpolationMode);
    HD_API virtual VtValue GetExtComputationInput(SdfPath const &computationId,
                                                  TfToken const &input);
    HD_API virtual size_t SampleExtComputationInput(SdfPath const &computationId,
                                                    TfToken const &input, size_t maxSampleCount,
                                                    float *sampleTimes, VtValue *sampleValues);
    HD_API virtual size_t SampleExtComputationInput(SdfPath const &computationId,
                                                    TfToken const &input, float startTime,
                                                    float endTime, size_t maxSampleCount,
                                                    float *sampleTimes, VtValue *sampleValues);
    HD_API virtual std::string GetExtComputationKernel(SdfPath const &computationId);
    HD_API virtual void InvokeExtComputation(SdfPath const &computationId,
                                             HdExtComputationContext *context);

    HD_API virtual HdPrimvarDescriptorVector GetPrimvarDescriptors(SdfPath const &id,
                                                                   HdInterpolation interpolation);
    HD_API virtual TfTokenVector GetTaskRenderTags(SdfPath const &taskId);

  private:
    HdRenderIndex *_index;
    SdfPath _delegateID;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
