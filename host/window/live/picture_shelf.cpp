#include "window/live/picture_shelf.h"

#include "media/image.h"

#include <algorithm>
#include <stdexcept>

namespace glint {
namespace {

constexpr std::size_t kMostKept = 4;

std::unique_ptr<Buffer> read_buffer(const std::filesystem::path& file) {
    try {
        const Image image = read_image(file);
        if (image.type != ChannelType::u8 || image.channels < 3) return nullptr;
        auto buffer =
            std::make_unique<Buffer>(BufferShape{.size = image.size, .format = PixelFormat::rgba8});
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(buffer->texture(0), 0, 0, 0, image.size.x, image.size.y,
                            image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                            image.pixels.data());
        return buffer;
    } catch (const std::runtime_error&) {
        return nullptr;
    }
}

}  // namespace

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
