#ifndef HDCC_CONVERT_H
#define HDCC_CONVERT_H

#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/math/vec.h"
#include "core/scene/camera.h"
#include "core/subdiv/controlMesh.h"

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/meshTopology.h"
#include "pxr/imaging/pxOsd/subdivTags.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// @name Between USD's types and core's
/// @{

inline cc::Vec3f HdCCToVec3f(GfVec3f const &v) { return {v[0], v[1], v[2]}; }

/// The affine part of a matrix that is applied to row vectors.
cc::AffineTransform HdCCToTransform(GfMatrix4d const &m);

/// Reads three-component vectors of any precision, one or an array of them.
/// Returns false if the value holds anything else; an empty value gives an empty list.
bool HdCCToVec3fs(VtValue const &value, std::vector<cc::Vec3f> *result);

/// Reads numbers, or vectors of two to four of them, of any precision, one or an array of them.
/// @param arity    set to the numbers a value
/// @param numbers  set to the numbers of all values, one value after the other
/// Returns false if the value holds anything else; an empty value gives no numbers.
bool HdCCToNumbers(VtValue const &value, int *arity, std::vector<float> *numbers);

/// @param warnings  gets a line for each rule that does not exist; the usual one is taken
/// Returns false if the renderer knows no such scheme.
bool HdCCToControlMesh(HdMeshTopology const &topology, PxOsdSubdivTags const &tags,
                       cc::ControlMesh *mesh, std::vector<std::string> *warnings);

/// Makes a camera of the matrices that Hydra's pass state gives for the whole picture.
/// Returns false if there is no such camera: a matrix is singular or not finite, or the clipping
/// range is empty.
bool HdCCToCamera(GfMatrix4d const &worldToView, GfMatrix4d const &projection, float clipNear,
                  float clipFar, cc::Camera *camera);

/// @}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
