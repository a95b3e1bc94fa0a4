#include "core/scene/shape.h"

#include <utility>

namespace cc {
namespace {

constexpr char kDisplayColor[] = "displayColor";

}  // namespace

Shape::Shape(std::string name) : _name(std::move(name)) {}

Shape::~Shape() = default;

void Shape::SetPrimvar(const std::string& name, Primvar primvar) {
    if (primvar.IsEmpty()) {
        _primvars.erase(name);
        _NotePrimvarsForShading();
        return;
    }
    PrimvarSlot& slot = _primvars[name];
    if (!slot.isChanged && !slot.field.IsEmpty() && slot.field.IsMadeOf(primvar)) {
        return;
    }
    slot.waiting = std::move(primvar);
    slot.isChanged = true;
}

void Shape::SetTransform(const AffineTransform& objectToWorld) {
    SetMovingTransform(Moving<AffineTransform>(objectToWorld));
}

void Shape::SetMovingTransform(Moving<AffineTransform> objectToWorld) {
    _placementChanged |= _placement.SetTransform(std::move(objectToWorld));
}

void Shape::SetInstances(std::vector<AffineTransform> instanceToWorld) {
    SetMovingInstances(Moving<std::vector<AffineTransform>>(std::move(instanceToWorld)));
}

void Shape::SetMovingInstances(Moving<std::vector<AffineTransform>> instanceToWorld) {
    _placement.SetInstances(std::move(instanceToWorld));
    _placementChanged = true;
    _TakePrimvarsBack(/* ofInstancesOnly */ true);
}

void Shape::ClearInstances() { _placementChanged |= _placement.ClearInstances(); }

void Shape::SetMaterial(std::string name) {
    _materialsChanged |= name != _material;
    _material = std::move(name);
}

void Shape::_SetSubsets(std::vector<FaceSubset> subsets) {
    _materialsChanged |= !(subsets == _subsets);
    _subsets = std::move(subsets);
}

Vec3f Shape::DisplayColor(const ShapePoint& at) const {
    if (!_displayColor) {
        return kDefaultDisplayColor;
    }
    const SurfaceValue color = Evaluate(*_displayColor, at);
    return {color.value[0], color.value[1], color.value[2]};
}

const PrimvarField* Shape::FindPrimvar(const std::string& name) const {
    const auto found = _primvars.find(name);
    return found == _primvars.end() || found->second.field.IsEmpty() ? nullptr
                                                                     : &found->second.field;
}

Shape::BuildReport Shape::_Build() {
    BuildReport report;
    _BuildGeometry(&report);
    if (_Geometry()) {
        _BuildPrimvars(&report);
    }
    if (_placementChanged || report.work != GeometryWork::None) {
        _BuildPlacement(&report);
    }
    if (_Geometry() && (_materialsChanged || report.work == GeometryWork::Rebuilt)) {
        _BuildMaterials(&report);
    }
    _placementChanged = false;
    return report;
}

void Shape::_TakePrimvarsBack(bool ofInstancesOnly) {
    for (auto& [name, slot] : _primvars) {
        const bool isOfInstances = slot.field.IsEmpty()
                                       ? slot.waiting.interpolation == Interpolation::Instance
                                       : slot.field.IsOfInstances();
        if (ofInstancesOnly && !isOfInstances) {
            continue;
        }
        if (!slot.isChanged && !slot.field.IsEmpty()) {
            slot.waiting = slot.field.TakePrimvar();
        }
        slot.field = {};
        slot.isChanged = true;
    }
    _NotePrimvarsForShading();
}

void Shape::_NotePrimvarsForShading() { _displayColor = FindPrimvar(kDisplayColor); }

void Shape::_BuildPrimvars(BuildReport* report) {
    for (auto& [name, slot] : _primvars) {
        if (slot.isChanged) {
            _BuildPrimvar(name, &slot, report);
            ++report->primvarsBuilt;
        }
    }
    _NotePrimvarsForShading();
}

void Shape::_BuildPrimvar(const std::string& name, PrimvarSlot* slot, BuildReport* report) const {
    std::string error = CheckPrimvar(name, slot->waiting, _Sizes());
    if (error.empty()) {
        error = _CheckPrimvar(name, slot->waiting);
    }
    slot->isChanged = false;
    // Kept if it does not fit, as the next geometry may be the one that it belongs to.
    slot->field = {};
    if (!error.empty()) {
        report->lines.push_back(error + "; " + _Without(name));
        return;
    }
    slot->field = _MakeField(name, std::exchange(slot->waiting, {}), report);
}

std::string Shape::_CheckPrimvar(const std::string& name, const Primvar& primvar) const {
    if (name != kDisplayColor || primvar.arity == 3) {
        return {};
    }
    return name + " has " + std::to_string(primvar.arity) + " numbers a value, not 3";
}

std::string Shape::_Without(const std::string& name) const {
    return name == kDisplayColor ? std::string(_Is()) + " shown in grey" : "it is left out";
}

PrimvarField Shape::_MakeField(const std::string&, Primvar primvar, BuildReport*) const {
    return PrimvarField(std::move(primvar));
}

void Shape::_BuildPlacement(BuildReport* report) {
    report->topLevelChanged = true;
    const Placement::Obstacles before = _obstacles;
    const Geometry* const geometry = BuiltGeometry();
    _obstacles = geometry ? _placement.FindObstacles(*geometry) : Placement::Obstacles();
    if (_placementChanged || !(_obstacles == before)) {
        for (std::string& line : _placement.Describe(_obstacles, _Is())) {
            report->lines.push_back(std::move(line));
        }
    }
}

void Shape::_BuildMaterials(BuildReport* report) {
    std::string warning;
    _materials = FaceMaterials(_material, _subsets, _FaceCount(), &warning);
    _materialsChanged = false;
    if (!warning.empty()) {
        report->lines.push_back(warning);
    }
}

size_t Shape::_Bytes() const {
    size_t bytes = _OwnBytes() + _placement.Bytes() + _materials.Bytes();
    for (const FaceSubset& subset : _subsets) {
        bytes += subset.faces.capacity() * sizeof(int);
    }
    bytes += BuiltGeometry() ? BuiltGeometry()->Bytes() : 0;
    for (const auto& [name, slot] : _primvars) {
        bytes += slot.field.Bytes();
    }
    return bytes;
}

}  // namespace cc
