#include "core/scene/scene.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <set>
#include <unordered_set>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/scene/tessellationMemory.h"
#include "core/subdiv/limitGridPlan.h"

namespace cc {
namespace {

/// Takes the object out of the vector that owns it.
template <typename T>
void Remove(std::vector<std::unique_ptr<T>>* owners, const T* object) {
    const auto found = std::find_if(owners->begin(), owners->end(),
                                    [&](const auto& owner) { return owner.get() == object; });
    if (found != owners->end()) {
        owners->erase(found);
    }
}

/// An order of lights by what they are. Any will do, so bytes are compared: NaN cannot upset it.
bool IsBefore(const Light& a, const Light& b) {
    const auto key = [](const Light& light) {
        return std::array<float, 11>{light.kind == Light::Kind::Sphere ? 1.0f : 0.0f,
                                     light.castsShadows ? 1.0f : 0.0f,
                                     light.direction.x,
                                     light.direction.y,
                                     light.direction.z,
                                     light.position.x,
                                     light.position.y,
                                     light.position.z,
                                     light.power.x,
                                     light.power.y,
                                     light.power.z};
    };
    const auto keyA = key(a), keyB = key(b);
    return std::memcmp(keyA.data(), keyB.data(), sizeof(keyA)) < 0;
}

bool IsPlaced(const Placement& placement, const Geometry& geometry, size_t index, float time,
              Instance* instance) {
    return placement.Place(geometry, index, time, instance) == Placement::Obstacle::None;
}

double SecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Scene::Scene() = default;
Scene::~Scene() = default;

template <class Kind>
Kind* Scene::_AddShape(std::string name) {
    auto shape = std::make_unique<Kind>(std::move(name));
    Kind* const added = shape.get();
    const std::lock_guard<std::mutex> lock(_mutex);
    _shapes.push_back(std::move(shape));
    return added;
}

Mesh* Scene::AddMesh(std::string name) { return _AddShape<Mesh>(std::move(name)); }

Curves* Scene::AddCurves(std::string name) { return _AddShape<Curves>(std::move(name)); }

Points* Scene::AddPoints(std::string name) { return _AddShape<Points>(std::move(name)); }

void Scene::RemoveShape(Shape* shape) {
    const std::lock_guard<std::mutex> lock(_mutex);
    Remove(&_shapes, shape);
}

Light* Scene::AddLight() {
    const std::lock_guard<std::mutex> lock(_mutex);
    _lights.push_back(std::make_unique<Light>());
    return _lights.back().get();
}

void Scene::RemoveLight(Light* light) {
    const std::lock_guard<std::mutex> lock(_mutex);
    Remove(&_lights, light);
}

std::vector<std::string> Scene::Build(const std::vector<std::string>& renderTags,
                                      std::optional<int> tessellationLevel) {
    const auto start = std::chrono::steady_clock::now();
    // Threads add shapes and lights in any order; pictures and warnings must not depend on it.
    std::stable_sort(_shapes.begin(), _shapes.end(),
                     [](const auto& a, const auto& b) { return a->Name() < b->Name(); });
    std::stable_sort(_lights.begin(), _lights.end(),
                     [](const auto& a, const auto& b) { return IsBefore(*a, *b); });
    std::vector<Shape*> shapes;
    const auto isAsked = [&](const std::string& tag) {
        return renderTags.empty() ||
               std::find(renderTags.begin(), renderTags.end(), tag) != renderTags.end();
    };
    for (const auto& shape : _shapes) {
        if (shape->_visible && isAsked(shape->_renderTag)) {
            shapes.push_back(shape.get());
        }
    }
    std::vector<std::string> lines;
    const bool shapesChanged = _BuildShapes(shapes, &lines);
    _BuildTopLevel(shapes, shapesChanged);
    _NumberMaterials();
    SetTime(0);
    _Tessellate(tessellationLevel, &lines);
    _work.buildSeconds = SecondsSince(start);
    return lines;
}

bool Scene::_BuildShapes(const std::vector<Shape*>& shapes, std::vector<std::string>* lines) {
    std::vector<Shape::BuildReport> reports(shapes.size());
    tbb::parallel_for(size_t(0), shapes.size(),
                      [&](size_t i) { reports[i] = shapes[i]->_Build(); });
    bool changed = false;
    for (size_t i = 0; i < shapes.size(); ++i) {
        const Shape::BuildReport& report = reports[i];
        changed = changed || report.topLevelChanged;
        _work.surfacesBuilt += report.work == Shape::GeometryWork::Rebuilt;
        _work.surfacesMoved += report.work == Shape::GeometryWork::Moved;
        _work.primvarsBuilt += report.primvarsBuilt;
        for (const std::string& line : report.lines) {
            lines->push_back("<" + shapes[i]->Name() + ">: " + line);
        }
    }
    return changed;
}

void Scene::_BuildTopLevel(const std::vector<Shape*>& shapes, bool shapesChanged) {
    std::vector<const Shape*> shown;
    std::copy_if(shapes.begin(), shapes.end(), std::back_inserter(shown),
                 [](const Shape* shape) { return shape->_IsShown(); });
    if (!shapesChanged && shown == _shown) {
        return;
    }
    _shown = std::move(shown);
    _NumberSurfaces(shapes);
    _instances = {};  // before there is another one
    _instances = InstanceBvh(_PlaceInstances(), [&](size_t i, const Box3f& box) {
        return _shown[_origins[i].shape]->_placement.WorldBox(_origins[i].index, box);
    });
    ++_work.topLevelsBuilt;
}

void Scene::_NumberSurfaces(const std::vector<Shape*>& shapes) {
    uint32_t number = 0;
    for (Shape* shape : shapes) {
        Geometry* const geometry = shape->_Geometry();
        if (geometry && geometry->Kind() == GeometryKind::Surface) {
            static_cast<Surface*>(geometry)->SetNumber(number++);
        }
    }
}

std::vector<Instance> Scene::_PlaceInstances() {
    std::vector<size_t> firsts{0};
    for (const Shape* shape : _shown) {
        firsts.push_back(firsts.back() + shape->_placement.Count());
    }
    std::vector<Instance> instances(firsts.back());
    _origins.assign(firsts.back(), {});
    tbb::parallel_for(size_t(0), _shown.size(), [&](size_t m) {
        const Shape& shape = *_shown[m];
        tbb::parallel_for(size_t(0), shape._placement.Count(), [&, m](size_t i) {
            const Geometry& geometry = *shape.BuiltGeometry();
            const bool isLeftOut =
                shape._placement.IsMoving() &&
                shape._placement.FindObstacle(geometry, i) != Placement::Obstacle::None;
            if (!isLeftOut) {
                shape._placement.Place(geometry, i, 0, &instances[firsts[m] + i]);
            }
            _origins[firsts[m] + i] = {static_cast<uint32_t>(m), static_cast<uint32_t>(i)};
        });
    });
    size_t placed = 0;
    for (size_t i = 0; i < instances.size(); ++i) {
        if (instances[i].geometry) {
            instances[placed] = instances[i];
            _origins[placed++] = _origins[i];
        }
    }
    instances.resize(placed);
    _origins.resize(placed);
    return instances;
}

void Scene::_NumberMaterials() {
    std::set<std::string> names;
    for (const Shape* shape : _shown) {
        names.insert(shape->Materials().Names().begin(), shape->Materials().Names().end());
    }
    names.erase(std::string());
    _materialNames.assign(names.begin(), names.end());
    _materialsOfShapes.clear();
    for (const Shape* shape : _shown) {
        std::vector<int>& numbers = _materialsOfShapes.emplace_back();
        for (const std::string& name : shape->Materials().Names()) {
            const auto place = std::lower_bound(_materialNames.begin(), _materialNames.end(), name);
            numbers.push_back(name.empty() ? -1 : static_cast<int>(place - _materialNames.begin()));
        }
    }
}

bool Scene::IsMoving() const {
    return std::any_of(_shown.begin(), _shown.end(),
                       [](const Shape* shape) { return shape->_IsMoving(); });
}

void Scene::SetTime(float time) {
    if (!IsMoving()) {
        return;
    }
    for (const auto& shape : _shapes) {
        if (shape->_IsShown()) {
            shape->_Pose(time);
        }
    }
    tbb::parallel_for(size_t(0), _origins.size(), [&](size_t i) { _MoveInstance(i, time); });
}

/// Where a place has no transform between two poses, the shape is shown as it is at time 0.
void Scene::_MoveInstance(size_t instance, float time) {
    const Origin origin = _origins[instance];
    const Shape& shape = *_shown[origin.shape];
    const Placement& placement = shape._placement;
    const Geometry& geometry = *shape.BuiltGeometry();
    Instance moved;
    if (placement.IsMoving() && (IsPlaced(placement, geometry, origin.index, time, &moved) ||
                                 IsPlaced(placement, geometry, origin.index, 0, &moved))) {
        _instances.Move(instance, moved.objectToWorld, moved.worldToObject);
    }
}

int Scene::PrimvarArity(const std::string& name) const {
    int arity = 0;
    for (const Shape* shape : _shown) {
        const PrimvarField* primvar = shape->FindPrimvar(name);
        arity = primvar ? std::max(arity, primvar->Arity()) : arity;
    }
    return arity;
}

/// Tessellates the surfaces that are shown, if a level is given, and drops all other tessellations.
void Scene::_Tessellate(std::optional<int> level, std::vector<std::string>* lines) {
    const bool isOtherLevel = std::exchange(_tessellationLevel, level) != level;
    const std::unordered_set<const Shape*> shown(_shown.begin(), _shown.end());
    std::vector<Surface*> surfaces;
    for (const auto& shape : _shapes) {
        Geometry* const geometry = shape->_Geometry();
        if (!geometry || geometry->Kind() != GeometryKind::Surface) {
            continue;
        }
        auto* const surface = static_cast<Surface*>(geometry);
        const bool isShown = level && shown.count(shape.get()) != 0;
        if (isShown) {
            surfaces.push_back(surface);
        }
        if (!isShown || isOtherLevel) {
            surface->DropTessellation();
        }
    }
    const std::string obstacle = level ? WhyNotTessellate(surfaces, *level) : std::string();
    const bool isNews = isOtherLevel || _tessellationFits;
    _tessellationFits = obstacle.empty();
    if (_tessellationFits) {
        tbb::parallel_for(size_t(0), surfaces.size(),
                          [&](size_t i) { surfaces[i]->TessellationAt(*level); });
        return;
    }
    for (Surface* surface : surfaces) {
        surface->DropTessellation();
    }
    if (isNews) {
        lines->push_back(obstacle + "; packets trace the surface itself");
    }
}

Scene::Statistics Scene::GetStatistics() const {
    Statistics statistics = _work;
    statistics.materials = _materialNames;
    for (const Shape* shape : _shown) {
        statistics.faces += shape->_FaceCount();
        statistics.bytes += shape->_Bytes();
        const Geometry& geometry = *shape->BuiltGeometry();
        if (geometry.Kind() == GeometryKind::Surface) {
            statistics.patches += geometry.PrimitiveCount();
            statistics.tessellationBytes +=
                static_cast<const Surface&>(geometry).TessellationBytes();
        }
    }
    statistics.bytes += LimitGridPlans::SharedBytes();
    statistics.instances = _instances.Instances().size();
    statistics.bytes += _instances.Instances().capacity() * sizeof(Instance) + _instances.Bytes() +
                        _shown.capacity() * sizeof(const Shape*) +
                        _origins.capacity() * sizeof(Origin);
    return statistics;
}

}  // namespace cc
