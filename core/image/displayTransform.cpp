#include "core/image/displayTransform.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>

#include <OpenColorIO/OpenColorIO.h>
#include <tbb/parallel_for.h>

namespace OCIO = OCIO_NAMESPACE;

namespace cc {
namespace {

/// The curve of IEC 61966-2-1, clamped to what a display shows.
float EncodeSrgb(float linear) {
    if (!(linear > 0)) {
        return 0;  // NaN too
    }
    if (linear >= 1) {
        return 1;
    }
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Calls function(first float, pixel count) for every row, in parallel.
template <typename Function>
void ForEachRow(float* rgba, int width, int height, const Function& function) {
    tbb::parallel_for(
        0, height, [&](int row) { function(rgba + static_cast<size_t>(row) * width * 4, width); });
}

OCIO::ConstConfigRcPtr LoadConfig() {
    const char* file = std::getenv("OCIO");
    return file && *file ? OCIO::Config::CreateFromFile(file)
                         : OCIO::Config::CreateFromBuiltinConfig("ocio://default");
}

/// The configuration's name of our working space, linear Rec.709; what it renders in by default
/// if it does not know that.
std::string FindSourceSpace(const OCIO::Config& config) {
    for (const char* name : {"lin_rec709", "lin_rec709_srgb", "Linear Rec.709 (sRGB)",
                             "Utility - Linear - sRGB", "Utility - Linear - Rec.709"}) {
        if (const OCIO::ConstColorSpaceRcPtr space = config.getColorSpace(name)) {
            return space->getName();
        }
    }
    return OCIO::ROLE_SCENE_LINEAR;
}

OCIO::ConstCPUProcessorRcPtr MakeProcessor(const OpenColorIOOptions& options) {
    const OCIO::ConstConfigRcPtr config = LoadConfig();
    const std::string display =
        options.display.empty() ? config->getDefaultDisplay() : options.display;
    const std::string source =
        options.colorSpace.empty() ? FindSourceSpace(*config) : options.colorSpace;
    const std::string view =
        options.view.empty() ? config->getDefaultView(display.c_str()) : options.view;
    if (view.empty()) {
        const std::string reason = "display '" + display + "' has no views";
        throw OCIO::Exception(reason.c_str());
    }

    const OCIO::DisplayViewTransformRcPtr transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(source.c_str());
    transform->setDisplay(display.c_str());
    transform->setView(view.c_str());
    const OCIO::LegacyViewingPipelineRcPtr pipeline = OCIO::LegacyViewingPipeline::Create();
    pipeline->setDisplayViewTransform(transform);
    if (!options.look.empty()) {
        pipeline->setLooksOverrideEnabled(true);
        pipeline->setLooksOverride(options.look.c_str());
    }
    return pipeline->getProcessor(config)->getDefaultCPUProcessor();
}

std::string ApplyOpenColorIO(const OpenColorIOOptions& options, float* rgba, int width,
                             int height) {
    try {
        const OCIO::ConstCPUProcessorRcPtr processor = MakeProcessor(options);
        ForEachRow(rgba, width, height, [&](float* row, int count) {
            OCIO::PackedImageDesc image(row, count, 1, 4);
            processor->apply(image);
        });
        return {};
    } catch (const std::exception& error) {
        std::string reason = error.what();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        return "OpenColorIO: " + reason;
    }
}

}  // namespace

std::string ApplyDisplayTransform(ColorCorrection mode, const OpenColorIOOptions& options,
                                  float* rgba, int width, int height) {
    if (width < 1 || height < 1) {
        return {};
    }
    switch (mode) {
        case ColorCorrection::Disabled: break;
        case ColorCorrection::SRGB:
            ForEachRow(rgba, width, height, [](float* row, int count) {
                for (int i = 0; i < 4 * count; ++i) {
                    row[i] = i % 4 == 3 ? row[i] : EncodeSrgb(row[i]);
                }
            });
            break;
        case ColorCorrection::OpenColorIO: return ApplyOpenColorIO(options, rgba, width, height);
    }
    return {};
}

}  // namespace cc
