#ifndef HDCC_DUMP_H
#define HDCC_DUMP_H

#include <string>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Writes what the core was handed for a frame as text: settings, camera, shapes and lights, in an
/// order of their own. Two scenes whose texts are the same make the same picture.
/// @param path  the file; it is there as a whole or not at all
/// @param scene built
/// Returns an empty string, or one line that says what is wrong.
std::string HdCCDumpFrame(std::string const &path, HdRenderDelegate const &delegate,
                          cc::Scene const &scene, cc::Camera const &camera);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
