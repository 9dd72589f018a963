// What becomes of a text that was opened or saved: it is tried, put in place, or refused.
//
// The machine decides; others read, try and compile for it, so that it knows neither window nor GL
// nor process. All times are milliseconds.
#pragma once

#include "scene/preset.h"
#include "window/trial/trial.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// What is under way. Nothing waits here for a file to be quiet: the watcher has done so.
enum class ReloadState {
    idle,              // no newer text is known than the last that was shown or refused
    trying_text,       // the newest text is in the other process
    placing_text,      // it passed, and is compiled and put on the screen here
    trying_constants,  // the shown text, its tweaks written in as constants, is in the other
                       // process
    placing_constants  // it passed, and is compiled and exchanged here
};

enum class ReloadEvent {
    read,        // a text was opened or saved, and says something that can be tried
    unreadable,  // it is missing, or no scene at all
    passed,      // the other process has drawn it, or there is none
    refused,     // not drawn there in reasonable time, or not to be put in place here
    placed,      // in place here
    moved,       // a tweak was moved
    rested       // no tweak was moved for a while
};

// Every transition that there is; nothing where an event cannot come.
std::optional<ReloadState> next(ReloadState state, ReloadEvent event);

std::string_view name_of(ReloadState state);

// What the tweaks of the picture are. Constants are faster, to compile too, and are compiled anew
// for each value.
enum class Programs {
    uniforms,          // until the tweaks rest; numbers of the text are uniforms as well
    constants,         // they rest
    uniforms_for_good  // constants were refused for these values, or are not wanted
};

// How a save, or the first opening, or the arrival of an input file went; one line on stderr each.
struct ReloadReport {
    std::filesystem::path file;
    bool shown = false;           // it is on the screen
    double read_ms = 0.0;         // reading and parsing
    double trial_ms = 0.0;        // in the other process
    double compile_ms = 0.0;      // in this one
    double first_frame_ms = 0.0;  // drawing it
    std::string text;             // the line
};

// Who does what is decided. None may be empty; none calls the reloader back.
struct ReloadSteps {
    std::function<ReadPreset(const std::filesystem::path&)> read;
    // What was read is to be followed from now on, also what could not be read.
    std::function<void(const ReadPreset&)> watch;
    // Whether programs with uniforms are at hand that would draw this text: it differs from the one
    // that is shown in what they are fed with alone.
    std::function<bool(const Preset&)> has_uniforms;
    // Starts trying a preset with uniforms or constants; what was tried before gives way.
    std::function<void(const Preset&, Programs, bool is_text)> start_trial;
    // What is known of the newest trial. Asked again and again, also while nobody waits for the
    // answer: the other process wants to be heard, and ended when it hangs.
    std::function<const Verdict&()> trial;
    // Compiles it here and exchanges what is drawn, in one step. Returns why not, having changed
    // nothing; empty when it is in place.
    std::function<Diagnostics(const Preset&, Programs, bool is_text)> put_in_place;
};

struct ReloaderOptions {
    bool constants = true;         // once the tweaks rest
    double hopeless_ms = 10000.0;  // a frame that would take longer is refused
    double slow_ms = 1000.0;       // the trial warns of one that would
};

class Reloader {
public:
    explicit Reloader(ReloadSteps steps, const ReloaderOptions& options = {});

    // Another file from now on, or the same one from its start.
    void open(const std::filesystem::path& file);

    // Something that the text was read from has been saved.
    void saved(const std::filesystem::path& changed);

    // Hears the trial; does not wait for it. True when a new text has been put in place.
    bool follow();

    // A tweak was moved: constants that are tried are those of other values.
    void tweaks_moved();
    // What is drawn was exchanged for a program with uniforms, which are wanted there.
    void uses_uniforms();
    // Whether constants would be tried if the tweaks rested.
    bool wants_constants() const {
        return state_ == ReloadState::idle && programs_ == Programs::uniforms;
    }
    // They rest, at the values of what is drawn.
    void tweaks_rest(const Preset& drawn);

    // The input files of what is drawn; with `report.file` and `report.read_ms`. What comes before
    // the first frame of a text is part of its report; later it has one of its own.
    void input_arrived(const ReloadReport& report);
    void input_failed(const ReloadReport& report, const Diagnostic& why);

    // A frame was drawn, and took this long.
    void drawn(double frame_ms);

    // Adds to what is told of the newest text.
    void tell(const Diagnostic& diagnostic) { diagnostics_.push_back(diagnostic); }
    // A file is there of which this was told, wherever the newest text names it.
    void forget_missing_file(const std::string& why);
    // Frames are not as slow as was warned of.
    void forget_slowness();

    // What is shown stands in another file from now on, which has just been given this: it is read
    // from there as after a save.
    void go_on_in(const std::filesystem::path& file, const Preset& preset);

    // The file has just been given this.
    void note_saved(const Preset& preset) { written_ = preset; }

    ReloadState state() const { return state_; }
    Programs programs() const { return programs_; }
    bool is_trying() const {
        return state_ == ReloadState::trying_text || state_ == ReloadState::trying_constants;
    }
    // Whether a text, or an input, is in place of which no frame has been drawn yet.
    bool has_unseen() const { return unseen_.has_value(); }
    // The newest text that was tried was refused, for the reasons that the diagnostics tell.
    bool shows_older_text() const { return refused_; }

    const std::filesystem::path& file() const { return file_; }
    // Whether the text was read from this file.
    bool is_read_from(const std::filesystem::path& file) const;
    // What is shown as its file has it, without what was changed here; null until it is shown.
    const Preset* as_written() const { return written_ ? &*written_ : nullptr; }
    // Of the newest text, whether it is shown or not.
    const Diagnostics& diagnostics() const { return diagnostics_; }
    // The last reports, and how many there were in all.
    const std::deque<ReloadReport>& reports() const { return reports_; }
    std::size_t report_count() const { return report_count_; }

private:
    void on(ReloadEvent event);
    void read(const std::filesystem::path& changed);
    bool place_text();
    void place_constants();
    void refuse_text(ReloadReport report);
    void finish(ReloadReport report);

    // What is tried or placed, with what is known of it so far.
    struct Tried {
        Preset preset;
        ReloadReport report;
        Programs programs = Programs::constants;
    };

    ReloadSteps steps_;
    ReloaderOptions options_;
    ReloadState state_ = ReloadState::idle;
    Programs programs_;
    std::filesystem::path file_;
    std::vector<std::filesystem::path> read_from_;
    std::optional<Tried> tried_;  // unless it is idle
    std::optional<Preset> written_;
    std::optional<ReloadReport> unseen_;  // to be told with the first frame
    bool refused_ = false;                // the newest text that was judged
    Diagnostics diagnostics_;
    std::string slowness_;  // the warning of a slow frame among them
    std::deque<ReloadReport> reports_;
    std::size_t report_count_ = 0;
};

}  // namespace glint
