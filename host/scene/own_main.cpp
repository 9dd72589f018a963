#include "scene/own_main.h"

#include <algorithm>
#include <cctype>

namespace glint {
namespace {

bool is_at_another_location(const Reading& reading, TokenRange qualifiers) {
    for (std::uint32_t at = qualifiers.begin; at + 2 < qualifiers.end; ++at)
        if (reading.tokens[at].is("location")) return !reading.tokens[at + 2].is("0");
    return false;
}

bool writes_plain_colour(const Reading& reading) {
    return reading.mentions("gl_FragColor") || reading.mentions("gl_FragData");
}

// As where main() is that of one of several files (glsl/foreign_text.h).
bool main_image_calls_main(const Reading& reading) {
    for (const std::uint32_t function : reading.functions_named("mainImage")) {
        const TokenRange body = reading.functions[function].body;
        for (std::uint32_t at = body.begin; at < body.end; ++at)
            if (reading.tokens[at].is("main")) return true;
    }
    return false;
}

}  // namespace

bool has_own_main(const Reading& reading) {
    const auto mains = reading.functions_named("main");
    if (!reading.mentions("mainImage")) return writes_plain_colour(reading) || !mains.empty();
    return !mains.empty() && reading.functions[mains.front()].is_defined() &&
           !main_image_calls_main(reading) &&
           (writes_plain_colour(reading) || colour_output(reading));
}

bool is_of_older_glsl(const Reading& reading) {
    return writes_plain_colour(reading) && !colour_output(reading);
}

const Declaration* colour_output(const Reading& reading) {
    for (const Declaration& declaration : reading.declarations) {
        const std::string_view type = reading.word(declaration.type);
        const bool is_colour = type == "vec4" || type == "vec3";
        if (declaration.scope == Scope::global && declaration.is_out && is_colour &&
            declaration.names.size() == 1 && declaration.names.front().array.empty() &&
            !is_at_another_location(reading, declaration.qualifiers))
            return &declaration;
    }
    return nullptr;
}

bool is_texture_coordinate(const Reading& reading, const Declaration& declaration) {
    if (reading.find_global("iResolution")) return false;  // then what the place is is not known
    const auto& tokens = reading.tokens;
    bool is_input = false;
    for (std::uint32_t at = declaration.qualifiers.begin; at < declaration.qualifiers.end; ++at)
        is_input |= tokens[at].is("varying") || tokens[at].is("in");
    if (!is_input || declaration.scope != Scope::global || declaration.names.size() != 1 ||
        reading.word(declaration.type) != "vec2" || !declaration.names.front().array.empty())
        return false;
    std::string name;
    for (const char c : reading.word(declaration.names.front().name))
        if (c != '_') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    constexpr std::string_view kWords[] = {"uv", "texcoord", "texturecoord", "fragnormcoord"};
    return std::ranges::any_of(
        kWords, [&](std::string_view word) { return name.find(word) != std::string::npos; });
}

std::optional<NoColour> why_no_colour(const Reading& reading) {
    const auto mains = reading.functions_named("main");
    if (writes_plain_colour(reading) || colour_output(reading) || mains.empty())
        return std::nullopt;
    const std::string_view other =
        reading.mentions("gl_Position")             ? "this main() is of a vertex shader"
        : reading.mentions("gl_GlobalInvocationID") ? "this main() is of a compute shader"
                                                    : "this main() writes no colour";
    return NoColour{reading.place(reading.functions[mains.front()].name).begin,
                    std::string(other) +
                        "; a picture is drawn by one that writes gl_FragColor, or a variable that "
                        "is declared by out vec4 before it"};
}

}  // namespace glint
