#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/faceVertices.h"
#include "core/scene/movingPoints.h"
#include "core/scene/shape.h"
#include "core/subdiv/controlMesh.h"
#include "core/trace/surface.h"

namespace cc {

/// A subdivision mesh in the scene. Under scheme none it is shaded with its normals, of three
/// numbers each.
class Mesh final : public Shape {
  public:
    explicit Mesh(std::string name);
    ~Mesh() override;

    void SetTopology(ControlMesh topology);
    /// Points that are those in use already cost no work.
    void SetPoints(std::vector<Vec3f> points);
    /// Points that move (Moving). Poses that do not fit the mesh, or are not numbers, leave it at
    /// rest as it is at time 0.
    void SetMovingPoints(MovingPoints points);
    /// Makes one side of the mesh invisible to the camera. Both are shaded with the normal that
    /// faces the viewer.
    void SetCulled(CulledSide side);
    /// Gives faces a material of their own. Faces that there are not, and those of an earlier
    /// subset, are left out, and Build says so.
    void SetSubsets(std::vector<FaceSubset> subsets) { _SetSubsets(std::move(subsets)); }

    // For the renderer, after Scene::Build:

    const Surface* BuiltSurface() const { return _isSurfaceUsable ? _surface.get() : nullptr; }
    const Geometry* BuiltGeometry() const override { return BuiltSurface(); }
    CulledSide Culled() const override { return _culled; }
    uint32_t ElementOf(uint32_t primitive) const override {
        return _surface->Patches().AuthoredFace(primitive);
    }
    SurfaceValue Evaluate(const PrimvarField& primvar, const ShapePoint& at) const override {
        return primvar.Evaluate(_surface->Patches(), _faces, at);
    }
    Vec3f AuthoredNormal(const ShapePoint& at) const override;

  private:
    const char* _KindName() const override { return "mesh"; }
    void _WriteOwnText(TextWriter* out) const override;
    const char* _Is() const override { return "the mesh is"; }
    Geometry* _Geometry() override { return _surface.get(); }
    void _BuildGeometry(BuildReport* report) override;
    bool _GeometryMoves() const override { return _motion.IsMoving(); }
    void _Pose(float time) override;
    PrimvarSizes _Sizes() const override;
    std::string _CheckPrimvar(const std::string& name, const Primvar& primvar) const override;
    std::string _Without(const std::string& name) const override;
    PrimvarField _MakeField(const std::string& name, Primvar primvar,
                            BuildReport* report) const override;
    void _NotePrimvarsForShading() override;
    size_t _OwnBytes() const override;
    size_t _FaceCount() const override { return _faces.FaceCount(); }

    void _TakePoints(std::vector<Vec3f> points);
    bool _IsNormals(const std::string& name) const;
    void _RebuildSurface(BuildReport* report);
    void _MoveSurface(BuildReport* report);
    void _BuildMotion(BuildReport* report);
    /// What is wrong with a pose of moving points; empty if nothing is.
    std::string _CheckPose(const std::vector<Vec3f>& pose) const;
    /// Empty if the primvar needs none.
    FaceVaryingChannel _MakeChannel(const std::string& name, const Primvar& primvar,
                                    BuildReport* report) const;

    CulledSide _culled = CulledSide::None;

    /// Topology and points wait here until they are built; then the surface and _faces have all
    /// that is needed of them.
    ControlMesh _topology;
    bool _topologyChanged = false;
    std::vector<Vec3f> _points;
    bool _pointsChanged = false;
    /// Of the points that were set last.
    size_t _pointsHash = 0;
    /// True if the points in use are those of the surface, and _points is empty.
    bool _pointsAreInSurface = false;
    /// Kept while the points move.
    MovingPoints _motion;

    std::unique_ptr<Surface> _surface;
    bool _isSurfaceUsable = false;
    FaceVertices _faces;
    /// Rules and tags of the topology in use, without its faces.
    ControlMesh _tags;
    /// Points of the cage that faces use: all have lower indices.
    size_t _usedPointCount = 0;
    /// Null if there are none, or subdivision gives the normals.
    const PrimvarField* _normals = nullptr;
};

}  // namespace cc
