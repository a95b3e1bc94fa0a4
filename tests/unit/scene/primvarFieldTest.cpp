#include "core/scene/primvarField.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "tests/repeats.h"
#include "tests/unit/render/renderTestKit.h"
#include "tests/unit/subdiv/faceVaryingOracle.h"
#include "tests/unit/subdiv/primvarOracle.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

constexpr Interpolation kInterpolations[] = {Interpolation::Constant, Interpolation::Uniform,
                                             Interpolation::Varying, Interpolation::Vertex,
                                             Interpolation::FaceVarying};

size_t ElementCount(const Cage& cage, Interpolation interpolation) {
    switch (interpolation) {
        case Interpolation::Uniform: return cage.mesh.faceVertexCounts.size();
        case Interpolation::Varying:
        case Interpolation::Vertex: return cage.points.size();
        case Interpolation::FaceVarying: return cage.mesh.faceVertexIndices.size();
        case Interpolation::Instance:
        case Interpolation::Constant: break;
    }
    return 1;
}

/// Random values in 0..1, with or without indices; with, faceVarying ones are welded here and
/// there.
Primvar RandomPrimvar(const Cage& cage, Interpolation interpolation, int arity, bool isIndexed) {
    std::mt19937 random(static_cast<unsigned>(arity));
    std::uniform_real_distribution<float> unit(0, 1);
    Primvar primvar{interpolation, arity, {}, {}};
    const size_t count = ElementCount(cage, interpolation);
    size_t valueCount = count;
    if (isIndexed) {
        for (size_t i = 0; i < count; ++i) {
            const bool isWelded = interpolation == Interpolation::FaceVarying && random() % 4 != 0;
            primvar.indices.push_back(isWelded ? cage.mesh.faceVertexIndices[i]
                                               : static_cast<int>(count - 1 - i));
        }
        valueCount = std::max(count, cage.points.size());
    }
    primvar.values.resize(valueCount * static_cast<size_t>(arity));
    std::generate(primvar.values.begin(), primvar.values.end(), [&] { return unit(random); });
    return primvar;
}

/// A mesh with one primvar, built.
struct Built {
    Built(const Cage& cage, const Primvar& primvar) : mesh(AddCage(&scene, "/mesh", cage)) {
        mesh->SetPrimvar("x", primvar);
        lines = scene.Build({"geometry"});
        field = mesh->FindPrimvar("x");
    }

    const PatchTable& Patches() const { return mesh->BuiltSurface()->Patches(); }
    SurfaceValue At(uint32_t patch, float u, float v) const {
        return mesh->Evaluate(*field, {0, patch, u, v});
    }

    Scene scene;
    Mesh* mesh;
    const PrimvarField* field;
    std::vector<std::string> lines;
};

class PrimvarFieldTest : public testing::TestWithParam<Cage> {};

/// How far values and derivatives are apart at worst.
struct WorstDifference {
    float value = 0, derivative = 0;

    bool IsWithinTolerance() const { return value < 1e-5f && derivative < 1e-4f; }
    void Note(const SurfaceValue& ours, const SurfaceValue& expected) {
        for (int i = 0; i < 4; ++i) {
            value = std::max(value, std::fabs(ours.value[i] - expected.value[i]));
            const float scale = 1 + std::fabs(expected.du[i]) + std::fabs(expected.dv[i]);
            derivative = std::max({derivative, std::fabs(ours.du[i] - expected.du[i]) / scale,
                                   std::fabs(ours.dv[i] - expected.dv[i]) / scale});
        }
    }
};

template <typename Oracle>
WorstDifference Compare(const Built& built, Oracle* oracle) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.05f, 0.95f);
    WorstDifference worst;
    for (uint32_t patch = 0; patch < built.Patches().Count(); ++patch) {
        for (int sample = 0; sample < Repeats(3); ++sample) {
            const float u = unit(random);
            const float v = unit(random) * (built.Patches().IsTriangle(patch) ? 1 - u : 1);
            SurfaceValue expected;
            EXPECT_TRUE(oracle->Evaluate(built.Patches().ToFace(patch, u, v), &expected));
            worst.Note(built.At(patch, u, v), expected);
        }
    }
    return worst;
}

/// Values must agree with Bfr's, or with Far's where the two contradict each other
/// (FaceVaryingOracle).
void ExpectAgreement(const Cage& cage, const Primvar& primvar, const std::string& what) {
    SCOPED_TRACE(what);
    Cage valid = cage;
    ValidateControlMesh(&valid.mesh, cage.points.size());
    const Built built(cage, primvar);
    ASSERT_NE(built.field, nullptr);
    ASSERT_EQ(built.field->Arity(), primvar.arity);
    PrimvarOracle oracle(valid.mesh, cage.points.size(), primvar);
    WorstDifference worst = Compare(built, &oracle);
    if (!worst.IsWithinTolerance() && primvar.interpolation == Interpolation::FaceVarying &&
        !primvar.indices.empty()) {
        FaceVaryingOracle far(valid.mesh, cage.points.size(), primvar);
        worst = Compare(built, &far);
    }
    EXPECT_TRUE(worst.IsWithinTolerance())
        << "value off by " << worst.value << ", derivative by " << worst.derivative;
}

TEST_P(PrimvarFieldTest, AgreesWithOpenSubdiv) {
    Cage cage = GetParam();
    int arity = 0;
    for (const Interpolation interpolation :
         {Interpolation::Varying, Interpolation::Vertex, Interpolation::FaceVarying}) {
        for (const bool isIndexed : {false, true}) {
            for (const FaceVaryingRule rule :
                 {FaceVaryingRule::None, FaceVaryingRule::CornersOnly,
                  FaceVaryingRule::CornersPlus1, FaceVaryingRule::CornersPlus2,
                  FaceVaryingRule::Boundaries, FaceVaryingRule::All}) {
                if (interpolation != Interpolation::FaceVarying && rule != FaceVaryingRule::None) {
                    continue;
                }
                cage.mesh.faceVaryingRule = rule;
                arity = arity % 4 + 1;
                ExpectAgreement(cage, RandomPrimvar(cage, interpolation, arity, isIndexed),
                                "interpolation " + std::to_string(int(interpolation)) + ", rule " +
                                    std::to_string(int(rule)) + (isIndexed ? ", indexed" : ""));
            }
        }
    }
}

TEST_P(PrimvarFieldTest, AgreesWithOpenSubdivsBilinearScheme) {
    Cage cage = GetParam();
    cage.mesh.scheme = Scheme::Bilinear;
    cage.mesh.boundaryRule = BoundaryRule::EdgeAndCorner;
    int arity = 2;
    for (const Interpolation interpolation :
         {Interpolation::Varying, Interpolation::Vertex, Interpolation::FaceVarying}) {
        arity = arity % 4 + 1;
        ExpectAgreement(cage, RandomPrimvar(cage, interpolation, arity, true),
                        "interpolation " + std::to_string(int(interpolation)));
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, PrimvarFieldTest, testing::ValuesIn(Sample(Catalogue())),
                         TestName);

/// Calls check(patch, u, v) all over a surface.
template <typename Check>
void ForEachParameter(const Built& built, const Check& check) {
    for (uint32_t patch = 0; patch < built.Patches().Count(); ++patch) {
        for (const float u : {0.0f, 0.3f, 0.75f, 1.0f}) {
            for (const float v : {0.0f, 0.4f, 1.0f}) {
                check(patch, u, v);
            }
        }
    }
}

TEST(PrimvarField, ConstantIsTheSameEverywhere) {
    for (int arity = 1; arity <= 4; ++arity) {
        Primvar primvar{Interpolation::Constant, arity, {0, 1, 2, 3, 4, 5, 6, 7}, {1}};
        primvar.values.resize(2 * static_cast<size_t>(arity));
        const Built built(Cube(), primvar);
        ASSERT_NE(built.field, nullptr);
        ForEachParameter(built, [&](uint32_t patch, float u, float v) {
            const SurfaceValue value = built.At(patch, u, v);
            for (int i = 0; i < 4; ++i) {
                EXPECT_EQ(value.value[i], i < arity ? primvar.values[arity + i] : 0);
                EXPECT_EQ(value.du[i], 0);
                EXPECT_EQ(value.dv[i], 0);
            }
        });
    }
}

TEST(PrimvarField, UniformGoesByTheAuthoredFace) {
    for (const Cage& cage : {Drum(5), Fan(5), Tetrahedron()}) {
        const Primvar primvar = RandomPrimvar(cage, Interpolation::Uniform, 2, false);
        const Built built(cage, primvar);
        ForEachParameter(built, [&](uint32_t patch, float u, float v) {
            const float* const expected = primvar.Element(built.Patches().AuthoredFace(patch));
            EXPECT_EQ(built.At(patch, u, v).value[0], expected[0]);
            EXPECT_EQ(built.At(patch, u, v).value[1], expected[1]);
        });
    }
}

TEST(PrimvarField, VertexPositionsAreTheSurface) {
    for (const Cage& cage : {Cube(), Fan(5), Drum(7), Tetrahedron()}) {
        const Built built(cage, Primvar3(Interpolation::Vertex, cage.points));
        ForEachParameter(built, [&](uint32_t patch, float u, float v) {
            const LimitPoint limit = EvaluateLimit(
                built.Patches(), patch, built.mesh->BuiltSurface()->PatchPoints().data(), u, v);
            const SurfaceValue value = built.At(patch, u, v);
            // The surface's own points lie on a lattice (Surface).
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(value.value[axis], limit.position[axis], 1e-6f);
            }
        });
    }
}

/// A patch whose extraordinary vertex is not at the face's first corner is turned.
TEST(PrimvarField, DerivativesAreThoseByTheFaceHoweverThePatchIsTurned) {
    int turned[4] = {};
    for (int first = 0; first < 4; ++first) {
        Cage cage = Fan(5);
        for (size_t face = 0; face < cage.mesh.faceVertexCounts.size(); ++face) {
            const auto begin = cage.mesh.faceVertexIndices.begin() + 4 * static_cast<long>(face);
            std::rotate(begin, begin + first, begin + 4);
        }
        const Primvar primvar = RandomPrimvar(cage, Interpolation::Vertex, 2, false);
        ExpectAgreement(cage, primvar, "first corner " + std::to_string(first));
        const Built built(cage, primvar);
        for (uint32_t patch = 0; patch < built.Patches().Count(); ++patch) {
            ++turned[built.Patches().At(patch).rotation];
        }
    }
    for (int count : turned) {
        EXPECT_GT(count, 0);
    }
}

TEST(PrimvarField, LeftHandedMeshesKeepTheirCorners) {
    Cage cage = Drum(5);
    const Primvar primvar = RandomPrimvar(cage, Interpolation::FaceVarying, 2, false);
    const Built right(cage, primvar);
    cage.mesh.leftHanded = true;
    const Built left(cage, primvar);
    ForEachParameter(right, [&](uint32_t patch, float u, float v) {
        EXPECT_EQ(left.At(patch, u, v).value[0], right.At(patch, u, v).value[0]);
    });
}

TEST(PrimvarField, GivesThePrimvarBack) {
    const Cage cage = Fan(5);
    for (const Interpolation interpolation : kInterpolations) {
        for (int arity = 1; arity <= 4; ++arity) {
            const Primvar primvar = RandomPrimvar(cage, interpolation, arity, false);
            const Built built(cage, primvar);
            PrimvarField field = *built.field;
            EXPECT_TRUE(field.IsMadeOf(primvar));
            Primvar other = primvar;
            other.values.back() += 1;
            EXPECT_FALSE(field.IsMadeOf(other));
            EXPECT_EQ(field.TakePrimvar(), primvar);
            EXPECT_TRUE(field.IsEmpty());
        }
    }
}

TEST(CheckPrimvar, FindsWrongElementCounts) {
    const Cage cage = Drum(5);
    const size_t points = cage.points.size();
    const PrimvarSizes sizes{cage.mesh.faceVertexCounts.size(), points, points,
                             cage.mesh.faceVertexIndices.size(), 1};
    for (const Interpolation interpolation : kInterpolations) {
        for (int arity = 1; arity <= 4; ++arity) {
            const size_t count = ElementCount(cage, interpolation);
            const auto check = [&](size_t valueCount, std::vector<int> indices) {
                return CheckPrimvar("st",
                                    {interpolation, arity, std::vector<float>(valueCount * arity),
                                     std::move(indices)},
                                    sizes);
            };
            EXPECT_EQ(check(count, {}), "");
            EXPECT_NE(check(count + 1, {}), "");
            EXPECT_NE(check(count + 40, {}), "");
            // Indices count, if there are any.
            EXPECT_EQ(check(1, std::vector<int>(count, 0)), "");
            EXPECT_NE(check(count, std::vector<int>(count + 1, 0)), "");
            EXPECT_NE(check(1, std::vector<int>(count, 1)), "");
            EXPECT_NE(check(1, std::vector<int>(count, -1)), "");
            EXPECT_NE(check(0, std::vector<int>(count, 0)), "");
        }
    }
}

TEST(CheckPrimvar, NamesWhatIsNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const std::string error =
            CheckPrimvar("st", {Interpolation::Constant, 2, {1, bad}, {}}, {1, 4, 4, 4, 1});
        EXPECT_NE(error.find("st has"), std::string::npos) << error;
    }
}

}  // namespace
}  // namespace cc::test
