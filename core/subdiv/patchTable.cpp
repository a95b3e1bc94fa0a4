#include "core/subdiv/patchTable.h"

#include <algorithm>
#include <cassert>

namespace cc {

int PatchTable::IndexCount(uint32_t patch) const {
    switch (_patches[patch].kind) {
        case PatchKind::Regular: return 16;
        case PatchKind::Bilinear: return 4;
        case PatchKind::Irregular: return 8;
        case PatchKind::RegularTriangle: return 12;
        case PatchKind::IrregularTriangle: return 6;
        case PatchKind::FlatTriangle: return 3;
        case PatchKind::Extraordinary: break;
    }
    return 2 * _patches[patch].valence + 8;
}

RingTags PatchTable::TagsOf(const PatchRing& ring) const {
    const float* sharpness = &_sharpnesses[ring.firstSharpness];
    const float* const outside = sharpness + ring.faceCount + (ring.isClosed ? 0 : 1);
    RingTags tags;
    tags.edgeSharpness.assign(sharpness, outside);
    tags.outsideSharpness.assign(outside, outside + ring.outsideCount);
    if (_decay == SharpnessDecay::Chaikin) {
        const float* const far = outside + ring.outsideCount;
        const float* const seam = far + tags.edgeSharpness.size();
        tags.farSharpness.assign(far, seam);
        tags.seamSharpness.assign(seam, seam + ring.seamCount);
    }
    tags.vertexSharpness = ring.vertexSharpness;
    tags.isClosed = ring.isClosed;
    tags.outsideNeighborCount = ring.outsideNeighborCount;
    tags.decay = _decay;
    return tags;
}

std::vector<Vec3f> PatchTable::PatchPoints(const std::vector<Vec3f>& cageValues) const {
    assert(cageValues.size() == _cagePointCount);
    std::vector<Vec3f> points(PointCount());
    std::copy(cageValues.begin(), cageValues.end(), points.begin());
    const uint32_t* index = _stencilIndices.data();
    const float* weight = _stencilWeights.data();
    for (size_t i = 0; i < _stencilEnds.size(); ++i) {
        // Doubles keep a long sum from drifting between neighbours.
        double sum[3] = {0, 0, 0};
        const auto add = [&](double times) {
            const Vec3f& p = points[*index++];
            sum[0] += times * p.x;
            sum[1] += times * p.y;
            sum[2] += times * p.z;
        };
        if (_stencilEnds[i] & kExtrapolated) {
            add(2);
            add(-1);
        } else {
            const uint32_t* const end = _stencilIndices.data() + _stencilEnds[i];
            while (index < end) {
                add(*weight++);
            }
        }
        points[_cagePointCount + i] = {static_cast<float>(sum[0]), static_cast<float>(sum[1]),
                                       static_cast<float>(sum[2])};
    }
    return points;
}

bool PatchTable::_IsExtrapolatedFrom(uint32_t index, uint32_t a, uint32_t b) const {
    if (!_IsExtrapolated(index)) {
        return false;
    }
    const uint32_t end = _stencilEnds[index - _cagePointCount] & ~kExtrapolated;
    return _stencilIndices[end - 2] == a && _stencilIndices[end - 1] == b;
}

uint8_t PatchTable::_ExtrapolatedSides(const uint32_t* indices) const {
    // Of each side: its first outer point, the step along the side, and that into the patch.
    struct Side {
        PatchSide side;
        int first, along, inwards;
    };
    constexpr Side kSides[4] = {
        {kLowRow, 0, 1, 4}, {kHighRow, 12, 1, -4}, {kLowColumn, 0, 4, 1}, {kHighColumn, 3, 4, -1}};
    uint8_t sides = 0;
    for (const Side& side : kSides) {
        const auto isInner = [&](int i) {
            const int at = side.first + i * side.along;
            return _IsExtrapolatedFrom(indices[at], indices[at + side.inwards],
                                       indices[at + 2 * side.inwards]);
        };
        // At a corner between two such sides either may have been first.
        const auto isOuter = [&](int i) {
            return _IsExtrapolated(indices[side.first + i * side.along]);
        };
        if (isOuter(0) && isInner(1) && isInner(2) && isOuter(3)) {
            sides |= side.side;
        }
    }
    return sides;
}

FaceParameter PatchTable::ToFace(uint32_t patch, float u, float v) const {
    const Patch& p = _patches[patch];
    if (IsTriangle(patch)) {
        return {p.face, p.corner, u, v, true};
    }
    float cellU = u, cellV = v;
    switch (p.rotation) {
        case 1: cellU = 1 - v, cellV = u; break;
        case 2: cellU = 1 - u, cellV = 1 - v; break;
        case 3: cellU = v, cellV = 1 - u; break;
        default: break;
    }
    const float size = 1.0f / static_cast<float>(1 << (p.depth - p.isSubQuad));
    return {p.face, p.corner, (static_cast<float>(p.cellU) + cellU) * size,
            (static_cast<float>(p.cellV) + cellV) * size};
}

size_t PatchTable::Bytes() const {
    return _patches.capacity() * sizeof(Patch) + _indices.capacity() * sizeof(uint32_t) +
           _rings.capacity() * sizeof(PatchRing) + _sharpnesses.capacity() * sizeof(float) +
           _stencilEnds.capacity() * sizeof(uint32_t) +
           _stencilIndices.capacity() * sizeof(uint32_t) +
           _stencilWeights.capacity() * sizeof(float);
}

uint32_t PatchTable::AddPoint(const Stencil& stencil) {
    _stencilIndices.insert(_stencilIndices.end(), stencil.indices.begin(), stencil.indices.end());
    _stencilWeights.insert(_stencilWeights.end(), stencil.weights.begin(), stencil.weights.end());
    _stencilEnds.push_back(static_cast<uint32_t>(_stencilIndices.size()));
    return static_cast<uint32_t>(PointCount() - 1);
}

uint32_t PatchTable::AddExtrapolatedPoint(uint32_t a, uint32_t b) {
    _stencilIndices.push_back(a);
    _stencilIndices.push_back(b);
    _stencilEnds.push_back(static_cast<uint32_t>(_stencilIndices.size()) | kExtrapolated);
    return static_cast<uint32_t>(PointCount() - 1);
}

void PatchTable::AddPatch(Patch patch, const uint32_t* indices, int count) {
    patch.firstIndex = static_cast<uint32_t>(_indices.size());
    _indices.insert(_indices.end(), indices, indices + count);
    patch.extrapolatedSides =
        patch.kind == PatchKind::Regular ? _ExtrapolatedSides(indices) & 15 : 0;
    _patches.push_back(patch);
    _maxDepth = std::max(_maxDepth, static_cast<int>(patch.depth));
}

void PatchTable::AddOuterEdges(const EdgePoints& next, const EdgePoints& previous) {
    _indices.insert(_indices.end(), {next.a, next.b, previous.a, previous.b});
}

void PatchTable::Corners(uint32_t patch, uint32_t corners[4]) const {
    static constexpr int kRegular[4] = {5, 6, 10, 9}, kExtraordinary[4] = {0, 1, 2, 3};
    const uint32_t* indices = Indices(patch);
    const PatchKind kind = At(patch).kind;
    for (int i = 0; i < 4; ++i) {
        corners[i] = kind == PatchKind::Irregular ? RingIndices(Ring(indices[2 * i]))[0]
                     : kind == PatchKind::Regular ? indices[kRegular[i]]
                                                  : indices[kExtraordinary[i]];
    }
}

void PatchTable::EdgeEnds(uint32_t patch, EdgePoints edges[4]) const {
    uint32_t corners[4];
    Corners(patch, corners);
    for (int i = 0; i < 4; ++i) {
        edges[i] = {corners[i], corners[(i + 1) & 3]};
    }
    const Patch& p = At(patch);
    if (p.depth > 0) {
        const uint32_t* outer = Indices(patch) + IndexCount(patch);
        edges[p.outerCorner] = {outer[0], outer[1]};
        edges[(p.outerCorner + 3) & 3] = {outer[2], outer[3]};
    }
}

PolygonTriangle PatchTable::TriangleCorners(uint32_t patch) const {
    if (_patches[patch].kind != PatchKind::FlatTriangle) {
        return {0, 1, 2};
    }
    const uint32_t* const corners = Indices(patch) + 3;
    return {corners[0], corners[1], corners[2]};
}

void PatchTable::_SetTriangle(uint32_t* indices, const std::vector<uint32_t>& points,
                              const PolygonTriangle& triangle) {
    for (int i = 0; i < 3; ++i) {
        indices[i] = points[triangle[i]];
        indices[3 + i] = triangle[i];
    }
}

void PatchTable::AddPolygon(uint32_t face, const std::vector<uint32_t>& points,
                            const std::vector<PolygonTriangle>& triangles) {
    Patch patch{};
    patch.face = face;
    patch.kind = PatchKind::FlatTriangle;
    for (const PolygonTriangle& triangle : triangles) {
        uint32_t indices[6];
        _SetTriangle(indices, points, triangle);
        AddPatch(patch, indices, 6);
        ++patch.corner;
    }
}

void PatchTable::RecutPolygon(uint32_t firstPatch, const std::vector<uint32_t>& points,
                              const std::vector<PolygonTriangle>& triangles) {
    for (const PolygonTriangle& triangle : triangles) {
        _SetTriangle(&_indices[_patches[firstPatch++].firstIndex], points, triangle);
    }
}

uint32_t PatchTable::AddRing(PatchRing ring, const std::vector<uint32_t>& indices,
                             const std::vector<float>& sharpnesses) {
    ring.firstIndex = static_cast<uint32_t>(_indices.size());
    ring.firstSharpness = static_cast<uint32_t>(_sharpnesses.size());
    _indices.insert(_indices.end(), indices.begin(), indices.end());
    _sharpnesses.insert(_sharpnesses.end(), sharpnesses.begin(), sharpnesses.end());
    _rings.push_back(ring);
    return static_cast<uint32_t>(_rings.size() - 1);
}

void PatchTable::Finish() {
    _rings.shrink_to_fit();
    _sharpnesses.shrink_to_fit();
    _patches.shrink_to_fit();
    _indices.shrink_to_fit();
    _stencilEnds.shrink_to_fit();
    _stencilIndices.shrink_to_fit();
    _stencilWeights.shrink_to_fit();
}

}  // namespace cc
