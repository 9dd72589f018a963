// Textures drawn at another size: smaller levels, previews, a picture in a window.
#pragma once

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

namespace glint {

// Draws all of a 2D texture's level into a rectangle of a framebuffer, in pixels from the bottom
// left, within the scissor: as it is where the sizes agree, else between the four nearest texels.
// What is bound stays bound. A program of ours, since the drivers' own way is not quick everywhere:
// llvmpipe compiles glGenerateTextureMipmap and glBlitFramebuffer anew in each process, 30 to 80 ms
// for each format, while a program is kept on the disk.
struct Resampling {
    GLuint texture = 0;
    int level = 0;  // from the texture's base level on
    GLuint framebuffer = 0;
    glm::ivec2 origin{0}, size{0};
};
void resample(const Resampling& resampling);

// Fills all levels below a texture's base level, each texel with the mean of the two by two that it
// covers; where a side is odd, with what a linear filter finds in the middle of what it covers, as
// drivers do. What is bound stays bound.
void make_mipmaps(GLuint texture);

// Deletes what both keep of this thread's context, while that is current.
void forget_resampling();

}  // namespace glint
