#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "core/trace/algorithm1Tracer.h"
#include "core/trace/objectRays.h"
#include "core/trace/tracer.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/rayAnswer.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

constexpr int kLevel = 4;

/// How far apart, in sizes of the scene, tracers may see the same point. They split cages into the
/// same triangles: only the rounding of vertices and distances is left.
constexpr float kAgreement = 1e-5f;

struct Reference {
    const char* name;
    TracerKind kind;
};
constexpr Reference kReferences[] = {
    {"single", TracerKind::Single},
    {"algorithm1", TracerKind::Algorithm1},
    {"tessellated", TracerKind::Tessellated},
    {"algorithm1 with texture coordinates", TracerKind::Algorithm1WithTexture},
};
constexpr size_t kReferenceCount = sizeof(kReferences) / sizeof(kReferences[0]);

class TracerAgreementTest : public testing::TestWithParam<Cage> {
  protected:
    static void TearDownTestSuite() {
        for (size_t r = 0; r < kReferenceCount; ++r) {
            std::printf("%s: %ld of %ld rays differ from packet\n", kReferences[r].name,
                        static_cast<long>(_differing[r]), static_cast<long>(_rays));
        }
    }

    static std::array<int64_t, kReferenceCount> _differing;
    static int64_t _rays;
};

std::array<int64_t, kReferenceCount> TracerAgreementTest::_differing{};
int64_t TracerAgreementTest::_rays = 0;

TEST_P(TracerAgreementTest, ReferencesHitWhatPacketsHit) {
    const TracedCage traced(GetParam());
    const float bound = kAgreement * traced.surface->Bounds().Diagonal();
    const std::unique_ptr<Tracer> packet = MakeTracer(TracerKind::Packet, kLevel);
    std::array<std::unique_ptr<Tracer>, kReferenceCount> references;
    for (size_t r = 0; r < kReferenceCount; ++r) {
        references[r] = MakeTracer(kReferences[r].kind, kLevel);
    }
    const Vec3f directions[] = {
        {1, 0.2f, 0.3f}, {-0.4f, 1, 0.1f}, {0.2f, -0.3f, 1}, {0.1f, 0.2f, -1}};
    std::mt19937 random(7);
    TraceStatistics statistics;
    int hitCount = 0;
    for (const Vec3f& from : directions) {
        for (int n = 0; n < Repeats(3); ++n) {
            const RayPacket rays = CameraPacket(traced.surface->Bounds(), from, 0.3f, &random);
            RayPacket nearest = rays;
            HitPacket hits;
            packet->Intersect(traced.world, &nearest, &hits, &statistics);
            _rays += rays.count;
            for (size_t r = 0; r < kReferenceCount; ++r) {
                RayPacket other = rays;
                HitPacket otherHits;
                references[r]->Intersect(traced.world, &other, &otherHits, &statistics);
                const uint64_t occluded = references[r]->Occluded(traced.world, rays, &statistics);
                for (int i = 0; i < rays.count; ++i) {
                    const RayAnswer expected = AnswerOf(traced.world, nearest, hits, i);
                    RayAnswer found = AnswerOf(traced.world, other, otherHits, i);
                    if (HasCoincidentFaces(GetParam())) {
                        found.face = kAnyFace;
                    }
                    hitCount += found.instance != kNoHit;
                    EXPECT_EQ((occluded >> i & 1) != 0, found.instance != kNoHit);
                    if (Agree(expected, found, bound)) {
                        continue;
                    }
                    ++_differing[r];
                    EXPECT_TRUE(IsAnswerBeside(traced.world, *packet, rays, i, found, bound))
                        << kReferences[r].name << " has face " << int(found.face) << " at "
                        << found.distance << ", packet " << int(expected.face) << " at "
                        << expected.distance;
                }
            }
        }
    }
    EXPECT_GT(hitCount, 100);
}

TEST_P(TracerAgreementTest, TextureCoordinatesAreThoseOfTheHit) {
    const TracedCage traced(GetParam());
    const float bound = kAgreement * traced.surface->Bounds().Diagonal();
    std::mt19937 random(9);
    TraceStatistics statistics;
    int hitCount = 0;
    for (int n = 0; n < 3; ++n) {
        const RayPacket rays =
            CameraPacket(traced.surface->Bounds(), {0.2f, -0.3f, 1}, 0.3f, &random);
        ObjectRays object;
        TransformRays(rays, AffineTransform(), &object);
        HitPacket hits;
        std::fill(hits.instance, hits.instance + kPacketSize, kNoHit);
        TextureHits texture;
        IntersectWithTexture(traced.world, kLevel, &object, rays, &hits, &texture, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            if (hits.instance[i] == kNoHit) {
                continue;
            }
            ++hitCount;
            // The Loop scheme's recursion carries none.
            if (!traced.surface->Patches().IsTriangle(hits.patch[i])) {
                const float t = object.tMax[i];
                EXPECT_NEAR(texture.s[i], rays.originX[i] + t * rays.directionX[i], bound);
                EXPECT_NEAR(texture.t[i], rays.originY[i] + t * rays.directionY[i], bound);
            }
        }
    }
    EXPECT_GT(hitCount, 20);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, TracerAgreementTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

}  // namespace
}  // namespace cc::test
