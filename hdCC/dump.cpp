#include "hdCC/dump.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "core/scene/sceneText.h"

#include "pxr/base/tf/stringUtils.h"

#include "hdCC/renderSettings.h"

PXR_NAMESPACE_OPEN_SCOPE

static void _WriteSettings(HdRenderDelegate const &delegate, cc::TextWriter *out) {
    HdRenderSettingDescriptorList settings = delegate.GetRenderSettingDescriptors();
    std::sort(settings.begin(), settings.end(),
              [](auto const &a, auto const &b) { return a.key.GetString() < b.key.GetString(); });
    out->Begin("settings");
    for (HdRenderSettingDescriptor const &setting : settings) {
        if (setting.key != HdCCDumpSetting()) {
            out->Write(setting.key.GetString(),
                       TfStringify(delegate.GetRenderSetting(setting.key)));
        }
    }
    out->End();
}

std::string HdCCDumpFrame(std::string const &path, HdRenderDelegate const &delegate,
                          cc::Scene const &scene, cc::Camera const &camera) {
    const std::string temporary = path + ".partial";
    std::ofstream file(temporary);
    cc::TextWriter out(&file);
    _WriteSettings(delegate, &out);
    cc::WriteText(camera, &out);
    cc::WriteText(scene, &out);
    file.close();
    if (file && std::rename(temporary.c_str(), path.c_str()) == 0) {
        return std::string();
    }
    const int reason = errno;
    std::remove(temporary.c_str());
    return TfStringPrintf("%s: the dump cannot be written: %s", path.c_str(),
                          std::strerror(reason));
}

PXR_NAMESPACE_CLOSE_SCOPE
