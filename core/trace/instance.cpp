#include "core/trace/instance.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include <tbb/parallel_for.h>

namespace cc {
namespace {

/// How many parts there are at most: so many for each instance, and so many more than instances.
constexpr size_t kMostPartsEach = 128, kMostMoreParts = size_t(1) << 18;

/// A part, and its bounds in the world.
struct PlacedPart {
    InstancePart part;
    Box3f box;
};

/// Opens instances into parts, the largest first.
class PartOpener {
  public:
    PartOpener(const std::vector<Instance>& instances, const InstanceBvh::WorldBox& worldBox)
        : _instances(instances), _worldBox(worldBox) {
        for (uint32_t i = 0; i < instances.size(); ++i) {
            const Bvh& bvh = instances[i].geometry->PrimitiveBvh();
            if (!bvh.IsEmpty()) {
                _Add({i, 0, InstancePart::kWhole}, bvh.Bounds());
            }
        }
    }

    /// Returns the parts in an order of their own.
    std::vector<PlacedPart> Open(size_t most) {
        while (!_inner.empty() && _inner.size() + _parts.size() + kBvhWidth <= most) {
            const InstancePart opened = _inner.top().placed.part;
            _inner.pop();
            const uint32_t index = _Child(opened);
            const BvhNode& node = _Nodes(opened)[index];
            for (int slot = 0; slot < node.childCount; ++slot) {
                _Add({opened.instance, index, slot}, node.ChildBox(slot));
            }
        }
        for (; !_inner.empty(); _inner.pop()) {
            _parts.push_back(_inner.top().placed);
        }
        const auto key = [](const PlacedPart& placed) {
            return std::tie(placed.part.instance, placed.part.node, placed.part.slot);
        };
        std::sort(_parts.begin(), _parts.end(),
                  [&](const PlacedPart& a, const PlacedPart& b) { return key(a) < key(b); });
        return std::move(_parts);
    }

  private:
    /// A part that can be opened.
    struct Inner {
        float size;
        PlacedPart placed;

        bool operator<(const Inner& other) const { return size < other.size; }
    };

    const std::vector<BvhNode>& _Nodes(const InstancePart& part) const {
        return _instances[part.instance].geometry->PrimitiveBvh().Nodes();
    }
    uint32_t _Child(const InstancePart& part) const {
        return part.slot == InstancePart::kWhole ? part.node
                                                 : _Nodes(part)[part.node].child[part.slot];
    }

    void _Add(const InstancePart& part, const Box3f& box) {
        const Box3f placed = _worldBox(part.instance, box);
        if ((_Child(part) & kBvhLeaf) != 0) {
            _parts.push_back({part, placed});
            return;
        }
        const float area = placed.HalfArea();
        _inner.push({area > 0 ? area : 0, {part, placed}});  // not so if it is not a number
    }

    const std::vector<Instance>& _instances;
    const InstanceBvh::WorldBox& _worldBox;
    std::priority_queue<Inner> _inner;
    std::vector<PlacedPart> _parts;
};

}  // namespace

InstanceBvh::InstanceBvh(std::vector<Instance> instances) : _instances(std::move(instances)) {
    _Build([&](size_t i, const Box3f& box) {
        const Instance& instance = _instances[i];
        return instance.isInPlace ? box : instance.objectToWorld.Box(box);
    });
}

InstanceBvh::InstanceBvh(std::vector<Instance> instances, const WorldBox& worldBox)
    : _instances(std::move(instances)) {
    _Build(worldBox);
}

void InstanceBvh::Move(size_t index, const AffineTransform& objectToWorld,
                       const AffineTransform& worldToObject) {
    Instance& instance = _instances[index];
    instance.objectToWorld = objectToWorld;
    instance.worldToObject = worldToObject;
    instance.isInPlace = objectToWorld == AffineTransform();
}

void InstanceBvh::_Build(const WorldBox& worldBox) {
    std::vector<Box3f> boxes(_instances.size());
    tbb::parallel_for(size_t(0), _instances.size(), [&](size_t i) {
        Instance& instance = _instances[i];
        instance.isInPlace = instance.objectToWorld == AffineTransform();
        boxes[i] = worldBox(i, instance.geometry->Bounds());
    });
    _bvh = Bvh(boxes);

    const size_t count = _instances.size();
    const std::vector<PlacedPart> parts =
        PartOpener(_instances, worldBox)
            .Open(std::min(kMostPartsEach * count, kMostMoreParts + count));
    boxes.clear();
    for (const PlacedPart& placed : parts) {
        _parts.push_back(placed.part);
        boxes.push_back(placed.box);
    }
    _partBvh = Bvh(boxes);
}

}  // namespace cc
