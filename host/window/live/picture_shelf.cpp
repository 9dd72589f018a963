#include "window/live/picture_shelf.h"

#include "window/live/start_picture.h"

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
