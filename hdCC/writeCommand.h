#ifndef HDCC_WRITE_COMMAND_H
#define HDCC_WRITE_COMMAND_H

#include <string>

#include "pxr/imaging/hd/command.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

struct HdCCFrame;

/// The renderer command `write`: the last frame to a picture file.
HdCommandDescriptor HdCCWriteCommandDescriptor();

/// Does what the command's arguments say.
/// @param frame  null if there is none
/// Returns an empty string, or one line that says what went wrong.
std::string HdCCWriteFrame(HdCCFrame const *frame, HdCommandArgs const &args);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
