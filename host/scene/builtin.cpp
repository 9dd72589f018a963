// The table of built-in uniforms.
#include "scene/builtin.h"

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

}  // namespace

bool is_old_name(std::string_view type, std::string_view name) {
    return (type == "float" && (name == "u_time" || name == "time" || name == "iGlobalTime")) ||
           (type == "vec2" && (name == "u_resolution" || name == "resolution" ||
                               name == "u_mouse" || name == "mouse"));
}

const HostUniform* find_builtin(std::string_view name) {
    const auto found = kBuiltins.find(name);
    return found == kBuiltins.end() ? nullptr : &found->second;
}

}  // namespace glint
