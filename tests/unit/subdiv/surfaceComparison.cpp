#include "tests/unit/subdiv/surfaceComparison.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "core/math/box.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/limitOracle.h"

namespace cc::test {
namespace {

constexpr double kDegrees = 57.29577951308232;

double Degrees(const Vec3f& a, const Vec3f& b) {
    return std::atan2(Length(Cross(a, b)), Dot(a, b)) * kDegrees;
}

/// Compares one sample after the other and keeps the worst.
class Comparison {
  public:
    Comparison(const Cage& cage, const PatchTable& patches)
        : _oracle(cage.mesh, cage.points),
          _coarseOracle(cage.mesh, cage.points, LimitOracle::Precision::Coarse),
          _patches(patches),
          _points(patches.PatchPoints(cage.points)) {
        Box3f box;
        for (int vertex : cage.mesh.faceVertexIndices) {
            box.Extend(cage.points[vertex]);
        }
        _diagonal = box.Diagonal();
    }

    bool HasFace(uint32_t face) { return _oracle.HasFace(face); }

    void Sample(uint32_t patch, float u, float v) {
        const FaceParameter at = _patches.ToFace(patch, u, v);
        const LimitOracle::Sample expected = _oracle.Evaluate(at);
        const LimitPoint actual = EvaluateLimit(_patches, patch, _points.data(), u, v);
        const std::string where = _Where(patch, at);
        ++result.sampleCount;
        if (!expected.exists) {
            result.error = "no surface at " + where;
            return;
        }
        const bool isCorner = (u == 0 || u == 1) && (v == 0 || v == 1);
        const double distance = Length(actual.position - expected.position);
        const double position =
            std::max(distance - (isCorner ? _ErrorAt(at, expected.position) : 0), 0.0) / _diagonal;
        if (!(position <= result.position)) {
            result.position = position;
            result.worstPosition = where;
        }
        if (expected.normal == Vec3f{} || (isCorner && !_IsNormalSettled(at, expected.normal))) {
            return;
        }
        const double normal =
            Degrees(_patches.IsLeftHanded() ? -actual.normal : actual.normal, expected.normal);
        if (!(normal <= result.normal)) {
            result.normal = normal;
            result.worstNormal = where;
        }
    }

    SurfaceDifference result;

  private:
    std::string _Where(uint32_t patch, const FaceParameter& at) const {
        const Patch& p = _patches.At(patch);
        return "face " + std::to_string(at.face) + "." + std::to_string(at.corner) + " (" +
               std::to_string(at.u) + ", " + std::to_string(at.v) + ") kind " +
               std::to_string(static_cast<int>(p.kind)) + " depth " + std::to_string(p.depth);
    }

    /// What the oracle lacks at the end of a dart, where each of its steps halves the error and the
    /// coarse oracle takes five fewer. Nothing elsewhere: both agree there.
    double _ErrorAt(const FaceParameter& at, const Vec3f& fine) {
        return Length(_coarseOracle.Evaluate(at).position - fine) / 31;
    }

    /// Corners where the surface has no normal show in the oracle's: it depends on how far the
    /// oracle followed the corner. Where it is exact, it does not.
    bool _IsNormalSettled(const FaceParameter& at, const Vec3f& normal) {
        const Vec3f coarse = _coarseOracle.Evaluate(at).normal;
        return coarse != Vec3f{} && Degrees(coarse, normal) < kNormalTolerance;
    }

    LimitOracle _oracle, _coarseOracle;
    const PatchTable& _patches;
    const std::vector<Vec3f> _points;
    double _diagonal = 1;
};

void SampleTriangle(uint32_t patch, std::mt19937* random, Comparison* comparison) {
    std::uniform_real_distribution<float> unit(0.01f, 0.99f);
    const auto at = [&](float u, float v) { comparison->Sample(patch, u, v); };
    for (int i = 0; i < 4; ++i) {
        const float u = unit(*random), along = unit(*random);
        at(u, (1 - u) * along);
        at(along, 0);
        at(0, along);
        at(along, 1 - along);
    }
    at(0, 0);
    at(1, 0);
    at(0, 1);
}

void SamplePatch(uint32_t patch, std::mt19937* random, Comparison* comparison) {
    std::uniform_real_distribution<float> unit(0.01f, 0.99f);
    const auto at = [&](float u, float v) { comparison->Sample(patch, u, v); };
    for (int i = 0; i < 4; ++i) {
        at(unit(*random), unit(*random));
        const float along = unit(*random);
        at(along, 0);
        at(1, along);
        at(along, 1);
        at(0, along);
    }
    for (int corner = 0; corner < 4; ++corner) {
        at(corner == 1 || corner == 2 ? 1 : 0, corner >= 2 ? 1 : 0);
    }
}

}  // namespace

SurfaceDifference CompareWithOracle(Cage cage) {
    SurfaceDifference failed;
    failed.error = ValidateControlMesh(&cage.mesh, cage.points.size()).error;
    if (!failed.error.empty()) {
        return failed;
    }
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &failed.error);
    if (!failed.error.empty()) {
        return failed;
    }
    Comparison comparison(cage, patches);
    std::mt19937 random(7);
    std::set<uint32_t> covered(cage.mesh.holeIndices.begin(), cage.mesh.holeIndices.end());
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        if (patches.IsTriangle(patch)) {
            SampleTriangle(patch, &random, &comparison);
        } else {
            SamplePatch(patch, &random, &comparison);
        }
        covered.insert(patches.AuthoredFace(patch));
    }
    for (int face = 0; face < cage.mesh.FaceCount(); ++face) {
        if (covered.count(face) == 0 && comparison.HasFace(face)) {
            comparison.result.error = "no patch for face " + std::to_string(face);
        }
    }
    return comparison.result;
}

double DifferenceFromRefinement(Cage cage) {
    // Patches are refined twice at most, and the grid has four steps: level 4 would do, and darts,
    // where Far's limits are approximate, gain by more.
    const std::vector<Vec3f> refined = LimitOracle(cage.mesh, cage.points).RefinedLimits(5);
    ValidateControlMesh(&cage.mesh, cage.points.size());
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
    Box3f box;
    for (int vertex : cage.mesh.faceVertexIndices) {
        box.Extend(cage.points[vertex]);
    }
    double worst = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        for (int i = 0; i < 25; ++i) {
            const float u = static_cast<float>(i % 5) / 4, v = static_cast<float>(i / 5) / 4;
            const Vec3f p = EvaluateLimit(patches, patch, points.data(), u, v).position;
            double nearest = 1e30;
            for (const Vec3f& q : refined) {
                nearest = std::min<double>(nearest, Length(p - q));
            }
            worst = std::max(worst, nearest / box.Diagonal());
        }
    }
    return worst;
}

}  // namespace cc::test
