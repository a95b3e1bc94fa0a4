#include "tests/catalogue/usdText.h"

#include <cctype>
#include <cstdio>
#include <cstdlib>

#include "core/math/box.h"

namespace cc::test {
namespace {

/// Brightness of one face, the next and the one after that.
constexpr float kShades[] = {1, 0.78f, 0.6f};

std::string Text(int value) { return std::to_string(value); }
std::string Text(float value) { return ToText(value); }

std::string Text(const Vec3f& value) {
    return "(" + Text(value.x) + ", " + Text(value.y) + ", " + Text(value.z) + ")";
}

template <typename Value>
std::string Text(const std::vector<Value>& values) {
    std::string text = "[";
    for (const Value& value : values) {
        text += (text.size() > 1 ? ", " : "") + Text(value);
    }
    return text + "]";
}

std::string Quoted(const std::string& token) { return '"' + token + '"'; }

const char* Token(Scheme scheme) {
    switch (scheme) {
        case Scheme::CatmullClark: return "catmullClark";
        case Scheme::Bilinear: return "bilinear";
        case Scheme::None: return "none";
        case Scheme::Loop: return "loop";
    }
    return "";
}

const char* Token(BoundaryRule rule) {
    switch (rule) {
        case BoundaryRule::None: return "none";
        case BoundaryRule::EdgeOnly: return "edgeOnly";
        case BoundaryRule::EdgeAndCorner: return "edgeAndCorner";
    }
    return "";
}

const char* Token(TriangleRule rule) {
    return rule == TriangleRule::Smooth ? "smooth" : "catmullClark";
}

const char* Token(FaceVaryingRule rule) {
    switch (rule) {
        case FaceVaryingRule::None: return "none";
        case FaceVaryingRule::CornersOnly: return "cornersOnly";
        case FaceVaryingRule::CornersPlus1: return "cornersPlus1";
        case FaceVaryingRule::CornersPlus2: return "cornersPlus2";
        case FaceVaryingRule::Boundaries: return "boundaries";
        case FaceVaryingRule::All: return "all";
    }
    return "";
}

/// The text of one prim, attribute by attribute.
class PrimText {
  public:
    explicit PrimText(const std::string& indentation) : _indentation(indentation) {}

    void Set(const std::string& attribute, const std::string& value) {
        _lines += _indentation + attribute + " = " + value + "\n";
    }
    template <typename Value>
    void SetUnlessEmpty(const std::string& attribute, const std::vector<Value>& values) {
        if (!values.empty()) {
            Set(attribute, Text(values));
        }
    }
    const std::string& Lines() const { return _lines; }

  private:
    std::string _indentation, _lines;
};

void SetTags(const ControlMesh& mesh, PrimText* prim) {
    prim->Set("uniform token subdivisionScheme", Quoted(Token(mesh.scheme)));
    prim->Set("uniform token interpolateBoundary", Quoted(Token(mesh.boundaryRule)));
    prim->Set("uniform token faceVaryingLinearInterpolation", Quoted(Token(mesh.faceVaryingRule)));
    prim->Set("uniform token triangleSubdivisionRule", Quoted(Token(mesh.triangleRule)));
    prim->Set("uniform token orientation", Quoted(mesh.leftHanded ? "leftHanded" : "rightHanded"));
    prim->SetUnlessEmpty("int[] holeIndices", mesh.holeIndices);
    prim->SetUnlessEmpty("int[] creaseIndices", mesh.creaseIndices);
    prim->SetUnlessEmpty("int[] creaseLengths", mesh.creaseLengths);
    prim->SetUnlessEmpty("float[] creaseSharpnesses", mesh.creaseSharpnesses);
    prim->SetUnlessEmpty("int[] cornerIndices", mesh.cornerIndices);
    prim->SetUnlessEmpty("float[] cornerSharpnesses", mesh.cornerSharpnesses);
}

void SetShape(const Cage& cage, PrimText* prim) {
    Box3f box;
    for (const Vec3f& point : cage.points) {
        box.Extend(point);
    }
    prim->Set("float3[] extent", Text(std::vector<Vec3f>{box.lower, box.upper}));
    prim->Set("int[] faceVertexCounts", Text(cage.mesh.faceVertexCounts));
    prim->Set("int[] faceVertexIndices", Text(cage.mesh.faceVertexIndices));
    prim->Set("point3f[] points", Text(cage.points));
}

void SetColor(int faceCount, const Vec3f& color, const std::string& indentation, PrimText* prim) {
    std::vector<Vec3f> shades;
    for (float shade : kShades) {
        shades.push_back(color * shade);
    }
    std::vector<int> indices;
    for (int face = 0; face < faceCount; ++face) {
        indices.push_back(face % static_cast<int>(shades.size()));
    }
    prim->Set("color3f[] primvars:displayColor", Text(shades) + " (\n" + indentation +
                                                     "    interpolation = \"uniform\"\n" +
                                                     indentation + ")");
    prim->Set("int[] primvars:displayColor:indices", Text(indices));
}

void SetPlace(const SheetPlace& place, PrimText* prim) {
    prim->Set("double3 xformOp:translate", Text(place.move));
    prim->Set("float3 xformOp:rotateZYX", Text(Vec3f{place.tilt, 0, place.spin}));
    prim->Set("float3 xformOp:scale", Text(place.scale));
    prim->Set("uniform token[] xformOpOrder",
              "[\"xformOp:translate\", \"xformOp:rotateZYX\", \"xformOp:scale\"]");
}

}  // namespace

std::string ToText(float value) {
    char text[32];
    for (int digits = 3; digits <= 9; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtof(text, nullptr) == value) {
            break;
        }
    }
    return text;
}

std::string PrimName(const std::string& name) {
    std::string prim;
    for (char c : name) {
        prim += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    return prim;
}

std::string MeshPrim(const Cage& cage, const std::string& prim, const SheetPlace& place,
                     const Vec3f& color, const std::string& indentation) {
    PrimText attributes(indentation + "    ");
    SetShape(cage, &attributes);
    SetTags(cage.mesh, &attributes);
    SetColor(cage.mesh.FaceCount(), color, indentation + "    ", &attributes);
    attributes.Set("uniform bool doubleSided", "1");
    SetPlace(place, &attributes);
    return indentation + "def Mesh \"" + prim + "\"\n" + indentation + "{\n" + attributes.Lines() +
           indentation + "}\n";
}

}  // namespace cc::test
