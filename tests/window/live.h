// The real glint, open on a screen of its own, with a home of its own, on a scene that the test
// saves.
#pragma once

#include "../base/test_folder.h"
#include "media/image.h"
#include "screen.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glint::window {

namespace fs = std::filesystem;

// With a home for the programs that run in it.
class Folder : public TestFolder {
public:
    Folder() { fs::create_directory(path() / "home"); }
};

void write(const fs::path& file, std::string_view text);
std::string read(const fs::path& file);
// What a PNG says of itself under `key`, "glint:time" for one; empty where it says nothing.
std::string text_in(const fs::path& png, std::string_view key);

// The checkout that the program to run was built in, whose scenes it draws.
fs::path repository();

// A scene in one colour, 0 to 255.
std::string flat(const Colour& colour);

using Environment = std::vector<std::pair<std::string, std::string>>;

// Where the driver keeps what it compiled, Mesa's and NVIDIA's.
Environment shader_cache(const fs::path& folder);

// A process of glint; what it says goes to a file.
class Glint {
public:
    // Runs in `folder`, whose `home` is its home and whose `bin` is the first to look for programs,
    // on this X11 display ("": none), with this added to the environment.
    Glint(const std::string& display, const fs::path& folder, std::vector<std::string> arguments,
          const Environment& environment = {});
    ~Glint();
    Glint(const Glint&) = delete;
    Glint& operator=(const Glint&) = delete;

    pid_t id() const { return process_; }
    bool runs();
    void signal(int number);
    struct End {
        int code = -1, signal = 0;
    };
    End wait(double seconds = kPatience);  // killed then

    std::string errors() const;  // stderr so far
    // Waits until stderr holds this text `count` times. That glint ends before is a failure.
    bool says(std::string_view text, int count = 1, double seconds = kPatience);
    int count(std::string_view text) const;

    double cpu_seconds() const;     // user and system, with the processes it has started
    double waited_seconds() const;  // ready to run while others ran, with those processes
    double resident_mib() const;    // of the process alone: no library, nothing shared with X11
    std::vector<pid_t> children() const;

private:
    pid_t process_ = 0;
    fs::path errors_;
    End end_;
};

// A screen, a folder, and glint open on `scene.frag` (or another file) in it.
class Window : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    // Saves the scene, starts glint on it and waits for the first picture.
    void open(std::string_view scene, const std::vector<std::string>& arguments = {});
    void start(const std::vector<std::string>& arguments);
    // Once it does; else says what was seen instead.
    ::testing::AssertionResult shows(const Colour& colour, glm::ivec2 at = {640, 340},
                                     double seconds = kPatience) const;
    // Waits until nothing has changed on the screen for a while in which glint could have run.
    void settle() const;
    // A still of the same scene by the other verb, as RGB rows; of another file, where one is
    // named.
    fs::path still(const std::vector<std::string>& arguments, fs::path file = {}) const;
    // In any channel, 0 to 255, between the upper rows of the screen and of a picture of its size.
    int largest_difference(const Image& wanted, int rows) const;
    fs::path memory_of_resolutions() const {
        return folder_->path() / "home/.local/state/glint/resolution";
    }
    fs::path scene() const { return folder_->path() / "scene.frag"; }

    std::unique_ptr<Screen> screen_;
    std::unique_ptr<Folder> folder_;
    std::unique_ptr<Glint> glint_;
    glm::ivec2 screen_size_{1280, 720};
    bool screen_has_glx_ = true;
    Environment environment_;  // added to that of glint
    // However slow the machine, no resolution is chosen for what is opened.
    bool counts_pixels_ = true;

private:
    void remember_full_size(const std::vector<std::string>& files) const;
};

// For what hangs: a software driver would hang on every core, for as long.
inline const Environment kOnOneCore = {{"LP_NUM_THREADS", "1"}};

}  // namespace glint::window
