#include "core/render/film.h"

#include <algorithm>
#include <utility>

namespace cc {
namespace {

struct AovDescription {
    Aov::Kind kind;
    const char* name;
    AovLayout layout;
    int background;
};

constexpr AovDescription kAovs[] = {
    {Aov::Color, "color", {4, false}, 0},
    {Aov::Depth, "depth", {1, false}, 1},
    {Aov::CameraDepth, "cameraDepth", {1, false}, 0},
    {Aov::PrimId, "primId", {1, true}, -1},
    {Aov::InstanceId, "instanceId", {1, true}, -1},
    {Aov::ElementId, "elementId", {1, true}, -1},
    {Aov::Normal, "normal", {3, false}, 0},
    {Aov::Neye, "Neye", {3, false}, 0},
    {Aov::Material, "hdcc:material", {1, true}, -1},
    {Aov::Level, "hdcc:level", {1, true}, -1},
    {Aov::Fan, "hdcc:fan", {1, true}, -1},
    {Aov::Cost, "hdcc:cost", {1, false}, 0},
    {Aov::Primvar, "primvars:", {3, false}, 0},
};

const AovDescription& Describe(const Aov& aov) {
    return *std::find_if(std::begin(kAovs), std::end(kAovs),
                         [&](const AovDescription& d) { return d.kind == aov.kind; });
}

}  // namespace

AovLayout LayoutOf(const Aov& aov) {
    return aov.kind == Aov::Primvar ? AovLayout{aov.arity, false} : Describe(aov).layout;
}

std::string NameOf(const Aov& aov) { return Describe(aov).name + aov.primvar; }

bool AovFromName(const std::string& name, Aov* aov) {
    for (const AovDescription& description : kAovs) {
        const std::string known = description.name;
        if (description.kind == Aov::Primvar && name.size() > known.size() &&
            name.compare(0, known.size(), known) == 0) {
            *aov = Aov(Aov::Primvar, name.substr(known.size()), description.layout.components);
            return true;
        }
        if (description.kind != Aov::Primvar && name == known) {
            *aov = description.kind;
            return true;
        }
    }
    return false;
}

Film::Film(int width, int height, std::vector<Aov> aovs)
    : _width(std::max(width, 0)),
      _height(std::max(height, 0)),
      _aovs(std::move(aovs)),
      _planes(_aovs.size()) {
    Clear();
}

bool Film::Has(const Aov& aov) const { return _Find(aov) != nullptr; }

AovLayout Film::Layout(const Aov& aov) const {
    return LayoutOf(*std::find(_aovs.begin(), _aovs.end(), aov));
}

void Film::Clear() {
    const size_t pixels = static_cast<size_t>(_width) * _height;
    for (size_t i = 0; i < _aovs.size(); ++i) {
        const AovDescription& description = Describe(_aovs[i]);
        const size_t size = pixels * LayoutOf(_aovs[i]).components;
        if (description.layout.isInteger) {
            _planes[i].ints.assign(size, description.background);
        } else {
            _planes[i].floats.assign(size, static_cast<float>(description.background));
        }
        if (_aovs[i].kind == Aov::Primvar) {
            _planes[i].coverage.assign(pixels, 0);
        }
    }
}

const Film::Plane* Film::_Find(const Aov& aov) const {
    const auto found = std::find(_aovs.begin(), _aovs.end(), aov);
    return found == _aovs.end() ? nullptr : &_planes[found - _aovs.begin()];
}

const float* Film::Floats(const Aov& aov) const {
    const Plane* plane = _Find(aov);
    return plane && !LayoutOf(aov).isInteger ? plane->floats.data() : nullptr;
}

float* Film::Floats(const Aov& aov) {
    return const_cast<float*>(static_cast<const Film*>(this)->Floats(aov));
}

const int32_t* Film::Ints(const Aov& aov) const {
    const Plane* plane = _Find(aov);
    return plane && LayoutOf(aov).isInteger ? plane->ints.data() : nullptr;
}

int32_t* Film::Ints(const Aov& aov) {
    return const_cast<int32_t*>(static_cast<const Film*>(this)->Ints(aov));
}

const uint8_t* Film::Coverage(const Aov& aov) const {
    const Plane* plane = _Find(aov);
    return plane && aov.kind == Aov::Primvar ? plane->coverage.data() : nullptr;
}

uint8_t* Film::Coverage(const Aov& aov) {
    return const_cast<uint8_t*>(static_cast<const Film*>(this)->Coverage(aov));
}

}  // namespace cc
