// Adds up a picture drawn at several sub-pixel positions in linear light, and encodes the mean for
// the display again.
#pragma once

#include "render/buffer.h"

#include <glm/vec2.hpp>

namespace glint {

// Position i of `count` inside the pixel, in (-0.5, 0.5): the Hammersley set (Hammersley 1960),
// with van der Corput's sequence in base 2 replaced by its ranks. For any count each of `count`
// rows and columns has one position, so their mean is the centre.
glm::vec2 sub_pixel_position(int i, int count);

// When sample i of `count` is taken, as a fraction of the exposure: each of `count` equal parts of
// it has one, at a place of its own in the part, in an order that follows neither row nor column.
// Equal arguments give equal times.
double shutter_time(int i, int count, int frame);

class Average {
public:
    explicit Average(glm::ivec2 size);

    const Buffer& sum() const { return sum_; }

    void clear();

    // Where to draw the next position, blending by addition.
    GLuint target() const { return sum_.target(); }

    // Draws the mean of `count` positions, sRGB-encoded, into a framebuffer of the same size.
    void resolve(GLuint framebuffer, int count);

private:
    Buffer sum_;
    Program encode_;
    GLint scale_location_ = -1;
};

}  // namespace glint
