#include "core/subdiv/vertexRing.h"

#include <algorithm>
#include <cmath>

namespace cc {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool IsInfinite(float sharpness) { return sharpness >= kInfiniteSharpness; }
bool IsSemiSharp(float sharpness) { return sharpness > 0 && !IsInfinite(sharpness); }

float DecayUniformly(float sharpness) {
    return IsInfinite(sharpness) ? kInfiniteSharpness : std::max(sharpness - 1, 0.0f);
}

/// Chaikin's rule: neighbouring semi-sharp edges pull on each other before sharpness decays.
float DecayByNeighbors(float sharpness, float semiSharpSum, int semiSharpCount) {
    if (!IsSemiSharp(sharpness) || semiSharpCount < 2) {
        return DecayUniformly(sharpness);
    }
    const float others = (semiSharpSum - sharpness) / static_cast<float>(semiSharpCount - 1);
    return std::max(0.75f * sharpness + 0.25f * others - 1, 0.0f);
}

}  // namespace

bool VertexRing::IsSettled() const {
    return !IsSemiSharp(vertexSharpness) &&
           std::none_of(edgeSharpness.begin(), edgeSharpness.end(), IsSemiSharp) &&
           std::none_of(outsideSharpness.begin(), outsideSharpness.end(), IsSemiSharp);
}

bool VertexRing::IsSmooth() const {
    return isClosed && vertexSharpness <= 0 &&
           std::all_of(edgeSharpness.begin(), edgeSharpness.end(), [](float s) { return s <= 0; });
}

bool VertexRing::IsRegular() const {
    if (IsSmooth()) {
        return FaceCount() == 4;
    }
    if (!IsSettled() || _IsDart()) {
        return false;
    }
    switch (_VertexRule()) {
        case Rule::Smooth: return FaceCount() == 4;
        case Rule::Crease: return FaceCount() == 2;
        case Rule::Corner: return FaceCount() == 1;
    }
    return false;
}

VertexRing VertexRing::Subdivide() const {
    VertexRing child;
    child.isClosed = isClosed;
    child.decay = decay;
    for (int j = 0; j < FaceCount(); ++j) {
        child.diagonals.push_back(((center + edges[j]) + (diagonals[j] + edges[Wrap(j + 1)])) *
                                  0.25f);
    }
    for (int j = 0; j < static_cast<int>(edges.size()); ++j) {
        child.edges.push_back(_EdgePoint(j, child.diagonals));
    }
    _DecaySharpness(&child);
    const Rule rule = _VertexRule(), childRule = child._VertexRule();
    child.center = _VertexPoint(rule, edgeSharpness, child.diagonals);
    if (rule != childRule) {
        const float weight = _FractionalWeight(child);
        child.center = child.center * weight +
                       _VertexPoint(childRule, child.edgeSharpness, child.diagonals) * (1 - weight);
    }
    return child;
}

Vec3f VertexRing::_EdgePoint(int edge, const Diagonals& facePoints) const {
    const Vec3f middle = (center + edges[edge]) * 0.5f;
    const bool isEnd = !isClosed && (edge == 0 || edge == FaceCount());
    if (isEnd || edgeSharpness[edge] >= 1) {
        return middle;
    }
    const Vec3f& left = facePoints[edge];
    const Vec3f& right = facePoints[Wrap(edge - 1)];
    const Vec3f smooth = ((center + edges[edge]) + (left + right)) * 0.25f;
    const float s = edgeSharpness[edge];
    return s > 0 ? smooth * (1 - s) + middle * s : smooth;
}

Vec3f VertexRing::_VertexPoint(Rule rule, const Sharpnesses& sharpness,
                               const Diagonals& facePoints) const {
    if (rule == Rule::Corner) {
        return center;
    }
    if (rule == Rule::Crease) {
        Vec3f neighbors[2];
        _CreaseNeighbors(sharpness, neighbors);
        return center * 0.75f + (neighbors[0] + neighbors[1]) * 0.125f;
    }
    Vec3f sum;
    for (int j = 0; j < FaceCount(); ++j) {
        sum += edges[j] + facePoints[j];
    }
    const float inverse = 1.0f / static_cast<float>(FaceCount());
    return center * (1 - 2 * inverse) + sum * (inverse * inverse);
}

void VertexRing::_CreaseNeighbors(const Sharpnesses& sharpness, Vec3f neighbors[2]) const {
    if (!isClosed) {
        neighbors[0] = edges.front();
        neighbors[1] = edges.back();
        return;
    }
    int found = 0;
    for (int j = 0; j < static_cast<int>(edges.size()) && found < 2; ++j) {
        if (sharpness[j] > 0) {
            neighbors[found++] = edges[j];
        }
    }
}

VertexRing::Rule VertexRing::_VertexRule() const {
    if (vertexSharpness > 0) {
        return Rule::Corner;
    }
    const auto isSharp = [](float s) { return s > 0; };
    const auto sharp = std::count_if(edgeSharpness.begin(), edgeSharpness.end(), isSharp) +
                       std::count_if(outsideSharpness.begin(), outsideSharpness.end(), isSharp);
    return sharp > 2 ? Rule::Corner : sharp == 2 ? Rule::Crease : Rule::Smooth;
}

bool VertexRing::_IsDart() const {
    return isClosed &&
           std::any_of(edgeSharpness.begin(), edgeSharpness.end(), [](float s) { return s > 0; }) &&
           _VertexRule() == Rule::Smooth;
}

void VertexRing::_DecaySharpness(VertexRing* child) const {
    float sum = 0;
    int count = 0;
    if (decay == SharpnessDecay::Chaikin) {
        const auto add = [&](const auto& sharpnesses) {
            for (float s : sharpnesses) {
                sum += IsSemiSharp(s) ? s : 0;
                count += IsSemiSharp(s);
            }
        };
        add(edgeSharpness);
        add(outsideSharpness);
    }
    for (float s : edgeSharpness) {
        child->edgeSharpness.push_back(DecayByNeighbors(s, sum, count));
    }
    for (float s : outsideSharpness) {
        child->outsideSharpness.push_back(DecayByNeighbors(s, sum, count));
    }
    child->vertexSharpness = DecayUniformly(vertexSharpness);
}

/// How much of the old rule is left when sharpness below 1 changes the rule: the mean of those.
float VertexRing::_FractionalWeight(const VertexRing& child) const {
    float sum = 0;
    int count = 0;
    const auto add = [&](float before, float after) {
        if (IsSemiSharp(before) && after <= 0) {
            sum += before;
            ++count;
        }
    };
    for (size_t j = 0; j < edgeSharpness.size(); ++j) {
        add(edgeSharpness[j], child.edgeSharpness[j]);
    }
    for (size_t j = 0; j < outsideSharpness.size(); ++j) {
        add(outsideSharpness[j], child.outsideSharpness[j]);
    }
    add(vertexSharpness, child.vertexSharpness);
    return count > 0 ? std::min(sum / static_cast<float>(count), 1.0f) : 0;
}

Vec3f VertexRing::LimitPosition() const {
    if (!IsSettled()) {
        return Subdivide().LimitPosition();
    }
    const Rule rule = _VertexRule();
    if (rule == Rule::Corner) {
        return center;
    }
    if (rule == Rule::Crease) {
        Vec3f neighbors[2];
        _CreaseNeighbors(edgeSharpness, neighbors);
        return (center * 4 + (neighbors[0] + neighbors[1])) * (1 / 6.0f);
    }
    if (_IsDart()) {
        // No short mask is known to us; the step contracts by half or better.
        VertexRing ring = *this;
        ring.Translate(-center);
        for (int step = 0; step < 40; ++step) {
            ring = ring.Subdivide();
        }
        return ring.center + center;
    }
    Vec3f edgeSum, diagonalSum;
    for (int j = 0; j < FaceCount(); ++j) {
        edgeSum += edges[j];
        diagonalSum += diagonals[j];
    }
    const float n = static_cast<float>(FaceCount());
    return (center * (n * n) + edgeSum * 4 + diagonalSum) * (1 / (n * (n + 5)));
}

bool VertexRing::LimitTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const {
    const Rule rule = _VertexRule();
    if (!IsSettled() || _IsDart() || (rule == Rule::Crease && FaceCount() < 2)) {
        return false;
    }
    Vec3f* const tangents[2] = {towardsEdge, towardsNextEdge};
    const Vec3f along = isClosed ? Vec3f{} : edges.front() - edges.back();
    const Vec3f across = rule == Rule::Crease ? _TangentAcrossCrease() : Vec3f{};
    for (int i = 0; i < 2; ++i) {
        if (rule == Rule::Corner) {
            *tangents[i] = edges[Wrap(face + i)] - center;
        } else if (rule == Rule::Smooth) {
            *tangents[i] = _SmoothTangent(face + i);
        } else {
            const double angle = kPi * (face + i) / FaceCount();
            *tangents[i] = along * static_cast<float>(std::cos(angle)) +
                           across * static_cast<float>(std::sin(angle));
        }
    }
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
