// What shapes were handed, as text: in the form that Build has brought it into, mended and
// complete, so that the same scene makes the same text whatever the edits that led to it.

#include "core/scene/curves.h"
#include "core/scene/mesh.h"
#include "core/scene/points.h"
#include "core/scene/textWriter.h"

namespace cc {
namespace {

const char* NameOf(Interpolation interpolation) {
    switch (interpolation) {
        case Interpolation::Uniform: return "uniform";
        case Interpolation::Varying: return "varying";
        case Interpolation::Vertex: return "vertex";
        case Interpolation::FaceVarying: return "faceVarying";
        case Interpolation::Instance: return "instance";
        case Interpolation::Constant: break;
    }
    return "constant";
}

const char* NameOf(CulledSide side) {
    switch (side) {
        case CulledSide::Back: return "back";
        case CulledSide::Front: return "front";
        case CulledSide::None: break;
    }
    return "none";
}

const char* NameOf(Scheme scheme) {
    switch (scheme) {
        case Scheme::Bilinear: return "bilinear";
        case Scheme::None: return "none";
        case Scheme::Loop: return "loop";
        case Scheme::CatmullClark: break;
    }
    return "catmullClark";
}

const char* NameOf(BoundaryRule rule) {
    switch (rule) {
        case BoundaryRule::None: return "none";
        case BoundaryRule::EdgeOnly: return "edgeOnly";
        case BoundaryRule::EdgeAndCorner: break;
    }
    return "edgeAndCorner";
}

const char* NameOf(FaceVaryingRule rule) {
    switch (rule) {
        case FaceVaryingRule::None: return "none";
        case FaceVaryingRule::CornersOnly: return "cornersOnly";
        case FaceVaryingRule::CornersPlus2: return "cornersPlus2";
        case FaceVaryingRule::Boundaries: return "boundaries";
        case FaceVaryingRule::All: return "all";
        case FaceVaryingRule::CornersPlus1: break;
    }
    return "cornersPlus1";
}

const char* NameOf(CurveBasis basis) {
    switch (basis) {
        case CurveBasis::Bezier: return "bezier";
        case CurveBasis::BSpline: return "bspline";
        case CurveBasis::CatmullRom: return "catmullRom";
        case CurveBasis::Linear: break;
    }
    return "linear";
}

const char* NameOf(CurveWrap wrap) {
    switch (wrap) {
        case CurveWrap::Periodic: return "periodic";
        case CurveWrap::Pinned: return "pinned";
        case CurveWrap::Nonperiodic: break;
    }
    return "nonperiodic";
}

std::string OrDash(const std::string& text) { return text.empty() ? "-" : text; }

void WritePrimvar(const std::string& name, const Primvar& primvar, TextWriter* out) {
    if (primvar.IsEmpty()) {
        return;
    }
    out->Begin(name + " " + NameOf(primvar.interpolation));
    out->Write("values", primvar.values, primvar.arity);
    out->Write("indices", primvar.indices);
    out->End();
}

void WriteTags(const ControlMesh& mesh, TextWriter* out) {
    out->Write("subdivisionScheme", NameOf(mesh.scheme));
    out->Write("interpolateBoundary", NameOf(mesh.boundaryRule));
    out->Write("faceVaryingLinearInterpolation", NameOf(mesh.faceVaryingRule));
    out->Write("triangleSubdivisionRule",
               mesh.triangleRule == TriangleRule::Smooth ? "smooth" : "catmullClark");
    out->Write("creaseMethod", mesh.creaseRule == CreaseRule::Chaikin ? "chaikin" : "uniform");
    out->Write("orientation", mesh.leftHanded ? "leftHanded" : "rightHanded");
    out->Write("holeIndices", mesh.holeIndices);
    out->Write("creaseIndices", mesh.creaseIndices);
    out->Write("creaseLengths", mesh.creaseLengths);
    out->Write("creaseSharpnesses", mesh.creaseSharpnesses);
    out->Write("cornerIndices", mesh.cornerIndices);
    out->Write("cornerSharpnesses", mesh.cornerSharpnesses);
}

}  // namespace

void Shape::WriteText(bool isShown, TextWriter* out) const {
    out->Begin(std::string(_KindName()) + " <" + _name + ">");
    out->Write("renderTag", _renderTag);
    if (!isShown) {
        out->Write("shown", false);
        out->End();
        return;
    }
    out->Write("material", OrDash(_material));
    for (const FaceSubset& subset : _subsets) {
        out->Begin("subset " + subset.material);
        out->Write("faces", subset.faces);
        out->End();
    }
    out->Write("transform", _placement.Transform());
    if (const auto* const instances = _placement.Instances()) {
        out->Write("instances", *instances);
    }
    _WriteOwnText(out);
    for (const auto& [name, slot] : _primvars) {
        if (slot.field.IsEmpty()) {
            out->Write("primvars:" + name, "is left out");
        } else {
            WritePrimvar("primvars:" + name, slot.field.CopyPrimvar(), out);
        }
    }
    out->End();
}

void Mesh::_WriteOwnText(TextWriter* out) const {
    ControlMesh mesh = _tags;
    _faces.CopyTo(&mesh.faceVertexCounts, &mesh.faceVertexIndices);
    WriteTags(mesh, out);
    out->Write("culledSide", NameOf(_culled));
    out->Write("faceVertexCounts", mesh.faceVertexCounts);
    out->Write("faceVertexIndices", mesh.faceVertexIndices);
    // Points that no face uses come and go.
    const auto used = static_cast<std::ptrdiff_t>(_usedPointCount);
    MovingPoints points(_surface->PatchPoints());
    if (_motion.IsMoving()) {
        points = _motion;
    }
    for (std::vector<Vec3f>& pose : points.Poses()) {
        pose.erase(pose.begin() + used, pose.end());
    }
    out->Write("points", points);
}

void Points::_WriteOwnText(TextWriter* out) const {
    MovingPoints points = _motion;
    for (uint32_t i = 0; !_motion.IsMoving() && i < _spheres->PrimitiveCount(); ++i) {
        points.Poses().front().push_back(_spheres->At(i).center);
    }
    out->Write("points", points);
    WritePrimvar("widths", _widths, out);
}

void Curves::_WriteOwnText(TextWriter* out) const {
    out->Write("basis", NameOf(_topology.basis));
    out->Write("wrap", NameOf(_topology.wrap));
    out->Write("curveVertexCounts", _topology.vertexCounts);
    out->Write("points", _motion.IsMoving() ? _motion : MovingPoints(_points));
    WritePrimvar("widths", _widths, out);
    WritePrimvar("normals", _normals, out);
}

}  // namespace cc
