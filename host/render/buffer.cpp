#include "render/buffer.h"

#include "gl/resample.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace glint {
namespace {

GLenum gl_format(const BufferShape& shape) {
    switch (shape.format) {
        case PixelFormat::r8:
            return shape.fine_bytes ? GL_R16 : GL_R8;
        case PixelFormat::rg8:
            return shape.fine_bytes ? GL_RG16 : GL_RG8;
        case PixelFormat::rgba8:
            return shape.fine_bytes ? GL_RGBA16 : GL_RGBA8;
        case PixelFormat::r16f:
            return GL_R16F;
        case PixelFormat::rg16f:
            return GL_RG16F;
        case PixelFormat::rgba16f:
            return GL_RGBA16F;
        case PixelFormat::r32f:
            return GL_R32F;
        case PixelFormat::rg32f:
            return GL_RG32F;
        case PixelFormat::rgba32f:
            return GL_RGBA32F;
    }
    return GL_RGBA32F;
}

// How texels stand in memory; the same as in the texture, so that nothing is converted.
GLenum gl_channels(PixelFormat format) {
    const int channels = channel_count(format);
    return channels == 1 ? GL_RED : channels == 2 ? GL_RG : GL_RGBA;
}

GLenum gl_type(PixelFormat format) {
    const int bytes = bytes_a_channel(format);
    return bytes == 1 ? GL_UNSIGNED_BYTE : bytes == 2 ? GL_HALF_FLOAT : GL_FLOAT;
}

// One texture's.
std::size_t texture_bytes(const BufferShape& shape) {
    return static_cast<std::size_t>(shape.size.x) * static_cast<std::size_t>(shape.size.y) *
           (shape.cube ? 6 : 1) * bytes_a_texel(shape.format);
}

}  // namespace

std::size_t byte_count(const BufferShape& shape) {
    return texture_bytes(shape) * static_cast<std::size_t>(shape.outputs) *
           (shape.feedback ? 2 : 1);
}

bool Buffer::is_whole() const {
    return std::ranges::all_of(sides_, [](const Side& side) {
        return glCheckNamedFramebufferStatus(side.framebuffers.front().id(), GL_FRAMEBUFFER) ==
               GL_FRAMEBUFFER_COMPLETE;
    });
}

Buffer::Buffer(const BufferShape& shape) : shape_(shape) {
    for (int side = 0; side < (shape.feedback ? 2 : 1); ++side) sides_.push_back(make_side());
}

Buffer::Side Buffer::make_side() const {
    Side side;
    const int levels = shape_.mipmaps ? mipmap_levels(shape_.size) : 1;
    const GLenum format = gl_format(shape_);
    for (int i = 0; i < shape_.outputs; ++i) {
        side.textures.push_back(shape_.cube ? make_texture_cube(format, shape_.size.x, levels)
                                            : make_texture_2d(format, shape_.size, levels));
    }
    for (int face = 0; face < (shape_.cube ? 6 : 1); ++face) {
        GLuint id = 0;
        glCreateFramebuffers(1, &id);
        side.framebuffers.emplace_back(id);
        std::array<GLenum, 8> attachments{};
        for (std::size_t i = 0; i < side.textures.size(); ++i) {
            attachments[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
            if (shape_.cube) {
                glNamedFramebufferTextureLayer(id, attachments[i], side.textures[i].id(), 0, face);
            } else {
                glNamedFramebufferTexture(id, attachments[i], side.textures[i].id(), 0);
            }
        }
        glNamedFramebufferDrawBuffers(id, shape_.outputs, attachments.data());
    }
    return side;
}

GLuint Buffer::target(int face) const {
    return sides_[back()].framebuffers[static_cast<std::size_t>(face)].id();
}

void Buffer::finish_draw() {
    front_ = back();
    ++version_;
    if (!shape_.mipmaps) return;
    for (const Texture& texture : sides_[front_].textures) make_mipmaps(texture.id());
}

void Buffer::clear() {
    for (const Side& side : sides_) {
        for (const Texture& texture : side.textures) {
            const int levels = shape_.mipmaps ? mipmap_levels(shape_.size) : 1;
            for (int level = 0; level < levels; ++level) {
                glClearTexImage(texture.id(), level, GL_RGBA, GL_FLOAT, nullptr);
            }
        }
    }
    ++version_;
}

void Buffer::resize(glm::ivec2 size) {
    if (size == shape_.size) return;
    const glm::ivec2 kept = glm::min(size, shape_.size);
    shape_.size = size;
    for (Side& side : sides_) {
        Side fresh = make_side();
        for (std::size_t i = 0; i < fresh.textures.size(); ++i) {
            const GLenum target = shape_.cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
            glCopyImageSubData(side.textures[i].id(), target, 0, 0, 0, 0, fresh.textures[i].id(),
                               target, 0, 0, 0, 0, kept.x, kept.y, shape_.cube ? 6 : 1);
            if (shape_.mipmaps) make_mipmaps(fresh.textures[i].id());
        }
        side = std::move(fresh);
    }
    ++version_;
}

void Buffer::copy_from(const Buffer& other) {
    if (other.shape_.format != shape_.format || other.shape_.cube != shape_.cube) return;
    const glm::ivec2 kept = glm::min(shape_.size, other.shape_.size);
    const GLenum target = shape_.cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
    const auto outputs = static_cast<std::size_t>(std::min(shape_.outputs, other.shape_.outputs));
    for (std::size_t i = 0; i < outputs; ++i) {
        glCopyImageSubData(other.texture(i), target, 0, 0, 0, 0, texture(i), target, 0, 0, 0, 0,
                           kept.x, kept.y, shape_.cube ? 6 : 1);
        if (shape_.mipmaps) make_mipmaps(texture(i));
    }
    ++version_;
}

namespace {

// All of a texture, in parts whose bytes a GLsizei counts.
void read_texture(const Texture& texture, const BufferShape& shape, std::byte* to) {
    constexpr std::size_t kLargestPart = 1u << 30;
    const int faces = shape.cube ? 6 : 1;
    const std::size_t row = texture_bytes(shape) / static_cast<std::size_t>(faces) /
                            static_cast<std::size_t>(shape.size.y);
    const int rows = std::max(static_cast<int>(kLargestPart / row), 1);
    for (int face = 0; face < faces; ++face) {
        for (int y = 0; y < shape.size.y; y += rows) {
            const int height = std::min(rows, shape.size.y - y);
            const std::size_t part = row * static_cast<std::size_t>(height);
            glGetTextureSubImage(texture.id(), 0, 0, y, face, shape.size.x, height, 1,
                                 gl_channels(shape.format), gl_type(shape.format),
                                 static_cast<GLsizei>(part), to);
            to += part;
        }
    }
}

}  // namespace

std::vector<std::byte> Buffer::bytes() const {
    std::vector<std::byte> all(byte_count());
    const std::size_t one = texture_bytes(shape_);
    std::byte* to = all.data();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (const std::size_t side : {front_, back()}) {
        if (to == all.data() + all.size()) break;  // single: front and back are the same
        for (const Texture& texture : sides_[side].textures) {
            read_texture(texture, shape_, to);
            to += one;
        }
    }
    return all;
}

void Buffer::set_bytes(std::span<const std::byte> bytes) {
    const GLenum channels = gl_channels(shape_.format), type = gl_type(shape_.format);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::byte* from = bytes.data();
    for (const std::size_t side : {front_, back()}) {
        if (from == bytes.data() + bytes.size()) break;
        for (const Texture& texture : sides_[side].textures) {
            if (shape_.cube) {
                glTextureSubImage3D(texture.id(), 0, 0, 0, 0, shape_.size.x, shape_.size.y, 6,
                                    channels, type, from);
            } else {
                glTextureSubImage2D(texture.id(), 0, 0, 0, shape_.size.x, shape_.size.y, channels,
                                    type, from);
            }
            if (shape_.mipmaps) make_mipmaps(texture.id());
            from += texture_bytes(shape_);
        }
    }
    ++version_;
}

BufferShape shape_of(const Pass& pass, glm::ivec2 picture, bool feedback) {
    return {.size = buffer_size(pass, picture),
            .format = pass.format,
            .outputs = static_cast<int>(pass.outputs.size()),
            .cube = pass.cube,
            .feedback = feedback};
}

glm::ivec2 buffer_size(const Pass& pass, glm::ivec2 picture) {
    if (pass.size) return *pass.size;
    if (pass.cube) return glm::ivec2(1024);  // as on the site
    return glm::max(glm::ivec2(1), glm::ivec2(glm::floor(glm::dvec2(picture) * pass.scale + 0.5)));
}

}  // namespace glint
