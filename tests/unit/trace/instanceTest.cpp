#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/trace/instance.h"
#include "core/trace/tracer.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

constexpr int kLevel = 3;

/// Turned by an angle about z, scaled, and moved.
AffineTransform Placed(double angle, double scale, const Vec3f& at) {
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return AffineTransform({{{c, -s, 0, at.x}, {s, c, 0, at.y}, {0, 0, scale, at.z}}});
}

/// A large sheet that others stand in and on, some of them twice.
struct Crowd {
    std::vector<std::unique_ptr<Surface>> surfaces;
    std::vector<Instance> instances;

    Crowd() {
        _Add(Sheet(24), {AffineTransform(), Placed(0.3, 0.7, {0, 0, 0.2f})});
        _Add(Torus(12, 8), {Placed(1, 0.5, {3, 2, 0}), Placed(2, 1.5, {1, 4, 0.5f})});
        _Add(Cube(), {AffineTransform(), Placed(0.5, 2, {2, 2, 0}), Placed(0, 1, {1e-3f, 0, 0})});
    }

    InstanceBvh World() const { return InstanceBvh(instances); }
    InstanceBvh Alone(size_t instance) const { return InstanceBvh({instances[instance]}); }

  private:
    void _Add(Cage cage, const std::vector<AffineTransform>& places) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        surfaces.push_back(std::make_unique<Surface>(cage.mesh, cage.points));
        for (const AffineTransform& place : places) {
            Instance instance;
            instance.geometry = surfaces.back().get();
            instance.objectToWorld = place;
            place.Invert(&instance.worldToObject);
            instances.push_back(instance);
        }
    }
};

/// Counts patches below a child of a node.
void CountPatches(const Bvh& bvh, uint32_t child, std::vector<int>* counts) {
    if ((child & kBvhLeaf) != 0) {
        ++(*counts)[child & ~kBvhLeaf];
        return;
    }
    const BvhNode& node = bvh.Nodes()[child];
    for (int slot = 0; slot < node.childCount; ++slot) {
        CountPatches(bvh, node.child[slot], counts);
    }
}

TEST(InstanceBvh, EachPatchIsInOnePart) {
    const Crowd crowd;
    const InstanceBvh world = crowd.World();
    EXPECT_GT(world.Parts().size(), 4 * crowd.instances.size()) << "nothing was opened";
    std::vector<std::vector<int>> counts;
    for (const Instance& instance : crowd.instances) {
        counts.emplace_back(SurfaceOf(instance).Patches().Count());
    }
    for (const InstancePart& part : world.Parts()) {
        const Bvh& bvh = crowd.instances[part.instance].geometry->PrimitiveBvh();
        CountPatches(
            bvh,
            part.slot == InstancePart::kWhole ? part.node : bvh.Nodes()[part.node].child[part.slot],
            &counts[part.instance]);
    }
    for (const std::vector<int>& ofInstance : counts) {
        EXPECT_EQ(ofInstance, std::vector<int>(ofInstance.size(), 1));
    }
}

TEST(InstanceBvh, ManyInstancesAreNotOpened) {
    const Crowd crowd;
    const std::vector<Instance> many(300'000, crowd.instances[2]);
    const InstanceBvh world(many);
    EXPECT_GE(world.Parts().size(), many.size());
    EXPECT_LE(world.Parts().size(), many.size() + (1 << 18));
}

/// The nearest of the hits that each instance has by itself.
void IntersectOneByOne(const Crowd& crowd, const Tracer& tracer, RayPacket* rays, HitPacket* hits) {
    TraceStatistics statistics;
    std::fill(hits->instance, hits->instance + kPacketSize, kNoHit);
    for (uint32_t k = 0; k < crowd.instances.size(); ++k) {
        HitPacket own;
        tracer.Intersect(crowd.Alone(k), rays, &own, &statistics);
        for (int i = 0; i < rays->count; ++i) {
            if (own.instance[i] != kNoHit) {
                hits->instance[i] = k;
                hits->patch[i] = own.patch[i];
            }
        }
    }
}

TEST(InstanceBvh, PartsAreHitLikeInstancesOneByOne) {
    const Crowd crowd;
    const InstanceBvh world = crowd.World();
    for (const TracerKind kind : {TracerKind::Packet, TracerKind::Single, TracerKind::Algorithm1}) {
        const std::unique_ptr<Tracer> tracer = MakeTracer(kind, kLevel);
        std::mt19937 random(8);
        std::uniform_real_distribution<float> unit(-1, 1);
        int hitCount = 0;
        for (int n = 0; n < 40; ++n) {
            const Vec3f from{unit(random), unit(random), unit(random)};
            RayPacket rays = CameraPacket(world.Bounds(), from, 0.3f, &random), alone = rays;
            const RayPacket shadows = rays;
            TraceStatistics statistics;
            HitPacket hits, expected;
            tracer->Intersect(world, &rays, &hits, &statistics);
            IntersectOneByOne(crowd, *tracer, &alone, &expected);
            const uint64_t occluded = tracer->Occluded(world, shadows, &statistics);
            for (int i = 0; i < rays.count; ++i) {
                ASSERT_EQ(rays.tMax[i], alone.tMax[i]) << n << " " << i;
                const bool isHit = hits.instance[i] != kNoHit;
                ASSERT_EQ(isHit, expected.instance[i] != kNoHit) << n << " " << i;
                ASSERT_EQ(isHit, (occluded >> i & 1) != 0) << n << " " << i;
                hitCount += static_cast<int>(isHit);
            }
        }
        EXPECT_GT(hitCount, 500);
    }
}

}  // namespace
}  // namespace cc::test
