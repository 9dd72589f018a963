// What the verbs share: exit codes, opening a preset, playing it to a time, progress.
#pragma once

#include "base/stopwatch.h"
#include "media/image.h"
#include "offline/options.h"
#include "render/renderer.h"
#include "scene/preset.h"

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace glint {

// As documented in docs/exporting.md; scripts rely on them.
enum class ExitCode {
    done = 0,
    failure = 1,
    usage = 2,
    shader = 3,
    missing_file = 4,
    no_context = 5,
    check_failed = 6,
    context_lost = 7,
};

// What each stands for, in one line; docs/exporting.md has the same table.
struct ExitMeaning {
    int code;
    const char* meaning;
};
inline constexpr ExitMeaning kExitMeanings[] = {
    {0, "done"},
    {1, "other failure"},
    {2, "usage"},
    {3, "the shader does not compile"},
    {4, "a file is missing or unreadable"},
    {5, "no GL context"},
    {6, "a check failed, or pictures are missing"},
    {7, "the GPU hung or was lost"},
    {130, "Ctrl+C, as in the shell"},
};

// The command line asks for something that makes no sense: exit code 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Ends the program with this code; the reason has been printed already.
struct Stop : std::exception {
    explicit Stop(ExitCode exit_code) : code(exit_code) {}
    ExitCode code;
};

// A bar on stderr with the rate and the time left, when that is a terminal and the work takes
// longer than half a second.
class Progress {
public:
    // Whole pictures count; smaller pieces of one are told in percent.
    enum class Unit { pictures, percent };
    Progress(std::string what, long total, Unit unit = Unit::pictures);
    ~Progress();
    void update(long done);
    // So many need not be done after all.
    void leave_out(long count) { total_ -= count; }

private:
    std::string what_;
    long total_;
    Unit unit_;
    bool shown_ = false, enabled_;
    Stopwatch since_start_, since_last_;
};

// Prints diagnostics to stderr, each once in the life of the process; throws Stop with exit code 3
// or 4 when there are errors.
void report(const Diagnostics& diagnostics);
// From now on it prints no warnings: another process of the same call has.
void hush_warnings();

// Lays the options' size and tweaks over a preset; returns a sentence on each value that was beyond
// its range. Throws UsageError.
std::vector<std::string> lay_over(Preset& preset, const ViewOptions& options);

// "the scene has no tweak 'wave' (it has waves, wind); did you mean 'waves'?", for a sentence's
// end.
std::string no_such_tweak(const Scene& scene, const std::string& name);

// The --size of the options; the preset's where there is none. Throws UsageError.
glm::ivec2 size_of(const ViewOptions& options, glm::ivec2 otherwise);

// Reads the preset or scene, prints what is wrong with it, and lays the options' size and tweaks
// over it. Throws Stop or UsageError.
Preset open_preset(const ViewOptions& options);
// The same of one of which all has been said.
Preset open_preset_again(const ViewOptions& options);

// The pass of this name, or kImagePass for "image", and kSoundPass for "sound" where that may be
// meant. Throws UsageError that lists the names.
std::size_t find_pass(const Scene& scene, const std::string& name, bool or_sound = false);

// What is said of a pass that the driver would never finish compiling; see GiveUp.
Diagnostic given_up(const Preset& preset, std::size_t pass, const std::string& why);

// Links what `options` asks for. Throws Stop with exit code 3. Ends the process with it where the
// driver would never finish, be it at the first draw.
CompiledScene compile_or_stop(const Preset& preset, CompileOptions options);

// What a picture's file tells of where it comes from. File names only: the same scene gives the
// same bytes in every folder.
Metadata picture_metadata(const Preset& preset, const Frame& frame, const std::string& renderer);

// RGBA values as an RGB image, in the room that they had: a picture's alpha means nothing.
Image picture_without_alpha(std::vector<std::byte> rgba, glm::ivec2 size,
                            ChannelType type = ChannelType::u8);

// The picture as it stands, RGB in bytes or floats.
Image read_picture(Renderer& renderer, bool floats);

// Frames of a preset that is played from 0 at a fixed rate to exactly `end`: frame k stands at k /
// fps, the last one at `end`.
struct Playback {
    double end = 0.0;   // s
    double fps = 60.0;  // Hz
    // Of the picture in whose pixels the mouse is counted; 0: the preset's.
    glm::ivec2 mouse_size{0};

    int last_frame() const;
    Frame frame(const Preset& preset, int index) const;
};

// The frame at `time`, with what a person did since `previous`.
Frame frame_at(const Preset& preset, double previous, double time, double delta, int index);

// A frame after the end: time stands still, iFrame counts on, nothing new is pressed.
Frame settled_frame(const Preset& preset, const Playback& playback, int extra);

// Brings a stateful scene to just before the last frame of `playback` with `settle` frames after
// it, and returns that last frame, to be drawn. `frames_rendered` counts what was played. A
// renderer that has been brought to a saved state goes on with frame `first`.
Frame play(const Preset& preset, Renderer& renderer, const Playback& playback, int settle,
           int& frames_rendered, int first = 0);

}  // namespace glint
