// What the oracle says is there is what rays hit, and where it has a hole they hit nothing; under
// every scheme.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/repeats.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/limitOracle.h"
#include "tests/unit/subdiv/polygonOracle.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/rayAnswer.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

constexpr int kLevel = 5;

/// How far from the surface rays begin, in sizes of the scene.
constexpr float kDistance = 0.05f;

/// What rounding leaves of distances, in sizes of the scene: the oracle's tolerance is half of it.
constexpr float kRounding = 2e-5f;

/// A place of the oracle's surface that a ray looks at.
struct Target {
    uint32_t face;
    Vec3f position, normal;
    /// How far the triangles of the level may be from the surface.
    float bound;
};

/// The surface of a cage as it would be without holes.
std::unique_ptr<LimitOracle> OracleOf(const Cage& cage) {
    ControlMesh mesh = cage.mesh;
    mesh.holeIndices.clear();
    return mesh.scheme == Scheme::None ? MakePolygonOracle(mesh, cage.points)
                                       : MakeFarOracle(mesh, cage.points, cage.points);
}

/// The parts of a face that have parameters of their own: the triangles of a polygon, and the
/// sub-quads of what is no quad.
std::vector<FaceParameter> PartsOf(const ControlMesh& mesh, uint32_t face, const int* vertices) {
    std::vector<FaceParameter> parts;
    if (mesh.scheme == Scheme::None) {
        for (int triangle = 0; triangle < mesh.faceVertexCounts[face] - 2; ++triangle) {
            parts.push_back({face, static_cast<uint32_t>(triangle), 0, 0, true});
        }
        return parts;
    }
    const std::vector<int> kept = KeptCorners(vertices, mesh.faceVertexCounts[face]);
    if (mesh.scheme == Scheme::Loop) {
        return {{face, 0, 0, 0, true}};
    }
    if (kept.size() == 4) {
        return {{face, 0, 0, 0}};
    }
    for (const int corner : kept) {
        parts.push_back({face, static_cast<uint32_t>(corner), 0, 0});
    }
    return parts;
}

/// How far the triangles of a level are from the surface at a place: those between the oracle's
/// points at the corners of the cell around it, on whichever diagonal. False if there are none.
bool FindBound(LimitOracle* oracle, const FaceParameter& at, const Vec3f& position, int cells,
               float* bound) {
    const auto side = static_cast<float>(cells);
    const auto cellOf = [side](float x) { return std::min(std::floor(x * side), side - 1); };
    const float column = cellOf(at.u), row = cellOf(at.v);
    // In a triangle, every other cell is turned by half a turn, and has no other diagonal.
    const float u = at.u * side - column, v = at.v * side - row;
    std::array<Vec3f, 4> corners;
    for (int i = 0; i < 4; ++i) {
        const int right = i & 1, up = i >> 1;
        if (at.isTriangle && ((i == 0 && u + v > 1) || (i == 3 && u + v <= 1))) {
            continue;
        }
        FaceParameter corner = at;
        corner.u = (column + static_cast<float>(right)) / side;
        corner.v = (row + static_cast<float>(up)) / side;
        const LimitOracle::Sample sample = oracle->Evaluate(corner);
        if (!sample.exists) {
            return false;
        }
        corners[i] = sample.position;
    }
    const auto& [p00, p10, p01, p11] = corners;
    const Vec3f falling = u + v <= 1 ? p00 + (p10 - p00) * u + (p01 - p00) * v
                                     : p11 + (p01 - p11) * (1 - u) + (p10 - p11) * (1 - v);
    const Vec3f rising =
        u >= v ? p00 + (p10 - p00) * u + (p11 - p10) * v : p00 + (p01 - p00) * v + (p11 - p01) * u;
    *bound = Length(falling - position);
    if (!at.isTriangle) {
        *bound = std::max(*bound, Length(rising - position));
    }
    return true;
}

/// Places on a face, away from its edges: beyond an edge of the surface, its triangles end early.
void AddTargets(LimitOracle* oracle, FaceParameter part, bool isWhole, int count,
                std::mt19937* random, std::vector<Target>* targets) {
    std::uniform_real_distribution<float> unit(0.03f, 0.97f);
    for (int i = 0; i < count; ++i) {
        part.u = unit(*random);
        part.v = unit(*random);
        if (part.isTriangle) {
            // Into the triangle, and then away from its third edge.
            const bool isBeyond = part.u + part.v > 1;
            part.u = 0.02f + 0.95f * (isBeyond ? 1 - part.u : part.u);
            part.v = 0.02f + 0.95f * (isBeyond ? 1 - part.v : part.v);
        }
        const LimitOracle::Sample sample = oracle->Evaluate(part);
        float bound;
        if (sample.exists && sample.normal != Vec3f{} &&
            FindBound(oracle, part, sample.position, 1 << (isWhole ? kLevel : kLevel - 1),
                      &bound)) {
            targets->push_back({part.face, sample.position, sample.normal, bound});
        }
    }
}

/// Places all over a cage's surface.
/// @param oracle  OracleOf the cage
std::vector<Target> TargetsOf(const Cage& cage, LimitOracle* oracle) {
    const ControlMesh& mesh = cage.mesh;
    std::mt19937 random(17);
    std::vector<Target> targets;
    const int* vertices = mesh.faceVertexIndices.data();
    for (int face = 0; face < mesh.FaceCount(); ++face) {
        if (oracle->HasFace(face)) {
            const std::vector<FaceParameter> parts = PartsOf(mesh, face, vertices);
            for (const FaceParameter& part : parts) {
                AddTargets(oracle, part, parts.size() == 1, parts.size() == 1 ? 4 : 2, &random,
                           &targets);
            }
        }
        vertices += mesh.faceVertexCounts[face];
    }
    return targets;
}

/// Rays at targets, from alternate sides. They see no more than lies within the bounds: what is in
/// front of a target is no matter.
RayPacket RaysAt(const std::vector<Target>& targets, size_t first, float diagonal) {
    RayPacket rays;
    rays.count = static_cast<int>(std::min<size_t>(kPacketSize, targets.size() - first));
    for (int i = 0; i < rays.count; ++i) {
        const Target& target = targets[first + i];
        const Vec3f direction = target.normal * (i % 2 == 0 ? -1.0f : 1.0f);
        const Vec3f origin = target.position - direction * (kDistance * diagonal);
        SetRay(i, origin, direction, &rays);
        const float bound = 2 * target.bound + kRounding * diagonal;
        rays.tMin[i] = kDistance * diagonal - bound;
        rays.tMax[i] = kDistance * diagonal + bound;
    }
    return rays;
}

/// The faces that rays at a face may hit: it and those on the same vertices, but for holes.
std::vector<std::set<uint32_t>> VisibleTwins(const ControlMesh& mesh) {
    const std::set<int> holes(mesh.holeIndices.begin(), mesh.holeIndices.end());
    std::map<std::set<int>, std::set<uint32_t>> visible;
    std::vector<std::set<int>> keys;
    const int* vertices = mesh.faceVertexIndices.data();
    for (int face = 0; face < mesh.FaceCount(); ++face) {
        keys.emplace_back(vertices, vertices + mesh.faceVertexCounts[face]);
        vertices += mesh.faceVertexCounts[face];
        if (holes.count(face) == 0) {
            visible[keys.back()].insert(face);
        }
    }
    std::vector<std::set<uint32_t>> twins;
    for (const std::set<int>& key : keys) {
        twins.push_back(visible[key]);
    }
    return twins;
}

/// A hit is no further from the surface at its own parameters than the level's triangles are there.
void ExpectOnSurface(const Surface& surface, LimitOracle* oracle, const RayPacket& rays,
                     const HitPacket& hits, int i) {
    const PatchTable& patches = surface.Patches();
    const FaceParameter at = patches.ToFace(hits.patch[i], hits.u[i], hits.v[i]);
    const LimitOracle::Sample sample = oracle->Evaluate(at);
    const int cells = 1 << (kLevel - patches.At(hits.patch[i]).isSubQuad);
    float bound = 0;
    ASSERT_TRUE(sample.exists && FindBound(oracle, at, sample.position, cells, &bound));
    EXPECT_LE(Length(PointOf(rays, i) - sample.position),
              bound + kRounding * surface.Bounds().Diagonal())
        << "face " << at.face << "." << at.corner << " (" << at.u << ", " << at.v << ")";
}

/// Traces rays at all places of a cage's surface, and expects those at holes to hit nothing and all
/// others the face that they are aimed at, on its surface.
void ExpectJustWhatIsVisible(const Cage& cage) {
    const TracedCage traced(cage);
    const std::unique_ptr<LimitOracle> oracle = OracleOf(cage);
    const std::vector<Target> targets = TargetsOf(cage, oracle.get());
    const std::vector<std::set<uint32_t>> twins = VisibleTwins(cage.mesh);
    EXPECT_FALSE(targets.empty());
    TraceStatistics statistics;
    for (const TracerKind kind : {TracerKind::Packet, TracerKind::Single}) {
        const std::unique_ptr<Tracer> tracer = MakeTracer(kind, kLevel);
        for (size_t first = 0; first < targets.size(); first += kPacketSize) {
            RayPacket rays = RaysAt(targets, first, traced.surface->Bounds().Diagonal());
            const uint64_t occluded = tracer->Occluded(traced.world, rays, &statistics);
            HitPacket hits;
            tracer->Intersect(traced.world, &rays, &hits, &statistics);
            for (int i = 0; i < rays.count; ++i) {
                const RayAnswer answer = AnswerOf(traced.world, rays, hits, i);
                const std::set<uint32_t>& expected = twins[targets[first + i].face];
                EXPECT_EQ((occluded >> i & 1) != 0, !expected.empty());
                EXPECT_TRUE(expected.empty() ? answer.instance == kNoHit
                                             : expected.count(answer.face) != 0)
                    << (kind == TracerKind::Packet ? "packet" : "single") << " hits face "
                    << int(answer.face) << " at face " << targets[first + i].face;
                if (answer.instance != kNoHit) {
                    ExpectOnSurface(*traced.surface, oracle.get(), rays, hits, i);
                }
            }
        }
    }
}

/// A cage with holes from one face on, at every third.
Cage Punched(Cage cage, int firstFace) {
    cage.mesh.holeIndices.clear();
    for (int face = firstFace; face < cage.mesh.FaceCount(); face += 3) {
        cage.mesh.holeIndices.push_back(face);
    }
    return cage;
}

class VisibilityTest : public testing::TestWithParam<Cage> {};

TEST_P(VisibilityTest, WhatIsThereIsHit) { ExpectJustWhatIsVisible(GetParam()); }

TEST_P(VisibilityTest, HolesAreNotHit) {
    for (int firstFace = 0; firstFace < 3; ++firstFace) {
        const Cage cage = Punched(GetParam(), firstFace);
        if (cage.mesh.holeIndices.size() < static_cast<size_t>(cage.mesh.FaceCount())) {
            ExpectJustWhatIsVisible(cage);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, VisibilityTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

/// A star of concave corners, and a square with a square hole, which a bridge that is walked twice
/// leads to; beside each other, and not quite flat.
Cage ConcavePolygons() {
    Cage cage = FromFaces(
        "",
        {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {10, 11, 12, 13, 10, 14, 15, 16, 17, 14}, {11, 18, 12}});
    cage.points.clear();
    for (int i = 0; i < 10; ++i) {
        const float angle = 0.62831853f * static_cast<float>(i), radius = i % 2 == 0 ? 1.0f : 0.3f;
        cage.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.01f * angle});
    }
    cage.points.insert(cage.points.end(), {{2, -2, 0},
                                           {6, -2, 0.1f},
                                           {6, 2, 0},
                                           {2, 2, 0.1f},
                                           {3, -1, 0},
                                           {3, 1, 0.1f},
                                           {5, 1, 0},
                                           {5, -1, 0.1f},
                                           {7, 0, 1}});
    return cage;
}

/// Cages whose faces are not smoothed, of every shape; where they have tags, those mean nothing.
std::vector<Cage> UnsmoothedCages() {
    std::vector<Cage> cages{WithScheme(ConcavePolygons(), Scheme::None, "concave polygons")};
    for (const auto& theme :
         {ShapeCages(), BoundaryCages(), NonManifoldCages(), CombinedCages(), LoopShapeCages()}) {
        for (const Cage& cage : theme) {
            cages.push_back(WithScheme(cage, Scheme::Bilinear, "bilinear " + cage.name));
            // Faces on the same vertices may be cut along other diagonals.
            if (!HasCoincidentFaces(cage)) {
                cages.push_back(WithScheme(cage, Scheme::None, "polygons of " + cage.name));
            }
        }
    }
    return cages;
}

INSTANTIATE_TEST_SUITE_P(Unsmoothed, VisibilityTest, testing::ValuesIn(Sample(UnsmoothedCages())),
                         TestName);

}  // namespace
}  // namespace cc::test
