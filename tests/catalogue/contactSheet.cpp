#include "tests/catalogue/contactSheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/math/box.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/catalogue/labelFont.h"
#include "tests/catalogue/sheetCages.h"
#include "tests/catalogue/usdText.h"
#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

// In dots of the labels, which are pixels of a picture that is as wide as the sheet.
constexpr int kColumnCount = 8;
constexpr int kCellWidth = 128, kCellHeight = 140;
constexpr float kShapeWidth = 116, kShapeHeight = 102;
/// From the top of a cell to the middle of its shape, and to the top of its label.
constexpr float kShapeMiddle = 56, kLabelTop = 111;
constexpr int kLabelLetters = kCellWidth / kLetterColumns - 1;
/// Units of the scene a dot: a power of two, so that dots are exact.
constexpr float kDot = 0.0625f;
/// Cells stand on a plane that faces the light, so that none shades another; an orthographic camera
/// shows them side by side. How far they come forward along x and y:
constexpr float kForwardByX = 0.7f, kForwardByY = -0.855f;
/// How far a label stands behind its cage, to be out of its shadow and of that of the next.
constexpr float kLabelBehind = 17;
/// How all cages are seen: turned a little, then from above.
constexpr float kSpin = 22, kTilt = -52;
constexpr float kRadians = 0.0174532925f;

const Vec3f kLabelColor{1, 1, 1};

/// Of a cage that shows its point from below.
constexpr float kTiltFromBelow = 230;
/// Thin surfaces are stretched along z towards this share of their width, but not by more than
/// kMostStretch: else creases in them could not be told.
constexpr float kLeastThickness = 0.3f, kMostStretch = 2;

/// A point as a place shows it, apart from the move.
Vec3f Shown(const SheetPlace& place, const Vec3f& point) {
    const float cz = std::cos(place.spin * kRadians), sz = std::sin(place.spin * kRadians);
    const float cx = std::cos(place.tilt * kRadians), sx = std::sin(place.tilt * kRadians);
    const Vec3f p = point * place.scale;
    const float x = cz * p.x - sz * p.y, y = sz * p.x + cz * p.y;
    return {x, cx * y - sx * p.z, sx * y + cx * p.z};
}

/// Points all over the limit surface of a cage.
std::vector<Vec3f> SurfacePoints(const Cage& cage, std::string* error) {
    ControlMesh mesh = cage.mesh;
    *error = ValidateControlMesh(&mesh, cage.points.size()).error;
    if (!error->empty()) {
        return {};
    }
    std::vector<Vec3f> found;
    const PatchTable patches = BuildPatchTable(mesh, cage.points.size(), error);
    const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
    constexpr int kSteps = 8;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= (patches.IsTriangle(patch) ? kSteps - i : kSteps); ++j) {
                const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps;
                found.push_back(EvaluateLimitValue(patches, patch, points.data(), u, v));
            }
        }
    }
    return found;
}

/// Three significant digits do, and stay the same when the last bits of a surface do not.
float Rounded(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return std::strtof(text, nullptr);
}

/// Puts the middle of what is seen of a surface at a point, as large as a cell allows.
SheetPlace Fitted(const std::vector<Vec3f>& surface, bool isFromBelow, const Vec3f& middle) {
    Box3f box;
    for (const Vec3f& point : surface) {
        box.Extend(point);
    }
    const float width = std::max(box.Size().x, box.Size().y);
    const float stretch = std::clamp(kLeastThickness * width / box.Size().z, 1.0f, kMostStretch);
    SheetPlace place;
    place.spin = kSpin;
    place.tilt = isFromBelow ? kTiltFromBelow : kTilt;
    place.scale = {1, 1, Rounded(stretch)};
    Box3f shown;
    for (const Vec3f& point : surface) {
        shown.Extend(Shown(place, point));
    }
    const Vec3f size = shown.Size();
    const float scale = kDot * std::min(kShapeWidth / size.x, kShapeHeight / size.y);
    place.scale = {Rounded(scale), Rounded(scale), Rounded(scale * stretch)};
    const Vec3f move = middle - shown.Center() * scale;
    place.move = {std::round(move.x * 100) / 100, std::round(move.y * 100) / 100,
                  std::round(move.z * 100) / 100};
    return place;
}

/// A text as polygons in the plane z = 0, in dots, centred below the origin.
Cage LabelOf(const std::string& text) {
    Cage label;
    label.mesh.scheme = Scheme::None;
    const std::vector<std::string> lines = BreakLines(text, kLabelLetters);
    for (size_t line = 0; line < lines.size(); ++line) {
        const int width = static_cast<int>(lines[line].size()) * kLetterColumns - 1;
        for (size_t letter = 0; letter < lines[line].size(); ++letter) {
            const int left = static_cast<int>(letter) * kLetterColumns - width / 2;
            const int top = -static_cast<int>(line) * kLineRows;
            for (const LetterStroke& stroke : StrokesOf(lines[line][letter])) {
                const auto x = static_cast<float>(left + stroke.column);
                const auto y = static_cast<float>(top - stroke.row);
                const auto right = x + static_cast<float>(stroke.columns);
                const auto bottom = y - static_cast<float>(stroke.rows);
                const int first = static_cast<int>(label.points.size());
                AddFace(&label, {first, first + 1, first + 2, first + 3});
                label.points.insert(label.points.end(),
                                    {{x, bottom, 0}, {right, bottom, 0}, {right, y, 0}, {x, y, 0}});
            }
        }
    }
    return label;
}

std::string Header(int rowCount) {
    const float width = kDot * kCellWidth * kColumnCount;
    const float height = kDot * kCellHeight * static_cast<float>(rowCount);
    return R"(#usda 1.0
(
    defaultPrim = "World"
    doc = """The catalogue's contact sheet: cages that the unit tests compare with OpenSubdiv, each with its
name below and its faces in three shades by turns; thin ones are stretched along z. Colours are themes: shapes, boundaries, creases,
creases that meet, corners, non-manifold, holes and several tags, loop, bilinear and polygons.
Written by tests/catalogue/contact_sheet.py; docs/testing.md shows the picture."""
    metersPerUnit = 0.01
    upAxis = "Y"
)

def Xform "World"
{
    def Camera "Camera"
    {
        float2 clippingRange = (0.1, 1000)
        float horizontalAperture = )" +
           ToText(10 * width) + R"(
        float verticalAperture = )" +
           ToText(10 * height) + R"(
        token projection = "orthographic"
        double3 xformOp:translate = ()" +
           ToText(width / 2) + ", " + ToText(-height / 2) + R"(, 250)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }

    def DistantLight "Key"
    {
        float inputs:angle = 0.53
        float inputs:intensity = 2
        bool inputs:normalize = 1
        float3 xformOp:rotateXYZ = (-35, -35, 0)
        uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
    }
)";
}

/// The prims of one cell: the cage and its label.
std::string Cell(const Cage& cage, int index, const Vec3f& color, std::string* error) {
    const auto left = static_cast<float>(index % kColumnCount * kCellWidth);
    const auto top = static_cast<float>(-(index / kColumnCount) * kCellHeight);
    const float middle = left + kCellWidth * 0.5f;
    const float forward = kForwardByX * middle + kForwardByY * top;
    const std::vector<Vec3f> surface = SurfacePoints(cage, error);
    if (surface.empty()) {
        *error = cage.name + ": " + (error->empty() ? "has no surface" : *error);
        return "";
    }
    const SheetPlace place =
        Fitted(surface, IsSeenFromBelow(cage), Vec3f{middle, top - kShapeMiddle, forward} * kDot);
    SheetPlace labelPlace;
    labelPlace.move = Vec3f{middle, top - kLabelTop, forward - kLabelBehind} * kDot;
    labelPlace.scale = {kDot, kDot, kDot};
    const std::string prim = PrimName(cage.name);
    return "\n" + MeshPrim(cage, prim, place, color, "    ") + "\n" +
           MeshPrim(LabelOf(cage.name), prim + "_label", labelPlace, kLabelColor, "    ");
}

}  // namespace

std::string ContactSheet(std::string* error) {
    error->clear();
    const std::vector<SheetTheme> themes = SheetThemes(error);
    std::string cells;
    int count = 0;
    for (const SheetTheme& theme : themes) {
        for (const Cage& cage : theme.cages) {
            if (!error->empty()) {
                return "";
            }
            cells += Cell(cage, count++, theme.color, error);
        }
    }
    return Header((count + kColumnCount - 1) / kColumnCount) + cells + "}\n";
}

}  // namespace cc::test
