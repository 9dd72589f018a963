// The table of built-in uniforms.
#include "scene/builtin.h"

#include <algorithm>
#include <array>
#include <map>

namespace glint {

namespace {

const std::map<std::string_view, HostUniform> kBuiltins = {
    {"iResolution", {"vec3", ""}},    {"iTime", {"float", ""}},
    {"iTimeDelta", {"float", ""}},    {"iFrameRate", {"float", ""}},
    {"iFrame", {"int", ""}},          {"iMouse", {"vec4", ""}},
    {"iDate", {"vec4", ""}},          {"iSampleRate", {"float", ""}},
    {"iChannelTime", {"float", "4"}}, {"iChannelResolution", {"vec3", "4"}},
    {"iTick", {"uint", ""}},          {"iChannel0", {"sampler", ""}},
    {"iChannel1", {"sampler", ""}},   {"iChannel2", {"sampler", ""}},
    {"iChannel3", {"sampler", ""}},
};

constexpr std::array kForeign = {
    ForeignName{"float", "iGlobalTime", "iTime"},
    ForeignName{"float", "time", "iTime"},
    ForeignName{"float", "u_time", "iTime"},
    ForeignName{"float", "uTime", "iTime"},
    ForeignName{"vec2", "resolution", "iResolution.xy"},
    ForeignName{"vec2", "u_resolution", "iResolution.xy"},
    ForeignName{"vec2", "uResolution", "iResolution.xy"},
    ForeignName{"vec3", "resolution", "iResolution"},
    ForeignName{"vec3", "u_resolution", "iResolution"},
    ForeignName{"vec3", "uResolution", "iResolution"},
    ForeignName{"vec2", "u_mouse", "iMouse.xy"},
    ForeignName{"vec2", "mouse", "iMouse.xy / iResolution.xy"},
    ForeignName{"float", "u_delta", "iTimeDelta"},
    ForeignName{"int", "u_frame", "iFrame"},
    ForeignName{"vec4", "u_date", "iDate"},
    // In texts with a main() of their own.
    ForeignName{"vec2", "iResolution", "iResolution.xy"},
    ForeignName{"vec2", "iMouse", "iMouse.xy"},
};

}  // namespace

const ForeignName* find_foreign_name(std::string_view type, std::string_view name) {
    const auto found = std::ranges::find_if(kForeign, [&](const ForeignName& known) {
        return known.type == type && known.name == name;
    });
    return found == kForeign.end() ? nullptr : &*found;
}

const HostUniform* find_builtin(std::string_view name) {
    const auto found = kBuiltins.find(name);
    return found == kBuiltins.end() ? nullptr : &found->second;
}

std::vector<std::string_view> builtin_names() {
    std::vector<std::string_view> names;
    for (const auto& [name, uniform] : kBuiltins) names.push_back(name);
    for (const ForeignName& foreign : kForeign) names.push_back(foreign.name);
    return names;
}

}  // namespace glint
