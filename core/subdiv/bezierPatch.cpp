#include "core/subdiv/bezierPatch.h"

#include <cassert>

namespace cc {
namespace {

/// Four B-spline values to four Bezier values of the middle segment, times six.
void CurveFromBSpline(double a, double b, double c, double d, double out[4]) {
    out[0] = a + 4 * b + c;
    out[1] = 4 * b + 2 * c;
    out[2] = 2 * b + 4 * c;
    out[3] = b + 4 * c + d;
}

/// The points at the thirds of a segment; backwards, the same ones.
Vec3f Third(const Vec3f& near, const Vec3f& far) { return (near * 2 + far) * (1 / 3.0f); }

/// Cubic Bernstein weights.
void Bernstein(float t, float w[4]) {
    const float s = 1 - t;
    w[0] = s * s * s;
    w[1] = 3 * s * s * t;
    w[2] = 3 * s * t * t;
    w[3] = t * t * t;
}

/// Their derivatives.
void BernsteinDerivative(float t, float w[4]) {
    const float s = 1 - t;
    w[0] = -3 * s * s;
    w[1] = 3 * s * (s - 2 * t);
    w[2] = 3 * t * (2 * s - t);
    w[3] = 3 * t * t;
}

Vec3f Sum(const Vec3f points[4][4], const float wu[4], const float wv[4]) {
    Vec3f sum;
    for (int row = 0; row < 4; ++row) {
        sum += ((points[row][0] * wu[0] + points[row][1] * wu[1]) +
                (points[row][2] * wu[2] + points[row][3] * wu[3])) *
               wv[row];
    }
    return sum;
}

/// De Casteljau at the middle: the seven points of both halves.
void SplitCurve(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d, Vec3f out[7]) {
    const Vec3f ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, cd = (c + d) * 0.5f;
    out[0] = a;
    out[1] = ab;
    out[2] = (ab + bc) * 0.5f;
    out[4] = (bc + cd) * 0.5f;
    out[3] = (out[2] + out[4]) * 0.5f;
    out[5] = cd;
    out[6] = d;
}

}  // namespace

BezierPatch BezierPatch::FromBSpline(const Vec3f bspline[16]) {
    BezierPatch patch;
    for (int axis = 0; axis < 3; ++axis) {
        double columns[4][4];
        for (int column = 0; column < 4; ++column) {
            CurveFromBSpline(bspline[column][axis], bspline[4 + column][axis],
                             bspline[8 + column][axis], bspline[12 + column][axis],
                             columns[column]);
        }
        for (int row = 0; row < 4; ++row) {
            double points[4];
            CurveFromBSpline(columns[0][row], columns[1][row], columns[2][row], columns[3][row],
                             points);
            for (int column = 0; column < 4; ++column) {
                patch.points[row][column][axis] = static_cast<float>(points[column] * (1 / 36.0));
            }
        }
    }
    return patch;
}

BezierPatch BezierPatch::FromBilinear(const Vec3f corners[4]) {
    const Vec3f left[4] = {corners[0], Third(corners[0], corners[3]), Third(corners[3], corners[0]),
                           corners[3]};
    const Vec3f right[4] = {corners[1], Third(corners[1], corners[2]),
                            Third(corners[2], corners[1]), corners[2]};
    BezierPatch patch;
    for (int row = 0; row < 4; ++row) {
        patch.points[row][0] = left[row];
        patch.points[row][1] = Third(left[row], right[row]);
        patch.points[row][2] = Third(right[row], left[row]);
        patch.points[row][3] = right[row];
    }
    return patch;
}

Vec3f BezierPatch::Position(float u, float v) const {
    float wu[4], wv[4];
    Bernstein(u, wu);
    Bernstein(v, wv);
    return Sum(points, wu, wv);
}

Vec3f BezierPatch::DerivativeU(float u, float v) const {
    float wu[4], wv[4];
    BernsteinDerivative(u, wu);
    Bernstein(v, wv);
    return Sum(points, wu, wv);
}

Vec3f BezierPatch::DerivativeV(float u, float v) const {
    float wu[4], wv[4];
    Bernstein(u, wu);
    BernsteinDerivative(v, wv);
    return Sum(points, wu, wv);
}

Box3f BezierPatch::SplitBounds() const {
    Box3f box;
    Vec3f columns[4][7];
    for (int column = 0; column < 4; ++column) {
        SplitCurve(points[0][column], points[1][column], points[2][column], points[3][column],
                   columns[column]);
    }
    for (int row = 0; row < 7; ++row) {
        Vec3f split[7];
        SplitCurve(columns[0][row], columns[1][row], columns[2][row], columns[3][row], split);
        for (const Vec3f& p : split) {
            box.Extend(p);
        }
    }
    return box;
}

BezierPatch GatherBezier(const PatchTable& patches, uint32_t patch, const Vec3f* values) {
    const uint32_t* indices = patches.Indices(patch);
    Vec3f points[16];
    const int count = patches.IndexCount(patch);
    assert(patches.At(patch).kind != PatchKind::Extraordinary);
    for (int i = 0; i < count; ++i) {
        points[i] = values[indices[i]];
    }
    return patches.At(patch).kind == PatchKind::Bilinear ? BezierPatch::FromBilinear(points)
                                                         : BezierPatch::FromBSpline(points);
}

}  // namespace cc
