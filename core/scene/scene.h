#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/curves.h"
#include "core/scene/light.h"
#include "core/scene/mesh.h"
#include "core/scene/points.h"
#include "core/trace/instance.h"

namespace cc {

/// Everything a picture shows but the camera, at one time after the other if it moves. Shapes and
/// lights may be added, set and removed from any thread between two calls of Build; during Build
/// and rendering the scene must rest.
class Scene {
  public:
    Scene();
    ~Scene();

    /// The scene owns what it returns.
    Mesh* AddMesh(std::string name);
    Points* AddPoints(std::string name);
    Curves* AddCurves(std::string name);
    void RemoveShape(Shape* shape);
    Light* AddLight();
    void RemoveLight(Light* light);

    /// Brings geometries and the top level up to date, in parallel, doing only what changes ask
    /// for: topology rebuilds one shape, points only its bounds, a transform only the top level.
    /// @param renderTags         shapes with another tag are left out; without any, none is
    /// @param tessellationLevel  for TracerKind::Tessellated: what is shown is tessellated at this
    ///                           level, 0..8, unless memory does not hold that; without one the
    ///                           memory of tessellations is given back
    /// Returns one line for each thing that was wrong, beginning with `<name>: ` of the shape. A
    /// line is returned once, not at every Build.
    std::vector<std::string> Build(const std::vector<std::string>& renderTags,
                                   std::optional<int> tessellationLevel = std::nullopt);

    /// Shows what moves as it is at a time: in frames from the one that is rendered, which Build
    /// leaves it at. To be called between two renderings, not while one goes on.
    void SetTime(float time);

    // After Build:

    /// True if anything moves that is seen.
    bool IsMoving() const;
    const InstanceBvh& Instances() const { return _instances; }
    /// False if the last Build did not tessellate, because memory does not hold what that takes.
    bool TessellationFits() const { return _tessellationFits; }
    /// All shapes, by their names.
    const std::vector<std::unique_ptr<Shape>>& Shapes() const { return _shapes; }
    /// The shapes that are seen.
    const std::vector<const Shape*>& ShownShapes() const { return _shown; }
    /// The shape of an instance, by the index that hits carry.
    const Shape& InstanceShape(uint32_t instance) const {
        return *_shown[_origins[instance].shape];
    }
    /// Which of its shape's instances it is; 0 if the shape is not instanced.
    uint32_t InstanceIndex(uint32_t instance) const { return _origins[instance].index; }
    const std::vector<std::unique_ptr<Light>>& Lights() const { return _lights; }
    /// The names of the materials of all shapes that are shown, in order.
    const std::vector<std::string>& MaterialNames() const { return _materialNames; }
    /// Which of them an element of an instance has; -1 for none.
    int MaterialOf(uint32_t instance, uint32_t element) const {
        const uint32_t shape = _origins[instance].shape;
        return _materialsOfShapes[shape][_shown[shape]->Materials().Of(element)];
    }

    /// Most numbers a value that a primvar has on any shape that is shown; 0 if none has it.
    int PrimvarArity(const std::string& name) const;

    /// Authored faces, patches and bytes of structures of all that is built, each shape counted
    /// once however many its instances, and limit grid plans of the process among them.
    struct Statistics {
        size_t faces = 0, patches = 0, instances = 0, bytes = 0;
        size_t tessellationBytes = 0;  ///< of bytes: those of tessellations
        double buildSeconds = 0;       ///< of the last Build
        /// What all calls of Build did: geometries made, those whose points moved, top levels
        /// and primvars.
        size_t surfacesBuilt = 0, surfacesMoved = 0, topLevelsBuilt = 0, primvarsBuilt = 0;
        std::vector<std::string> materials;  ///< MaterialNames
    };
    Statistics GetStatistics() const;

  private:
    bool _BuildShapes(const std::vector<Shape*>& shapes, std::vector<std::string>* lines);
    void _BuildTopLevel(const std::vector<Shape*>& shapes, bool shapesChanged);
    void _NumberSurfaces(const std::vector<Shape*>& shapes);
    /// Instances of what is shown, and their origins.
    std::vector<Instance> _PlaceInstances();
    void _MoveInstance(size_t instance, float time);
    void _NumberMaterials();
    void _Tessellate(std::optional<int> level, std::vector<std::string>* lines);

    template <class Kind>
    Kind* _AddShape(std::string name);

    std::mutex _mutex;
    std::vector<std::unique_ptr<Shape>> _shapes;
    std::vector<std::unique_ptr<Light>> _lights;
    std::vector<const Shape*> _shown;
    InstanceBvh _instances;
    /// What an instance is of.
    struct Origin {
        uint32_t shape;  ///< in _shown
        uint32_t index;  ///< among the instances of that
    };
    std::vector<Origin> _origins;
    std::vector<std::string> _materialNames;
    /// Of each that is in _shown, by the place in its FaceMaterials::Names.
    std::vector<std::vector<int>> _materialsOfShapes;
    std::optional<int> _tessellationLevel;
    bool _tessellationFits = true;
    /// Only the counts of work and the time; the rest is added up when asked for.
    Statistics _work;
};

}  // namespace cc
