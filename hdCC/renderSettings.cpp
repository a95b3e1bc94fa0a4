#include "hdCC/renderSettings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "pxr/base/tf/fileUtils.h"
#include "pxr/base/tf/pathUtils.h"
#include "pxr/base/tf/staticTokens.h"
#include "pxr/base/tf/stringUtils.h"

PXR_NAMESPACE_OPEN_SCOPE

// clang-format off
TF_DEFINE_PRIVATE_TOKENS(
    _tokens,
    ((tracer, "hdcc:tracer"))
    ((adaptive, "hdcc:adaptive"))
    ((pixelError, "hdcc:pixelError"))
    ((secondaryError, "hdcc:secondaryError"))
    ((alpha, "hdcc:alpha"))
    ((level, "hdcc:level"))
    ((integrator, "hdcc:integrator"))
    ((samples, "hdcc:samples"))
    ((seed, "hdcc:seed"))
    ((threads, "hdcc:threads"))
    ((aovs, "hdcc:aovs"))
    ((dump, "hdcc:dump"))
);
// clang-format on

namespace {

enum class _Kind { Choice, Switch, Integer, Number, Aovs, File };

struct _Setting {
    TfToken key;
    char const *title;
    _Kind kind;
    VtValue defaultValue;
    std::vector<std::string> choices = {};
    double lowest = 0, highest = 0;
};

}  // namespace

/// What hdcc:tracer may be, and what each is to core.
static std::vector<std::pair<std::string, cc::TracerKind>> const &_Tracers() {
    static const std::vector<std::pair<std::string, cc::TracerKind>> tracers{
        {"packet", cc::TracerKind::Packet},
        {"algorithm1", cc::TracerKind::Algorithm1},
        {"single", cc::TracerKind::Single},
        {"tessellated", cc::TracerKind::Tessellated},
    };
    return tracers;
}

static std::vector<std::string> _TracerNames() {
    std::vector<std::string> names;
    for (auto const &tracer : _Tracers()) {
        names.push_back(tracer.first);
    }
    return names;
}

static std::vector<_Setting> const &_Settings() {
    constexpr int kMost = std::numeric_limits<int>::max();
    // Far more than any machine has; the scheduler cannot take tens of thousands.
    constexpr int kMostThreads = 1024;
    static const std::vector<_Setting> settings{
        {_tokens->tracer, "Tracer", _Kind::Choice, VtValue(std::string("packet")), _TracerNames()},
        {_tokens->adaptive, "Adaptive levels", _Kind::Switch, VtValue(true)},
        {_tokens->pixelError,
         "Error of adaptive levels, in pixels",
         _Kind::Number,
         VtValue(0.25f),
         {},
         0.001,
         1000},
        {_tokens->secondaryError,
         "Error of other things in shadows, in pixels (0: as seen)",
         _Kind::Number,
         VtValue(0.0f),
         {},
         0,
         1000},
        {_tokens->alpha,
         "Levels by distance (0: by error)",
         _Kind::Number,
         VtValue(0.0f),
         {},
         0,
         1e9},
        {_tokens->level, "Finest level", _Kind::Integer, VtValue(4), {}, 0, 8},
        {_tokens->integrator,
         "Integrator",
         _Kind::Choice,
         VtValue(std::string("raycast")),
         {"raycast"}},
        {_tokens->samples, "Samples per pixel", _Kind::Integer, VtValue(16), {}, 1, kMost},
        {_tokens->seed,
         "Seed",
         _Kind::Integer,
         VtValue(0),
         {},
         std::numeric_limits<int>::min(),
         kMost},
        {_tokens->threads, "Threads (0: all)", _Kind::Integer, VtValue(0), {}, 0, kMostThreads},
        {_tokens->aovs, "AOVs to keep", _Kind::Aovs, VtValue(std::string())},
        {_tokens->dump, "Write the scene as text to", _Kind::File, VtValue(std::string())},
    };
    return settings;
}

HdRenderSettingDescriptorList HdCCRenderSettingDescriptors() {
    HdRenderSettingDescriptorList descriptors;
    for (_Setting const &setting : _Settings()) {
        descriptors.push_back({setting.title, setting.key, setting.defaultValue});
    }
    return descriptors;
}

TfToken const &HdCCDumpSetting() { return _tokens->dump; }

bool HdCCMayBeOfScene(TfToken const &key) { return key != _tokens->dump; }

bool HdCCIsRenderSetting(TfToken const &key) {
    return TfStringStartsWith(key.GetString(), "hdcc:");
}

static std::string _AllowedText(_Setting const &setting) {
    if (setting.kind == _Kind::Choice) {
        return TfStringJoin(setting.choices, ", ");
    }
    if (setting.kind == _Kind::Aovs) {
        return "names of AOVs, separated by spaces or commas";
    }
    if (setting.kind == _Kind::Switch) {
        return "true or false";
    }
    if (setting.kind == _Kind::File) {
        return "a file in a folder that is there";
    }
    char const *kind = setting.kind == _Kind::Integer ? "an integer" : "a number";
    const std::string lowest = TfStringPrintf("%s from %.10g", kind, setting.lowest);
    return setting.highest == std::numeric_limits<int>::max()
               ? lowest + " up"
               : lowest + TfStringPrintf(" to %.10g", setting.highest);
}

static bool _ToText(VtValue const &value, std::string *text) {
    if (value.IsHolding<std::string>()) {
        *text = value.UncheckedGet<std::string>();
    } else if (value.IsHolding<TfToken>()) {
        *text = value.UncheckedGet<TfToken>().GetString();
    } else {
        return false;
    }
    return true;
}

/// Reads a number, whatever its type; text must be nothing but a number.
static bool _ToNumber(VtValue const &value, double *number) {
    std::string text;
    if (_ToText(value, &text)) {
        char *end = nullptr;
        *number = std::strtod(text.c_str(), &end);
        return !text.empty() && *end == '\0';
    }
    if (value.IsHolding<bool>() || !value.CanCast<double>()) {
        return false;
    }
    *number = VtValue::Cast<double>(value).GetWithDefault(std::nan(""));
    return true;
}

/// Reads true or false, 1 or 0, or text that says one of these.
static bool _ToSwitch(VtValue const &value, bool *isOn) {
    std::string text;
    double number = 0;
    if (value.IsHolding<bool>()) {
        *isOn = value.UncheckedGet<bool>();
        return true;
    }
    if (_ToText(value, &text) && (text == "true" || text == "false")) {
        *isOn = text == "true";
        return true;
    }
    *isOn = _ToNumber(value, &number) && number == 1;
    return *isOn || (_ToNumber(value, &number) && number == 0);
}

static bool _Check(_Setting const &setting, VtValue const &value, VtValue *checked) {
    if (setting.kind == _Kind::Integer) {
        double number = 0;
        if (!_ToNumber(value, &number) || std::floor(number) != number || number < setting.lowest ||
            number > setting.highest) {
            return false;
        }
        *checked = VtValue(int(number));
        return true;
    }
    if (setting.kind == _Kind::Number) {
        double number = 0;
        if (!_ToNumber(value, &number) ||
            !(number >= setting.lowest && number <= setting.highest)) {
            return false;
        }
        *checked = VtValue(float(number));
        return true;
    }
    if (setting.kind == _Kind::Switch) {
        bool isOn = false;
        if (!_ToSwitch(value, &isOn)) {
            return false;
        }
        *checked = VtValue(isOn);
        return true;
    }
    std::string text;
    if (!_ToText(value, &text)) {
        return false;
    }
    *checked = VtValue(text);
    if (setting.kind == _Kind::File) {
        return text.empty() || TfIsDir(TfGetPathName(TfAbsPath(text)), /* resolveSymlinks */ true);
    }
    std::vector<cc::Aov> aovs;
    return setting.kind == _Kind::Aovs
               ? HdCCParseAovs(text, &aovs).empty()
               : std::count(setting.choices.begin(), setting.choices.end(), text) > 0;
}

std::string HdCCCheckRenderSetting(TfToken const &key, VtValue const &value, VtValue *checked) {
    std::vector<std::string> keys;
    for (_Setting const &setting : _Settings()) {
        if (setting.key == key) {
            return _Check(setting, value, checked)
                       ? std::string()
                       : TfStringPrintf("render setting %s cannot be '%s'; allowed: %s",
                                        key.GetText(), TfStringify(value).c_str(),
                                        _AllowedText(setting).c_str());
        }
        keys.push_back(setting.key.GetString());
    }
    return TfStringPrintf("there is no render setting %s (set to '%s'); there are: %s",
                          key.GetText(), TfStringify(value).c_str(),
                          TfStringJoin(keys, ", ").c_str());
}

cc::RenderOptions HdCCRenderOptions(HdRenderDelegate const &delegate) {
    cc::RenderOptions options;
    const std::string tracer = delegate.GetRenderSetting(_tokens->tracer, std::string());
    for (auto const &known : _Tracers()) {
        if (known.first == tracer) {
            options.tracer = known.second;
        }
    }
    options.integrator = cc::IntegratorKind::Raycast;
    options.adaptive = delegate.GetRenderSetting(_tokens->adaptive, options.adaptive);
    options.pixelError = delegate.GetRenderSetting(_tokens->pixelError, options.pixelError);
    options.secondaryError =
        delegate.GetRenderSetting(_tokens->secondaryError, options.secondaryError);
    options.alpha = delegate.GetRenderSetting(_tokens->alpha, options.alpha);
    options.level = delegate.GetRenderSetting(_tokens->level, options.level);
    options.samples = delegate.GetRenderSetting(_tokens->samples, options.samples);
    options.seed = delegate.GetRenderSetting(_tokens->seed, options.seed);
    options.threads = delegate.GetRenderSetting(_tokens->threads, options.threads);
    return options;
}

std::vector<cc::Aov> HdCCRequestedAovs(HdRenderDelegate const &delegate) {
    std::vector<cc::Aov> aovs;
    HdCCParseAovs(delegate.GetRenderSetting(_tokens->aovs, std::string()), &aovs);
    return aovs;
}

std::string HdCCParseAovs(std::string const &names, std::vector<cc::Aov> *aovs) {
    aovs->clear();
    for (std::string const &name : TfStringTokenize(names, " ,\t\n")) {
        cc::Aov aov;
        if (!cc::AovFromName(name, &aov)) {
            return TfStringPrintf("there is no AOV '%s'", name.c_str());
        }
        if (std::count(aovs->begin(), aovs->end(), aov) == 0) {
            aovs->push_back(aov);
        }
    }
    return std::string();
}

PXR_NAMESPACE_CLOSE_SCOPE
