#include "scene/other_language.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

namespace glint {
namespace {

constexpr std::pair<std::string_view, std::string_view> kWords[] = {
    {"shader_type", "Godot's language"},
    {"CGPROGRAM", "Unity's ShaderLab"},
    {"HLSLPROGRAM", "Unity's ShaderLab"},
    {"SubShader", "Unity's ShaderLab"},
    {"SV_Target", "HLSL"},
    {"SV_TARGET", "HLSL"},
    {"SV_Position", "HLSL"},
    {"SV_POSITION", "HLSL"},
    {"cbuffer", "HLSL"},
    {"SamplerState", "HLSL"},
    {"stage_in", "Metal"},
    {"stitchable", "Metal"},
    {"namespace", "Metal"},
    {"fn", "WGSL"}};

// `fn main(`
bool begins_function(const Reading& reading, std::uint32_t at) {
    return at + 2 < reading.tokens.size() && reading.tokens[at + 1].is_word() &&
           reading.tokens[at + 2].is("(");
}

}  // namespace

std::optional<OtherLanguage> other_language(const Reading& reading) {
    for (std::uint32_t at = 0; at < reading.tokens.size(); ++at) {
        const auto word = std::ranges::find(kWords, reading.tokens[at].text,
                                            &std::pair<std::string_view, std::string_view>::first);
        if (word == std::end(kWords) || (word->first == "fn" && !begins_function(reading, at)))
            continue;
        return OtherLanguage{reading.place(at).begin,
                             fmt::format("this is {}, and Glint draws GLSL: write it anew, from "
                                         "void mainImage(out vec4 fragColor, in vec2 fragCoord)",
                                         word->second)};
    }
    return std::nullopt;
}

}  // namespace glint
