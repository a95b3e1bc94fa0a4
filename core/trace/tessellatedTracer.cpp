#include "core/trace/tessellatedTracer.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/tessellatedTracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/trace/geometryTracing-inl.h"
#include "core/trace/instanceTraversal-inl.h"
#include "core/trace/packetTriangles-inl.h"
#include "core/trace/patchRays-inl.h"
#include "core/trace/tessellation.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// Intersects a packet with blocks of a tessellation.
template <bool kAnyHit>
class BlockIntersector {
  public:
    BlockIntersector(const Tessellation& tessellation, uint32_t instance, PacketRays* rays,
                     HitPacket* hits, TraceStatistics* statistics)
        : _tessellation(tessellation),
          _rays(*rays),
          _statistics(*statistics),
          _triangles(instance, &rays->rays, hits, statistics) {}

    void Intersect(uint32_t index, int firstRay) {
        ++_statistics.leafIntersections;
        const Tessellation::Block& block = _tessellation.BlockAt(index);
        const Tessellation::Grid& grid = _tessellation.PatchGrid(block.patch);
        const int side = Tessellation::BlockSide(grid);
        bool isShortened = false;
        for (int row = block.row; row < block.row + side; ++row) {
            const int end = std::min(block.column + side, grid.RowCells(row));
            for (int column = block.column; column < end; ++column) {
                const bool isHit =
                    grid.isTriangle ? _IntersectTriangles(block.patch, grid, column, row, firstRay)
                                    : _IntersectQuad(block.patch, grid, column, row, firstRay);
                isShortened = isHit || isShortened;
            }
        }
        if (isShortened) {
            _rays.Shortened();
        }
    }

    bool IsDone() const { return _triangles.IsDone(); }

  private:
    bool _IntersectQuad(uint32_t patch, const Tessellation::Grid& grid, int column, int row,
                        int firstRay) {
        const float size = 1.0f / static_cast<float>(grid.side);
        const Vec3f corners[4] = {_tessellation.PointAt(grid, column, row),
                                  _tessellation.PointAt(grid, column + 1, row),
                                  _tessellation.PointAt(grid, column + 1, row + 1),
                                  _tessellation.PointAt(grid, column, row + 1)};
        const Square square{static_cast<float>(column) * size, static_cast<float>(row) * size,
                            size};
        return _Intersect(SurfaceQuad(corners, square).triangles, 2, patch, grid.tolerance,
                          firstRay);
    }

    /// The triangle that lies as the patch does, and beside it, as far as the row goes, the one
    /// that is turned.
    bool _IntersectTriangles(uint32_t patch, const Tessellation::Grid& grid, int column, int row,
                             int firstRay) {
        const int cells = column + 1 < grid.RowCells(row) ? 2 : 1;
        const int places[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}};
        const float size = 1.0f / static_cast<float>(grid.side);
        SurfaceTriangle triangles[2];
        for (int i = 0; i < cells; ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const int c = column + places[i][corner][0], r = row + places[i][corner][1];
                triangles[i].corners[corner] = _tessellation.PointAt(grid, c, r);
                triangles[i].parameters[corner] = {static_cast<float>(c) * size,
                                                   static_cast<float>(r) * size};
            }
        }
        return _Intersect(triangles, cells, patch, grid.tolerance, firstRay);
    }

    bool _Intersect(const SurfaceTriangle* triangles, int count, uint32_t patch, float tolerance,
                    int firstRay) {
        Box3f box;
        for (int i = 0; i < count; ++i) {
            for (const Vec3f& corner : triangles[i].corners) {
                box.Extend(corner);
            }
        }
        box = Widened(box, tolerance);
        ++_statistics.boxTests;
        if (_rays.Culls(box)) {
            ++_statistics.intervalCulls;
            return false;
        }
        return _triangles.Intersect(triangles, count, patch, tolerance, box, firstRay,
                                    [](int, const TriangleHit<PacketRays::Tag>&, int) {});
    }

    const Tessellation& _tessellation;
    PacketRays& _rays;
    TraceStatistics& _statistics;
    PacketTriangles<PacketRays::Tag, kAnyHit> _triangles;
};

template <bool kAnyHit>
void TraceTessellations(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                        const RayPacket& world, HitPacket* hits, TraceStatistics* statistics) {
    TraceInstances<PacketRays>(
        instances, world, worldRays, statistics, [&](uint32_t instance, PacketRays* rays) {
            if (instances.Instances()[instance].geometry->Kind() != GeometryKind::Surface) {
                const TraversalStart whole{0, AllRays(rays->rays), {}};
                return TraceGeometry<PacketRays, kAnyHit>(instances.Instances()[instance], instance,
                                                          whole, rays, hits, statistics);
            }
            const Surface& surface = SurfaceOf(instances.Instances()[instance]);
            const Tessellation& tessellation = surface.TessellationAt(level);
            BlockIntersector<kAnyHit> intersector(tessellation, instance, rays, hits, statistics);
            TraverseBvh(tessellation.BlockBvh(), rays, statistics,
                        [&](uint32_t block, uint64_t hitting, const Box3f&) {
                            intersector.Intersect(block, FirstOf(hitting));
                            return !intersector.IsDone();
                        });
            return !intersector.IsDone();
        });
}

void IntersectTessellations(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                            const RayPacket& world, HitPacket* hits, TraceStatistics* statistics) {
    TraceTessellations<false>(instances, level, worldRays, world, hits, statistics);
}

void OccludeTessellations(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                          const RayPacket& world, TraceStatistics* statistics) {
    TraceTessellations<true>(instances, level, worldRays, world, nullptr, statistics);
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(IntersectTessellations);
HWY_EXPORT(OccludeTessellations);

void DispatchIntersect(const InstanceBvh& instances, const LevelMetric& levels,
                       ObjectRays* worldRays, const RayPacket& world, HitPacket* hits, SharedGrids*,
                       TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(IntersectTessellations)
    (instances, levels.Finest(), worldRays, world, hits, statistics);
}

void DispatchOcclude(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                     const RayPacket& world, SharedGrids*, TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(OccludeTessellations)(instances, levels.Finest(), worldRays, world,
                                               statistics);
}

}  // namespace

PacketKernels TessellatedKernels() { return {DispatchIntersect, DispatchOcclude}; }

}  // namespace cc
#endif  // HWY_ONCE
