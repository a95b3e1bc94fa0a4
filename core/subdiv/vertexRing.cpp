#include "core/subdiv/vertexRing.h"

#include <cmath>

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

/// Where the surface has a kink in the face's side, as in a corner of several faces, the face's own
/// edges stand for its tangents, as OpenSubdiv has it.
bool VertexRing::_CornerTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const {
    *towardsEdge = edges[face] - center;
    *towardsNextEdge = edges[Wrap(face + 1)] - center;
    return true;
}

/// The mask of Halstead et al. 1993.
Vec3f VertexRing::_SmoothTangent(int towardsEdge) const {
    const double angle = 2 * kPi / FaceCount();
    const double a =
        1 + std::cos(angle) + std::cos(angle / 2) * std::sqrt(2 * (9 + std::cos(angle)));
    Vec3f tangent;
    for (int j = 0; j < FaceCount(); ++j) {
        const double c0 = std::cos(angle * (j - towardsEdge));
        const double c1 = std::cos(angle * (j + 1 - towardsEdge));
        tangent +=
            edges[j] * static_cast<float>(a * c0) + diagonals[j] * static_cast<float>(c0 + c1);
    }
    return tangent;
}

/// The mask of Biermann et al. 2000 for the tangent that leaves a crease.
Vec3f VertexRing::_TangentAcrossCrease() const {
    const double angle = kPi / FaceCount(), cosine = std::cos(angle);
    const double r = (cosine + 1) / std::sin(angle);
    Vec3f sum = center * static_cast<float>(4 * r * (cosine - 1)) +
                (edges.front() + edges.back()) * static_cast<float>(-r * (1 + 2 * cosine));
    for (int j = 0; j < FaceCount(); ++j) {
        const double s0 = std::sin(angle * j), s1 = std::sin(angle * (j + 1));
        sum += diagonals[j] * static_cast<float>(s0 + s1);
        if (j > 0) {
            sum += edges[j] * static_cast<float>(4 * s0);
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
