// Picture files as buffers that the viewer can show.
#pragma once

#include "render/buffer.h"

#include <deque>
#include <filesystem>
#include <memory>

namespace glint {

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
