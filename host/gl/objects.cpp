#include "gl/objects.h"

#include <algorithm>
#include <bit>

namespace glint {
namespace {

struct Shader {
    GLuint id = 0;
    ~Shader() { glDeleteShader(id); }
};

GLuint make_shader(GLenum stage, const std::string& text, std::string& log) {
    const GLuint id = glCreateShader(stage);
    const char* data = text.data();
    const auto length = static_cast<GLint>(text.size());
    glShaderSource(id, 1, &data, &length);
    glCompileShader(id);
    GLint log_length = 0;
    glGetShaderiv(id, GL_INFO_LOG_LENGTH, &log_length);
    if (log_length > 1) {
        std::string part(static_cast<std::size_t>(log_length), '\0');
        glGetShaderInfoLog(id, log_length, &log_length, part.data());
        log.append(part, 0, static_cast<std::size_t>(log_length));
    }
    return id;
}

bool compiled(GLuint shader) {
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    return ok == GL_TRUE;
}

constexpr const char* kVertexText = R"(#version 300 es
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

}  // namespace

void destroy_texture(GLuint id) {
    glDeleteTextures(1, &id);
}
void destroy_framebuffer(GLuint id) {
    glDeleteFramebuffers(1, &id);
}
void destroy_sampler(GLuint id) {
    glDeleteSamplers(1, &id);
}
void destroy_program(GLuint id) {
    glDeleteProgram(id);
}
void destroy_vertex_array(GLuint id) {
    glDeleteVertexArrays(1, &id);
}
void destroy_buffer(GLuint id) {
    glDeleteBuffers(1, &id);
}

Texture make_unfilled_texture_2d(GLenum format, glm::ivec2 size, int levels) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, levels, format, size.x, size.y);
    return Texture(id);
}

Texture make_texture_2d(GLenum format, glm::ivec2 size, int levels) {
    Texture texture = make_unfilled_texture_2d(format, size, levels);
    for (int level = 0; level < levels; ++level) {
        glClearTexImage(texture.id(), level, GL_RGBA, GL_FLOAT, nullptr);
    }
    return texture;
}

Framebuffer make_framebuffer() {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    return Framebuffer(id);
}

Texture make_texture_3d(GLenum format, int width, int height, int depth, int levels) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &id);
    glTextureStorage3D(id, levels, format, width, height, depth);
    return Texture(id);
}

Texture make_texture_cube(GLenum format, int size, int levels) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &id);
    glTextureStorage2D(id, levels, format, size, size);
    for (int level = 0; level < levels; ++level) {
        glClearTexImage(id, level, GL_RGBA, GL_FLOAT, nullptr);
    }
    return Texture(id);
}

int mipmap_levels(glm::ivec2 size) {
    return std::bit_width(static_cast<unsigned>(std::max({size.x, size.y, 1})));
}

VertexArray make_vertex_array() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return VertexArray(id);
}

LinkedProgram make_program(const std::string& fragment_text) {
    LinkedProgram result;
    const Shader vertex{make_shader(GL_VERTEX_SHADER, kVertexText, result.log)};
    const Shader fragment{make_shader(GL_FRAGMENT_SHADER, fragment_text, result.log)};
    if (!compiled(vertex.id) || !compiled(fragment.id)) return result;

    Program program(glCreateProgram());
    glAttachShader(program.id(), vertex.id);
    glAttachShader(program.id(), fragment.id);
    glLinkProgram(program.id());
    glDetachShader(program.id(), vertex.id);
    glDetachShader(program.id(), fragment.id);
    GLint linked = GL_FALSE, log_length = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &log_length);
    if (log_length > 1) {
        std::string part(static_cast<std::size_t>(log_length), '\0');
        glGetProgramInfoLog(program.id(), log_length, &log_length, part.data());
        result.log.append(part, 0, static_cast<std::size_t>(log_length));
    }
    if (linked == GL_TRUE) result.program = std::move(program);
    return result;
}

std::string complaints_of(const std::string& fragment_text) {
    std::string log;
    const Shader fragment{make_shader(GL_FRAGMENT_SHADER, fragment_text, log)};
    return log;
}

void draw_triangle() {
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace glint
