// GLSL functions evaluated on the driver, one case a pixel, to be compared with double precision.
#pragma once

#include "../render/fixture.h"

#include <cstring>
#include <span>

namespace glint {

// A scene of ours with a picture of our own; `body` writes c from the pixel p.
inline std::string with_picture(std::string_view file, std::string_view body) {
    return fmt::format(
        "#define mainImage scene_image\n#include \"{}\"\n#undef mainImage\n"
        "void mainImage(out vec4 c, in vec2 p) {{\n{}}}\n",
        file, body);
}

// Every pixel of what was drawn.
inline std::vector<glm::vec4> pixels_of(Player& player) {
    const std::vector<float> values = player.floats();
    std::vector<glm::vec4> pixels(values.size() / 4);
    std::memcpy(pixels.data(), values.data(), values.size() * sizeof(float));
    return pixels;
}

// The inputs of one case: `a`, `b`, `c` and `d` in the expression.
struct ProbeCase {
    glm::vec4 a{0.0f}, b{0.0f}, c{0.0f}, d{0.0f};
};

// The value of a GLSL expression (float, vec2 and so on up to vec4) for each case. `functions` is
// any text before it: functions, or a whole scene, such as `#include "…/fragments/boat.frag"` with
// its full path, whose tweaks stand at their defaults. At most 16,384 cases. The texts go through
// the host like any scene, so the driver sees what it would see there. Throws with the diagnostics
// where they do not compile.
inline std::vector<glm::vec4> probe(std::string_view functions, std::string_view expression,
                                    std::span<const ProbeCase> cases) {
    const auto count = static_cast<int>(cases.size());
    // A scene has a mainImage of its own, which must not clash with the probe's.
    const std::string text = fmt::format(
        "#define mainImage probe_other_image\n"
        "{}\n"
        "#undef mainImage\n"
        "uniform sampler2D probe_cases; //@ image cases filter=nearest wrap=clamp\n"
        "uniform sampler2D probe_result; //@ pass mainProbe size={}x1\n"
        "vec4 probe_widen(float v) {{ return vec4(v, 0, 0, 0); }}\n"
        "vec4 probe_widen(vec2 v) {{ return vec4(v, 0, 0); }}\n"
        "vec4 probe_widen(vec3 v) {{ return vec4(v, 0); }}\n"
        "vec4 probe_widen(vec4 v) {{ return v; }}\n"
        "void mainProbe(out vec4 probe_out, in vec2 probe_at) {{\n"
        "    int i = int(probe_at.x);\n"
        "    vec4 a = texelFetch(probe_cases, ivec2(i, 0), 0);\n"
        "    vec4 b = texelFetch(probe_cases, ivec2(i, 1), 0);\n"
        "    vec4 c = texelFetch(probe_cases, ivec2(i, 2), 0);\n"
        "    vec4 d = texelFetch(probe_cases, ivec2(i, 3), 0);\n"
        "    probe_out = probe_widen({});\n"
        "}}\n"
        "void mainImage(out vec4 c, in vec2 p) {{ c = texelFetch(probe_result, ivec2(p), 0); }}\n",
        functions, count, expression);

    std::vector<glm::vec4> inputs(cases.size() * 4);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        inputs[i] = cases[i].a;
        inputs[i + cases.size()] = cases[i].b;
        inputs[i + cases.size() * 2] = cases[i].c;
        inputs[i + cases.size() * 3] = cases[i].d;
    }

    const TestFolder folder;
    const ReadPreset read = read_scene_text(folder, text, {});
    if (!read.preset) throw std::runtime_error(to_text(read.diagnostics));
    CompileResult compiled = compile_scene(
        *read.preset, {.root = find_pass(read.preset->scene, "probe_result"), .program = {}});
    if (!compiled.scene) throw std::runtime_error(to_text(compiled.diagnostics));
    Renderer renderer(*read.preset, std::move(*compiled.scene), {.size = {1, 1}});
    for (const std::size_t sampler : renderer.inputs_needed()) {
        renderer.set_image(sampler, {.size = {count, 4},
                                     .channels = 4,
                                     .floats = true,
                                     .data = std::as_bytes(std::span(inputs))});
    }
    renderer.draw({});
    const std::vector<float> values = renderer.read_floats();
    std::vector<glm::vec4> results(cases.size());
    std::memcpy(results.data(), values.data(), values.size() * sizeof(float));
    return results;
}

}  // namespace glint
