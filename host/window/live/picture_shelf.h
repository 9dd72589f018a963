// Pictures as buffers that the viewer can show, and the other way.
#pragma once

#include "media/image.h"
#include "render/buffer.h"

#include <deque>
#include <filesystem>
#include <memory>

namespace glint {

// A picture of bytes as a buffer that the viewer can show. Null for other pictures.
std::unique_ptr<Buffer> buffer_of(const Image& image);

// The other way: what a buffer shows, RGB, made smaller where a side is longer than `longest`
// pixels. Waits for the GPU.
Image picture_of(const Buffer& buffer, int longest);

class PictureShelf {
public:
    // Reads a file when it is asked for first, in the GL context that is current. The shelf owns
    // the buffer, and keeps the last few. Null where there is no file, or no picture of bytes in
    // it; that is remembered too.
    const Buffer* find(const std::filesystem::path& file);

    // Files may have changed.
    void clear() { kept_.clear(); }

private:
    struct Kept {
        std::filesystem::path file;
        std::unique_ptr<Buffer> buffer;  // null where it cannot be read
    };
    std::deque<Kept> kept_;  // the last ones
};

}  // namespace glint
