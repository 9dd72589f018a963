#include "window/live/start_picture.h"

#include "gl/resample.h"
#include "offline/common.h"
#include "window/live/preview.h"

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <exception>

namespace glint {

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

StartPicture::Reading StartPicture::begin(const std::filesystem::path& file) {
    if (file.empty()) return {};
    return {file, std::async(std::launch::async, [file] { return read_preview(file); })};
}

void StartPicture::read(const std::filesystem::path& file) {
    if (file == file_) return;
    *this = StartPicture(begin(file));
}

bool StartPicture::update() {
    if (!reading_.valid() ||
        reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return false;
    try {
        buffer_ = buffer_of(reading_.get());
    } catch (const std::exception&) {
        // Broken, or gone by now: the scene comes without.
    }
    return buffer_ != nullptr;
}

void StartPicture::wait(double seconds) const {
    if (reading_.valid()) reading_.wait_for(std::chrono::duration<double>(seconds));
}

void StartPicture::clear() {
    file_.clear();
    reading_ = {};
    buffer_.reset();
}

}  // namespace glint
