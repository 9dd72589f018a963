// GL objects as move-only handles, and the few ways in which they are made.
#pragma once

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

#include <string>
#include <utility>

namespace glint {

// Owns one GL name; 0 owns nothing.
template <void (*destroy)(GLuint)>
class Handle {
public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Handle() {
        if (id_ != 0) destroy(id_);
    }
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    GLuint id_ = 0;
};

void destroy_texture(GLuint id);
void destroy_framebuffer(GLuint id);
void destroy_sampler(GLuint id);
void destroy_program(GLuint id);
void destroy_vertex_array(GLuint id);
void destroy_buffer(GLuint id);

using Texture = Handle<destroy_texture>;
using Framebuffer = Handle<destroy_framebuffer>;
using SamplerObject = Handle<destroy_sampler>;
using Program = Handle<destroy_program>;
using VertexArray = Handle<destroy_vertex_array>;
using PixelBuffer = Handle<destroy_buffer>;

// A texture of zeros. `levels` is 1, or the full chain for mipmaps.
Texture make_texture_2d(GLenum format, glm::ivec2 size, int levels = 1);
Texture make_texture_3d(GLenum format, int width, int height, int depth, int levels = 1);
Texture make_texture_cube(GLenum format, int size, int levels = 1);

// The same for whoever writes every pixel of it.
Texture make_unfilled_texture_2d(GLenum format, glm::ivec2 size, int levels = 1);

Framebuffer make_framebuffer();

// The number of levels down to 1x1.
int mipmap_levels(glm::ivec2 size);

VertexArray make_vertex_array();

// A program that covers the picture with one triangle and runs `fragment_text` in each pixel. When
// it does not compile or link, the handle is empty; `log` is what the driver said in either case.
struct LinkedProgram {
    Program program;
    std::string log;
};
LinkedProgram make_program(const std::string& fragment_text);

// What the driver says of such a text alone, without linking it.
std::string complaints_of(const std::string& fragment_text);

// Draws the triangle that covers the viewport; needs a vertex array and a program bound.
void draw_triangle();

}  // namespace glint
