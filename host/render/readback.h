// Pictures on their way from the GPU, while it draws the next ones.
#pragma once

#include "gl/objects.h"
#include "render/renderer.h"

#include <deque>
#include <memory>

namespace glint {

class Readback {
public:
    // As many pictures as `ahead` may be on their way at once. With 0 each is read when it is
    // asked for, which is as fast where software draws.
    Readback(const Renderer& renderer, bool floats, int ahead);

    // Sends for the picture as it stands now.
    void send();

    // The picture that was sent for first, RGBA in bytes or floats, rows bottom up. Waits for it.
    std::vector<std::byte> take();

    // One must be taken before the next is sent for.
    bool full() const { return on_the_way_.size() > ahead_; }

private:
    struct Fence {
        void operator()(GLsync fence) const { glDeleteSync(fence); }
    };
    // In a pixel buffer once its fence is passed, or in memory already.
    struct Picture {
        PixelBuffer buffer;
        std::unique_ptr<std::remove_pointer_t<GLsync>, Fence> written;
        std::vector<std::byte> pixels;
    };

    const Renderer& renderer_;
    bool floats_;
    std::size_t ahead_;
    std::deque<Picture> on_the_way_;
    std::vector<PixelBuffer> unused_;
};

}  // namespace glint
