#ifndef PXR_IMAGING_HD_CAMERA_H
#define PXR_IMAGING_HD_CAMERA_H

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/range1f.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec4d.h"
#include "pxr/base/tf/token.h"
#include "pxr/imaging/cameraUtil/conformWindow.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/sprim.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

/// A physical camera. Hydra's own Sync fills it in; lengths are in the scene's unit, not tenths.
class HdCamera : public HdSprim {
  public:
    using ClipPlanesVector = std::vector<GfVec4d>;

    enum Projection { Perspective = 0, Orthographic = 1 };

    enum DirtyBits : HdDirtyBits {
        Clean = 0,
        DirtyTransform = 1 << 0,
        DirtyParams = 1 << 1,
        DirtyClipPlanes = 1 << 2,
        DirtyWindowPolicy = 1 << 3,
        AllDirty = DirtyTransform | DirtyParams | DirtyClipPlanes | DirtyWindowPolicy
    };

    HD_API HdCamera(SdfPath const &id);
    HD_API ~HdCamera() override;

    HD_API void Sync(HdSceneDelegate *sceneDelegate, HdRenderParam *renderParam,
                     HdDirtyBits *dirtyBits) override;
    HD_API HdDirtyBits GetInitialDirtyBitsMask() const override;

    /// The projection of the whole aperture, before it conforms to any image.
    HD_API GfMatrix4d ComputeProjectionMatrix() const;

    // The frustum.
    GfMatrix4d const &GetTransform() const { return _transform; }
    Projection GetProjection() const { return _projection; }
    float GetHorizontalAperture() const { return _horizontalAperture; }
    float GetVerticalAperture() const { return _verticalAperture; }
    float GetHorizontalApertureOffset() const { return _horizontalApertureOffset; }
    float GetVerticalApertureOffset() const { return _verticalApertureOffset; }
    float GetFocalLength() const { return _focalLength; }
    GfRange1f const &GetClippingRange() const { return _clippingRange; }
    ClipPlanesVector const &GetClipPlanes() const { return _clipPlanes; }

    // Depth of field.
    float GetFStop() const { return _fStop; }
    float GetFocusDistance() const { return _focusDistance; }
    bool GetFocusOn() const { return _focusOn; }
    float GetDofAspect() const { return _dofAspect; }

    // Two half lenses of other focus.
    int GetSplitDiopterCount() const { return _splitDiopterCount; }
    float GetSplitDiopterAngle() const { return _splitDiopterAngle; }
    float GetSplitDiopterOffset1() const { return _splitDiopterOffset1; }
    float GetSplitDiopterWidth1() const { return _splitDiopterWidth1; }
    float GetSplitDiopterFocusDistance1() const { return _splitDiopterFocusDistance1; }
    float GetSplitDiopterOffset2() const { return _splitDiopterOffset2; }
    float GetSplitDiopterWidth2() const { return _splitDiopterWidth2; }
    float GetSplitDiopterFocusDistance2() const { return _splitDiopterFocusDistance2; }

    // The shutter, in frames relative to the current one, and exposure. The linear scale, newer
    // than 24.11, sums up all that an image has to be multiplied by.
    double GetShutterOpen() const { return _shutterOpen; }
    double GetShutterClose() const { return _shutterClose; }
    float GetExposure() const { return _exposure; }
    float GetLinearExposureScale() const { return _linearExposureScale; }

    // The lens's distortion.
    TfToken GetLensDistortionType() const { return _lensDistortionType; }
    float GetLensDistortionK1() const { return _lensDistortionK1; }
    float GetLensDistortionK2() const { return _lensDistortionK2; }
    GfVec2f const &GetLensDistortionCenter() const { return _lensDistortionCenter; }
    float GetLensDistortionAnaSq() const { return _lensDistortionAnaSq; }
    GfVec2f const &GetLensDistortionAsym() const { return _lensDistortionAsym; }
    float GetLensDistortionScale() const { return _lensDistortionScale; }
    float GetLensDistortionIor() const { return _lensDistortionIor; }

    CameraUtilConformWindowPolicy const &GetWindowPolicy() const { return _windowPolicy; }

  protected:
    GfMatrix4d _transform;
    Projection _projection;
    float _horizontalAperture;
    float _verticalAperture;
    float _horizontalApertureOffset;
    float _verticalApertureOffset;
    float _focalLength;
    GfRange1f _clippingRange;
    ClipPlanesVector _clipPlanes;
    float _fStop;
    float _focusDistance;
    bool _focusOn;
    float _dofAspect;
    int _splitDiopterCount;
    float _splitDiopterAngle;
    float _splitDiopterOffset1;
    float _splitDiopterWidth1;
    float _splitDiopterFocusDistance1;
    float _splitDiopterOffset2;
    float _splitDiopterWidth2;
    float _splitDiopterFocusDistance2;
    double _shutterOpen;
    double _shutterClose;
    float _exposure;
    float _exposureTime;
    float _exposureIso;
    float _exposureFStop;
    float _exposureResponsivity;
    float _linearExposureScale;
    TfToken _lensDistortionType;
    float _lensDistortionK1;
    float _lensDistortionK2;
    GfVec2f _lensDistortionCenter;
    float _lensDistortionAnaSq;
    GfVec2f _lensDistortionAsym;
    float _lensDistortionScale;
    float _lensDistortionIor;
    CameraUtilConformWindowPolicy _windowPolicy;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
