#include "core/trace/instance.h"

namespace cc {

InstanceBvh::InstanceBvh(std::vector<Instance> instances) : _instances(std::move(instances)) {
    std::vector<Box3f> boxes;
    boxes.reserve(_instances.size());
    for (Instance& instance : _instances) {
        instance.isInPlace = instance.objectToWorld == AffineTransform();
        boxes.push_back(instance.objectToWorld.Box(instance.surface->Bounds()));
    }
    _bvh = Bvh(boxes);
}

}  // namespace cc
