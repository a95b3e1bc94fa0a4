#include "levelPicture.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "core/render/cameraRays.h"
#include "core/subdiv/limitPoint.h"
#include "core/trace/gridStitch.h"
#include "core/trace/instanceLevels.h"
#include "core/trace/tracer.h"

namespace {

std::array<float, 3> Show(const cc::Instance& instance, const cc::LevelMetric& metric,
                          const cc::RayPacket& ray, const cc::HitPacket& hit) {
    const cc::PatchTable& patches = cc::SurfaceOf(instance).Patches();
    const uint32_t patch = hit.patch[0];
    const cc::PatchLevels levels = cc::InstanceLevels(metric, instance).Of(patch);
    const int side = 1 << (levels.Finest() - patches.At(patch).depth);
    const bool isInFan =
        cc::GridStitch(levels, {0, 0, 1}, side, false).IsInFan({hit.u[0], hit.v[0]});
    const cc::Vec3f normal =
        EvaluateLimit(patches, patch, cc::SurfaceOf(instance).PatchPoints().data(), hit.u[0],
                      hit.v[0])
            .normal;
    const cc::Vec3f direction{ray.directionX[0], ray.directionY[0], ray.directionZ[0]};
    const float facing = std::abs(
        Dot(Normalize(instance.worldToObject.NormalByInverse(normal)), Normalize(direction)));
    return {static_cast<float>(levels.interior), isInFan ? 1.0f : 0.0f, facing};
}

}  // namespace

cc::Camera CameraFromAbove(const cc::Box3f& bounds) {
    cc::Camera camera;
    const cc::Vec3f size = bounds.Size(), centre = bounds.Center();
    // Right is +x, up in the picture -z.
    camera.cameraToWorld = cc::AffineTransform(
        {{{1, 0, 0, centre.x}, {0, 0, 1, bounds.upper.y + size.y}, {0, -1, 0, centre.z}}});
    camera.orthographic = true;
    const float half = 0.5f * std::max(size.x, size.z);
    camera.windowLower = {-half, -half};
    camera.windowUpper = {half, half};
    camera.clipNear = 0.5f * size.y;
    camera.clipFar = 3 * size.y;
    return camera;
}

void WriteLevelPicture(const cc::Scene& scene, const cc::LevelMetric& levels,
                       const cc::Camera& camera, int size, const std::string& path) {
    const cc::CameraRays rays(camera, size, size);
    const auto tracer = MakeTracer(cc::TracerKind::Packet, levels);
    std::vector<std::array<float, 3>> pixels;
    cc::TraceStatistics statistics;
    for (int row = size - 1; row >= 0; --row) {
        for (int column = 0; column < size; ++column) {
            cc::RayPacket ray;
            ray.count = 1;
            rays.SetRay(column + 0.5, row + 0.5, 0, &ray);
            cc::HitPacket hit;
            tracer->Intersect(scene.Instances(), &ray, &hit, &statistics);
            const bool isHit = hit.instance[0] != cc::kNoHit;
            pixels.push_back(
                isHit ? Show(scene.Instances().Instances()[hit.instance[0]], levels, ray, hit)
                      : std::array<float, 3>{-1, 0, 0});
        }
    }
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(pixels.data()),
               static_cast<std::streamsize>(pixels.size() * sizeof(pixels[0])));
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + path);
    }
}
