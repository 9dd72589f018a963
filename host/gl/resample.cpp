#include "gl/resample.h"

#include "gl/context.h"
#include "gl/objects.h"

#include <glm/common.hpp>

#include <array>
#include <optional>

namespace glint {
namespace {

// Of a picture that is shown at its own size, sixty times a second.
constexpr const char* kCopy = R"(#version 300 es
precision highp float;
uniform highp sampler2D source;
uniform int level;
uniform vec2 origin;
out vec4 colour;
void main() { colour = texelFetch(source, ivec2(gl_FragCoord.xy - origin), level); }
)";

constexpr const char* kBetween = R"(#version 300 es
precision highp float;
uniform highp sampler2D source;
uniform int level;
uniform ivec2 last;
uniform vec2 origin, ratio;
out vec4 colour;
void main() {
    vec2 at = (gl_FragCoord.xy - origin) * ratio - 0.5, whole = floor(at), f = at - whole;
    ivec2 a = clamp(ivec2(whole), ivec2(0), last), b = clamp(ivec2(whole) + 1, ivec2(0), last);
    vec4 low = texelFetch(source, a, level), high = texelFetch(source, ivec2(a.x, b.y), level);
    vec4 right = texelFetch(source, ivec2(b.x, a.y), level), far = texelFetch(source, b, level);
    // An infinity next to it has no share in what is read as it is.
    if (f.x > 0.0) {
        low = mix(low, right, f.x);
        high = mix(high, far, f.x);
    }
    colour = f.y > 0.0 ? mix(low, high, f.y) : low;
}
)";

struct Resampler {
    Program program;
    VertexArray vertex_array = make_vertex_array();
    SamplerObject sampler;
    Framebuffer levels = make_framebuffer();
    GLint level = glGetUniformLocation(program.id(), "level");
    GLint last = glGetUniformLocation(program.id(), "last");
    GLint origin = glGetUniformLocation(program.id(), "origin");
    GLint ratio = glGetUniformLocation(program.id(), "ratio");

    // Without a filter no other level counts as read, and may be drawn into.
    explicit Resampler(const char* text) : program(make_program(text).program) {
        GLuint id = 0;
        glCreateSamplers(1, &id);
        sampler = SamplerObject(id);
        glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
};
thread_local std::optional<Resampler> copies, between;

const Resampler& resampler(bool same_size) {
    std::optional<Resampler>& kept = same_size ? copies : between;
    if (!kept) kept.emplace(same_size ? kCopy : kBetween);
    return *kept;
}

// Puts back what drawing into levels changes.
class Unchanged {
public:
    Unchanged() {
        glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
        glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
        glGetIntegerv(GL_VIEWPORT, viewport_.data());
        glGetIntegeri_v(GL_TEXTURE_BINDING_2D, 0, &texture_);
        glGetIntegeri_v(GL_SAMPLER_BINDING, 0, &sampler_);
        for (std::size_t i = 0; i < kSwitches.size(); ++i) on_[i] = glIsEnabled(kSwitches[i]);
    }
    ~Unchanged() {
        glUseProgram(static_cast<GLuint>(program_));
        glBindVertexArray(static_cast<GLuint>(vertex_array_));
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
        glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
        glBindTextureUnit(0, static_cast<GLuint>(texture_));
        glBindSampler(0, static_cast<GLuint>(sampler_));
        for (std::size_t i = 0; i < kSwitches.size(); ++i)
            on_[i] ? glEnable(kSwitches[i]) : glDisable(kSwitches[i]);
    }
    Unchanged(const Unchanged&) = delete;
    Unchanged& operator=(const Unchanged&) = delete;

private:
    static constexpr std::array<GLenum, 2> kSwitches = {GL_BLEND, GL_COLOR_LOGIC_OP};
    GLint program_ = 0, vertex_array_ = 0, framebuffer_ = 0, texture_ = 0, sampler_ = 0;
    std::array<GLint, 4> viewport_{};
    std::array<GLboolean, 2> on_{};
};

GLint parameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureParameteriv(texture, name, &value);
    return value;
}

glm::ivec2 size_of(GLuint texture, int level) {
    glm::ivec2 size(1);
    glGetTextureLevelParameteriv(texture, level, GL_TEXTURE_WIDTH, &size.x);
    glGetTextureLevelParameteriv(texture, level, GL_TEXTURE_HEIGHT, &size.y);
    return size;
}

}  // namespace

void resample(const Resampling& resampling) {
    const auto& [texture, level, framebuffer, origin, size] = resampling;
    const glm::ivec2 from = size_of(texture, parameter(texture, GL_TEXTURE_BASE_LEVEL) + level);
    const Resampler& with = resampler(from == size);
    const glm::vec2 ratio = glm::vec2(from) / glm::vec2(glm::max(size, 1));
    const Unchanged unchanged;
    glDisable(GL_BLEND);
    glEnable(GL_COLOR_LOGIC_OP);  // GL_COPY; see render/plain_draw.h
    glUseProgram(with.program.id());
    glBindVertexArray(with.vertex_array.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBindTextureUnit(0, texture);
    glBindSampler(0, with.sampler.id());
    glViewport(origin.x, origin.y, size.x, size.y);
    glUniform1i(with.level, level);
    glUniform2i(with.last, from.x - 1, from.y - 1);
    glUniform2f(with.origin, static_cast<float>(origin.x), static_cast<float>(origin.y));
    glUniform2f(with.ratio, ratio.x, ratio.y);
    draw_triangle();
}

void make_mipmaps(GLuint texture) {
    if (!draws_in_software() || parameter(texture, GL_TEXTURE_TARGET) != GL_TEXTURE_2D)
        return glGenerateTextureMipmap(texture);
    const int base = parameter(texture, GL_TEXTURE_BASE_LEVEL);
    const int levels = parameter(texture, GL_TEXTURE_IMMUTABLE_LEVELS);
    const GLuint framebuffer = resampler(false).levels.id();
    const bool scissored = glIsEnabled(GL_SCISSOR_TEST);
    glDisable(GL_SCISSOR_TEST);
    for (int level = base + 1; level < levels; ++level) {
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, level);
        resample({.texture = texture,
                  .level = level - 1 - base,
                  .framebuffer = framebuffer,
                  .size = size_of(texture, level)});
    }
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, 0, 0);
    if (scissored) glEnable(GL_SCISSOR_TEST);
}

void forget_resampling() {
    copies.reset();
    between.reset();
}

}  // namespace glint
