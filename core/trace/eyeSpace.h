#pragma once

#include <array>

#include "core/math/vec.h"
#include "core/trace/instance.h"

namespace cc {

/// From the space of an instance to that of the world around an eye: floats keep their precision
/// where it matters, however far away from the origin that is.
class EyeSpace {
  public:
    EyeSpace(const Instance& instance, const std::array<double, 3>& eye);

    Vec3f FromObject(const Vec3f& p) const {
        return {Dot(_rows[0], p) + _offset.x, Dot(_rows[1], p) + _offset.y,
                Dot(_rows[2], p) + _offset.z};
    }
    /// The most that a length grows by, or a little more.
    float Stretch() const { return _stretch; }

  private:
    Vec3f _rows[3], _offset;
    float _stretch;
};

}  // namespace cc
