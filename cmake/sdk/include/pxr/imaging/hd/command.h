#ifndef PXR_IMAGING_HD_COMMAND_H
#define PXR_IMAGING_HD_COMMAND_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/pxr.h"

#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

/// One named argument of a command, and its type by way of its default.
struct HdCommandArgDescriptor {
    HdCommandArgDescriptor(TfToken const &argName_, VtValue const &defaultValue_)
        : argName(argName_), defaultValue(defaultValue_) {}

    TfToken const argName;
    VtValue const defaultValue;
};

using HdCommandArgDescriptors = std::vector<HdCommandArgDescriptor>;
using HdCommandArgs = VtDictionary;

/// An action that a render delegate offers to the application, such as 'clear statistics'.
struct HdCommandDescriptor {
    explicit HdCommandDescriptor(TfToken const &name, std::string const &description = {},
                                 HdCommandArgDescriptors const &args = {})
        : commandName(name), commandDescription(description), commandArgs(args) {}

    TfToken const commandName;
    std::string const commandDescription;
    HdCommandArgDescriptors const commandArgs;
};

using HdCommandDescriptors = std::vector<HdCommandDescriptor>;

PXR_NAMESPACE_CLOSE_SCOPE

#endif
