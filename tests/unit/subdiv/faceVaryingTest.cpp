#include <cstdlib>
#include <memory>
#include <random>

#include <gtest/gtest.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "core/subdiv/faceVaryingChannel.h"
#include "core/subdiv/faceVaryingMesh.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr FaceVaryingRule kRules[] = {FaceVaryingRule::None,         FaceVaryingRule::CornersOnly,
                                      FaceVaryingRule::CornersPlus1, FaceVaryingRule::CornersPlus2,
                                      FaceVaryingRule::Boundaries,   FaceVaryingRule::All};

Sdc::Options::FVarLinearInterpolation ToSdc(FaceVaryingRule rule) {
    switch (rule) {
        case FaceVaryingRule::None: return Sdc::Options::FVAR_LINEAR_NONE;
        case FaceVaryingRule::CornersOnly: return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
        case FaceVaryingRule::CornersPlus1: return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
        case FaceVaryingRule::CornersPlus2: return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
        case FaceVaryingRule::Boundaries: return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
        case FaceVaryingRule::All: break;
    }
    return Sdc::Options::FVAR_LINEAR_ALL;
}

Sdc::Options ToSdc(const ControlMesh& mesh) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        mesh.boundaryRule == BoundaryRule::None       ? Sdc::Options::VTX_BOUNDARY_NONE
        : mesh.boundaryRule == BoundaryRule::EdgeOnly ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                                      : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(ToSdc(mesh.faceVaryingRule));
    options.SetCreasingMethod(mesh.creaseRule == CreaseRule::Chaikin
                                  ? Sdc::Options::CREASE_CHAIKIN
                                  : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(mesh.triangleRule == TriangleRule::Smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

/// Face-varying values as OpenSubdiv's own evaluator has them.
class FaceVaryingOracle {
  public:
    FaceVaryingOracle(const ControlMesh& mesh, size_t pointCount, const std::vector<Vec3f>& values,
                      const std::vector<int>& indices)
        : _values(values) {
        Far::TopologyDescriptor d;
        d.numVertices = static_cast<int>(pointCount);
        d.numFaces = mesh.FaceCount();
        d.numVertsPerFace = mesh.faceVertexCounts.data();
        d.vertIndicesPerFace = mesh.faceVertexIndices.data();
        d.numCreases = static_cast<int>(mesh.creaseSharpnesses.size());
        d.creaseVertexIndexPairs = mesh.creaseIndices.data();
        d.creaseWeights = mesh.creaseSharpnesses.data();
        d.numCorners = static_cast<int>(mesh.cornerIndices.size());
        d.cornerVertexIndices = mesh.cornerIndices.data();
        d.cornerWeights = mesh.cornerSharpnesses.data();
        Far::TopologyDescriptor::FVarChannel channel;
        channel.numValues = static_cast<int>(values.size());
        channel.valueIndices = indices.data();
        d.numFVarChannels = 1;
        d.fvarChannels = &channel;
        using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
        _refiner.reset(RefinerFactory::Create(
            d, RefinerFactory::Options(
                   mesh.scheme == Scheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK,
                   ToSdc(mesh))));
        Factory::Options precise;
        precise.SetApproxLevelSmooth(8).SetApproxLevelSharp(10);
        _factory = std::make_unique<Factory>(*_refiner, precise);
    }

    Vec3f Evaluate(const FaceParameter& at) {
        if (_face != at.face) {
            _face = at.face;
            EXPECT_TRUE(_factory->InitFaceVaryingSurface(static_cast<int>(at.face), &_surface, 0));
            _points.resize(3 * _surface.GetNumPatchPoints());
            _surface.PreparePatchPoints(&_values[0].x, 3, _points.data(), 3);
        }
        float uv[2] = {at.u, at.v};
        if (_surface.GetParameterization().HasSubFaces()) {
            _surface.GetParameterization().ConvertNormalizedSubFaceToCoord(
                static_cast<int>(at.corner), uv, uv);
        }
        Vec3f value;
        _surface.Evaluate(uv, _points.data(), 3, &value.x);
        return value;
    }

  private:
    using Factory = Bfr::RefinerSurfaceFactory<>;
    const std::vector<Vec3f>& _values;
    std::unique_ptr<Far::TopologyRefiner> _refiner;
    std::unique_ptr<Factory> _factory;
    uint32_t _face = 0xffffffffu;
    Bfr::Surface<float> _surface;
    std::vector<float> _points;
};

/// A way to give face-vertices their values.
struct Split {
    const char* name;
    /// The value's group at a vertex, given its face and a coin.
    int (*group)(int face, int faceVertex, int coin);
};

constexpr Split kSplits[] = {
    {"whole", [](int, int, int) { return 0; }},
    {"stripes", [](int face, int, int) { return face % 2; }},
    {"halves", [](int face, int, int) { return static_cast<int>(face > 2); }},
    {"thirds", [](int face, int, int) { return face % 3; }},
    {"one corner", [](int, int faceVertex, int) { return static_cast<int>(faceVertex == 5); }},
    {"coins", [](int, int, int coin) { return static_cast<int>(coin % 4 == 0); }},
    {"islands", [](int face, int, int) { return face; }},
};

std::vector<int> ValueIndices(const ControlMesh& mesh, size_t pointCount, const Split& split) {
    std::vector<int> indices;
    std::mt19937 random(5);
    for (int face = 0, at = 0; face < mesh.FaceCount(); ++face) {
        for (int i = 0; i < mesh.faceVertexCounts[face]; ++i, ++at) {
            const int group = split.group(face, at, static_cast<int>(random() & 255));
            indices.push_back(mesh.faceVertexIndices[at] + group * static_cast<int>(pointCount));
        }
    }
    return indices;
}

std::vector<Vec3f> RandomValues(size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Vec3f> values(count);
    for (Vec3f& value : values) {
        value = {unit(random), unit(random), unit(random)};
    }
    return values;
}

bool HasCollapsedFaces(const ControlMesh& mesh) {
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        if (KeptCorners(face, count).size() < static_cast<size_t>(count)) {
            return true;
        }
        face += count;
    }
    return false;
}

class FaceVaryingTest : public testing::TestWithParam<Cage> {};

void ExpectAgreement(const Cage& cage, const PatchTable& patches, const Split& split) {
    const std::vector<int> indices = ValueIndices(cage.mesh, cage.points.size(), split);
    const std::vector<Vec3f> values =
        RandomValues(cage.points.size() * static_cast<size_t>(cage.mesh.FaceCount() + 2));
    FaceVaryingOracle oracle(cage.mesh, cage.points.size(), values, indices);
    std::string warning;
    const FaceVaryingChannel channel(cage.mesh, cage.points.size(), values, indices, &warning);
    if (!warning.empty()) {
        return;  // said to be approximate
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.01f, 0.99f);
    float worst = 0;
    FaceParameter worstAt{};
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        for (int i = 0; i < 4; ++i) {
            const float u = unit(random), v = unit(random);
            const FaceParameter at =
                patches.ToFace(patch, u, patches.IsTriangle(patch) ? (1 - u) * v : v);
            const float difference = Length(channel.Evaluate(at) - oracle.Evaluate(at));
            if (!(difference <= worst)) {
                worst = difference;
                worstAt = at;
            }
        }
    }
    EXPECT_LT(worst, 1e-5f) << split.name << ", rule " << int(cage.mesh.faceVaryingRule)
                            << ", face " << worstAt.face << " at " << worstAt.u << " " << worstAt.v;
}

TEST_P(FaceVaryingTest, AgreesWithOpenSubdiv) {
    Cage cage = GetParam();
    ASSERT_TRUE(ValidateControlMesh(&cage.mesh, cage.points.size()).IsValid());
    if (HasCollapsedFaces(cage.mesh)) {
        GTEST_SKIP() << "OpenSubdiv has no values on faces with collapsed edges";
    }
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    for (FaceVaryingRule rule : kRules) {
        cage.mesh.faceVaryingRule = rule;
        for (const Split& split : kSplits) {
            if (rule != FaceVaryingRule::All) {
                ExpectAgreement(cage, patches, split);
            }
        }
    }
}

TEST(FaceVarying, NeedsNoPatchesWhereItIsBilinear) {
    ControlMesh mesh = Cube().mesh;
    for (FaceVaryingRule rule : kRules) {
        mesh.faceVaryingRule = rule;
        EXPECT_EQ(IsFaceVaryingBilinear(mesh, true), rule == FaceVaryingRule::All);
        EXPECT_EQ(IsFaceVaryingBilinear(mesh, false), rule != FaceVaryingRule::None);
    }
    mesh.scheme = Scheme::Bilinear;
    EXPECT_TRUE(IsFaceVaryingBilinear(mesh, true));
}

TEST(FaceVarying, ValuesAreTakenAtTheirVertices) {
    // One value for all points of the cage is the same everywhere, and not one vertex.
    const Cage cage = Cube();
    std::string warning;
    const FaceVaryingChannel channel(cage.mesh, cage.points.size(), {{3, 4, 5}},
                                     std::vector<int>(24, 0), &warning);
    EXPECT_EQ(warning, "");
    for (uint32_t face = 0; face < 6; ++face) {
        const Vec3f value = channel.Evaluate({face, 0, 0.3f, 1});
        EXPECT_LT(Length(value - Vec3f{3, 4, 5}), 1e-5f);
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, FaceVaryingTest, testing::ValuesIn(Catalogue()), TestName);

}  // namespace
}  // namespace cc::test
