#ifndef HDCC_CAMERA_H
#define HDCC_CAMERA_H

#include "core/math/transform.h"
#include "core/scene/moving.h"

#include "pxr/imaging/hd/camera.h"
#include "pxr/pxr.h"

#include "hdCC/shutter.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A camera. The render pass reads it through the pass state, but for how it moves, which Hydra's
/// own class leaves out.
class HdCCCamera final : public HdCamera {
  public:
    explicit HdCCCamera(SdfPath const &id) : HdCamera(id) {}

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) override;

    /// Where the camera is while a shutter is open.
    cc::Moving<cc::AffineTransform> SampleTransform(HdCCShutter const &shutter) const;

  private:
    HdSceneDelegate *_delegate = nullptr;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
