#include "core/subdiv/vertexRing.h"

#include <cmath>

#include "core/subdiv/smoothTangent.h"

namespace cc {

VertexRing VertexRing::Subdivide() const {
    VertexRing child;
    static_cast<RingTags&>(child) = Decayed();
    for (int j = 0; j < FaceCount(); ++j) {
        child.diagonals.push_back(((center + edges[j]) + (diagonals[j] + edges[Wrap(j + 1)])) *
                                  0.25f);
    }
    for (int j = 0; j < static_cast<int>(edges.size()); ++j) {
        child.edges.push_back(_EdgePoint(j, EdgeWeight(j, child), child.diagonals));
    }
    child.center = _VertexPoint(*this, child.diagonals);
    if (VertexRule() != child.VertexRule()) {
        const float weight = FractionalWeight(child);
        child.center = child.center * weight + _VertexPoint(child, child.diagonals) * (1 - weight);
    }
    return child;
}

Vec3f VertexRing::_EdgePoint(int edge, float sharpness, const Diagonals& facePoints) const {
    const Vec3f middle = (center + edges[edge]) * 0.5f;
    if (sharpness == 1) {
        return middle;
    }
    const Vec3f& left = facePoints[edge];
    const Vec3f& right = facePoints[Wrap(edge - 1)];
    const Vec3f smooth = ((center + edges[edge]) + (left + right)) * 0.25f;
    return sharpness > 0 ? smooth * (1 - sharpness) + middle * sharpness : smooth;
}

/// @param tags  whose rule to follow: this ring's, or those of a step later
Vec3f VertexRing::_VertexPoint(const RingTags& tags, const Diagonals& facePoints) const {
    if (tags.VertexRule() != Rule::Smooth) {
        return _SharpVertexPoint(tags);
    }
    Vec3f sum;
    for (int j = 0; j < FaceCount(); ++j) {
        sum += edges[j] + facePoints[j];
    }
    const float inverse = 1.0f / static_cast<float>(FaceCount());
    return center * (1 - 2 * inverse) + sum * (inverse * inverse);
}

Vec3f VertexRing::_SmoothLimit() const {
    Vec3f edgeSum, diagonalSum;
    for (int j = 0; j < FaceCount(); ++j) {
        edgeSum += edges[j];
        diagonalSum += diagonals[j];
    }
    const float n = static_cast<float>(FaceCount());
    return (center * (n * n) + edgeSum * 4 + diagonalSum) * (1 / (n * (n + 5)));
}

Vec3f VertexRing::_SmoothTangent(int towardsEdge) const {
    const SmoothTangentMask mask(FaceCount(), towardsEdge);
    Vec3f tangent;
    for (int j = 0; j < FaceCount(); ++j) {
        tangent += edges[j] * mask.Edge(j) + diagonals[j] * mask.Diagonal(j);
    }
    return tangent;
}

/// The left eigenvector of the subdivision matrix whose eigenvalue is 1/4 + edge cos(pi/2n)/8: edge
/// j in between weighs `edge` times sin(pi j/n), diagonal j sin(pi (j + 1/2)/n), and what the
/// centre and the ends weigh follows from that. (The mask of Biermann et al. 2000 is that of other
/// rules, the same for two faces only.)
Vec3f VertexRing::_TangentAcrossCrease() const {
    const double angle = kPi / FaceCount();
    const double sine = std::sin(angle / 2), cosine = std::cos(angle / 2);
    const double edge = cosine + std::sqrt(cosine * cosine + 4);
    const double end = ((2 * sine * sine - 1) / (edge * cosine) - cosine * cosine) / sine;
    Vec3f sum = center * static_cast<float>(-(edge * cosine + 1) / sine - 2 * end) +
                (edges.front() + edges.back()) * static_cast<float>(end);
    for (int j = 0; j < FaceCount(); ++j) {
        sum += diagonals[j] * static_cast<float>(std::sin(angle * (j + 0.5)));
        if (j > 0) {
            sum += edges[j] * static_cast<float>(edge * std::sin(angle * j));
        }
    }
    return sum;
}

void VertexRing::Translate(const Vec3f& by) {
    center += by;
    for (Vec3f& p : edges) {
        p += by;
    }
    for (Vec3f& p : diagonals) {
        p += by;
    }
}

}  // namespace cc
