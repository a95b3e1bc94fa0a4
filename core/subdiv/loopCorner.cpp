#include "core/subdiv/loopCorner.h"

#include <cmath>

// A step halves a sharp edge of the corner, and takes any other edge e_j to 3/8 e_j + 1/8 (e_j-1 +
// e_j+1). What is left of the edges after many steps follows from the eigenvectors of that matrix
// whose eigenvalues are the largest.

namespace cc {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Sine of the angle below which directions are parallel but for rounding.
constexpr float kParallel = 1e-5f;

bool AreParallel(const Vec3f& a, const Vec3f& b) {
    return !(Length(Cross(Normalize(a), Normalize(b))) > kParallel);
}

/// What shrinks least of the edges between the ends among that in which edge j has the share
/// sin(pi mode j / n): it does by 3/8 + cos(pi mode / n) / 4 a step. The ends drive it, and it
/// alone is left of them if it is in resonance with them, shrinking by half as they do.
Vec3f OpenMode(const CornerEdges& edges, int mode) {
    const int faceCount = static_cast<int>(edges.size()) - 1;
    const Vec3f ends = edges.front() + edges.back() * (mode % 2 != 0 ? 1.0f : -1.0f);
    if (faceCount == 3 * mode) {
        return ends;
    }
    const double angle = kPi * mode / faceCount;
    Vec3f sum = ends * static_cast<float>(std::sin(angle) / (2 * std::cos(angle) - 1));
    for (int j = 1; j < faceCount; ++j) {
        sum += edges[j] * static_cast<float>(std::sin(angle * j));
    }
    return sum;
}

/// What shrinks least of an edge but for the first mode, in an open corner of four faces or more.
Vec3f SecondOfOpen(const CornerEdges& edges, int edge) {
    const int faceCount = static_cast<int>(edges.size()) - 1;
    if (faceCount < 6) {
        // The second mode shrinks by more than half; what follows the ends does so by half.
        const double whole = std::sin(kPi * faceCount / 3);
        return edges.front() * static_cast<float>(std::sin(kPi * (faceCount - edge) / 3) / whole) +
               edges.back() * static_cast<float>(std::sin(kPi * edge / 3) / whole);
    }
    return OpenMode(edges, 2) * static_cast<float>(std::sin(2 * kPi * edge / faceCount));
}

/// The mode of a closed corner in which edge j has the share cos(2 pi (j - edge) / n).
Vec3f ClosedMode(const CornerEdges& edges, int edge) {
    const int faceCount = static_cast<int>(edges.size());
    Vec3f sum;
    for (int j = 0; j < faceCount; ++j) {
        sum += edges[j] * static_cast<float>(std::cos(2 * kPi * (j - edge) / faceCount));
    }
    return sum;
}

/// Two tangents to either side of the direction that both edges of a face tend to.
/// @param turn  what turns the one edge into the other
bool Spread(const Vec3f& direction, const Vec3f& turn, Vec3f tangents[2]) {
    const Vec3f aside = Normalize(turn) * Length(direction);
    tangents[0] = direction - aside;
    tangents[1] = direction + aside;
    return !AreParallel(direction, turn);
}

bool OpenTangents(const CornerEdges& edges, int face, Vec3f tangents[2]) {
    const int faceCount = static_cast<int>(edges.size()) - 1;
    if (faceCount <= 3) {
        // Nothing shrinks less than the ends, whose plane it is. With three faces what is between
        // them tends to the mean of both, but the edges' difference to that of the ends.
        for (int i = 0; i < 2; ++i) {
            tangents[i] = edges.front() * static_cast<float>(faceCount - face - i) +
                          edges.back() * static_cast<float>(face + i);
        }
        return !AreParallel(edges.front(), edges.back());
    }
    const Vec3f first = OpenMode(edges, 1);
    if (face > 0 && face < faceCount - 1) {
        const double angle = kPi / faceCount;
        const Vec3f turn =
            SecondOfOpen(edges, face + 1) * static_cast<float>(std::sin(angle * face)) -
            SecondOfOpen(edges, face) * static_cast<float>(std::sin(angle * (face + 1)));
        return Spread(first, turn, tangents);
    }
    tangents[0] = face == 0 ? edges.front() : first;
    tangents[1] = face == 0 ? first : edges.back();
    return !AreParallel(tangents[0], tangents[1]);
}

bool ClosedTangents(const CornerEdges& edges, int face, Vec3f tangents[2]) {
    Vec3f sum;
    float length = 0;
    for (const Vec3f& edge : edges) {
        sum += edge;
        length += Length(edge);
    }
    for (int i = 0; i < 2; ++i) {
        tangents[i] = ClosedMode(edges, face + i);
    }
    // What all edges share shrinks least: they gather in a spike unless they cancel out.
    return Length(sum) > kParallel * length ? Spread(sum, tangents[1] - tangents[0], tangents)
                                            : !AreParallel(tangents[0], tangents[1]);
}

}  // namespace

bool LoopCornerTangents(const CornerEdges& edges, bool isClosed, int face, Vec3f* towardsEdge,
                        Vec3f* towardsNextEdge) {
    Vec3f tangents[2];
    const bool isKnown =
        isClosed ? ClosedTangents(edges, face, tangents) : OpenTangents(edges, face, tangents);
    *towardsEdge = tangents[0];
    *towardsNextEdge = tangents[1];
    return isKnown;
}

}  // namespace cc
