#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/primvarField.h"

namespace cc {

/// How the points of curves make segments (UsdGeomBasisCurves: type and basis).
enum class CurveBasis { Linear, Bezier, BSpline, CatmullRom };

/// How curves end (UsdGeomBasisCurves: wrap).
enum class CurveWrap { Nonperiodic, Periodic, Pinned };

/// A batch of curves without its points.
struct CurveTopology {
    CurveBasis basis = CurveBasis::Linear;
    CurveWrap wrap = CurveWrap::Nonperiodic;
    /// Points of each curve; the points of all follow each other.
    std::vector<int> vertexCounts;
};

/// A value that segments are made of: that of a vertex, or beyond a pinned end twice that of a less
/// that of b.
struct CurveControl {
    static constexpr uint32_t kNone = 0xffffffffu;

    uint32_t a = 0, b = kNone;
};

/// Where the segments of curves find their values.
class CurveLayout {
  public:
    CurveLayout() = default;
    /// Curves whose count does not suit the basis get no segments.
    /// @param topology  without negative counts
    explicit CurveLayout(const CurveTopology& topology);

    size_t CurveCount() const { return _curves.size(); }
    size_t SegmentCount() const { return _curveOf.size(); }
    size_t VertexCount() const { return _vertexCount; }
    /// Elements of a varying primvar: one at each end of a segment.
    size_t VaryingCount() const { return _varyingCount; }
    /// Curves with vertices, but too few of them, or not as many as the basis asks for.
    size_t BadCount() const { return _badCount; }

    uint32_t CurveOf(uint32_t segment) const { return _curveOf[segment]; }
    /// The segments before and after one, or CurveControl::kNone.
    uint32_t Previous(uint32_t segment) const { return _Neighbour(segment, -1); }
    uint32_t Next(uint32_t segment) const { return _Neighbour(segment, 1); }
    /// The four values that a segment is made of; of a linear one the first two.
    void Controls(uint32_t segment, CurveControl controls[4]) const;
    /// The varying elements at the begin and at the end of a segment.
    void Varying(uint32_t segment, uint32_t ends[2]) const;

    CurveBasis Basis() const { return _basis; }
    size_t Bytes() const;

  private:
    struct Curve {
        uint32_t firstVertex, vertexCount, firstVarying, firstSegment, segmentCount;
    };

    uint32_t _Neighbour(uint32_t segment, int step) const;
    bool _IsPeriodic() const { return _wrap == CurveWrap::Periodic; }

    CurveBasis _basis = CurveBasis::Linear;
    CurveWrap _wrap = CurveWrap::Nonperiodic;
    std::vector<Curve> _curves;
    std::vector<uint32_t> _curveOf;
    size_t _vertexCount = 0, _varyingCount = 0, _badCount = 0;
};

/// Brings the four values of a segment from a basis into Bezier form; of a linear one the first
/// two.
void ToBezier(CurveBasis basis, float values[4]);

}  // namespace cc
