#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "core/trace/tracer.h"
#include "tests/unit/render/renderTestKit.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

/// The bytes of whatever is added: equal if and only if all of it is, bit for bit.
class Fingerprint {
  public:
    template <class T>
    void AddArray(const T* values, size_t count) {
        _bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
    template <class... Numbers>
    void Add(Numbers... numbers) {
        (AddArray(&numbers, 1), ...);
    }

    void AddPatches(const PatchTable& patches) {
        for (uint32_t i = 0; i < patches.Count(); ++i) {
            const Patch& p = patches.At(i);
            Add(p.face, p.corner, p.cellU, p.cellV, p.valence, p.depth, p.kind);
            Add(int(p.rotation), int(p.isSubQuad));
            AddArray(patches.Indices(i), patches.IndexCount(i));
            ControlPoints points;
            if (!patches.IsTriangle(i)) {
                GatherControlPoints(patches, i, &points);
                AddArray(points.data(), points.size());
            }
        }
    }
    void AddPlans(const LimitGridPlans& plans, size_t patchCount) {
        for (uint32_t i = 0; i < patchCount; ++i) {
            const LimitGridPlan* plan = plans.Of(i);
            Add(plan != nullptr);
            if (plan) {
                AddArray(plan->Picks().data(), plan->Picks().size());
                AddArray(plan->Weights(0), LimitGridPlan::kWeightCount);
                AddArray(plan->HullWeights(0), plan->HullCount());
            }
        }
    }
    void AddBvh(const Bvh& bvh) {
        for (const BvhNode& node : bvh.Nodes()) {
            AddArray(reinterpret_cast<const char*>(&node), offsetof(BvhNode, childCount));
            Add(node.childCount);
        }
    }
    void AddSurface(const Surface& surface) {
        AddPatches(surface.Patches());
        AddPlans(surface.Plans(), surface.Patches().Count());
        AddArray(surface.PatchPoints().data(), surface.PatchPoints().size());
        AddBvh(surface.PrimitiveBvh());
    }
    /// Adds what rays towards each instance hit.
    void AddHits(const InstanceBvh& instances) {
        const std::unique_ptr<Tracer> tracer = MakeTracer(TracerKind::Packet, 4);
        std::mt19937 random(5);
        TraceStatistics statistics;
        for (const Instance& instance : instances.Instances()) {
            const Box3f box = instance.objectToWorld.Box(instance.geometry->Bounds());
            RayPacket rays = CameraPacket(box, {0.4f, 0.5f, 1}, 0.8f, &random);
            HitPacket hits;
            tracer->Intersect(instances, &rays, &hits, &statistics);
            AddArray(rays.tMax, kPacketSize);
            AddArray(hits.instance, kPacketSize);
            _hitCount += std::count_if(hits.instance, hits.instance + kPacketSize,
                                       [](uint32_t hit) { return hit != kNoHit; });
            AddArray(hits.patch, kPacketSize);
            AddArray(hits.u, kPacketSize);
            AddArray(hits.v, kPacketSize);
        }
    }
    void AddScene(const Scene& scene) {
        AddBvh(scene.Instances().TopLevel());
        AddBvh(scene.Instances().PartBvh());
        for (const Instance& instance : scene.Instances().Instances()) {
            AddSurface(SurfaceOf(instance));
        }
        AddHits(scene.Instances());
    }

    size_t HitCount() const { return _hitCount; }
    bool operator==(const Fingerprint& b) const { return _bytes == b._bytes; }

  private:
    std::string _bytes;
    size_t _hitCount = 0;
};

std::vector<Vec3f> Rippled(std::vector<Vec3f> points) {
    for (Vec3f& p : points) {
        p.z += 0.1f * std::sin(3 * p.x + 2 * p.y);
    }
    return points;
}

/// Many small cages and one that is large enough for every loop that threads share.
std::vector<Cage> ManyCages() {
    std::vector<Cage> cages = Catalogue();
    cages.push_back(Torus(300, 240));
    return cages;
}

struct Built {
    Fingerprint anew, moved;
};

Built BuildWith(int threads) {
    // More threads than the machine has cores are threads all the same.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(threads);
    Built built;
    arena.execute([&] {
        Scene scene;
        std::vector<Mesh*> meshes;
        std::vector<Cage> cages = ManyCages();
        for (size_t i = 0; i < cages.size(); ++i) {
            meshes.push_back(AddCage(&scene, "/cage" + std::to_string(i), cages[i]));
            meshes.back()->SetTransform(
                Placed(1, 6.0 * static_cast<double>(i % 20), 6.0 * static_cast<double>(i / 20), 0));
        }
        scene.Build({"geometry"});
        built.anew.AddScene(scene);
        for (size_t i = 0; i < cages.size(); ++i) {
            meshes[i]->SetPoints(Rippled(cages[i].points));
        }
        scene.Build({"geometry"});
        built.moved.AddScene(scene);
    });
    return built;
}

TEST(Scene, IsTheSameForAnyNumberOfThreads) {
    const Built one = BuildWith(1);
    EXPECT_GT(one.anew.HitCount(), 1000u);
    EXPECT_FALSE(one.anew == one.moved);
    for (const int threads : {2, 8}) {
        const Built many = BuildWith(threads);
        EXPECT_TRUE(many.anew == one.anew) << threads << " threads";
        EXPECT_TRUE(many.moved == one.moved) << threads << " threads, after an edit";
    }
}

}  // namespace
}  // namespace cc::test
