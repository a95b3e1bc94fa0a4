#pragma once

#include "core/math/box.h"
#include "core/trace/objectRays.h"

namespace cc {

/// Interval arithmetic over a packet: one test culls a box for all rays (paper, section 3.6).
///
/// All rays of a coherent packet run the same way along some axis k. Written as functions of the
/// distance along k, their other two coordinates are origin + slope * distance, with origins and
/// slopes in intervals; a box is missed when the interval of a coordinate, over the box's range of
/// distances, misses the box. A packet without such an axis culls nothing.
class PacketInterval {
  public:
    explicit PacketInterval(const ObjectRays& rays);

    /// Reads the far end of the packet anew, after hits have shortened rays.
    void UpdateReach(const ObjectRays& rays);

    bool IsValid() const { return _axis >= 0; }

    // For vectorized tests of many boxes:

    int Axis() const { return _axis; }
    /// True if the rays run towards smaller coordinates: distances are counted along -axis.
    bool IsReversed() const { return _reversed; }
    float OriginMin() const { return _originMin; }
    float OriginMax() const { return _originMax; }
    /// Smallest and largest distance along the axis that any ray covers.
    float Nearest() const { return _nearest; }
    float Reach() const { return _reach; }

    /// A coordinate of all rays at distance s along the axis:
    /// [originMin + min(slopeMin * s), originMax + max(slopeMax * s)].
    struct Slab {
        int axis;
        float originMin, originMax, slopeMin, slopeMax;
    };
    const Slab& Side(int i) const { return _sides[i]; }

    /// True if no ray of the packet hits the box.
    bool Culls(const Box3f& box) const;

  private:
    void _ChooseAxis(const ObjectRays& rays);

    int _axis = -1;
    bool _reversed = false;
    float _originMin = 0, _originMax = 0;
    float _nearest = 0, _reach = 0;
    Slab _sides[2] = {};
};

}  // namespace cc
