#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchScene.h"
#include "core/scene/scene.h"
#include "rays.h"

/// The renderer's scene, made of an exported one, with the time that took.
class BuiltScene {
  public:
    /// Builds from points in memory with so many threads, then traces the first ray.
    BuiltScene(const BenchScene& source, const Ray& firstRay, int threads);

    /// Moves all points, as an edit does, and traces the first ray. Returns the seconds it took.
    double Edit(std::vector<std::vector<cc::Vec3f>> points, const Ray& firstRay, int threads);

    /// Makes what cc::TracerKind::Tessellated traces, for one level. Returns the seconds it took;
    /// throws if memory does not hold it.
    double Tessellate(int level, int threads);
    /// Gives the memory of that back.
    void DropTessellation();

    const cc::Scene& Scene() const { return _scene; }
    double BuildSeconds() const { return _buildSeconds; }

  private:
    void _Build(int threads, std::optional<int> tessellationLevel = std::nullopt);
    void _TraceFirstRay(const Ray& ray) const;

    cc::Scene _scene;
    std::vector<cc::Mesh*> _meshes;
    double _buildSeconds = 0;
};
