#pragma once

#include <array>
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

/// What tools/_lib/bench_export.py writes: the cages of a USD scene, a camera and two lights.
struct BenchScene {
    cc::Camera camera;
    /// Positions in the world of the point lights that shadow rays go to.
    std::array<cc::Vec3f, 2> lights;
    std::vector<BenchMesh> meshes;
};

/// Reads an exported scene. Throws std::runtime_error with one line that says what is wrong.
BenchScene ReadBenchScene(const std::string& path);

/// The points after an edit that keeps the topology: a ripple through the mesh.
/// @param phase  of the ripple, in radians; each gives other points
std::vector<cc::Vec3f> RippledPoints(const BenchMesh& mesh, float phase);
