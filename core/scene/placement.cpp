#include "core/scene/placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "core/scene/largestCoordinate.h"

namespace cc {
namespace {

bool HasUsableEntries(const AffineTransform& transform) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            if (!(std::fabs(transform(row, column)) <= kLargestCoordinate)) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

bool Placement::SetTransform(Moving<AffineTransform> objectToWorld) {
    std::swap(_objectToWorld, objectToWorld);
    _NoteTimes();
    return _objectToWorld != objectToWorld;
}

void Placement::SetInstances(Moving<std::vector<AffineTransform>> instanceToWorld) {
    _instances = std::move(instanceToWorld);
    _NoteTimes();
}

bool Placement::ClearInstances() {
    const bool wasInstanced = std::exchange(_instances, std::nullopt).has_value();
    _NoteTimes();
    return wasInstanced;
}

AffineTransform Placement::_ObjectToWorld(size_t index, float time) const {
    const auto own = _objectToWorld.At(time);
    const AffineTransform objectToWorld =
        own.weight == 0 ? own.first : AffineTransform::Lerp(own.first, own.second, own.weight);
    if (!_instances) {
        return objectToWorld;
    }
    const auto of = _instances->At(time);
    return (of.weight == 0 ? of.first[index]
                           : AffineTransform::Lerp(of.first[index], of.second[index], of.weight)) *
           objectToWorld;
}

void Placement::_NoteTimes() {
    _times = _objectToWorld.Times();
    if (_instances) {
        _times.insert(_times.end(), _instances->Times().begin(), _instances->Times().end());
    }
    _times.push_back(0);
    std::sort(_times.begin(), _times.end());
    _times.erase(std::unique(_times.begin(), _times.end()), _times.end());
}

/// Maps between two poses take a point to a place between those that the poses take it to; where
/// two such maps follow each other, that holds for each.
Box3f Placement::WorldBox(size_t index, const Box3f& box) const {
    if (!IsMoving()) {
        const AffineTransform objectToWorld = _ObjectToWorld(index, 0);
        return objectToWorld == AffineTransform() ? box : objectToWorld.Box(box);
    }
    Box3f outer;
    for (const AffineTransform& pose : _objectToWorld.Poses()) {
        outer.Extend(pose.Box(box));
    }
    if (!_instances) {
        return outer;
    }
    Box3f world;
    for (const std::vector<AffineTransform>& pose : _instances->Poses()) {
        world.Extend(pose[index].Box(outer));
    }
    return world;
}

Placement::Obstacle Placement::Place(const Geometry& geometry, size_t index, float time,
                                     Instance* instance) const {
    const AffineTransform objectToWorld = _ObjectToWorld(index, time);
    AffineTransform worldToObject;
    if (!HasUsableEntries(objectToWorld) || !objectToWorld.Invert(&worldToObject) ||
        !HasUsableEntries(worldToObject)) {
        return Obstacle::Singular;
    }
    const Box3f bounds = objectToWorld.Box(geometry.Bounds());
    if (!bounds.IsEmpty() && !(IsUsable(bounds.lower) && IsUsable(bounds.upper))) {
        return Obstacle::TooLarge;
    }
    *instance = {&geometry, objectToWorld, worldToObject};
    return Obstacle::None;
}

Placement::Obstacle Placement::FindObstacle(const Geometry& geometry, size_t index) const {
    for (const float time : _times) {
        Instance instance;
        const Obstacle obstacle = Place(geometry, index, time, &instance);
        if (obstacle != Obstacle::None) {
            return obstacle;
        }
    }
    return Obstacle::None;
}

Placement::Obstacles Placement::FindObstacles(const Geometry& geometry) const {
    constexpr size_t kGrainSize = 1024;
    return tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, Count(), kGrainSize), Obstacles{},
        [&](const tbb::blocked_range<size_t>& part, Obstacles sum) {
            for (size_t i = part.begin(); i < part.end(); ++i) {
                const Obstacle obstacle = FindObstacle(geometry, i);
                sum.singular += obstacle == Obstacle::Singular;
                sum.tooLarge += obstacle == Obstacle::TooLarge;
            }
            return sum;
        },
        [](const Obstacles& a, const Obstacles& b) {
            return Obstacles{a.singular + b.singular, a.tooLarge + b.tooLarge};
        });
}

std::vector<std::string> Placement::Describe(const Obstacles& obstacles,
                                             const std::string& is) const {
    const std::string leftOut = "; " + is + " left out";
    std::vector<std::string> lines;
    if (obstacles.singular > 0) {
        lines.push_back(_DescribeOne(obstacles.singular,
                                     "has a singular or non-finite transform" + leftOut,
                                     "have a singular or non-finite transform"));
    }
    if (obstacles.tooLarge > 0) {
        lines.push_back(_DescribeOne(obstacles.tooLarge, "is too large once transformed" + leftOut,
                                     "are too large once transformed"));
    }
    return lines;
}

size_t Placement::Bytes() const {
    size_t bytes = 0;
    if (_instances) {
        for (const std::vector<AffineTransform>& pose : _instances->Poses()) {
            bytes += pose.capacity() * sizeof(AffineTransform);
        }
    }
    return bytes;
}

std::string Placement::_DescribeOne(size_t count, const std::string& ofOne,
                                    const char* ofInstances) const {
    return IsInstanced() ? std::to_string(count) + " of " + std::to_string(Count()) +
                               " instances " + ofInstances + "; they are left out"
                         : ofOne;
}

}  // namespace cc
