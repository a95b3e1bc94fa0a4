#include "builtScene.h"

#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "core/trace/tracer.h"
#include "tracing.h"

namespace {

double SecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

BuiltScene::BuiltScene(const BenchScene& source, const Ray& firstRay, int threads) {
    // The copies stand for what Hydra hands over, and are made before the clock starts.
    std::vector<BenchMesh> meshes = source.meshes;
    const auto begin = std::chrono::steady_clock::now();
    for (BenchMesh& mesh : meshes) {
        cc::Mesh* added = _scene.AddMesh(mesh.name);
        added->SetTopology(std::move(mesh.topology));
        added->SetPoints(std::move(mesh.points));
        added->SetTransform(mesh.objectToWorld);
        added->SetRenderTag("geometry");
        _meshes.push_back(added);
    }
    _Build(threads);
    _TraceFirstRay(firstRay);
    _buildSeconds = SecondsSince(begin);
}

double BuiltScene::Edit(std::vector<std::vector<cc::Vec3f>> points, const Ray& firstRay,
                        int threads) {
    const auto begin = std::chrono::steady_clock::now();
    for (size_t i = 0; i < _meshes.size(); ++i) {
        _meshes[i]->SetPoints(std::move(points[i]));
    }
    _Build(threads);
    _TraceFirstRay(firstRay);
    return SecondsSince(begin);
}

double BuiltScene::Tessellate(int level, int threads) {
    const auto begin = std::chrono::steady_clock::now();
    _Build(threads, level);
    if (!_scene.TessellationFits()) {
        throw std::runtime_error("memory does not hold the tessellation");
    }
    return SecondsSince(begin);
}

void BuiltScene::DropTessellation() { _Build(1); }

void BuiltScene::_Build(int threads, std::optional<int> tessellationLevel) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(threads));
    for (const std::string& warning : _scene.Build({"geometry"}, tessellationLevel)) {
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
}

void BuiltScene::_TraceFirstRay(const Ray& ray) const {
    cc::RayPacket packet;
    cc::HitPacket hits;
    cc::TraceStatistics statistics;
    FillPacket(&ray, 1, &packet);
    MakeTracer(cc::TracerKind::Packet, 4)
        ->Intersect(_scene.Instances(), &packet, &hits, &statistics);
}
