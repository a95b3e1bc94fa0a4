#include "core/scene/sceneText.h"

#include <unordered_set>

namespace cc {
namespace {

void WriteLight(const Light& light, TextWriter* out) {
    const bool isDistant = light.kind == Light::Kind::Distant;
    out->Begin(isDistant ? "light distant" : "light sphere");
    if (isDistant) {
        out->Write("direction", light.direction);
    } else {
        out->Write("position", light.position);
    }
    out->Write("power", light.power);
    out->Write("castsShadows", light.castsShadows);
    out->End();
}

}  // namespace

void WriteText(const Scene& scene, TextWriter* out) {
    const std::unordered_set<const Shape*> shown(scene.ShownShapes().begin(),
                                                 scene.ShownShapes().end());
    for (const auto& shape : scene.Shapes()) {
        shape->WriteText(shown.count(shape.get()) != 0, out);
    }
    for (const auto& light : scene.Lights()) {
        WriteLight(*light, out);
    }
}

void WriteText(const Camera& camera, TextWriter* out) {
    out->Begin("camera");
    out->Write("projection", camera.orthographic ? "orthographic" : "perspective");
    if (camera.motion.IsMoving()) {
        out->Write("cameraToWorld", camera.motion);
    } else {
        out->Write("cameraToWorld", camera.cameraToWorld);
    }
    out->Write("windowLower", camera.windowLower);
    out->Write("windowUpper", camera.windowUpper);
    if (camera.isCrop) {
        out->Write("wholeLower", camera.wholeLower);
        out->Write("wholeUpper", camera.wholeUpper);
    }
    out->Write("clippingRange", Vec2f{camera.clipNear, camera.clipFar});
    for (const ClipPlane& plane : camera.clipPlanes) {
        out->Write("clippingPlane",
                   TextWriter::Text(plane.normal) + " " + TextWriter::Text(plane.offset));
    }
    out->Write("lensRadius", camera.lensRadius);
    out->Write("focusDistance", camera.focusDistance);
    out->Write("exposure", camera.exposure);
    out->Write("shutter", Vec2f{camera.shutterOpen, camera.shutterClose});
    out->End();
}

}  // namespace cc
