// The main() of an instrumented program: where it looks, and what it tells beside the pass's
// outputs.
#include "glsl/probe.h"

#include <fmt/format.h>

namespace glint {
namespace {

constexpr std::string_view kMain = R"(void main() {{
    ivec2 cell = ivec2(gl_FragCoord.xy);
    int n = 0;
    glint0_coord = gl_FragCoord;
    if (glint0_place.z > 0) {{
        n = (cell.y >> 1) * glint0_place.z + (cell.x >> 1);
        glint0_coord.xy = vec2(glint0_place.xy + (cell & 1)) + 0.5;
    }}
    glint0_id = glint0_ask.x + n * glint0_ask.z;
    glint0_last = glint0_ask.y + n * glint0_ask.w;
    {}
    glint0_draw();
    {}
    glint0_kept = glint0_bits;
    glint0_told = uvec4({}, 1u);
}}
)";

// What a fragment sets before it draws.
const char* survey_of(ProbeKind kind) {
    if (kind == ProbeKind::faults)  // every fragment watches another site
        return "if (glint0_place.w > 0) { glint0_id = (glint0_ask.x + cell.x + 37 * "
               "cell.y) % glint0_place.w; glint0_mends = glint0_ask.y != 0; "
               "if (glint0_ask.y == 2) { glint0_scale = 7e-9; glint0_inside = -0.99; } "
               "if (glint0_ask.y == 3) { glint0_scale = 7e9; glint0_inside = 0.99; } "
               "if (glint0_ask.y == 4) { glint0_side = -1.0; glint0_inside = -0.37; } }";
    if (kind == ProbeKind::rounding)
        return "glint0_chance = uint(glint0_last) * 747796405u + uint(cell.x + 4096 * cell.y);\n"
               "    if (glint0_id == -3) glint0_coord.xy = "
               "uintBitsToFloat(floatBitsToUint(glint0_coord.xy) + uvec2(1));";
    return "";
}

// The first output is what is looked at: it shows what is no number in any of them.
std::string shown_of(ProbeKind kind, std::size_t outputs) {
    std::string text;
    for (std::size_t i = 1; i < outputs && kind == ProbeKind::faults; ++i)
        text += fmt::format(
            "if (any(isnan(glint_out{0})) || any(isinf(glint_out{0}))) glint_out0 = glint_out{0}; ",
            i);
    return text;
}

// What the second output tells.
const char* told_of(ProbeKind kind) {
    switch (kind) {
        case ProbeKind::values:
            return "glint0_hits, glint0_order, glint0_tag";
        case ProbeKind::cost:
        case ProbeKind::rounding:
            return "glint0_hits, 0, 0";
        case ProbeKind::faults:
            return "glint0_found, glint0_first, glint0_worst";
        case ProbeKind::assertions:
            return "0, 0, 0";
    }
    return "";
}

}  // namespace

std::string probe_main(ProbeKind kind, std::size_t outputs) {
    return fmt::format(
               "layout(location = {}) out uvec4 glint0_kept;\nlayout(location = {}) out uvec4 "
               "glint0_told;\n",
               outputs, outputs + 1) +
           fmt::format(fmt::runtime(kMain), survey_of(kind), shown_of(kind, outputs),
                       told_of(kind));
}

}  // namespace glint
