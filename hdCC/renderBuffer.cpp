#include "hdCC/renderBuffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "pxr/base/gf/half.h"
#include "pxr/base/gf/vec2d.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4d.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/diagnostic.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

// Doubles hold every float and every 32-bit int exactly.
using _Texel = std::array<double, 4>;

}  // namespace

template <class Int>
static Int _ToInt(double value) {
    const double lowest = double(std::numeric_limits<Int>::min());
    const double highest = double(std::numeric_limits<Int>::max());
    return std::isnan(value) ? Int(0) : Int(std::min(std::max(value, lowest), highest));
}

template <class T>
static void _StoreAs(uint8_t *pixel, int component, T value) {
    std::memcpy(pixel + component * sizeof(T), &value, sizeof(T));
}

static void _StoreComponent(HdFormat componentFormat, uint8_t *pixel, int i, double value) {
    switch (componentFormat) {
        case HdFormatUNorm8: return _StoreAs(pixel, i, _ToInt<uint8_t>(value * 255 + 0.5));
        case HdFormatSNorm8:
            return _StoreAs(pixel, i,
                            std::max(int8_t(-127), _ToInt<int8_t>(std::round(value * 127))));
        case HdFormatFloat16: return _StoreAs(pixel, i, GfHalf(float(value)));
        case HdFormatFloat32: return _StoreAs(pixel, i, float(value));
        case HdFormatInt16: return _StoreAs(pixel, i, _ToInt<int16_t>(value));
        case HdFormatUInt16: return _StoreAs(pixel, i, _ToInt<uint16_t>(value));
        case HdFormatInt32: return _StoreAs(pixel, i, _ToInt<int32_t>(value));
        default: return;
    }
}

static bool _IsSupported(HdFormat format) {
    switch (HdGetComponentFormat(format)) {
        case HdFormatUNorm8:
        case HdFormatSNorm8:
        case HdFormatFloat16:
        case HdFormatFloat32:
        case HdFormatInt16:
        case HdFormatUInt16:
        case HdFormatInt32: return format != HdFormatFloat32UInt8;
        default: return false;
    }
}

template <class Vec>
static bool _ReadVector(VtValue const &value, _Texel *texel) {
    if (!value.IsHolding<Vec>()) {
        return false;
    }
    Vec const &v = value.UncheckedGet<Vec>();
    for (size_t i = 0; i < Vec::dimension; ++i) {
        (*texel)[i] = v[i];
    }
    return true;
}

template <class Scalar>
static bool _ReadScalar(VtValue const &value, _Texel *texel) {
    if (!value.IsHolding<Scalar>()) {
        return false;
    }
    (*texel)[0] = value.UncheckedGet<Scalar>();
    return true;
}

static bool _ReadTexel(VtValue const &value, _Texel *texel) {
    *texel = {0, 0, 0, 1};
    return _ReadScalar<float>(value, texel) || _ReadScalar<int>(value, texel) ||
           _ReadScalar<double>(value, texel) || _ReadVector<GfVec2f>(value, texel) ||
           _ReadVector<GfVec3f>(value, texel) || _ReadVector<GfVec4f>(value, texel) ||
           _ReadVector<GfVec2d>(value, texel) || _ReadVector<GfVec3d>(value, texel) ||
           _ReadVector<GfVec4d>(value, texel);
}

namespace {

/// A plane of a film, looked up once.
class _Source {
  public:
    _Source(cc::Film const &film, cc::Aov const &aov)
        : _floats(film.Floats(aov)),
          _ints(film.Ints(aov)),
          _components(film.Layout(aov).components),
          _isColor(aov == cc::Aov::Color),
          _coverage(film.Coverage(aov)),
          _primIds(aov == cc::Aov::Color ? nullptr : film.Ints(cc::Aov::PrimId)) {}

    uint8_t const *Bytes() const {
        return _ints ? reinterpret_cast<uint8_t const *>(_ints)
                     : reinterpret_cast<uint8_t const *>(_floats);
    }

    _Texel At(size_t pixel) const {
        _Texel texel{0, 0, 0, 1};
        for (int i = 0; i < _components; ++i) {
            const size_t at = pixel * _components + i;
            texel[i] = _ints ? double(_ints[at]) : double(_floats[at]);
        }
        return texel;
    }

    /// What shows in place of the clear value.
    _Texel Over(size_t pixel, _Texel const &clear) const {
        _Texel texel = At(pixel);
        if (_isColor) {
            const double uncovered = 1 - texel[3];
            for (int i = 0; i < 4; ++i) {
                texel[i] += uncovered * clear[i];
            }
            return texel;
        }
        if (_coverage) {
            return _coverage[pixel] != 0 ? texel : clear;
        }
        return _primIds && _primIds[pixel] < 0 ? clear : texel;
    }

  private:
    float const *_floats;
    int32_t const *_ints;
    int _components;
    bool _isColor;
    uint8_t const *_coverage;
    int32_t const *_primIds;
};

}  // namespace

static HdFormat _FormatOf(cc::AovLayout const &layout) {
    const HdFormat first = layout.isInteger ? HdFormatInt32 : HdFormatFloat32;
    return HdFormat(int(first) + layout.components - 1);
}

/// Whether the clear value is what a new film holds, so that there is nothing to mix.
static bool _IsBackground(cc::Aov const &aov, _Texel const &clear) {
    const _Texel background = _Source(cc::Film(1, 1, {aov}), aov).At(0);
    const int components = cc::LayoutOf(aov).components;
    return std::equal(background.begin(), background.begin() + components, clear.begin());
}

HdCCRenderBuffer::HdCCRenderBuffer(SdfPath const &id) : HdRenderBuffer(id) {}

bool HdCCRenderBuffer::Allocate(GfVec3i const &dimensions, HdFormat format, bool) {
    _Deallocate();
    if (dimensions[0] < 0 || dimensions[1] < 0 || dimensions[2] > 1 || !_IsSupported(format)) {
        TF_WARN("<%s>: cannot make a render buffer of %d x %d x %d pixels in Hydra's format %d",
                GetId().GetText(), dimensions[0], dimensions[1], dimensions[2], int(format));
        return false;
    }
    try {
        _pixels.assign(size_t(dimensions[0]) * dimensions[1] * HdDataSizeOfFormat(format), 0);
    } catch (std::exception const &) {
        TF_WARN("<%s>: no memory for a render buffer of %d x %d pixels", GetId().GetText(),
                dimensions[0], dimensions[1]);
        return false;
    }
    _width = dimensions[0];
    _height = dimensions[1];
    _format = format;
    return true;
}

void HdCCRenderBuffer::_Deallocate() {
    static std::atomic<int> versions{0};
    _version = ++versions;
    _width = _height = 0;
    _format = HdFormatInvalid;
    _pixels.clear();
    _pixels.shrink_to_fit();
    _converged = false;
}

void *HdCCRenderBuffer::Map() {
    ++_mappers;
    return _pixels.data();
}

static void _StoreTexel(HdFormat componentFormat, int count, uint8_t *pixel, _Texel const &texel) {
    for (int i = 0; i < count; ++i) {
        _StoreComponent(componentFormat, pixel, i, texel[i]);
    }
}

void HdCCRenderBuffer::Clear(VtValue const &value) {
    _Texel texel;
    if (_pixels.empty() || !_ReadTexel(value, &texel)) {
        return;
    }
    const HdFormat componentFormat = HdGetComponentFormat(_format);
    const int count = int(HdGetComponentCount(_format));
    const size_t size = HdDataSizeOfFormat(_format);
    for (size_t at = 0; at < _pixels.size(); at += size) {
        _StoreTexel(componentFormat, count, _pixels.data() + at, texel);
    }
}

void HdCCRenderBuffer::Write(cc::Film const &film, cc::Aov const &aov, GfVec2i const &corner,
                             VtValue const &clearValue) {
    _Texel clear;
    const bool hasClear = _ReadTexel(clearValue, &clear) && !_IsBackground(aov, clear);
    const HdFormat componentFormat = HdGetComponentFormat(_format);
    const int count = int(HdGetComponentCount(_format));
    const size_t size = HdDataSizeOfFormat(_format);

    const int x0 = std::max(0, -corner[0]), x1 = std::min(film.Width(), int(_width) - corner[0]);
    const int y0 = std::max(0, -corner[1]), y1 = std::min(film.Height(), int(_height) - corner[1]);
    const _Source source(film, aov);
    const bool isPlainCopy = !hasClear && _format == _FormatOf(film.Layout(aov)) && x0 < x1;
    for (int y = y0; y < y1; ++y) {
        if (isPlainCopy) {
            const size_t from = (size_t(y) * film.Width() + x0) * size;
            const size_t to = (size_t(y + corner[1]) * _width + (x0 + corner[0])) * size;
            std::memcpy(_pixels.data() + to, source.Bytes() + from, (x1 - x0) * size);
            continue;
        }
        for (int x = x0; x < x1; ++x) {
            const size_t pixel = size_t(y) * film.Width() + x;
            const size_t at = size_t(y + corner[1]) * _width + (x + corner[0]);
            _StoreTexel(componentFormat, count, _pixels.data() + at * size,
                        hasClear ? source.Over(pixel, clear) : source.At(pixel));
        }
    }
}

PXR_NAMESPACE_CLOSE_SCOPE
