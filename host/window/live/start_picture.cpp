#include "window/live/start_picture.h"

#include "window/live/preview.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <exception>
#include <stdexcept>

namespace glint {
namespace {

constexpr int kLargestSide = 4000;  // pixels, that every driver takes

int power_of_two_above(int length) {
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(length) + 1));
}

// A piece of the picture at a place of the texture.
void put(GLuint texture, const Image& image, glm::ivec2 from, glm::ivec2 size, glm::ivec2 to) {
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, from.x);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, from.y);
    glTextureSubImage2D(texture, 0, to.x, to.y, size.x, size.y,
                        image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                        image.pixels.data());
}

// Its last column and row stand there twice, for those who interpolate at its edge.
StartPicture::Shown make_shown(const Image& image) {
    if (image.type != ChannelType::u8 || image.channels < 3 ||
        std::max(image.size.x, image.size.y) > kLargestSide)
        throw std::runtime_error("no picture of bytes, or too large a one");
    StartPicture::Shown shown;
    const glm::ivec2 size = shown.size = image.size;
    const glm::ivec2 whole{power_of_two_above(size.x), power_of_two_above(size.y)};
    shown.texture = make_unfilled_texture_2d(GL_RGBA8, whole);
    shown.share = glm::vec2(size) / glm::vec2(whole);
    const GLuint id = shown.texture.id();
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, size.x);
    put(id, image, {0, 0}, size, {0, 0});
    put(id, image, {size.x - 1, 0}, {1, size.y}, {size.x, 0});
    put(id, image, {0, size.y - 1}, {size.x, 1}, {0, size.y});
    put(id, image, size - 1, {1, 1}, size);
    for (const GLenum what : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS})
        glPixelStorei(what, 0);
    return shown;
}

}  // namespace

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
        shown_ = make_shown(reading_.get());
    } catch (const std::exception&) {
        shown_.reset();  // broken, or gone by now: the scene comes without
    }
    return shown_.has_value();
}

void StartPicture::wait(double seconds) const {
    if (reading_.valid()) reading_.wait_for(std::chrono::duration<double>(seconds));
}

void StartPicture::clear() {
    file_.clear();
    reading_ = {};
    shown_.reset();
}

}  // namespace glint
