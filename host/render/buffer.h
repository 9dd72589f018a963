// What a pass fills: its textures, double where it reads itself back, and the way to draw into
// them.
#pragma once

#include "gl/objects.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace glint {

struct BufferShape {
    glm::ivec2 size{0};  // pixels; of one face for cubes
    PixelFormat format = PixelFormat::rgba32f;
    int outputs = 1;
    bool cube = false;
    bool feedback = false;  // keeps the previous frame beside the one that is drawn
    bool mipmaps = false;
    // Bytes have 16 bits, which hold what 8 do, and 256 steps from each to the next.
    bool fine_bytes = false;
    bool operator==(const BufferShape&) const = default;
};

// Of all textures, without their mipmaps.
std::size_t byte_count(const BufferShape& shape);

class Buffer {
public:
    // Where the driver has no room, it is there all the same but is_whole() is false.
    explicit Buffer(const BufferShape& shape);

    const BufferShape& shape() const { return shape_; }
    bool is_whole() const;

    // The texture that readers see: the frame that was drawn last.
    GLuint texture(std::size_t output) const { return sides_[front_].textures[output].id(); }

    // How often it was drawn or changed; readers compare.
    std::size_t version() const { return version_; }

    // Where to draw now; `face` is 0 unless it is a cube.
    GLuint target(int face = 0) const;

    // What was drawn into the target becomes what readers see, with its mipmaps.
    void finish_draw();

    // A part of what readers see was drawn anew; mipmaps follow with the last, by finish_draw().
    // Without feedback alone.
    void finish_part() { ++version_; }

    // Everything to 0.
    void clear();

    // A new size; the content stays, pixel for pixel from the bottom left.
    void resize(glm::ivec2 size);

    // Takes over what readers see of another buffer, pixel for pixel from the bottom left. Nothing
    // where the formats differ.
    void copy_from(const Buffer& other);

    // Every texel of every output in the buffer's own format, bit for bit, also of the side that is
    // drawn into next: where a shader discards, that one shows through. Mipmaps are left out.
    std::vector<std::byte> bytes() const;
    std::size_t byte_count() const { return glint::byte_count(shape_); }

    // Takes back what bytes() gave; as many as byte_count().
    void set_bytes(std::span<const std::byte> bytes);

    // Framebuffer of what readers see, for reading back; `face` is 0 unless it is a cube.
    GLuint front_framebuffer(int face = 0) const {
        return sides_[front_].framebuffers[static_cast<std::size_t>(face)].id();
    }

private:
    struct Side {
        std::vector<Texture> textures;          // one an output
        std::vector<Framebuffer> framebuffers;  // one, or one a face
    };
    Side make_side() const;
    std::size_t back() const { return sides_.size() - 1 - front_; }

    BufferShape shape_;
    std::vector<Side> sides_;  // one, or two with feedback
    std::size_t front_ = 0;
    std::size_t version_ = 0;
};

// What a pass fills for a picture of this size; mipmaps are for its readers to ask.
BufferShape shape_of(const Pass& pass, glm::ivec2 picture, bool feedback);

// The size of a pass's buffer for a picture of this size; never below 1x1.
glm::ivec2 buffer_size(const Pass& pass, glm::ivec2 picture);

}  // namespace glint
