#pragma once

#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/scene/camera.h"
#include "core/subdiv/controlMesh.h"

/// A mesh as it is authored: all that cc::Scene needs to build it.
struct BenchMesh {
    std::string name;
    cc::ControlMesh topology;
    std::vector<cc::Vec3f> points;
    cc::AffineTransform objectToWorld;
};

/// What tools/_lib/bench_export.py writes: the cages of a USD scene and a camera.
struct BenchScene {
    cc::Camera camera;
    std::vector<BenchMesh> meshes;
};

/// Reads an exported scene. Returns an empty string, or one line that says what is wrong.
std::string ReadBenchScene(const std::string& path, BenchScene* scene);
