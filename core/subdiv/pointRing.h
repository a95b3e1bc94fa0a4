#pragma once

#include <cmath>

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/cornerTangents.h"
#include "core/subdiv/ringTags.h"

namespace cc {

/// A ring with its points, and what rules of a corner, a crease and a dart are the same in every
/// scheme.
/// @tparam Ring  derives from this, and befriends it. It has Subdivide and Translate, and for its
///     scheme _SmoothLimit, _SmoothTangent, _TangentAcrossCrease and _Diagonals.
template <typename Ring>
struct PointRing : RingTags {
    Vec3f center;
    InlineVector<Vec3f, kInlineEdges> edges;  ///< NeighborCount

    /// Where the vertex goes in the limit.
    Vec3f LimitPosition() const;

    /// Tangents of the surface at the settled vertex, of arbitrary length, towards the two edges of
    /// a face; their cross product points along the outward normal. Returns false if no mask is
    /// known: at a dart, on a crease that the ring does not have whole, where a smooth boundary has
    /// a single face, or in some corners (CornerTangents).
    bool LimitTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const;

  protected:
    static constexpr double kPi = 3.14159265358979323846;

    /// A step's vertex point by the rule of a corner or a crease.
    Vec3f _SharpVertexPoint(const RingTags& tags) const {
        return tags.VertexRule() == Rule::Corner ? center
                                                 : center * 0.75f + _CreaseSum(tags) * 0.125f;
    }

  private:
    friend Ring;
    PointRing() = default;

    const Ring& _Self() const { return static_cast<const Ring&>(*this); }

    Vec3f _CreaseSum(const RingTags& tags) const {
        int ends[2];
        tags.CreaseEdges(ends);
        return edges[ends[0]] + edges[ends[1]];
    }
    Vec3f _DartLimit() const;
    bool _CornerTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const;
};

template <typename Ring>
Vec3f PointRing<Ring>::LimitPosition() const {
    if (!IsSettled()) {
        return _Self().Subdivide().LimitPosition();
    }
    switch (VertexRule()) {
        case Rule::Corner: return center;
        case Rule::Crease: return (center * 4 + _CreaseSum(*this)) * (1 / 6.0f);
        case Rule::Smooth: break;
    }
    return IsDart() ? _DartLimit() : _Self()._SmoothLimit();
}

/// No short mask is known to us; the step contracts by half or better.
template <typename Ring>
Vec3f PointRing<Ring>::_DartLimit() const {
    Ring ring = _Self();
    ring.Translate(-center);
    for (int step = 0; step < 40; ++step) {
        ring = ring.Subdivide();
    }
    return ring.center + center;
}

template <typename Ring>
bool PointRing<Ring>::LimitTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const {
    const Rule rule = VertexRule();
    if (!IsSettled() || IsDart() || (rule == Rule::Crease && FaceCount() < 2) ||
        IsOnOutsideCrease()) {
        return false;
    }
    if (rule == Rule::Corner) {
        return _CornerTangents(face, towardsEdge, towardsNextEdge);
    }
    if (rule == Rule::Smooth) {
        *towardsEdge = _Self()._SmoothTangent(face);
        *towardsNextEdge = _Self()._SmoothTangent(face + 1);
        return true;
    }
    const Vec3f along = edges.front() - edges.back(), across = _Self()._TangentAcrossCrease();
    Vec3f* const tangents[2] = {towardsEdge, towardsNextEdge};
    for (int i = 0; i < 2; ++i) {
        const double angle = kPi * (face + i) / FaceCount();
        *tangents[i] = along * static_cast<float>(std::cos(angle)) +
                       across * static_cast<float>(std::sin(angle));
    }
    return true;
}

/// A closed ring that has a sharp edge is open, from that edge around to it again.
template <typename Ring>
bool PointRing<Ring>::_CornerTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const {
    int first = 0;
    bool isCut = !isClosed;
    for (int j = 0; j < FaceCount() && isClosed; ++j) {
        if (edgeSharpness[j] > 0) {
            first = j;
            isCut = true;
        }
    }
    SharpCorner corner;
    corner.isClosed = !isCut;
    for (int j = 0; j < FaceCount() + (isCut ? 1 : 0); ++j) {
        corner.edges.push_back(edges[Wrap(first + j)] - center);
    }
    const Vec3f* const diagonals = _Self()._Diagonals();
    for (int j = 0; j < FaceCount() && diagonals != nullptr; ++j) {
        corner.diagonals.push_back(diagonals[Wrap(first + j)] - center);
    }
    const int fromFirst = face >= first ? face - first : face - first + FaceCount();
    return CornerTangents(corner, fromFirst, towardsEdge, towardsNextEdge);
}

}  // namespace cc
