#include "render/average.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace glint {
namespace {

// The inverse of the decoding that the averaged picture's prologue does (render/pass_text.cpp).
constexpr const char* kEncode = R"(#version 300 es
precision highp float;
uniform highp sampler2D sum;
uniform float scale;
out vec4 colour;
void main() {
    vec3 c = texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb * scale;
    vec3 a = abs(c);
    vec3 encoded = mix(a * 12.92, 1.055 * pow(a, vec3(1.0 / 2.4)) - 0.055, greaterThan(a, vec3(0.0031308)));
    colour = vec4(sign(c) * encoded, 1.0);
}
)";

// How many of van der Corput's first `count` positions lie below the i-th. They compare like their
// numbers' bits, the lowest first: below are those that agree up to a bit and have 0 where i has 1.
std::uint32_t rank_of_radical_inverse(std::uint32_t i, std::uint32_t count) {
    std::uint32_t rank = 0;
    for (std::uint32_t bit = 0; i >> bit != 0; ++bit) {
        if ((i >> bit & 1u) == 0) continue;
        const std::uint32_t lowest = i & ((1u << bit) - 1u);
        rank += ((count - 1u - lowest) >> bit >> 1u) + 1u;
    }
    return rank;
}

}  // namespace

glm::vec2 sub_pixel_position(int i, int count) {
    const auto rank = static_cast<double>(
        rank_of_radical_inverse(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(count)));
    return {static_cast<float>((i + 0.5) / count - 0.5),
            static_cast<float>((rank + 0.5) / count - 0.5)};
}

double shutter_time(int i, int count, int frame) {
    // Steps of about the golden section through the parts; a step without a common divisor with
    // their number visits each once.
    int step = std::max(static_cast<int>(count * 0.618033988749895), 1);
    while (std::gcd(step, count) != 1) ++step;
    const auto part = static_cast<double>(static_cast<std::int64_t>(i) * step % count);
    // Weyl's sequence, whose places are spread evenly: 2^32 by the golden section.
    const std::uint32_t place =
        (static_cast<std::uint32_t>(frame) * 7919u + static_cast<std::uint32_t>(i)) * 2654435769u;
    return (part + place / 4294967296.0) / count;
}

Average::Average(glm::ivec2 size) : sum_(BufferShape{.size = size}) {
    LinkedProgram linked = make_program(kEncode);
    if (!linked.program) throw std::runtime_error("The averaging shader fails: " + linked.log);
    encode_ = std::move(linked.program);
    scale_location_ = glGetUniformLocation(encode_.id(), "scale");
}

void Average::clear() {
    sum_.clear();
}

void Average::resolve(GLuint framebuffer, int count) {
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glUseProgram(encode_.id());
    glProgramUniform1f(encode_.id(), scale_location_, 1.0f / static_cast<float>(count));
    glBindTextureUnit(0, sum_.texture(0));
    glBindSampler(0, 0);
    draw_triangle();
}

}  // namespace glint
