#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/scene/faceMaterials.h"
#include "core/scene/moving.h"
#include "core/scene/placement.h"
#include "core/scene/primvar.h"
#include "core/scene/primvarField.h"
#include "core/trace/geometry.h"

namespace cc {

class TextWriter;

/// What a shape without displayColor looks like.
constexpr Vec3f kDefaultDisplayColor{0.18f, 0.18f, 0.18f};

/// A side of a surface that rays pass through. Normals point away from the back.
enum class CulledSide { None, Back, Front };

/// Something in the scene that has a geometry: what its kinds share. Setters only note what
/// changed; Scene::Build does the work. Different shapes may be set from different threads, one
/// shape from one thread at a time.
class Shape {
  public:
    /// @param name  names the shape in warnings: the prim's path
    explicit Shape(std::string name);
    virtual ~Shape();
    Shape(const Shape&) = delete;
    Shape& operator=(const Shape&) = delete;

    const std::string& Name() const { return _name; }

    /// The id that the primId AOV shows, 0 or above.
    void SetPrimId(int primId) { _primId = primId; }
    /// Sets a primvar by its name without the prefix primvars:, as in "st". Empty ones are taken
    /// away. A shape is shaded with its displayColor of three numbers; what else it is shaded with
    /// is up to its kind, and any other is there to be evaluated. Values that are those in use
    /// already cost no work.
    void SetPrimvar(const std::string& name, Primvar primvar);
    void SetTransform(const AffineTransform& objectToWorld);
    void SetMovingTransform(Moving<AffineTransform> objectToWorld);
    /// Shows instances of the shape in place of the shape itself; none is nothing. Each map is
    /// applied after the shape's own transform.
    void SetInstances(std::vector<AffineTransform> instanceToWorld);
    /// @param instanceToWorld  every pose has as many
    void SetMovingInstances(Moving<std::vector<AffineTransform>> instanceToWorld);
    /// Shows the shape itself again.
    void ClearInstances();
    void SetVisible(bool visible) { _visible = visible; }
    /// Names the material of the shape; empty for none.
    void SetMaterial(std::string name);
    /// Hydra's render tag (purpose) of the shape: geometry, render, proxy or guide.
    void SetRenderTag(std::string tag) { _renderTag = std::move(tag); }

    // For the renderer, after Scene::Build:

    const FaceMaterials& Materials() const { return _materials; }
    int PrimId() const { return _primId; }
    /// Null if the shape is broken or empty: it is left out of the picture.
    virtual const Geometry* BuiltGeometry() const = 0;
    /// The side of the shape that is invisible.
    virtual CulledSide Culled() const { return CulledSide::None; }
    /// The authored element that a primitive of the geometry is of: a face, a point, a curve.
    virtual uint32_t ElementOf(uint32_t primitive) const = 0;
    /// Null if the shape has no such primvar, or one that does not fit it.
    const PrimvarField* FindPrimvar(const std::string& name) const;
    /// Evaluates one of the shape's primvars at a point of it.
    virtual SurfaceValue Evaluate(const PrimvarField& primvar, const ShapePoint& at) const = 0;
    /// The normal that the scene gives a point, in object space and of any length; zero if it gives
    /// none.
    virtual Vec3f AuthoredNormal(const ShapePoint&) const { return {}; }
    /// Writes what the shape was handed as a block of text.
    /// @param isShown  if the picture does not show the shape, it is only named
    void WriteText(bool isShown, TextWriter* out) const;
    /// Linear RGB display colour at a point.
    Vec3f DisplayColor(const ShapePoint& at) const;

  protected:
    friend class Scene;

    /// What Build did to the geometry.
    enum class GeometryWork { None, Moved, Rebuilt };
    struct BuildReport {
        GeometryWork work = GeometryWork::None;
        size_t primvarsBuilt = 0;
        /// Anything that the top level shows has changed.
        bool topLevelChanged = false;
        /// Lines that say what is wrong, without the shape's name.
        std::vector<std::string> lines;
    };

    /// The kind of shape, in a word.
    virtual const char* _KindName() const = 0;
    /// Writes what only this kind of shape is handed. The shape is shown.
    virtual void _WriteOwnText(TextWriter* out) const = 0;
    /// The shape in the middle of a line, with its verb: "the mesh is".
    virtual const char* _Is() const = 0;
    /// The geometry, usable or not; null before there is one.
    virtual Geometry* _Geometry() = 0;
    /// Brings the geometry up to date, if anything has changed.
    virtual void _BuildGeometry(BuildReport* report) = 0;
    /// True if points of the geometry move.
    virtual bool _GeometryMoves() const { return false; }
    /// Moves them to where they are at a time (Moving).
    virtual void _Pose(float) {}
    /// How many elements a primvar may have, now that the geometry is up to date.
    virtual PrimvarSizes _Sizes() const = 0;
    /// What is wrong with a primvar that has the right size; empty if nothing is.
    virtual std::string _CheckPrimvar(const std::string& name, const Primvar& primvar) const;
    /// What becomes of the shape without a primvar.
    virtual std::string _Without(const std::string& name) const;
    /// Spreads a primvar that nothing is wrong with.
    virtual PrimvarField _MakeField(const std::string& name, Primvar primvar,
                                    BuildReport* report) const;
    /// Looks for those primvars that shading asks for at every hit.
    virtual void _NotePrimvarsForShading();
    /// Memory held beside the geometry and what all shapes have, in bytes.
    virtual size_t _OwnBytes() const = 0;
    /// Authored faces.
    virtual size_t _FaceCount() const { return 0; }

    /// Before the geometry goes, or the instances: primvars are to be spread over the next ones.
    void _TakePrimvarsBack(bool ofInstancesOnly);
    size_t _PlaceCount() const { return _placement.Count(); }
    /// Of a mesh; the next Build takes them over.
    void _SetSubsets(std::vector<FaceSubset> subsets);

  private:
    struct PrimvarSlot {
        /// Waits to be built.
        Primvar waiting;
        bool isChanged = false;
        /// Empty if the last one that was built does not fit the shape, and then still waits.
        PrimvarField field;
    };

    /// Brings everything up to date with what was set since the last call.
    BuildReport _Build();
    void _BuildPrimvars(BuildReport* report);
    void _BuildPrimvar(const std::string& name, PrimvarSlot* slot, BuildReport* report) const;
    void _BuildPlacement(BuildReport* report);
    void _BuildMaterials(BuildReport* report);
    bool _IsMoving() const { return _GeometryMoves() || _placement.IsMoving(); }
    bool _IsShown() const { return BuiltGeometry() && _obstacles.Count() < _placement.Count(); }
    size_t _Bytes() const;

    std::string _name;
    int _primId = -1;
    bool _visible = true;
    std::string _renderTag = "geometry";

    Placement _placement;
    bool _placementChanged = false;
    Placement::Obstacles _obstacles;

    std::string _material;
    std::vector<FaceSubset> _subsets;
    bool _materialsChanged = false;
    FaceMaterials _materials;

    std::map<std::string, PrimvarSlot> _primvars;
    /// Of displayColor; null for the default grey.
    const PrimvarField* _displayColor = nullptr;
};

}  // namespace cc
