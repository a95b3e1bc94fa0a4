#ifndef HDCC_PICK_COMMAND_H
#define HDCC_PICK_COMMAND_H

#include <string>

#include "pxr/imaging/hd/command.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCRenderParam;

/// What the renderer command "pick" takes.
HdCommandDescriptor HdCCPickCommandDescriptor();

/// Looks up what a pixel of the last frame shows, and hands it to SetPicked: the prim's path in
/// Hydra, the instance, the authored element and the distance along the view axis; nothing where
/// nothing is seen.
/// Returns an empty string, or one line that says what is wrong.
std::string HdCCPick(HdCCRenderParam *param, HdCommandArgs const &args);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
