#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <deque>
#include <string>
#include <vector>

#include "benchScene.h"

/// How Embree is given the surface.
enum class EmbreeMode {
    Subdivision,  ///< the cage and its tags, tessellated by Embree at 2^level segments an edge
    Grid,         ///< our limit points, a grid a patch
    Quad,         ///< the same points, as quads of their own
};

/// An exported scene inside Embree. All meshes stand in the world, in one scene without instances,
/// which is what Embree traces fastest; flags and build quality are Embree's defaults but for the
/// best quality of the hierarchy.
class EmbreeScene {
  public:
    EmbreeScene(BenchScene source, EmbreeMode mode, int level);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Seconds that an action took: work of ours before Embree has its points, then Embree's, to
    /// the first ray.
    struct Seconds {
        double tessellation = 0, commit = 0;
    };

    /// Points in memory to the first ray, all anew.
    Seconds Build(int threads);
    /// New points to the first ray; of subdivision surfaces only.
    Seconds Edit(float phase);

    RTCScene Handle() const { return _scene; }
    /// Bytes that Embree holds now, buffers included, and held at most.
    size_t Bytes() const { return _bytes; }
    size_t PeakBytes() const { return _peakBytes; }
    size_t FaceCount() const;
    /// Version, vector width and whatever else decides Embree's speed.
    std::string Description() const;

  private:
    void _Release();
    void _AddSubdivision(const BenchMesh& mesh);
    void _AddGrids(const BenchMesh& mesh, double* tessellation);
    void _Attach(RTCGeometry geometry);
    void _TraceFirstRay() const;
    static bool _CountBytes(void* scene, ssize_t bytes, bool after);

    /// Topology is validated, so that tags are in pairs as Embree takes them.
    BenchScene _source;
    const EmbreeMode _mode;
    const int _level;
    RTCDevice _device = nullptr;
    RTCScene _scene = nullptr;
    std::vector<RTCGeometry> _geometries;
    /// Of each mesh with holes in the subdivision mode, which faces they are.
    std::deque<std::vector<bool>> _isHole;
    std::atomic<size_t> _bytes{0}, _peakBytes{0};
};
