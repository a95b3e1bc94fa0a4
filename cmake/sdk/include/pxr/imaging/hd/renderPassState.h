#ifndef PXR_IMAGING_HD_RENDER_PASS_STATE_H
#define PXR_IMAGING_HD_RENDER_PASS_STATE_H

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/vec4d.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/imaging/cameraUtil/framing.h"
#include "pxr/imaging/hd/aov.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/imaging/hd/resourceRegistry.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <memory>
#include <optional>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

class HdCamera;

using HdRenderPassStateSharedPtr = std::shared_ptr<class HdRenderPassState>;

/// What a pass is to render: the camera, the part of its picture, and the outputs.
class HdRenderPassState {
  public:
    using ClipPlanesVector = std::vector<GfVec4d>;

    HD_API HdRenderPassState();
    HD_API virtual ~HdRenderPassState();
    HD_API virtual void Prepare(HdResourceRegistrySharedPtr const &resourceRegistry);

    // Called by applications.
    HD_API void SetCamera(HdCamera const *camera);
    HD_API void SetFraming(CameraUtilFraming const &framing);
    HD_API void SetViewport(GfVec4d const &viewport);
    HD_API void SetOverrideWindowPolicy(
        std::optional<CameraUtilConformWindowPolicy> const &overrideWindowPolicy);
    HD_API void SetAovBindings(HdRenderPassAovBindingVector const &aovBindings);

    /// Null when an application gives matrices only; then the virtual getters below have them.
    HdCamera const *GetCamera() const { return _camera; }

    /// Valid, or else the viewport counts.
    CameraUtilFraming const &GetFraming() const { return _framing; }
    GfVec4f const &GetViewport() const { return _viewport; }

    std::optional<CameraUtilConformWindowPolicy> const &GetOverrideWindowPolicy() const {
        return _overrideWindowPolicy;
    }
    HD_API CameraUtilConformWindowPolicy GetWindowPolicy() const;

    HD_API virtual GfMatrix4d GetWorldToViewMatrix() const;
    HD_API virtual GfMatrix4d GetProjectionMatrix() const;
    HD_API GfMatrix4d GetImageToWorldMatrix() const;
    HD_API virtual ClipPlanesVector const &GetClipPlanes() const;

    HD_API HdRenderPassAovBindingVector const &GetAovBindings() const;
    HD_API HdRenderPassAovBindingVector const &GetAovInputBindings() const;

  protected:
    HdCamera const *_camera;
    GfVec4f _viewport;
    CameraUtilFraming _framing;
    std::optional<CameraUtilConformWindowPolicy> _overrideWindowPolicy;

  private:
    // What a rasterizer is told follows, down to the end of the object.
    alignas(8) unsigned char _rasterizerOnly[0x180 - 0x50];
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
