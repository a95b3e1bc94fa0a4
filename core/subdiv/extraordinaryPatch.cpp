#include "core/subdiv/extraordinaryPatch.h"

#include "core/subdiv/smoothTangent.h"

namespace cc {
namespace {

/// Limit position of a regular vertex: the tensor product of (1 4 1) / 6.
Vec3f RegularLimit(const Vec3f grid[4][4], int row, int column) {
    const Vec3f diagonals = (grid[row - 1][column - 1] + grid[row + 1][column + 1]) +
                            (grid[row - 1][column + 1] + grid[row + 1][column - 1]);
    const Vec3f edges = (grid[row - 1][column] + grid[row + 1][column]) +
                        (grid[row][column - 1] + grid[row][column + 1]);
    return (diagonals + edges * 4 + grid[row][column] * 16) * (1 / 36.0f);
}

/// Refined B-spline points of one row or column of four: e v e v e.
void RefineCurve(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d, Vec3f out[5]) {
    out[0] = (a + b) * 0.5f;
    out[1] = ((a + c) + b * 6) * 0.125f;
    out[2] = (b + c) * 0.5f;
    out[3] = ((b + d) + c * 6) * 0.125f;
    out[4] = (c + d) * 0.5f;
}

}  // namespace

void ExtraordinaryPatch::_GatherGrid(Vec3f grid[4][4]) const {
    const Vec3f* outer = &_points[1 + 2 * _valence];
    // The corner (0,0) does not exist in the ring; nothing that reads it is kept.
    grid[0][0] = _points[0];
    grid[0][1] = _EdgeNeighbor(_valence - 1);
    grid[0][2] = _FaceDiagonal(_valence - 1);
    grid[0][3] = outer[0];
    grid[1][0] = _EdgeNeighbor(2);
    grid[1][1] = _points[0];
    grid[1][2] = _EdgeNeighbor(0);
    grid[1][3] = outer[1];
    grid[2][0] = _FaceDiagonal(1);
    grid[2][1] = _EdgeNeighbor(1);
    grid[2][2] = _FaceDiagonal(0);
    grid[2][3] = outer[2];
    grid[3][0] = outer[6];
    grid[3][1] = outer[5];
    grid[3][2] = outer[4];
    grid[3][3] = outer[3];
}

/// The ring after a step, into _scratch: face points, edge points and the vertex point (paper,
/// section 2.1).
void ExtraordinaryPatch::_RefineRing() {
    const int n = _valence;
    const Vec3f center = _points[0];
    _scratch.resize(_points.size());
    Vec3f edgeSum, faceSum;
    for (int i = 0; i < n; ++i) {
        const Vec3f face =
            ((center + _EdgeNeighbor(i)) + (_FaceDiagonal(i) + _EdgeNeighbor(i + 1))) * 0.25f;
        _scratch[2 + 2 * i] = face;
        edgeSum += _EdgeNeighbor(i);
        faceSum += face;
    }
    for (int i = 0; i < n; ++i) {
        const Vec3f& left = _scratch[2 + 2 * i];
        const Vec3f& right = _scratch[2 + 2 * ((i + n - 1) % n)];
        _scratch[1 + 2 * i] = ((center + _EdgeNeighbor(i)) + (left + right)) * 0.25f;
    }
    const float inverse = 1.0f / static_cast<float>(n);
    _scratch[0] = center * (1 - 2 * inverse) + (edgeSum + faceSum) * (inverse * inverse);
}

void ExtraordinaryPatch::Subdivide(RegularQuarters* quarters) {
    const int n = _valence;
    _RefineRing();

    // The refined 5x5 grid by tensor product; then the points that the ring decides.
    Vec3f grid[4][4], columns[4][5], refined[5][5];
    _GatherGrid(grid);
    for (int c = 0; c < 4; ++c) {
        RefineCurve(grid[0][c], grid[1][c], grid[2][c], grid[3][c], columns[c]);
    }
    for (int r = 0; r < 5; ++r) {
        RefineCurve(columns[0][r], columns[1][r], columns[2][r], columns[3][r], refined[r]);
    }
    refined[1][1] = _scratch[0];
    refined[1][2] = _scratch[1];
    refined[2][2] = _scratch[2];
    refined[2][1] = _scratch[3];
    refined[2][0] = _scratch[4];
    refined[1][0] = _scratch[1 + 2 * (2 % n)];
    refined[0][1] = _scratch[1 + 2 * (n - 1)];
    refined[0][2] = _scratch[2 + 2 * (n - 1)];

    const int firstRow[3] = {0, 1, 1}, firstColumn[3] = {1, 1, 0};
    for (int quarter = 0; quarter < 3; ++quarter) {
        for (int r = 0; r < 4; ++r) {
            for (int c = 0; c < 4; ++c) {
                quarters->points[quarter][4 * r + c] =
                    refined[firstRow[quarter] + r][firstColumn[quarter] + c];
            }
        }
    }

    Vec3f* outer = &_scratch[1 + 2 * n];
    outer[0] = refined[0][3];
    outer[1] = refined[1][3];
    outer[2] = refined[2][3];
    outer[3] = refined[3][3];
    outer[4] = refined[3][2];
    outer[5] = refined[3][1];
    outer[6] = refined[3][0];
    _points.swap(_scratch);
}

Vec3f ExtraordinaryPatch::LimitPosition() const {
    Vec3f edges, faces;
    for (int i = 0; i < _valence; ++i) {
        edges += _EdgeNeighbor(i);
        faces += _FaceDiagonal(i);
    }
    const float n = static_cast<float>(_valence);
    return (_points[0] * (n * n) + edges * 4 + faces) * (1 / (n * (n + 5)));
}

void ExtraordinaryPatch::LimitTangents(Vec3f* towardsU, Vec3f* towardsV) const {
    Vec3f* const tangents[2] = {towardsU, towardsV};
    for (int edge = 0; edge < 2; ++edge) {
        const SmoothTangentMask mask(_valence, edge);
        *tangents[edge] = {};
        for (int j = 0; j < _valence; ++j) {
            *tangents[edge] +=
                _EdgeNeighbor(j) * mask.Edge(j) + _FaceDiagonal(j) * mask.Diagonal(j);
        }
    }
}

void ExtraordinaryPatch::LimitCorners(Vec3f corners[4]) const {
    Vec3f grid[4][4];
    _GatherGrid(grid);
    corners[0] = LimitPosition();
    corners[1] = RegularLimit(grid, 1, 2);
    corners[2] = RegularLimit(grid, 2, 2);
    corners[3] = RegularLimit(grid, 2, 1);
}

void ExtraordinaryPatch::Translate(const Vec3f& by) {
    for (Vec3f& p : _points) {
        p += by;
    }
}

ExtraordinaryPatch GatherExtraordinary(const PatchTable& patches, uint32_t patch,
                                       const Vec3f* values) {
    const uint32_t* indices = patches.Indices(patch);
    ExtraordinaryPatch::Points points;
    points.resize(static_cast<size_t>(patches.IndexCount(patch)));
    for (size_t i = 0; i < points.size(); ++i) {
        points[i] = values[indices[i]];
    }
    return {points.data(), patches.At(patch).valence};
}

}  // namespace cc
