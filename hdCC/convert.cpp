#include "hdCC/convert.h"

#include <cmath>

#include "pxr/base/gf/half.h"
#include "pxr/base/gf/vec2d.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec2h.h"
#include "pxr/base/gf/vec2i.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/gf/vec3i.h"
#include "pxr/base/gf/vec4d.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/gf/vec4h.h"
#include "pxr/base/gf/vec4i.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/tf/token.h"

PXR_NAMESPACE_OPEN_SCOPE

cc::AffineTransform HdCCToTransform(GfMatrix4d const &m) {
    std::array<std::array<double, 4>, 3> rows;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            rows[row][column] = m[column][row];
        }
    }
    return cc::AffineTransform(rows);
}

template <class Vec>
static bool _AppendIfHeld(VtValue const &value, std::vector<cc::Vec3f> *result) {
    if (value.IsHolding<VtArray<Vec>>()) {
        VtArray<Vec> const &values = value.UncheckedGet<VtArray<Vec>>();
        result->reserve(values.size());
        for (Vec const &v : values) {
            result->push_back(HdCCToVec3f(GfVec3f(v)));
        }
        return true;
    }
    if (value.IsHolding<Vec>()) {
        result->push_back(HdCCToVec3f(GfVec3f(value.UncheckedGet<Vec>())));
        return true;
    }
    return false;
}

bool HdCCToVec3fs(VtValue const &value, std::vector<cc::Vec3f> *result) {
    result->clear();
    return value.IsEmpty() || _AppendIfHeld<GfVec3f>(value, result) ||
           _AppendIfHeld<GfVec3d>(value, result) || _AppendIfHeld<GfVec3h>(value, result);
}

/// @tparam T  a number if kArity is 1, else a vector of Gf
template <int kArity, class T>
static void _AppendNumbers(T const &value, std::vector<float> *numbers) {
    if constexpr (kArity == 1) {
        numbers->push_back(float(value));
    } else {
        for (int i = 0; i < kArity; ++i) {
            numbers->push_back(float(value[i]));
        }
    }
}

template <int kArity, class T>
static bool _ReadIfHeld(VtValue const &value, int *arity, std::vector<float> *numbers) {
    if (value.IsHolding<T>()) {
        _AppendNumbers<kArity>(value.UncheckedGet<T>(), numbers);
    } else if (value.IsHolding<VtArray<T>>()) {
        VtArray<T> const &values = value.UncheckedGet<VtArray<T>>();
        numbers->reserve(values.size() * kArity);
        for (T const &element : values) {
            _AppendNumbers<kArity>(element, numbers);
        }
    } else {
        return false;
    }
    *arity = kArity;
    return true;
}

template <int kArity, class... Types>
static bool _ReadAnyHeld(VtValue const &value, int *arity, std::vector<float> *numbers) {
    return (_ReadIfHeld<kArity, Types>(value, arity, numbers) || ...);
}

bool HdCCToNumbers(VtValue const &value, int *arity, std::vector<float> *numbers) {
    numbers->clear();
    return value.IsEmpty() || _ReadAnyHeld<1, float, double, GfHalf, int>(value, arity, numbers) ||
           _ReadAnyHeld<2, GfVec2f, GfVec2d, GfVec2h, GfVec2i>(value, arity, numbers) ||
           _ReadAnyHeld<3, GfVec3f, GfVec3d, GfVec3h, GfVec3i>(value, arity, numbers) ||
           _ReadAnyHeld<4, GfVec4f, GfVec4d, GfVec4h, GfVec4i>(value, arity, numbers);
}

static bool _ToScheme(TfToken const &token, cc::Scheme *scheme) {
    if (token == "catmullClark") {
        *scheme = cc::Scheme::CatmullClark;
    } else if (token == "loop") {
        *scheme = cc::Scheme::Loop;
    } else if (token == "bilinear") {
        *scheme = cc::Scheme::Bilinear;
    } else if (token == "none" || token.IsEmpty()) {
        *scheme = cc::Scheme::None;
    } else {
        return false;
    }
    return true;
}

/// A rule that a mesh's attribute may name. The first of a list is what holds if none is named.
template <class Rule>
struct _Choice {
    char const *name;
    Rule rule;
};

static constexpr _Choice<cc::BoundaryRule> kBoundaryRules[] = {
    {"edgeAndCorner", cc::BoundaryRule::EdgeAndCorner},
    {"edgeOnly", cc::BoundaryRule::EdgeOnly},
    {"none", cc::BoundaryRule::None},
};
static constexpr _Choice<cc::FaceVaryingRule> kFaceVaryingRules[] = {
    {"cornersPlus1", cc::FaceVaryingRule::CornersPlus1},
    {"none", cc::FaceVaryingRule::None},
    {"cornersOnly", cc::FaceVaryingRule::CornersOnly},
    {"cornersPlus2", cc::FaceVaryingRule::CornersPlus2},
    {"boundaries", cc::FaceVaryingRule::Boundaries},
    {"all", cc::FaceVaryingRule::All},
};
static constexpr _Choice<cc::CreaseRule> kCreaseRules[] = {
    {"uniform", cc::CreaseRule::Uniform},
    {"chaikin", cc::CreaseRule::Chaikin},
};
static constexpr _Choice<cc::TriangleRule> kTriangleRules[] = {
    {"catmullClark", cc::TriangleRule::CatmullClark},
    {"smooth", cc::TriangleRule::Smooth},
};
static constexpr _Choice<bool> kIsLeftHanded[] = {{"rightHanded", false}, {"leftHanded", true}};

/// The rule that a token names. Another token is warned about, but for the empty one.
template <class Rule, size_t kCount>
static Rule _Choose(char const *attribute, TfToken const &token,
                    _Choice<Rule> const (&choices)[kCount], std::vector<std::string> *warnings) {
    for (_Choice<Rule> const &choice : choices) {
        if (token == choice.name) {
            return choice.rule;
        }
    }
    if (!token.IsEmpty()) {
        warnings->push_back(TfStringPrintf("%s cannot be '%s'; %s is used", attribute,
                                           token.GetText(), choices[0].name));
    }
    return choices[0].rule;
}

template <class T>
static std::vector<T> _ToVector(VtArray<T> const &values) {
    return std::vector<T>(values.cbegin(), values.cend());
}

bool HdCCToControlMesh(HdMeshTopology const &topology, PxOsdSubdivTags const &tags,
                       cc::ControlMesh *mesh, std::vector<std::string> *warnings) {
    *mesh = cc::ControlMesh();
    if (!_ToScheme(topology.GetScheme(), &mesh->scheme)) {
        return false;
    }
    mesh->boundaryRule =
        _Choose("interpolateBoundary", tags.GetVertexInterpolationRule(), kBoundaryRules, warnings);
    mesh->creaseRule = _Choose("creaseMethod", tags.GetCreaseMethod(), kCreaseRules, warnings);
    mesh->triangleRule =
        _Choose("triangleSubdivisionRule", tags.GetTriangleSubdivision(), kTriangleRules, warnings);
    mesh->faceVaryingRule =
        _Choose("faceVaryingLinearInterpolation", tags.GetFaceVaryingInterpolationRule(),
                kFaceVaryingRules, warnings);
    mesh->leftHanded = _Choose("orientation", topology.GetOrientation(), kIsLeftHanded, warnings);

    mesh->faceVertexCounts = _ToVector(topology.GetFaceVertexCounts());
    mesh->faceVertexIndices = _ToVector(topology.GetFaceVertexIndices());
    mesh->holeIndices = _ToVector(topology.GetHoleIndices());

    mesh->creaseIndices = _ToVector(tags.GetCreaseIndices());
    mesh->creaseLengths = _ToVector(tags.GetCreaseLengths());
    mesh->creaseSharpnesses = _ToVector(tags.GetCreaseWeights());
    mesh->cornerIndices = _ToVector(tags.GetCornerIndices());
    mesh->cornerSharpnesses = _ToVector(tags.GetCornerWeights());
    return true;
}

/// False for what is not finite, and for what Gf gives as the inverse of a singular matrix.
static bool _IsUsable(GfMatrix4d const &m) {
    for (int i = 0; i < 16; ++i) {
        if (!(std::fabs(m.GetArray()[i]) <= 1e18)) {
            return false;
        }
    }
    return true;
}

bool HdCCToCamera(GfMatrix4d const &worldToView, GfMatrix4d const &projection, float clipNear,
                  float clipFar, cc::Camera *camera) {
    const GfMatrix4d viewToWorld = worldToView.GetInverse();
    if (!_IsUsable(worldToView) || !_IsUsable(viewToWorld) || !_IsUsable(projection) ||
        projection[0][0] == 0 || projection[1][1] == 0 || !(clipNear < clipFar) ||
        !std::isfinite(clipFar)) {
        return false;
    }
    camera->cameraToWorld = HdCCToTransform(viewToWorld);
    camera->orthographic = projection[2][3] == 0;
    // The projection takes (x, y, z) to (x p00 + z p20 + p30) / -z, or over 1 if orthographic:
    // the window is what comes out as -1 and 1 at z = -1.
    for (int axis = 0; axis < 2; ++axis) {
        const double scale = projection[axis][axis];
        const double offset = camera->orthographic ? -projection[3][axis] : projection[2][axis];
        (axis == 0 ? camera->windowLower.x : camera->windowLower.y) = float((offset - 1) / scale);
        (axis == 0 ? camera->windowUpper.x : camera->windowUpper.y) = float((offset + 1) / scale);
    }
    // A perspective camera sees nothing at or behind its eye.
    camera->clipNear = camera->orthographic || clipNear > 0 ? clipNear : 1e-7f * clipFar;
    camera->clipFar = clipFar;
    return camera->clipNear < clipFar && std::isfinite(camera->windowLower.x) &&
           std::isfinite(camera->windowLower.y) && std::isfinite(camera->windowUpper.x) &&
           std::isfinite(camera->windowUpper.y);
}

PXR_NAMESPACE_CLOSE_SCOPE
