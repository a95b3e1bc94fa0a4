#include "core/trace/simdTargets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/tracer.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/rayAnswer.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

/// How far apart hits of two targets may lie, in sizes of the scene.
constexpr float kAgreement = 1e-6f;

constexpr int kPacketCount = 2 + Repeats(4);

/// What all rays of a scene hit on one target, by one kind of tracer.
struct Trace {
    RayPacket rays[kPacketCount];
    HitPacket hits[kPacketCount];
    uint64_t occluded[kPacketCount];
};

std::unique_ptr<Trace> TraceAll(const TracedCage& traced, TracerKind kind) {
    auto trace = std::make_unique<Trace>();
    const std::unique_ptr<Tracer> tracer = MakeTracer(kind, 4);
    const Vec3f directions[] = {
        {1, 0.2f, 0.3f}, {-0.4f, 1, 0.1f}, {0.2f, -0.3f, 1}, {0.1f, 0.2f, -1}};
    std::mt19937 random(13);
    TraceStatistics statistics;
    for (int n = 0; n < kPacketCount; ++n) {
        RayPacket& rays = trace->rays[n];
        rays = CameraPacket(traced.surface->Bounds(), directions[n % 4], 0.3f, &random);
        // Not all packets are full.
        rays.count = n % 3 == 2 ? 37 : kPacketSize;
        trace->occluded[n] = tracer->Occluded(traced.world, rays, &statistics);
        tracer->Intersect(traced.world, &rays, &trace->hits[n], &statistics);
    }
    return trace;
}

/// The limit surface where a hit says that it is.
LimitPoint SurfaceAt(const TracedCage& traced, const HitPacket& hits, int i) {
    return EvaluateLimit(traced.surface->Patches(), hits.patch[i],
                         traced.surface->PatchPoints().data(), hits.u[i], hits.v[i]);
}

/// Expects a ray to hit the surface at the same height on two targets: a step along the ray counts
/// by how steeply the ray meets the surface, as rounding moves grazing hits far along it.
void ExpectSameHit(const Cage& cage, const TracedCage& traced, const Trace& a, const Trace& b,
                   int n, int i) {
    const RayPacket& rays = a.rays[n];
    const LimitPoint atA = SurfaceAt(traced, a.hits[n], i), atB = SurfaceAt(traced, b.hits[n], i);
    const Vec3f direction = Normalize({rays.directionX[i], rays.directionY[i], rays.directionZ[i]});
    const float steepness = std::fabs(Dot(atA.normal, direction));
    const float bound = kAgreement * traced.surface->Bounds().Diagonal();
    EXPECT_LE(Length(PointOf(rays, i) - PointOf(b.rays[n], i)) * steepness, bound);
    if (!HasCoincidentFaces(cage)) {
        EXPECT_LE(Length(atA.position - atB.position) * steepness, bound);
    }
}

/// Counts hits, and expects those of another target, which is the one in use, to be the same. Only
/// a ray by an edge may hit on one of them alone, and few of many do.
int ExpectSame(const Cage& cage, const TracedCage& traced, const Tracer& tracer, const Trace& a,
               const Trace& b) {
    const float bound = kAgreement * traced.surface->Bounds().Diagonal();
    int hitCount = 0, edgeCount = 0;
    for (int n = 0; n < kPacketCount; ++n) {
        for (int i = 0; i < a.rays[n].count; ++i) {
            EXPECT_EQ((b.occluded[n] >> i & 1) != 0, b.hits[n].instance[i] != kNoHit);
            if (a.hits[n].instance[i] != b.hits[n].instance[i]) {
                ++edgeCount;
                const RayAnswer answer = AnswerOf(traced.world, a.rays[n], a.hits[n], i);
                EXPECT_TRUE(IsAnswerBeside(traced.world, tracer, a.rays[n], i, answer, bound));
            } else if (a.hits[n].instance[i] != kNoHit) {
                ++hitCount;
                ExpectSameHit(cage, traced, a, b, n, i);
            }
        }
    }
    EXPECT_LE(edgeCount, 1);
    return hitCount;
}

class SimdTargetsTest : public testing::TestWithParam<Cage> {
  protected:
    void TearDown() override { EXPECT_TRUE(UseSimdTarget("").empty()); }

    static void SetUpTestSuite() {
        std::printf("targets:");
        for (const std::string& name : SimdTargets()) {
            std::printf(" %s", name.c_str());
        }
        std::printf("\n");
    }
};

TEST_P(SimdTargetsTest, HitTheSame) {
    for (const TracerKind kind : {TracerKind::Packet, TracerKind::Single, TracerKind::Algorithm1,
                                  TracerKind::Tessellated}) {
        const TracedCage traced(GetParam());
        std::unique_ptr<Trace> best;
        for (const std::string& target : SimdTargets()) {
            SCOPED_TRACE(target);
            ASSERT_EQ(UseSimdTarget(target), "");
            ASSERT_EQ(CurrentSimdTarget(), target);
            std::unique_ptr<Trace> trace = TraceAll(traced, kind);
            if (best) {
                EXPECT_GT(ExpectSame(GetParam(), traced, *MakeTracer(kind, 4), *best, *trace), 10);
            } else {
                best = std::move(trace);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, SimdTargetsTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

TEST(SimdTargets, AreAllOfThisMachine) {
    const std::vector<std::string> names = SimdTargets();
    ASSERT_FALSE(names.empty());
#if defined(__x86_64__)
    EXPECT_EQ(names.back(), "SSE4") << "what every build has";
#ifndef CC_SANITIZED
    EXPECT_EQ(std::count(names.begin(), names.end(), "AVX2"),
              __builtin_cpu_supports("avx2") ? 1 : 0);
#endif
#endif
    EXPECT_EQ(UseSimdTarget(names.back()), "");
    EXPECT_EQ(SimdTargets(), names) << "also while one of them is in use";
    EXPECT_EQ(UseSimdTarget(""), "");
    EXPECT_EQ(CurrentSimdTarget(), names.front());
}

TEST(SimdTargets, UnknownOnesAreRefused) {
    const std::string error = UseSimdTarget("MMX");
    EXPECT_NE(error.find("'MMX'"), std::string::npos);
    EXPECT_NE(error.find(SimdTargets().front()), std::string::npos);
}

}  // namespace
}  // namespace cc::test
