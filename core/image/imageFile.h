#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cc {

/// A plane of pixels to write: rows from the bottom up, components interleaved.
struct ImagePlane {
    std::string name;  ///< "color" is no layer: channels R, G, B, A; else the layer's
    int components = 4;
    bool isInteger = false;
    const void* pixels = nullptr;  ///< 32-bit floats, or 32-bit ints if isInteger
    /// EXR keeps what has more than one component as half unless this is set.
    bool isPrecise = false;
    /// Channels are called R, G, B, A in a layer of any name.
    bool isColor = false;
    /// The type of EXR channels, in place of the one that follows from the rest.
    std::optional<bool> isHalf = std::nullopt;
};

/// What a file says of its picture besides pixels.
struct ImageHeader {
    /// Where the picture lies in a larger one, in pixels from the upper left corner of that, and
    /// how large that is; 0 if there is none. EXR keeps it as display and data window.
    int x = 0, y = 0, fullWidth = 0, fullHeight = 0;
    float pixelAspect = 1;
    std::vector<std::pair<std::string, std::string>> texts;
    std::vector<std::pair<std::string, double>> numbers;
    /// For row vectors, row by row; EXR keeps `worldtocamera` and `worldtoscreen` under its own
    /// names.
    std::vector<std::pair<std::string, std::array<float, 16>>> matrices;
};

/// Writes planes to a picture. EXR takes any number of planes as one multi-layer file: floats as
/// half (colour, normals) or float (depths, primvars), ints as float. 8-bit formats (PNG, JPEG,
/// TIFF by extension) take the colour plane alone, which must have been converted for display; JPEG
/// drops its alpha. The file appears under its name only when it is whole.
///
/// EXR channels are named LAYER.CHANNEL, as compositors group them. The layer is the plane's name
/// and none for "color":
///
///     color                  R G B A           half, too large values end at 65504
///     three components       NAME.X .Y .Z      half
///     two or four            NAME.X .Y (.Z .W) half
///     precise, any number    NAME.X (.Y .Z .W) float
///     one other float        NAME.Z            float
///     one int                NAME.X            float: exact to 2^24, and -1 stays -1
///     colour of a layer      NAME.R .G .B (.A) half
///
/// Ids are floats and not EXR's unsigned ints: those have no -1, and readers that convert to
/// float, as idiff does, would scale them to 0..1.
///
/// Returns an empty string, or one line that says what went wrong.
std::string WriteImage(const std::string& path, int width, int height,
                       const std::vector<ImagePlane>& planes, const ImageHeader& header = {});

/// True if the format that the path's extension names holds 8-bit display values.
bool IsDisplayFormat(const std::string& path);

}  // namespace cc
