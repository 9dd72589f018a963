// What stands in the window from the start until the scene draws.
#pragma once

#include "media/image.h"
#include "render/buffer.h"

#include <filesystem>
#include <future>
#include <memory>
#include <utility>

namespace glint {

class StartPicture {
public:
    // Begun before there is a window, whose driver takes longer to start than most pictures to
    // read.
    struct Reading {
        std::filesystem::path file;
        std::future<Image> image;
    };
    static Reading begin(const std::filesystem::path& file);

    StartPicture() = default;
    explicit StartPicture(Reading reading)
        : file_(std::move(reading.file)), reading_(std::move(reading.image)) {}

    // Begins to read the file beside the window; "" shows nothing. What was shown goes, unless it
    // is this file's.
    void read(const std::filesystem::path& file);

    // Takes what has been read, in the GL context that is current; does not wait. True when there
    // is a picture that was not there before.
    bool update();

    // Until it has been read, so many seconds at the most.
    void wait(double seconds) const;

    void clear();

    bool is_reading() const { return reading_.valid(); }
    // Null until it is there, and where there is none.
    const Buffer* buffer() const { return buffer_.get(); }

private:
    std::filesystem::path file_;
    std::future<Image> reading_;
    std::unique_ptr<Buffer> buffer_;
};

// A picture of bytes as a buffer that the viewer can show. Null for other pictures.
std::unique_ptr<Buffer> buffer_of(const Image& image);

// The other way: what a buffer shows, RGB, made smaller where a side is longer than `longest`
// pixels. Waits for the GPU.
Image picture_of(const Buffer& buffer, int longest);

}  // namespace glint
