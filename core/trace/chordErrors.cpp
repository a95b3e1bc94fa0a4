#include "core/trace/chordErrors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/subdiv/limitPoint.h"

namespace cc {
namespace {

/// Bytes count quarters of powers of two, from here down.
constexpr int kLargestExponent = 8;

/// What is measured at some points may be a little more between them.
constexpr float kMeasureMargin = 1.5f;

/// The most that errors can grow from level to level, beside quartering: they are halved at least.
constexpr float kMostGrowth = 2;

/// Quads along a patch between whose corners its surface is measured.
constexpr int kLattice = kPlanSide;
/// Levels that are measured: there are points between their corners.
constexpr int kMeasuredLevels = 4;

/// Patches that a thread takes at a time.
constexpr size_t kGrainSize = 256;

std::array<float, 256> MakeDecoded() {
    std::array<float, 256> decoded{};
    for (int byte = 1; byte < 256; ++byte) {
        decoded[byte] = static_cast<float>(
            std::exp2(kLargestExponent - 0.25 * static_cast<double>(255 - byte)));
    }
    return decoded;
}

/// The byte that is decoded to no less than an error.
uint8_t Encode(float error) {
    if (!(error > 0)) {
        return error == 0 ? 0 : 255;  // 255 if it is not a number
    }
    const double quarters =
        std::ceil(4 * (std::log2(static_cast<double>(error)) - kLargestExponent));
    return static_cast<uint8_t>(std::min(std::max(255 + quarters, 1.0), 255.0));
}

float LargestLength(const Vec3f* vectors, int count) {
    float square = 0;
    for (int i = 0; i < count; ++i) {
        square = std::max(square, Dot(vectors[i], vectors[i]));
    }
    return std::sqrt(square);
}

float BSplineError(const uint32_t* indices, const Vec3f* points) {
    Vec3f p[4][4], alongU[8], alongV[8], mixed[9];
    for (int i = 0; i < 16; ++i) {
        p[i / 4][i % 4] = points[indices[i]];
    }
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 2; ++j) {
            alongU[2 * i + j] = p[i][j] - 2 * p[i][j + 1] + p[i][j + 2];
            alongV[2 * i + j] = p[j][i] - 2 * p[j + 1][i] + p[j + 2][i];
        }
    }
    for (int i = 0; i < 9; ++i) {
        const int row = i / 3, column = i % 3;
        mixed[i] =
            (p[row][column] - p[row][column + 1]) - (p[row + 1][column] - p[row + 1][column + 1]);
    }
    return (LargestLength(alongU, 8) + 2 * LargestLength(mixed, 9) + LargestLength(alongV, 8)) / 8;
}

float BilinearError(const uint32_t* i, const Vec3f* points) {
    return Length((points[i[0]] - points[i[1]]) + (points[i[2]] - points[i[3]])) / 4;
}

/// Points of a patch at multiples of 1 / kLattice.
struct Lattice {
    Vec3f points[kLattice + 1][kLattice + 1];

    /// How far points in the middles of a level's triangles and edges are from those.
    float Error(int level) const {
        const int cell = kLattice >> level;
        float square = 0;
        for (int i = 0; i <= kLattice; i += cell / 2) {
            for (int j = 0; j <= kLattice; j += cell / 2) {
                const int row = std::min(i / cell, (1 << level) - 1) * cell;
                const int column = std::min(j / cell, (1 << level) - 1) * cell;
                const float u = static_cast<float>(j - column) / static_cast<float>(cell);
                const float v = static_cast<float>(i - row) / static_cast<float>(cell);
                const Vec3f& a = points[row][column];
                const Vec3f& c = points[row + cell][column + cell];
                const Vec3f& b = u >= v ? points[row][column + cell] : points[row + cell][column];
                const float most = std::max(u, v), least = std::min(u, v);
                const Vec3f off = points[i][j] - ((1 - most) * a + (most - least) * b + least * c);
                square = std::max(square, Dot(off, off));
            }
        }
        return std::sqrt(square);
    }
};

void EvaluateByPlan(const LimitGridPlan& plan, const PatchTable& patches, uint32_t patch,
                    const Vec3f* points, Lattice* lattice) {
    ControlPoints indices;
    GatherControlPoints(patches, patch, &indices);
    const Vec3f base = points[indices[plan.Picks()[0]]];
    float sums[3][LimitGridPlan::kWeightCount] = {};
    for (size_t pick = 1; pick < plan.Picks().size(); ++pick) {
        const Vec3f p = points[indices[plan.Picks()[pick]]] - base;
        const float* weights = plan.Weights(pick);
        for (int axis = 0; axis < 3; ++axis) {
            for (int i = 0; i < LimitGridPlan::kWeightCount; ++i) {
                sums[axis][i] += weights[i] * p[axis];
            }
        }
    }
    for (int row = 0; row <= kLattice; ++row) {
        for (int column = 0; column <= kLattice; ++column) {
            const int at =
                column < kLattice ? kPlanSide * row + column : kPlanSide * (kPlanSide + 1) + row;
            lattice->points[row][column] = {sums[0][at], sums[1][at], sums[2][at]};
        }
    }
}

void Evaluate(const PatchTable& patches, uint32_t patch, const Vec3f* points, Lattice* lattice) {
    for (int row = 0; row <= kLattice; ++row) {
        for (int column = 0; column <= kLattice; ++column) {
            lattice->points[row][column] =
                EvaluateLimitValue(patches, patch, points, static_cast<float>(column) / kLattice,
                                   static_cast<float>(row) / kLattice);
        }
    }
}

/// What a patch would be off by at its own level 0, by what it is off by at the first levels.
/// Around creases and high valences that may quarter later, or more slowly: what it has grown by at
/// last, it may grow by once more.
float MeasuredError(const Lattice& lattice) {
    float error = 0, last = 0, growth = 1;
    for (int level = 0; level < kMeasuredLevels; ++level) {
        const float scaled = static_cast<float>(1 << (2 * level)) * lattice.Error(level);
        growth = last > 0 ? scaled / last : 1;
        last = scaled;
        error = std::max(error, scaled);
    }
    return kMeasureMargin * std::max(error, last * std::min(std::max(growth, 1.0f), kMostGrowth));
}

/// The same for a triangle, by the middles of its edges. Errors of irregular ones shrink more
/// slowly.
float TriangleError(const PatchTable& patches, uint32_t patch, const Vec3f* points) {
    const auto at = [&](float u, float v) {
        return EvaluateLimitValue(patches, patch, points, u, v);
    };
    const Vec3f a = at(0, 0), b = at(1, 0), c = at(0, 1);
    const float error =
        std::max({Length(at(0.5f, 0) - 0.5f * (a + b)), Length(at(0.5f, 0.5f) - 0.5f * (b + c)),
                  Length(at(0, 0.5f) - 0.5f * (c + a))});
    const bool isRegular = patches.At(patch).kind == PatchKind::RegularTriangle;
    return 2 * kMeasureMargin * (isRegular ? 1 : kMostGrowth * kMostGrowth) * error;
}

float PatchError(const PatchTable& patches, const LimitGridPlans& plans, const Vec3f* points,
                 uint32_t patch) {
    Lattice lattice;
    switch (patches.At(patch).kind) {
        case PatchKind::Regular: return BSplineError(patches.Indices(patch), points);
        case PatchKind::Bilinear: return BilinearError(patches.Indices(patch), points);
        case PatchKind::FlatTriangle: return 0;
        case PatchKind::RegularTriangle:
        case PatchKind::IrregularTriangle: return TriangleError(patches, patch, points);
        case PatchKind::Extraordinary:
        case PatchKind::Irregular: break;
    }
    if (const LimitGridPlan* plan = plans.Of(patch)) {
        EvaluateByPlan(*plan, patches, patch, points, &lattice);
    } else {
        Evaluate(patches, patch, points, &lattice);
    }
    return MeasuredError(lattice);
}

void RaiseTo(uint8_t value, uint8_t* byte) {
    uint8_t before = __atomic_load_n(byte, __ATOMIC_RELAXED);
    while (before < value && !__atomic_compare_exchange_n(byte, &before, value, true,
                                                          __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
}

}  // namespace

ChordErrors::ChordErrors(const PatchTable& patches, const LimitGridPlans& plans,
                         const std::vector<Vec3f>& points, float unit)
    : _bytes(points.size(), 0), _unit(unit) {
    const tbb::blocked_range<size_t> all(0, patches.Count(), kGrainSize);
    tbb::parallel_for(all, [&](const tbb::blocked_range<size_t>& part) {
        uint8_t largest = 0;
        for (size_t i = part.begin(); i < part.end(); ++i) {
            const auto patch = static_cast<uint32_t>(i);
            const auto scale = static_cast<float>(1 << (2 * patches.At(patch).depth));
            const uint8_t byte =
                Encode(scale * PatchError(patches, plans, points.data(), patch) / unit);
            largest = std::max(largest, byte);
            if (patches.IsTriangle(patch)) {
                continue;
            }
            EdgePoints edges[4];
            patches.EdgeEnds(patch, edges);
            for (const EdgePoints& edge : edges) {
                RaiseTo(byte, &_bytes[edge.a]);
                RaiseTo(byte, &_bytes[edge.b]);
            }
        }
        RaiseTo(largest, &_largest);
    });
}

float ChordErrors::_Decode(uint8_t byte) {
    static const std::array<float, 256> kDecoded = MakeDecoded();
    return kDecoded[byte];
}

}  // namespace cc
