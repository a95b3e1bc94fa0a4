#ifndef HDCC_RENDER_SETTINGS_H
#define HDCC_RENDER_SETTINGS_H

#include <string>
#include <vector>

#include "core/render/film.h"
#include "core/render/renderer.h"

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// @name The hdcc: render settings
/// @{

/// All of them, with their defaults.
HdRenderSettingDescriptorList HdCCRenderSettingDescriptors();

/// The key of the setting that names a file for HdCCDumpFrame.
TfToken const &HdCCDumpSetting();

/// False for settings that the application alone may set: scenes write no files.
bool HdCCMayBeOfScene(TfToken const &key);

/// True if the key is for us to judge: it begins with "hdcc:".
bool HdCCIsRenderSetting(TfToken const &key);

/// Converts a value to the type of the setting and checks its range. Numbers may come as any
/// number type or as text.
/// Returns an empty string, or one line that names key, value and what is allowed.
std::string HdCCCheckRenderSetting(TfToken const &key, VtValue const &value, VtValue *checked);

/// Checked settings as core wants them.
cc::RenderOptions HdCCRenderOptions(HdRenderDelegate const &delegate);

/// The AOVs that hdcc:aovs names.
std::vector<cc::Aov> HdCCRequestedAovs(HdRenderDelegate const &delegate);

/// Splits a list of AOV names at spaces and commas.
/// Returns an empty string, or one line that names what is no AOV.
std::string HdCCParseAovs(std::string const &names, std::vector<cc::Aov> *aovs);

/// @}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
