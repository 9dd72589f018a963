#include "window/live/picture_shelf.h"

#include "gl/resample.h"
#include "offline/common.h"

#include <glm/common.hpp>

#include <algorithm>
#include <stdexcept>

namespace glint {
namespace {

constexpr std::size_t kMostKept = 4;

std::unique_ptr<Buffer> read_buffer(const std::filesystem::path& file) {
    try {
        return buffer_of(read_image(file));
    } catch (const std::runtime_error&) {
        return nullptr;
    }
}

}  // namespace

std::unique_ptr<Buffer> buffer_of(const Image& image) {
    if (image.type != ChannelType::u8 || image.channels < 3) return nullptr;
    auto buffer =
        std::make_unique<Buffer>(BufferShape{.size = image.size, .format = PixelFormat::rgba8});
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(buffer->texture(0), 0, 0, 0, image.size.x, image.size.y,
                        image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                        image.pixels.data());
    return buffer;
}

Image picture_of(const Buffer& buffer, int longest) {
    const glm::ivec2 size = buffer.shape().size;
    const double share = std::min(1.0, static_cast<double>(longest) / std::max(size.x, size.y));
    const glm::ivec2 small = glm::max(glm::ivec2(glm::round(glm::dvec2(size) * share)), 1);
    const Buffer copy({.size = small, .format = PixelFormat::rgba8});
    glDisable(GL_SCISSOR_TEST);
    resample(
        {.texture = buffer.texture(0), .framebuffer = copy.front_framebuffer(), .size = small});
    std::vector<std::byte> pixels(static_cast<std::size_t>(small.x) *
                                  static_cast<std::size_t>(small.y) * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, copy.front_framebuffer());
    glReadPixels(0, 0, small.x, small.y, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return picture_without_alpha(std::move(pixels), small);
}

const Buffer* PictureShelf::find(const std::filesystem::path& file) {
    if (file.empty()) return nullptr;
    const auto found = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const Kept& kept) { return kept.file == file; });
    if (found != kept_.end()) return found->buffer.get();
    kept_.push_back({file, read_buffer(file)});
    if (kept_.size() > kMostKept) kept_.pop_front();
    return kept_.back().buffer.get();
}

}  // namespace glint
