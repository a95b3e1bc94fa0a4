#include "core/trace/chordErrors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/chordErrorKernels.h"

namespace cc {
namespace {

/// Bytes count quarters of powers of two, from here down.
constexpr int kLargestExponent = 8;

/// What is measured at some points may be a little more between them.
constexpr float kMeasureMargin = 1.5f;

/// The most that errors can grow from level to level, beside quartering: they are halved at least.
constexpr float kMostGrowth = 2;

/// Patches that a thread takes at a time, at most.
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
    // A fourth of a power of two at a time: those that the fraction is above.
    constexpr float kQuarters[3] = {0.594603557f, 0.707106781f, 0.840896415f};
    int exponent;
    const float fraction = std::frexp(error, &exponent);
    int quarters = 4 * (exponent - 1 - kLargestExponent) + (fraction > 0.5f ? 1 : 0);
    for (const float quarter : kQuarters) {
        quarters += fraction > quarter ? 1 : 0;
    }
    return static_cast<uint8_t>(std::min(std::max(255 + quarters, 1), 255));
}

float BilinearError(const uint32_t* i, const Vec3f* points) {
    return Length((points[i[0]] - points[i[1]]) + (points[i[2]] - points[i[3]])) / 4;
}

void Evaluate(const PatchTable& patches, uint32_t patch, const Vec3f* points,
              ErrorLattice* lattice) {
    constexpr int kSide = ErrorLattice::kSide;
    for (int i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
        const int row = i / (kSide + 1), column = i % (kSide + 1);
        const Vec3f p =
            EvaluateLimitValue(patches, patch, points, static_cast<float>(column) / kSide,
                               static_cast<float>(row) / kSide);
        for (int axis = 0; axis < 3; ++axis) {
            lattice->points[axis][row][column] = p[axis];
        }
    }
}

/// What a patch would be off by at its own level 0, by what it is off by at the first levels.
/// Around creases and high valences errors may quarter later, or shrink more slowly: they are taken
/// to go on for some levels as they do at last.
float MeasuredError(const ErrorLattice& lattice) {
    float errors[ErrorLattice::kLevels];
    MeasureErrors(lattice, errors);
    float error = 0, last = 0, growth = 1;
    for (int level = 0; level < ErrorLattice::kLevels; ++level) {
        const float scaled = static_cast<float>(1 << (2 * level)) * errors[level];
        growth = last > 0 ? std::min(std::max(scaled / last, 1.0f), kMostGrowth) : 1;
        last = scaled;
        error = std::max(error, scaled);
    }
    return kMeasureMargin * std::max(error, last * growth * growth * growth);
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

/// Of a patch that is no B-spline.
float PatchError(const PatchTable& patches, const LimitGridPlans& plans, const Vec3f* points,
                 uint32_t patch) {
    ErrorLattice lattice;
    switch (patches.At(patch).kind) {
        case PatchKind::Regular:
        case PatchKind::FlatTriangle: return 0;
        case PatchKind::Bilinear: return BilinearError(patches.Indices(patch), points);
        case PatchKind::RegularTriangle:
        case PatchKind::IrregularTriangle: return TriangleError(patches, patch, points);
        case PatchKind::Extraordinary:
        case PatchKind::Irregular: break;
    }
    if (const LimitGridPlan* plan = plans.Of(patch)) {
        ControlPoints indices;
        GatherControlPoints(patches, patch, &indices);
        EvaluateLattice(*plan, indices, points, &lattice);
    } else {
        Evaluate(patches, patch, points, &lattice);
    }
    return MeasuredError(lattice);
}

/// Of all patches from one to another: B-splines many at a time.
void PatchErrors(const PatchTable& patches, const LimitGridPlans& plans, const Vec3f* points,
                 uint32_t begin, uint32_t end, float* errors) {
    const uint32_t* indices[kGrainSize] = {};
    uint32_t regular[kGrainSize];
    float found[kGrainSize];
    size_t count = 0;
    for (uint32_t patch = begin; patch < end; ++patch) {
        if (patches.At(patch).kind == PatchKind::Regular) {
            regular[count] = patch;
            indices[count++] = patches.Indices(patch);
        } else {
            errors[patch - begin] = PatchError(patches, plans, points, patch);
        }
    }
    BSplineErrors(indices, count, points, found);
    for (size_t i = 0; i < count; ++i) {
        errors[regular[i] - begin] = found[i];
    }
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
    const auto measure = [&](const tbb::blocked_range<size_t>& part) {
        uint8_t largest = 0;
        float errors[kGrainSize];
        const auto begin = static_cast<uint32_t>(part.begin());
        const auto end = static_cast<uint32_t>(part.end());
        PatchErrors(patches, plans, points.data(), begin, end, errors);
        for (uint32_t patch = begin; patch < end; ++patch) {
            const auto scale = static_cast<float>(1 << (2 * patches.At(patch).depth));
            const uint8_t byte = Encode(scale * errors[patch - begin] / unit);
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
    };
    tbb::parallel_for(all, measure, tbb::simple_partitioner());
}

void ChordErrors::Raise(const ChordErrors& others) {
    for (size_t i = 0; i < std::min(_bytes.size(), others._bytes.size()); ++i) {
        _bytes[i] = std::max(_bytes[i], others._bytes[i]);
    }
    _largest = std::max(_largest, others._largest);
}

float ChordErrors::_Decode(uint8_t byte) {
    static const std::array<float, 256> kDecoded = MakeDecoded();
    return kDecoded[byte];
}

}  // namespace cc
