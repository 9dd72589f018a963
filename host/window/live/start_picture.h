// What stands in the window from the start until the scene draws. It is drawn with the panels, by
// their program and as a texture of the same kind as their letters: on the processor a driver that
// has kept nothing makes code for each kind, for which both would wait.
#pragma once

#include "gl/objects.h"
#include "media/image.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <future>
#include <optional>
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

    // A picture in the lower left of a texture whose sides are powers of two.
    struct Shown {
        Texture texture;
        glm::ivec2 size{0};    // pixels of the picture
        glm::vec2 share{0.0};  // of the texture that is the picture
    };

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
    const Shown* shown() const { return shown_ ? &*shown_ : nullptr; }

private:
    std::filesystem::path file_;
    std::future<Image> reading_;
    std::optional<Shown> shown_;
};

}  // namespace glint
