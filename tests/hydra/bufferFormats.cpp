// Loaded into Python by test_buffers.py: render buffers are out of reach of OpenUSD's bindings.

#include <cmath>
#include <cstring>
#include <string>

#include "pxr/base/gf/half.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/stringUtils.h"

#include "hdCC/renderBuffer.h"

PXR_NAMESPACE_USING_DIRECTIVE

static double Component(const uint8_t* pixel, HdFormat component, int i) {
    const auto read = [&](auto value) {
        std::memcpy(&value, pixel + i * sizeof(value), sizeof(value));
        return double(value);
    };
    switch (component) {
        case HdFormatUNorm8: return read(uint8_t()) / 255;
        case HdFormatSNorm8: return read(int8_t()) / 127;
        case HdFormatFloat16: {
            GfHalf half;
            std::memcpy(&half, pixel + i * sizeof(half), sizeof(half));
            return float(half);
        }
        case HdFormatFloat32: return read(float());
        case HdFormatInt16: return read(int16_t());
        case HdFormatUInt16: return read(uint16_t());
        default: return read(int32_t());
    }
}

/// The value as the format can hold it.
static double Held(HdFormat component, double value) {
    switch (component) {
        case HdFormatUNorm8: return std::min(std::max(value, 0.0), 1.0);
        case HdFormatSNorm8: return std::min(std::max(value, -1.0), 1.0);
        case HdFormatFloat16:
        case HdFormatFloat32: return value;
        case HdFormatUInt16: return std::trunc(std::max(value, 0.0));
        default: return std::trunc(value);
    }
}

static std::string CheckPixel(HdCCRenderBuffer* buffer, int x, int y, const double* expected) {
    const HdFormat component = HdGetComponentFormat(buffer->GetFormat());
    const size_t size = HdDataSizeOfFormat(buffer->GetFormat());
    const auto* pixels = static_cast<const uint8_t*>(buffer->Map());
    const uint8_t* pixel = pixels + (size_t(y) * buffer->GetWidth() + x) * size;
    std::string error;
    for (int i = 0; i < int(HdGetComponentCount(buffer->GetFormat())); ++i) {
        const double found = Component(pixel, component, i), held = Held(component, expected[i]);
        if (!(std::fabs(found - held) < 0.005)) {
            error = TfStringPrintf("format %d, pixel %d %d, component %d: %g, not %g",
                                   int(buffer->GetFormat()), x, y, i, found, held);
        }
    }
    buffer->Unmap();
    return error;
}

/// A film of 2 x 2 in a buffer of 3 x 2, one pixel from the left; what is not covered is clear.
static std::string CheckFormat(HdFormat format) {
    HdCCRenderBuffer buffer{SdfPath("/Buffer")};
    if (!buffer.Allocate(GfVec3i(3, 2, 1), format, false)) {
        return TfStringPrintf("format %d is refused", int(format));
    }
    cc::Film film(2, 2, {cc::Aov::Color});
    const float covered[4] = {-0.5f, 0.25f, 1.5f, 1}, half[4] = {0.25f, 0.5f, 0, 0.5f};
    std::memcpy(film.Floats(cc::Aov::Color), covered, sizeof(covered));
    std::memcpy(film.Floats(cc::Aov::Color) + 12, half, sizeof(half));
    const VtValue clear(GfVec4f(1, 0, 0.5f, 1));
    buffer.Clear(clear);
    buffer.Write(film, cc::Aov::Color, GfVec2i(1, 0), clear);

    const double clearPixel[4] = {1, 0, 0.5, 1}, mixed[4] = {0.75, 0.5, 0.25, 1};
    const double coveredPixel[4] = {-0.5, 0.25, 1.5, 1};
    for (const std::string& error :
         {CheckPixel(&buffer, 0, 0, clearPixel), CheckPixel(&buffer, 1, 0, coveredPixel),
          CheckPixel(&buffer, 2, 0, clearPixel), CheckPixel(&buffer, 2, 1, mixed)}) {
        if (!error.empty()) {
            return error;
        }
    }
    return {};
}

static std::string CheckIds(HdFormat format) {
    HdCCRenderBuffer buffer{SdfPath("/Buffer")};
    buffer.Allocate(GfVec3i(2, 1, 1), format, false);
    cc::Film film(2, 1, {cc::Aov::PrimId});
    film.Ints(cc::Aov::PrimId)[1] = 1000;
    buffer.Write(film, cc::Aov::PrimId, GfVec2i(0), VtValue(-7));
    const double background[4] = {-7, 0, 0, 1}, id[4] = {1000, 0, 0, 1};
    const std::string error = CheckPixel(&buffer, 0, 0, background);
    return error.empty() ? CheckPixel(&buffer, 1, 0, id) : error;
}

/// What falls outside is cropped, wherever the corner is.
static std::string CheckCrop() {
    cc::Film film(4, 4, {cc::Aov::Depth});
    for (int i = 0; i < 16; ++i) {
        film.Floats(cc::Aov::Depth)[i] = float(i);
    }
    for (int y = -5; y <= 5; ++y) {
        for (int x = -5; x <= 5; ++x) {
            HdCCRenderBuffer buffer{SdfPath("/Buffer")};
            buffer.Allocate(GfVec3i(3, 2, 1), HdFormatFloat32, false);
            buffer.Clear(VtValue(-1.0f));
            buffer.Write(film, cc::Aov::Depth, GfVec2i(x, y), VtValue());
            for (int i = 0; i < 6; ++i) {
                const int fx = i % 3 - x, fy = i / 3 - y;
                const bool inside = fx >= 0 && fx < 4 && fy >= 0 && fy < 4;
                const double expected = inside ? 4 * fy + fx : -1;
                const std::string error = CheckPixel(&buffer, i % 3, i / 3, &expected);
                if (!error.empty()) {
                    return error;
                }
            }
        }
    }
    return {};
}

/// Returns null, or what is wrong.
extern "C" const char* HdCCCheckBufferFormats() {
    static std::string error;
    for (int format = 0; format < HdFormatCount && error.empty(); ++format) {
        if (format != HdFormatFloat32UInt8) {
            error = CheckFormat(HdFormat(format));
        }
    }
    for (HdFormat format : {HdFormatInt32, HdFormatInt16, HdFormatFloat32, HdFormatFloat16,
                            HdFormatInt32Vec2, HdFormatFloat32Vec4}) {
        error = error.empty() ? CheckIds(format) : error;
    }
    error = error.empty() ? CheckCrop() : error;
    return error.empty() ? nullptr : error.c_str();
}
