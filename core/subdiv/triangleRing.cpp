#include "core/subdiv/triangleRing.h"

#include <cassert>
#include <cmath>

namespace cc {
namespace {

/// Weight of each neighbour of a smooth vertex in a subdivision step (Loop 1987).
double NeighborWeight(int valence) {
    constexpr double kTwoPi = 6.28318530717958647692;
    const double beta = 0.375 + 0.25 * std::cos(kTwoPi / valence);
    return (0.625 - beta * beta) / valence;
}

}  // namespace

void TriangleRing::RegularNeighbors(int face, Vec3f neighbors[6]) const {
    Vec3f all[6];
    for (size_t j = 0; j < edges.size(); ++j) {
        all[j] = edges[j];
    }
    if (!isClosed && FaceCount() == 3) {
        all[4] = (center + edges[3]) - edges[2];
        all[5] = (center + edges[0]) - edges[1];
    } else if (!isClosed) {
        assert(FaceCount() == 1);
        all[2] = (center + edges[1]) - edges[0];
        all[3] = center * 2 - edges[0];
        all[4] = center * 2 - edges[1];
        all[5] = (center + edges[0]) - edges[1];
    }
    for (int k = 0; k < 6; ++k) {
        neighbors[k] = all[(face + k) % 6];
    }
}

TriangleRing TriangleRing::Subdivide() const {
    TriangleRing child;
    static_cast<RingTags&>(child) = Decayed();
    for (int j = 0; j < static_cast<int>(edges.size()); ++j) {
        child.edges.push_back(_EdgePoint(j, EdgeWeight(j, child)));
    }
    child.center = _VertexPoint(*this);
    if (VertexRule() != child.VertexRule()) {
        const float weight = FractionalWeight(child);
        child.center = child.center * weight + _VertexPoint(child) * (1 - weight);
    }
    return child;
}

Vec3f TriangleRing::_EdgePoint(int edge, float sharpness) const {
    const Vec3f ends = center + edges[edge];
    if (sharpness == 1) {
        return ends * 0.5f;
    }
    const Vec3f smooth = ends * 0.375f + (edges[Wrap(edge - 1)] + edges[Wrap(edge + 1)]) * 0.125f;
    return sharpness > 0 ? smooth * (1 - sharpness) + ends * (0.5f * sharpness) : smooth;
}

/// @param tags  whose rule to follow: this ring's, or those of a step later
Vec3f TriangleRing::_VertexPoint(const RingTags& tags) const {
    if (tags.VertexRule() != Rule::Smooth) {
        return _SharpVertexPoint(tags);
    }
    const double weight = NeighborWeight(FaceCount());
    return center * static_cast<float>(1 - FaceCount() * weight) +
           _EdgeSum() * static_cast<float>(weight);
}

Vec3f TriangleRing::_EdgeSum() const {
    Vec3f sum;
    for (const Vec3f& p : edges) {
        sum += p;
    }
    return sum;
}

Vec3f TriangleRing::_SmoothLimit() const {
    // The left eigenvector of the subdivision matrix to its eigenvalue 1.
    const double n = FaceCount(), weight = 1 / (n + 0.375 / NeighborWeight(FaceCount()));
    return center * static_cast<float>(1 - n * weight) + _EdgeSum() * static_cast<float>(weight);
}

Vec3f TriangleRing::_SmoothTangent(int towardsEdge) const {
    Vec3f sum;
    for (int j = 0; j < FaceCount(); ++j) {
        const double angle = 2 * kPi * (j - towardsEdge) / FaceCount();
        sum += edges[j] * static_cast<float>(std::cos(angle));
    }
    return sum;
}

/// The left eigenvector of the subdivision matrix whose eigenvalue is 3/8 + cos(pi/n)/4: the weight
/// of edge j in between is sin(pi j/n), and what the centre and the ends weigh follows from that.
Vec3f TriangleRing::_TangentAcrossCrease() const {
    const double angle = kPi / FaceCount(), between = 1 / std::tan(angle / 2);
    const double end = (std::sin(angle) - between) / (1 + 2 * std::cos(angle));
    Vec3f sum = center * static_cast<float>(-between - 2 * end) +
                (edges.front() + edges.back()) * static_cast<float>(end);
    for (int j = 1; j < FaceCount(); ++j) {
        sum += edges[j] * static_cast<float>(std::sin(angle * j));
    }
    return sum;
}

void TriangleRing::Translate(const Vec3f& by) {
    center += by;
    for (Vec3f& p : edges) {
        p += by;
    }
}

TriangleRing GatherTriangleRing(const PatchTable& patches, uint32_t ring, const Vec3f* values) {
    const PatchRing& stored = patches.Ring(ring);
    const uint32_t* points = patches.RingIndices(stored);
    TriangleRing result;
    static_cast<RingTags&>(result) = patches.TagsOf(stored);
    result.center = values[*points++];
    for (int edge = 0; edge < result.NeighborCount(); ++edge) {
        result.edges.push_back(values[*points++]);
    }
    return result;
}

}  // namespace cc
