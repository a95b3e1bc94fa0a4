#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/scene/faceVertices.h"
#include "core/scene/moving.h"
#include "core/scene/placement.h"
#include "core/scene/primvar.h"
#include "core/scene/primvarField.h"
#include "core/subdiv/controlMesh.h"
#include "core/trace/surface.h"

namespace cc {

/// What a mesh without displayColor looks like.
constexpr Vec3f kDefaultDisplayColor{0.18f, 0.18f, 0.18f};

/// A subdivision mesh in the scene. Setters only note what changed; Scene::Build does the work.
/// Different meshes may be set from different threads, one mesh from one thread at a time.
class Mesh {
  public:
    /// @param name  names the mesh in warnings: the prim's path
    explicit Mesh(std::string name);

    const std::string& Name() const { return _name; }

    /// The id that the primId AOV shows, 0 or above.
    void SetPrimId(int primId);
    void SetTopology(ControlMesh topology);
    void SetPoints(std::vector<Vec3f> points);
    /// Points that move (Moving). Poses that do not fit the mesh, or are not numbers, leave it at
    /// rest as it is at time 0.
    void SetMovingPoints(Moving<std::vector<Vec3f>> points);
    /// Sets a primvar by its name without the prefix primvars:, as in "st". Empty ones are taken
    /// away. A mesh is shaded with its displayColor and under scheme none with its normals, each of
    /// three numbers; any other is there to be evaluated. Values that are those in use already cost
    /// no work.
    void SetPrimvar(const std::string& name, Primvar primvar);
    void SetTransform(const AffineTransform& objectToWorld);
    void SetMovingTransform(Moving<AffineTransform> objectToWorld);
    /// Shows instances of the mesh in place of the mesh itself; none is nothing. Each map is
    /// applied after the mesh's own transform.
    void SetInstances(std::vector<AffineTransform> instanceToWorld);
    /// @param instanceToWorld  every pose has as many
    void SetMovingInstances(Moving<std::vector<AffineTransform>> instanceToWorld);
    /// Shows the mesh itself again.
    void ClearInstances();
    void SetVisible(bool visible);
    /// Single-sided meshes are invisible from behind only if cullBackFaces is set; both sides are
    /// shaded with the normal that faces the viewer.
    void SetCullBackFaces(bool cull);
    /// Hydra's render tag (purpose) of the mesh: geometry, render, proxy or guide.
    void SetRenderTag(std::string tag);

    // For the renderer, after Scene::Build:

    int PrimId() const { return _primId; }
    bool CullBackFaces() const { return _cullBackFaces; }
    /// Null if the mesh is broken or empty: it is left out of the picture.
    const Surface* BuiltSurface() const { return _isSurfaceUsable ? _surface.get() : nullptr; }
    /// Null if the mesh has no such primvar, or one that does not fit it.
    const PrimvarField* FindPrimvar(const std::string& name) const;
    /// Evaluates one of the mesh's primvars at a point of a patch.
    SurfaceValue Evaluate(const PrimvarField& primvar, const MeshPoint& at) const {
        return primvar.Evaluate(_surface->Patches(), _faces, at);
    }
    /// The normal that the scene gives a point of a patch of scheme none, in object space and of
    /// any length; zero if it gives none.
    Vec3f AuthoredNormal(const MeshPoint& at) const;
    /// Linear RGB display colour at a point.
    Vec3f DisplayColor(const MeshPoint& at) const;

  private:
    friend class Scene;

    /// What Build did to the surface.
    enum class SurfaceWork { None, Moved, Rebuilt };
    struct BuildReport {
        SurfaceWork work = SurfaceWork::None;
        size_t primvarsBuilt = 0;
        /// Anything that the top level shows has changed.
        bool topLevelChanged = false;
        /// Lines that say what is wrong, without the mesh's name.
        std::vector<std::string> lines;
    };

    struct PrimvarSlot {
        /// Waits to be built.
        Primvar waiting;
        bool isChanged = false;
        /// Empty if the last one that was built does not fit the mesh, and then still waits.
        PrimvarField field;
    };

    /// Brings everything up to date with what was set since the last call.
    BuildReport _Build();
    void _BuildSurface(BuildReport* report);
    /// Before the surface goes, or the instances: primvars are to be spread over the next ones.
    void _TakePrimvarsBack(bool ofInstancesOnly);
    void _RebuildSurface(BuildReport* report);
    void _MoveSurface(BuildReport* report);
    void _BuildMotion(BuildReport* report);
    /// What is wrong with a pose of moving points; empty if nothing is.
    std::string _CheckPose(const std::vector<Vec3f>& pose) const;
    /// True if the surface or its place moves.
    bool _IsMoving() const { return _motion.IsMoving() || _placement.IsMoving(); }
    /// Moves the points of the surface to where they are at a time.
    void _Pose(float time);
    void _BuildPrimvars(BuildReport* report);
    /// Looks for those primvars that shading asks for at every hit.
    void _NotePrimvarsForShading();
    void _BuildPrimvar(const std::string& name, PrimvarSlot* slot, BuildReport* report) const;
    /// Empty if the primvar needs none.
    FaceVaryingChannel _MakeChannel(const std::string& name, const Primvar& primvar,
                                    BuildReport* report) const;
    void _BuildPlacement(BuildReport* report);
    bool _IsShown() const { return BuiltSurface() && _obstacles.Count() < _placement.Count(); }
    size_t _Bytes() const;

    std::string _name;
    int _primId = -1;
    bool _cullBackFaces = false;
    bool _visible = true;
    std::string _renderTag = "geometry";

    Placement _placement;
    bool _placementChanged = false;
    Placement::Obstacles _obstacles;

    /// Topology and points wait here until they are built; then the surface and _faces have all
    /// that is needed of them.
    ControlMesh _topology;
    bool _topologyChanged = false;
    std::vector<Vec3f> _points;
    bool _pointsChanged = false;
    /// True if the points in use are those of the surface, and _points is empty.
    bool _pointsAreInSurface = false;
    /// Kept while the points move.
    Moving<std::vector<Vec3f>> _motion;

    std::unique_ptr<Surface> _surface;
    bool _isSurfaceUsable = false;
    FaceVertices _faces;
    /// Rules and tags of the topology in use, without its faces.
    ControlMesh _tags;
    /// Points of the cage that faces use: all have lower indices.
    size_t _usedPointCount = 0;
    std::map<std::string, PrimvarSlot> _primvars;
    /// Of displayColor; null for the default grey.
    const PrimvarField* _displayColor = nullptr;
    /// Null if there are none, or subdivision gives the normals.
    const PrimvarField* _normals = nullptr;
};

}  // namespace cc
