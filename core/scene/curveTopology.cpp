#include "core/scene/curveTopology.h"

#include <algorithm>

namespace cc {
namespace {

/// Segments of a curve; 0 if the count does not suit.
uint32_t CountSegments(CurveBasis basis, CurveWrap wrap, uint32_t vertices) {
    const bool isPeriodic = wrap == CurveWrap::Periodic;
    switch (basis) {
        case CurveBasis::Linear:
            return isPeriodic ? (vertices >= 3 ? vertices : 0) : vertices - (vertices > 0);
        case CurveBasis::Bezier:
            if (isPeriodic) {
                return vertices % 3 == 0 ? vertices / 3 : 0;
            }
            return vertices >= 4 && vertices % 3 == 1 ? (vertices - 1) / 3 : 0;
        case CurveBasis::BSpline:
        case CurveBasis::CatmullRom: break;
    }
    if (isPeriodic) {
        return vertices >= 3 ? vertices : 0;
    }
    if (wrap == CurveWrap::Pinned) {
        return vertices - (vertices > 0);
    }
    return vertices >= 4 ? vertices - 3 : 0;
}

}  // namespace

CurveLayout::CurveLayout(const CurveTopology& topology)
    : _basis(topology.basis), _wrap(topology.wrap) {
    for (const int count : topology.vertexCounts) {
        const auto vertices = static_cast<uint32_t>(count);
        Curve curve{static_cast<uint32_t>(_vertexCount), vertices,
                    static_cast<uint32_t>(_varyingCount), static_cast<uint32_t>(_curveOf.size()),
                    CountSegments(_basis, _wrap, vertices)};
        _badCount += vertices > 0 && curve.segmentCount == 0;
        _curveOf.insert(_curveOf.end(), curve.segmentCount, static_cast<uint32_t>(_curves.size()));
        _vertexCount += vertices;
        _varyingCount += curve.segmentCount + (_IsPeriodic() || vertices == 0 ? 0 : 1);
        _curves.push_back(curve);
    }
}

uint32_t CurveLayout::_Neighbour(uint32_t segment, int step) const {
    const Curve& curve = _curves[_curveOf[segment]];
    const uint32_t last = curve.segmentCount - 1, at = segment - curve.firstSegment;
    if (at == (step < 0 ? 0 : last)) {
        return _IsPeriodic() ? curve.firstSegment + (step < 0 ? last : 0) : CurveControl::kNone;
    }
    return segment + static_cast<uint32_t>(step);
}

void CurveLayout::Controls(uint32_t segment, CurveControl controls[4]) const {
    const Curve& curve = _curves[_curveOf[segment]];
    const auto count = static_cast<int>(curve.vertexCount);
    const int at = static_cast<int>(segment - curve.firstSegment);
    const bool hasPhantoms = _wrap == CurveWrap::Pinned &&
                             (_basis == CurveBasis::BSpline || _basis == CurveBasis::CatmullRom);
    const int first = _basis == CurveBasis::Bezier ? 3 * at : hasPhantoms ? at - 1 : at;
    const auto vertex = [&](int i) { return curve.firstVertex + static_cast<uint32_t>(i); };
    for (int i = 0; i < 4; ++i) {
        const int index = first + i;
        if (hasPhantoms && index < 0) {
            controls[i] = {vertex(0), vertex(1)};
        } else if (hasPhantoms && index >= count) {
            controls[i] = {vertex(count - 1), vertex(count - 2)};
        } else {
            // Linear segments have no more than two.
            controls[i] = {vertex(_IsPeriodic() ? index % count : std::min(index, count - 1))};
        }
    }
}

void CurveLayout::Varying(uint32_t segment, uint32_t ends[2]) const {
    const Curve& curve = _curves[_curveOf[segment]];
    const uint32_t at = segment - curve.firstSegment;
    const bool isLast = at + 1 == curve.segmentCount;
    ends[0] = curve.firstVarying + at;
    ends[1] = curve.firstVarying + (_IsPeriodic() && isLast ? 0 : at + 1);
}

size_t CurveLayout::Bytes() const {
    return _curves.capacity() * sizeof(Curve) + _curveOf.capacity() * sizeof(uint32_t);
}

void ToBezier(CurveBasis basis, float values[4]) {
    const float a = values[0], b = values[1], c = values[2], d = values[3];
    switch (basis) {
        case CurveBasis::Linear:
            values[1] = (2 * a + b) / 3;
            values[2] = (a + 2 * b) / 3;
            values[3] = b;
            return;
        case CurveBasis::Bezier: return;
        case CurveBasis::BSpline:
            values[0] = (a + 4 * b + c) / 6;
            values[1] = (2 * b + c) / 3;
            values[2] = (b + 2 * c) / 3;
            values[3] = (b + 4 * c + d) / 6;
            return;
        case CurveBasis::CatmullRom:
            values[0] = b;
            values[1] = b + (c - a) / 6;
            values[2] = c - (d - b) / 6;
            values[3] = c;
            return;
    }
}

}  // namespace cc
