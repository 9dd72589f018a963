#include "render/viewer.h"

#include "gl/resample.h"
#include "render/plain_draw.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace glint {
namespace {

constexpr const char* kShow = R"(#version 300 es
precision highp float;
uniform highp sampler2D shown;
uniform vec4 area;      // origin and size of the picture on the screen, pixels
uniform int channel;
uniform float gain;
uniform bool toneCurve, markNotFinite;
out vec4 colour;

// By comparison, one by one: drivers fold arithmetic on NaN, and all() of comparisons.
bool isNotFinite(float v) { return !(abs(v) <= 3.402823e38); }
bool isNotFinite(vec4 v) {
    return isNotFinite(v.r) || isNotFinite(v.g) || isNotFinite(v.b) || isNotFinite(v.a);
}

void main() {
    vec2 uv = (gl_FragCoord.xy - area.xy) / area.zw;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0)))) {
        colour = vec4(0.07, 0.07, 0.08, 1.0);
        return;
    }
    vec4 exact = texelFetch(shown, ivec2(uv * vec2(textureSize(shown, 0))), 0);
    if (markNotFinite && isNotFinite(exact)) {
        colour = vec4(1.0, 0.0, 1.0, 1.0);
        return;
    }
    vec4 v = texture(shown, uv);
    if (isNotFinite(v)) v = exact;  // the filter spreads what is no number, also by a weight of 0
    vec3 c = channel == 0 ? v.rgb : channel == 1 ? v.rrr : channel == 2 ? v.ggg : channel == 3 ? v.bbb : v.aaa;
    c *= gain;
    if (toneCurve) c = max(c, 0.0) / (1.0 + max(c, 0.0));
    colour = vec4(c, 1.0);
}
)";

Program make_show() {
    LinkedProgram linked = make_program(kShow);
    if (!linked.program) throw std::runtime_error("The viewer's shader fails: " + linked.log);
    return std::move(linked.program);
}

SamplerObject make_sampler(GLint filter) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return SamplerObject(id);
}

// As large as a room allows in this shape. Bars that were narrower than one of its pixels come of a
// share of the room that was rounded to whole pixels: such a picture fills it.
glm::dvec2 fitting_size(glm::ivec2 pixels, glm::ivec2 room) {
    const glm::dvec2 ratio = glm::dvec2(room) / glm::dvec2(pixels);
    const double zoom = std::min(ratio.x, ratio.y);
    const glm::dvec2 size = glm::dvec2(pixels) * zoom, bars = glm::dvec2(room) - size;
    return std::max(bars.x, bars.y) < zoom ? glm::dvec2(room) : size;
}

}  // namespace

// Where the whole buffer lies on the screen, perhaps beyond the area: origin and size, pixels.
struct Viewer::Placed {
    glm::dvec2 origin, size;
};

Viewer::Placed Viewer::place(glm::ivec2 buffer_size, const BufferView& view,
                             const ScreenArea& area) {
    const glm::dvec2 middle = glm::dvec2(area.origin) + glm::dvec2(area.size) * 0.5;
    if (view.zoom > 0.0) {
        const glm::dvec2 size = glm::dvec2(buffer_size) * view.zoom;
        return {middle - view.centre * size, size};
    }
    const glm::dvec2 size = fitting_size(buffer_size, area.size);
    return {middle - 0.5 * size, size};
}

ValueRange value_range(std::span<const float> rgba) {
    ValueRange result;
    bool all_finite = true;
    for (int c = 0; c < 4; ++c) {  // one after the other, so that both ends stay in registers
        float low = std::numeric_limits<float>::infinity(), high = -low;
        for (auto i = static_cast<std::size_t>(c); i < rgba.size(); i += 4) {
            const float v = rgba[i];
            if (!std::isfinite(v)) {
                all_finite = false;
                continue;
            }
            low = v < low ? v : low, high = v > high ? v : high;
        }
        result.min[c] = low, result.max[c] = high;
    }
    if (all_finite) return result;
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const auto pixel = rgba.subspan(i, 4);
        result.nan += std::ranges::any_of(pixel, [](float v) { return std::isnan(v); });
        result.infinite += std::ranges::any_of(pixel, [](float v) { return std::isinf(v); });
    }
    return result;
}

BufferStatistics statistics(std::span<const float> rgba) {
    BufferStatistics result{value_range(rgba)};
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const auto c = static_cast<int>(i % 4);
        const float range = result.max[c] - result.min[c];
        if (!std::isfinite(rgba[i]) || !(range >= 0.0f)) continue;
        const float at = range > 0.0f ? (rgba[i] - result.min[c]) / range * 63.999f : 0.0f;
        ++result.histogram[i % 4][static_cast<std::size_t>(at)];
    }
    return result;
}

// As the shader above does it; channel 0 is all three.
glm::vec4 displayed(const BufferView& view, const glm::vec4& value) {
    const int channel = static_cast<int>(view.channel);
    glm::vec4 shown = channel == 0 ? value : glm::vec4(value[channel - 1]);
    shown *= std::exp2(view.exposure);
    if (view.tone_curve) shown = glm::max(shown, 0.0f) / (1.0f + glm::max(shown, 0.0f));
    return glm::vec4(glm::clamp(glm::vec3(shown), 0.0f, 1.0f), 1.0f);
}

Viewer::Viewer()
    : vertex_array_(make_vertex_array()),
      nearest_(make_sampler(GL_NEAREST)),
      linear_(make_sampler(GL_LINEAR)) {}

glm::dvec2 Viewer::fraction_at(glm::dvec2 point, glm::ivec2 buffer_size, const BufferView& view,
                               const ScreenArea& area) {
    const Placed placed = place(buffer_size, view, area);
    return (point - placed.origin) / placed.size;
}

void Viewer::show(const Buffer& buffer, const BufferView& view, const ScreenArea& area) {
    if (buffer.shape().cube) return;  // no plane to show
    if (view.is_plain() && view.output == 0)
        copy(buffer, area_of(buffer.shape().size, view, area));
    else
        draw(buffer, view, area);
}

ScreenArea Viewer::area_of(glm::ivec2 buffer_size, const BufferView& view, const ScreenArea& area) {
    const Placed placed = place(buffer_size, view, area);
    const glm::ivec2 from(glm::round(placed.origin)), to(glm::round(placed.origin + placed.size));
    return {.origin = from, .size = to - from};
}

// A reduced resolution is smoothed over.
void Viewer::copy(const Buffer& buffer, const ScreenArea& to) const {
    resample({.texture = buffer.texture(0), .origin = to.origin, .size = to.size});
}

void Viewer::draw(const Buffer& buffer, const BufferView& view, const ScreenArea& area) {
    const Placed placed = place(buffer.shape().size, view, area);
    if (!program_) program_ = make_show();  // most windows never need it
    const auto location = [&](const char* name) {
        return glGetUniformLocation(program_.id(), name);
    };
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(area.origin.x, area.origin.y, area.size.x, area.size.y);
    glBindVertexArray(vertex_array_.id());
    glUseProgram(program_.id());
    glUniform4f(location("area"), static_cast<float>(placed.origin.x),
                static_cast<float>(placed.origin.y), static_cast<float>(placed.size.x),
                static_cast<float>(placed.size.y));
    glUniform1i(location("channel"), static_cast<int>(view.channel));
    glUniform1f(location("gain"), std::exp2(view.exposure));
    glUniform1i(location("toneCurve"), view.tone_curve);
    glUniform1i(location("markNotFinite"), view.mark_not_finite);
    glBindTextureUnit(0, buffer.texture(view.output));
    // Enlarged pixels are shown as they are; a reduced resolution is smoothed over.
    glBindSampler(0, view.zoom >= 1.0 ? nearest_.id() : linear_.id());
    const PlainDraw plain;
    draw_triangle();
}

}  // namespace glint
