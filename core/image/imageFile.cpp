#include "core/image/imageFile.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <set>

#include <OpenImageIO/imageio.h>

namespace cc {
namespace {

/// Rows that are packed and handed to OpenImageIO at once: a multiple of EXR's blocks of 16.
constexpr int kBandRows = 64;

constexpr float kLargestHalf = 65504;

enum class FileFormat { Unknown, OpenExr, Png, Jpeg, Tiff };

FileFormat FormatOf(const std::string& path) {
    const size_t dot = path.find_last_of("./");
    if (dot == std::string::npos || path[dot] == '/') {
        return FileFormat::Unknown;
    }
    std::string extension = path.substr(dot + 1);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == "exr") return FileFormat::OpenExr;
    if (extension == "png") return FileFormat::Png;
    if (extension == "jpg" || extension == "jpeg") return FileFormat::Jpeg;
    if (extension == "tif" || extension == "tiff") return FileFormat::Tiff;
    return FileFormat::Unknown;
}

const char* OpenImageIOName(FileFormat format) {
    switch (format) {
        case FileFormat::OpenExr: return "openexr";
        case FileFormat::Png: return "png";
        case FileFormat::Jpeg: return "jpeg";
        case FileFormat::Tiff: return "tiff";
        case FileFormat::Unknown: break;
    }
    return "";
}

std::string OneLine(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string Failure(const std::string& path, const std::string& reason) {
    return "cannot write '" + path + "': " + OneLine(reason);
}

/// A channel of the file and where its values come from.
struct Channel {
    std::string name;
    bool isHalf;
    const ImagePlane* plane;
    int component;
};

std::vector<Channel> ExrChannels(const std::vector<ImagePlane>& planes) {
    std::vector<Channel> channels;
    for (const ImagePlane& plane : planes) {
        const bool isLayer = plane.name != "color";
        const bool isScalar = plane.components == 1;
        const bool isHalf =
            plane.isHalf.value_or(!isScalar && !plane.isInteger && !plane.isPrecise);
        const char* suffixes = plane.isColor || !isLayer                          ? "RGBA"
                               : isScalar && !plane.isInteger && !plane.isPrecise ? "Z"
                                                                                  : "XYZW";
        for (int c = 0; c < plane.components; ++c) {
            const std::string layer = isLayer ? plane.name + "." : "";
            channels.push_back({layer + suffixes[c], isHalf, &plane, c});
        }
    }
    return channels;
}

float ChannelValue(const Channel& channel, size_t pixel) {
    const size_t i = pixel * channel.plane->components + channel.component;
    if (channel.plane->isInteger) {
        return static_cast<float>(static_cast<const int32_t*>(channel.plane->pixels)[i]);
    }
    const float value = static_cast<const float*>(channel.plane->pixels)[i];
    // Half has an infinity that no later step of a pipeline wants.
    return channel.isHalf && std::isfinite(value)
               ? std::min(std::max(value, -kLargestHalf), kLargestHalf)
               : value;
}

/// Fills rows of the file, counted from the top, from planes whose rows go up.
void PackExrRows(const std::vector<Channel>& channels, int width, int height, int beginRow,
                 int endRow, std::vector<float>* packed) {
    packed->resize(static_cast<size_t>(endRow - beginRow) * width * channels.size());
    float* value = packed->data();
    for (int row = beginRow; row < endRow; ++row) {
        const size_t firstPixel = static_cast<size_t>(height - 1 - row) * width;
        for (int x = 0; x < width; ++x) {
            for (const Channel& channel : channels) {
                *value++ = ChannelValue(channel, firstPixel + x);
            }
        }
    }
}

/// As PackExrRows, for the colour plane in an 8-bit format. With alpha, colours are divided by it,
/// so that the picture over black is the one that was rendered.
void PackDisplayRows(const ImagePlane& color, int channelCount, int width, int height, int beginRow,
                     int endRow, std::vector<float>* packed) {
    packed->resize(static_cast<size_t>(endRow - beginRow) * width * channelCount);
    float* value = packed->data();
    for (int row = beginRow; row < endRow; ++row) {
        const float* rgba = static_cast<const float*>(color.pixels) +
                            static_cast<size_t>(height - 1 - row) * width * color.components;
        for (int x = 0; x < width; ++x, rgba += color.components) {
            const float alpha = channelCount == 4 ? rgba[3] : 1;
            for (int c = 0; c < channelCount; ++c) {
                const float v = c < 3 && alpha > 0 ? rgba[c] / alpha : rgba[c];
                *value++ = v > 0 ? std::min(v, 1.0f) : 0;  // NaN gives 0
            }
        }
    }
}

/// What is wrong with a plane, or an empty string.
std::string CheckPlane(const ImagePlane& plane) {
    if (plane.name.empty() || !plane.pixels) {
        return "a plane has no name or no pixels";
    }
    if (plane.components < 1 || plane.components > 4) {
        return "plane '" + plane.name + "' has " + std::to_string(plane.components) + " components";
    }
    return {};
}

std::string CheckPlanes(int width, int height, const std::vector<ImagePlane>& planes) {
    if (width < 1 || height < 1) {
        return "the picture has no pixels";
    }
    if (planes.empty()) {
        return "there is nothing to write";
    }
    std::set<std::string> names;
    for (const ImagePlane& plane : planes) {
        const std::string error = CheckPlane(plane);
        if (!error.empty()) {
            return error;
        }
        if (!names.insert(plane.name).second) {
            return "two planes are named '" + plane.name + "'";
        }
    }
    return {};
}

void AddHeader(const ImageHeader& header, OIIO::ImageSpec* spec) {
    if (header.fullWidth > 0 && header.fullHeight > 0) {
        spec->x = header.x;
        spec->y = header.y;
        spec->full_width = header.fullWidth;
        spec->full_height = header.fullHeight;
    }
    spec->attribute("PixelAspectRatio", header.pixelAspect);
    for (const auto& [name, text] : header.texts) {
        spec->attribute(name, text);
    }
    for (const auto& [name, number] : header.numbers) {
        spec->attribute(name, static_cast<float>(number));
    }
    for (const auto& [name, matrix] : header.matrices) {
        spec->attribute(name, OIIO::TypeMatrix, matrix.data());
    }
    spec->attribute("Software", "hdCC");
    // Left out, it is the time of day, and no two files are alike.
    spec->attribute("DateTime", "");
}

OIIO::ImageSpec MakeExrSpec(int width, int height, const std::vector<Channel>& channels,
                            const ImageHeader& header) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeFloat);
    spec.channelnames.clear();
    for (const Channel& channel : channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(channel.isHalf ? OIIO::TypeHalf : OIIO::TypeFloat);
    }
    spec.alpha_channel = -1;
    for (size_t c = 0; c < channels.size(); ++c) {
        if (channels[c].name == "A") {
            spec.alpha_channel = static_cast<int>(c);
        }
    }
    spec.attribute("compression", "zip");
    AddHeader(header, &spec);
    return spec;
}

OIIO::ImageSpec MakeDisplaySpec(int width, int height, int channelCount) {
    OIIO::ImageSpec spec(width, height, channelCount, OIIO::TypeUInt8);
    AddHeader({}, &spec);  // these formats have no place for most of it
    // Colours are divided by alpha already.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
}

/// Writes bands of rows, made by pack(beginRow, endRow, &values), to a new file.
template <typename PackRows>
std::string WriteFile(const std::string& path, FileFormat format, const OIIO::ImageSpec& spec,
                      const PackRows& pack) {
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(OpenImageIOName(format));
    if (!output) {
        return OIIO::geterror();
    }
    if (!output->open(path, spec)) {
        return output->geterror();
    }
    std::vector<float> values;
    for (int row = 0; row < spec.height; row += kBandRows) {
        const int endRow = std::min(row + kBandRows, spec.height);
        pack(row, endRow, &values);
        if (!output->write_scanlines(spec.y + row, spec.y + endRow, 0, OIIO::TypeFloat,
                                     values.data())) {
            return output->geterror();
        }
    }
    return output->close() ? std::string() : output->geterror();
}

std::string WriteExr(const std::string& path, int width, int height,
                     const std::vector<ImagePlane>& planes, const ImageHeader& header) {
    const std::vector<Channel> channels = ExrChannels(planes);
    return WriteFile(path, FileFormat::OpenExr, MakeExrSpec(width, height, channels, header),
                     [&](int beginRow, int endRow, std::vector<float>* values) {
                         PackExrRows(channels, width, height, beginRow, endRow, values);
                     });
}

std::string WriteDisplay(const std::string& path, FileFormat format, int width, int height,
                         const std::vector<ImagePlane>& planes) {
    const auto color = std::find_if(planes.begin(), planes.end(), [](const ImagePlane& plane) {
        return (plane.name == "color" || plane.isColor) && !plane.isInteger &&
               plane.components >= 3;
    });
    if (color == planes.end()) {
        return "this format holds colour only, and there is none";
    }
    const int channelCount = format == FileFormat::Jpeg ? 3 : color->components;
    return WriteFile(path, format, MakeDisplaySpec(width, height, channelCount),
                     [&](int beginRow, int endRow, std::vector<float>* values) {
                         PackDisplayRows(*color, channelCount, width, height, beginRow, endRow,
                                         values);
                     });
}

/// A name next to path that no other writer uses.
std::string TemporaryName(const std::string& path) {
    static std::atomic<int> count{0};
    const size_t slash = path.rfind('/');
    const size_t nameBegin = slash == std::string::npos ? 0 : slash + 1;
    return path.substr(0, nameBegin) + ".hdCC-" + std::to_string(getpid()) + "-" +
           std::to_string(count++) + ".partial";
}

}  // namespace

bool IsDisplayFormat(const std::string& path) {
    const FileFormat format = FormatOf(path);
    return format == FileFormat::Png || format == FileFormat::Jpeg || format == FileFormat::Tiff;
}

std::string WriteImage(const std::string& path, int width, int height,
                       const std::vector<ImagePlane>& planes, const ImageHeader& header) {
    const FileFormat format = FormatOf(path);
    if (format == FileFormat::Unknown) {
        return Failure(path, "the file's extension must be exr, png, jpg or tif");
    }
    std::string error = CheckPlanes(width, height, planes);
    if (!error.empty()) {
        return Failure(path, error);
    }
    const std::string temporary = TemporaryName(path);
    error = format == FileFormat::OpenExr ? WriteExr(temporary, width, height, planes, header)
                                          : WriteDisplay(temporary, format, width, height, planes);
    if (error.empty() && std::rename(temporary.c_str(), path.c_str()) != 0) {
        error = std::strerror(errno);
    }
    if (!error.empty()) {
        std::remove(temporary.c_str());
        return Failure(path, error);
    }
    return {};
}

}  // namespace cc
