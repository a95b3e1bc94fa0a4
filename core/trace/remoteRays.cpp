#include "core/trace/remoteRays.h"

namespace cc {

bool IsRemote(const Surface& surface, const ObjectRays& rays) {
    const Vec3f lower = surface.Bounds().lower, upper = surface.Bounds().upper;
    int inside = 0;
    for (int i = 0; i < rays.count; ++i) {
        inside += rays.originX[i] >= lower.x && rays.originX[i] <= upper.x &&
                  rays.originY[i] >= lower.y && rays.originY[i] <= upper.y &&
                  rays.originZ[i] >= lower.z && rays.originZ[i] <= upper.z;
    }
    return inside == 0;
}

}  // namespace cc
