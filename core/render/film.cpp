#include "core/render/film.h"

#include <algorithm>
#include <utility>

namespace cc {
namespace {

struct AovDescription {
    Aov aov;
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
};

const AovDescription& Describe(Aov aov) {
    return *std::find_if(std::begin(kAovs), std::end(kAovs),
                         [&](const AovDescription& d) { return d.aov == aov; });
}

}  // namespace

AovLayout LayoutOf(Aov aov) { return Describe(aov).layout; }

const char* NameOf(Aov aov) { return Describe(aov).name; }

bool AovFromName(const std::string& name, Aov* aov) {
    for (const AovDescription& description : kAovs) {
        if (name == description.name) {
            *aov = description.aov;
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

bool Film::Has(Aov aov) const { return _Find(aov) != nullptr; }

void Film::Clear() {
    const size_t pixels = static_cast<size_t>(_width) * _height;
    for (size_t i = 0; i < _aovs.size(); ++i) {
        const AovDescription& description = Describe(_aovs[i]);
        const size_t size = pixels * description.layout.components;
        if (description.layout.isInteger) {
            _planes[i].ints.assign(size, description.background);
        } else {
            _planes[i].floats.assign(size, static_cast<float>(description.background));
        }
    }
}

const Film::Plane* Film::_Find(Aov aov) const {
    const auto found = std::find(_aovs.begin(), _aovs.end(), aov);
    return found == _aovs.end() ? nullptr : &_planes[found - _aovs.begin()];
}

const float* Film::Floats(Aov aov) const {
    const Plane* plane = _Find(aov);
    return plane && !LayoutOf(aov).isInteger ? plane->floats.data() : nullptr;
}

float* Film::Floats(Aov aov) {
    return const_cast<float*>(static_cast<const Film*>(this)->Floats(aov));
}

const int32_t* Film::Ints(Aov aov) const {
    const Plane* plane = _Find(aov);
    return plane && LayoutOf(aov).isInteger ? plane->ints.data() : nullptr;
}

int32_t* Film::Ints(Aov aov) {
    return const_cast<int32_t*>(static_cast<const Film*>(this)->Ints(aov));
}

}  // namespace cc
