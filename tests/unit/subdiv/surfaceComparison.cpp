#include "tests/unit/subdiv/surfaceComparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "core/math/box.h"
#include "core/subdiv/irregularPatch.h"
#include "core/subdiv/irregularTriangle.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/limitOracle.h"

namespace cc::test {
namespace {

constexpr double kDegrees = 57.29577951308232;

double Degrees(const Vec3f& a, const Vec3f& b) {
    return std::atan2(Length(Cross(a, b)), Dot(a, b)) * kDegrees;
}

/// A vertex primvar that has nothing to do with the points.
std::vector<Vec3f> PrimvarFor(size_t pointCount) {
    std::mt19937 random(23);
    std::uniform_real_distribution<float> unit(-0.5f, 0.5f);
    std::vector<Vec3f> values(pointCount);
    for (Vec3f& value : values) {
        value = {unit(random), unit(random), unit(random)};
    }
    return values;
}

/// Compares one sample after the other and keeps the worst.
class Comparison {
  public:
    Comparison(const Cage& cage, const PatchTable& patches, OracleKind kind)
        : _kind(kind), _patches(patches), _points(patches.PatchPoints(cage.points)) {
        const std::vector<Vec3f> values = PrimvarFor(cage.points.size());
        _values = patches.PatchPoints(values);
        if (kind == OracleKind::Bfr) {
            _oracle = MakeBfrOracle(cage.mesh, cage.points, values);
        } else {
            _oracle = MakeFarOracle(cage.mesh, cage.points, values);
            _coarserOracle = MakeFarOracle(cage.mesh, cage.points, values, kOracleLevels - 1);
            _coarsestOracle = MakeFarOracle(cage.mesh, cage.points, values, kOracleLevels / 2);
        }
        Box3f box;
        for (int vertex : cage.mesh.faceVertexIndices) {
            box.Extend(cage.points[vertex]);
            _largest = std::max<double>(_largest, Length(cage.points[vertex]));
        }
        _diagonal = box.Diagonal();
    }

    bool HasFace(uint32_t face) { return _oracle->HasFace(face); }

    void Sample(uint32_t patch, float u, float v) {
        const bool isCorner = (u == 0 || u == 1) && (v == 0 || v == 1);
        if (isCorner && _kind == OracleKind::Bfr) {
            return;
        }
        const FaceParameter at = _patches.ToFace(patch, u, v);
        const LimitOracle::Sample expected = _oracle->Evaluate(at);
        const LimitPoint actual = EvaluateLimit(_patches, patch, _points.data(), u, v);
        const std::string where = _Where(patch, at);
        ++result.sampleCount;
        if (!expected.exists) {
            result.error = "no surface at " + where;
            return;
        }
        Keep(Length(actual.position - expected.position) / _diagonal, where, &result.position,
             &result.worstPosition);
        if (isCorner) {
            Keep(Length(_LimitCorner(patch, u, v) - expected.position) / _diagonal, where,
                 &result.position, &result.worstPosition);
        }
        const Vec3f value = EvaluateLimitValue(_patches, patch, _values.data(), u, v);
        Keep(Length(value - expected.value), where, &result.primvar, &result.worstPrimvar);
        if (_HasNormal(at, expected, isCorner)) {
            Keep(Degrees(_patches.IsLeftHanded() ? -actual.normal : actual.normal, expected.normal),
                 where, &result.normal, &result.worstNormal);
        }
    }

    SurfaceDifference result;

  private:
    /// The corner's limit position as tracers have it, without following the surface there.
    Vec3f _LimitCorner(uint32_t patch, float u, float v) const {
        Vec3f corners[4];
        if (_patches.At(patch).kind == PatchKind::Irregular) {
            GatherIrregular(_patches, patch, _points.data()).LimitCorners(corners);
            return corners[u == 0 ? (v == 0 ? 0 : 3) : (v == 0 ? 1 : 2)];
        }
        if (_patches.At(patch).kind == PatchKind::IrregularTriangle) {
            GatherIrregularTriangle(_patches, patch, _points.data()).LimitCorners(corners);
            return corners[u == 1 ? 1 : v == 1 ? 2 : 0];
        }
        return EvaluateLimit(_patches, patch, _points.data(), u, v).position;
    }

    /// NaN counts as worst.
    static void Keep(double difference, const std::string& where, double* worst,
                     std::string* worstWhere) {
        if (!(difference <= *worst)) {
            *worst = difference;
            *worstWhere = where;
        }
    }

    std::string _Where(uint32_t patch, const FaceParameter& at) const {
        const Patch& p = _patches.At(patch);
        return "face " + std::to_string(at.face) + "." + std::to_string(at.corner) + " (" +
               std::to_string(at.u) + ", " + std::to_string(at.v) + ") kind " +
               std::to_string(static_cast<int>(p.kind)) + " depth " + std::to_string(p.depth);
    }

    /// False where the surface has no normal, or none that floats can tell: our derivatives are
    /// sums of some twenty points, each of which is rounded.
    bool _HasNormal(const FaceParameter& at, const LimitOracle::Sample& expected, bool isCorner) {
        const double rounding = 16 * std::numeric_limits<float>::epsilon() * _largest;
        if (expected.normal == Vec3f{} ||
            rounding > expected.normalScale * kNormalTolerance / kDegrees) {
            return false;
        }
        return !isCorner || _IsSettled(at, expected.normal);
    }

    /// Where OpenSubdiv has no exact mask for a corner's tangents, its normal converges with the
    /// levels, by the ratio of the two largest eigenvalues: in a sharp corner whose n faces close
    /// around it those of rotations by 0 and by 2 pi / n, or 0.55 / 0.65 = 0.84 for 5 faces and
    /// 0.65 / 0.65 = 0.99 for 20; and in the corners of Loop's scheme where two are equal, as one
    /// over the levels. What is left in all is below 0.99 / (1 - 0.99) < 100 times what a level
    /// changes. A second, much coarser surface, since errors of two kinds may cancel out in one,
    /// and a normal may turn back: it is as near, or so far that the ratio is below 0.6.
    bool _IsSettled(const FaceParameter& at, const Vec3f& fine) {
        const double near = _Change(at, fine, _coarserOracle.get());
        const double far = _Change(at, fine, _coarsestOracle.get());
        constexpr double kSettled = kNormalTolerance / 100;
        return near < kSettled && (far < kSettled || 20 * near < far);
    }

    /// How far a coarser surface's normal is off, in degrees.
    static double _Change(const FaceParameter& at, const Vec3f& fine, LimitOracle* oracle) {
        const Vec3f coarse = oracle->Evaluate(at).normal;
        return coarse == Vec3f{} ? 180 : Degrees(coarse, fine);
    }

    const OracleKind _kind;
    std::unique_ptr<LimitOracle> _oracle;
    /// For corners, where Bfr is not asked.
    std::unique_ptr<LimitOracle> _coarserOracle, _coarsestOracle;
    const PatchTable& _patches;
    const std::vector<Vec3f> _points;
    std::vector<Vec3f> _values;
    double _diagonal = 1, _largest = 0;
};

/// False if all faces are left out, and there is nothing to compare.
bool HasAnyFace(const ControlMesh& mesh) {
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        if (!KeptCorners(face, count).empty()) {
            return true;
        }
        face += count;
    }
    return false;
}

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

SurfaceDifference CompareWithOracle(Cage cage, OracleKind kind) {
    if (!HasAnyFace(cage.mesh)) {
        return {};
    }
    SurfaceDifference failed;
    failed.error = ValidateControlMesh(&cage.mesh, cage.points.size()).error;
    if (!failed.error.empty()) {
        return failed;
    }
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &failed.error);
    if (!failed.error.empty()) {
        return failed;
    }
    Comparison comparison(cage, patches, kind);
    std::mt19937 random(7);
    const std::set<uint32_t> holes(cage.mesh.holeIndices.begin(), cage.mesh.holeIndices.end());
    std::set<uint32_t> covered = holes;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        if (patches.IsTriangle(patch)) {
            SampleTriangle(patch, &random, &comparison);
        } else {
            SamplePatch(patch, &random, &comparison);
        }
        if (holes.count(patches.AuthoredFace(patch)) != 0) {
            comparison.result.error = "a patch in a hole";
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

}  // namespace cc::test
