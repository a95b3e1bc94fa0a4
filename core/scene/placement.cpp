#include "core/scene/placement.h"

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

bool Placement::SetTransform(const AffineTransform& objectToWorld) {
    return std::exchange(_objectToWorld, objectToWorld) != objectToWorld;
}

void Placement::SetInstances(std::vector<AffineTransform> instanceToWorld) {
    _instances = std::move(instanceToWorld);
}

bool Placement::ClearInstances() { return std::exchange(_instances, std::nullopt).has_value(); }

Placement::Obstacle Placement::Place(const Geometry& geometry, size_t index,
                                     Instance* instance) const {
    const AffineTransform objectToWorld =
        _instances ? (*_instances)[index] * _objectToWorld : _objectToWorld;
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

Placement::Obstacles Placement::FindObstacles(const Geometry& geometry) const {
    constexpr size_t kGrainSize = 1024;
    return tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, Count(), kGrainSize), Obstacles{},
        [&](const tbb::blocked_range<size_t>& part, Obstacles sum) {
            for (size_t i = part.begin(); i < part.end(); ++i) {
                Instance instance;
                const Obstacle obstacle = Place(geometry, i, &instance);
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

std::string Placement::_DescribeOne(size_t count, const std::string& ofOne,
                                    const char* ofInstances) const {
    return IsInstanced() ? std::to_string(count) + " of " + std::to_string(Count()) +
                               " instances " + ofInstances + "; they are left out"
                         : ofOne;
}

}  // namespace cc
