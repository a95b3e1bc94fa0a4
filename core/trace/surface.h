#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/limitGridPlan.h"
#include "core/subdiv/patchTable.h"
#include "core/trace/chordErrors.h"
#include "core/trace/geometry.h"
#include "core/trace/tessellation.h"

namespace cc {

/// A mesh that rays can hit: its patches are the primitives. It lies in the mesh's own
/// space.
class Surface final : public Geometry {
  public:
    /// Converts a validated control mesh and its points. A mesh without any visible face, or with
    /// topology that cannot be used, gives a surface without patches, which no ray hits.
    Surface(const ControlMesh& mesh, const std::vector<Vec3f>& points);

    /// Moves the control points, as many as before: patches stay, bounds are made anew, and the BVH
    /// follows them (Bvh::Move).
    void SetPoints(const std::vector<Vec3f>& points);

    /// Makes bounds and errors hold for several poses of the control points, and for all that is
    /// between any two of them.
    /// @param poses  each has as many points as before
    void SetPoses(const std::vector<std::vector<Vec3f>>& poses);
    /// Moves the control points to between two of the poses.
    void Pose(const std::vector<Vec3f>& points);

    /// Why the topology cannot be used; empty if it can.
    const std::string& Error() const { return _error; }

    const PatchTable& Patches() const { return _patches; }
    const LimitGridPlans& Plans() const { return _plans; }
    /// The control points of the patches: cage points first, then those that refinement added.
    const std::vector<Vec3f>& PatchPoints() const { return _patchPoints; }
    const ChordErrors& Errors() const { return _errors; }

    /// Tells the surfaces of a scene apart where an address must not, being chance. 0 before it is
    /// set.
    uint32_t Number() const { return _number; }
    void SetNumber(uint32_t number) { _number = number; }

    size_t PrimitiveCount() const override { return _patches.Count(); }
    /// Derivatives are those by the parameters of the authored face (FaceParameter).
    GeometryPoint PointAt(const GeometryHit& hit, const Instance& instance,
                          const LevelMetric& levels) const override;

    /// The patches evaluated ahead of time, for the tracer that asks for it. Made by the first call
    /// that does, and kept until the points move, another level is asked for or it is dropped. Many
    /// threads may call this, if all of them mean one level.
    /// @param level  0..8
    const Tessellation& TessellationAt(int level) const;
    void DropTessellation();

    /// Memory held, in bytes, the tessellation's included.
    size_t Bytes() const override;
    size_t TessellationBytes() const;

  private:
    std::string _error;
    PatchTable _patches;
    LimitGridPlans _plans;
    std::vector<Vec3f> _patchPoints;
    ChordErrors _errors;
    uint32_t _number = 0;

    mutable std::mutex _tessellationMutex;
    mutable std::unique_ptr<const Tessellation> _ownedTessellation;
    /// The same, for threads to find it without waiting for each other.
    mutable std::atomic<const Tessellation*> _tessellation{nullptr};
};

}  // namespace cc
