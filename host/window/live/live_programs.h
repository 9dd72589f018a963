// The programs of an open scene: which are tried, and which are at hand.
//
// One other process tries what was opened or saved, another holds fed programs at standby; both
// compile. Here their programs are linked from what the driver keeps, and nothing is linked twice.
#pragma once

#include "window/live/kept_verdicts.h"
#include "window/live/program_loader.h"
#include "window/live/reloader.h"
#include "window/live/standby.h"
#include "window/trial/trial.h"

#include <optional>
#include <string>
#include <vector>

namespace glint {

// To be used on one thread, with the GL context current that draws.
class LivePrograms {
public:
    // `trial` tries what was opened or saved, on this device. `specialise`: constants are wanted
    // once the tweaks rest, and fed programs until then; else nothing but uniforms. What has passed
    // its trial before is in `verdicts`.
    LivePrograms(Trial& trial, const std::string& device, bool specialise, KeptVerdicts verdicts);

    // How a text is compiled for these programs.
    ProgramOptions options(Programs programs) const;
    // Those that have been linked, by their texts.
    ProgramShelf& shelf() { return shelf_; }

    // Another file: what its texts cost to compile is not known yet.
    void forget_costs() { longest_compile_ms_ = 0.0; }

    // Starts trying a preset, with the values that it would be drawn with, at this size in pixels
    // and this time in seconds. What was tried before gives way.
    void start_trial(Preset preset, Programs programs, bool is_text, glm::ivec2 size, double time);
    // What is known of that trial; does not wait. Its programs are linked here once they are
    // compiled there, a few milliseconds a call; until then one that has passed and is awaited is
    // told as running. `drawn`
    // has the text that is on the screen; null before the first. Valid until the next call.
    const Verdict& follow_trial(bool is_awaited, Renderer* drawn);
    // What was tried last.
    const Preset& tried() const { return *tried_; }
    // It has been drawn, and nothing has come of it: it need not be tried at the next start.
    void keep_verdict();
    // Whether that is by fed programs, which are compiled where nobody waits.
    bool is_tried_by_standby() const { return tried_by_standby_; }
    // The longest that a text of this file has been in a driver for its first draws, ms.
    double longest_compile_ms() const { return longest_compile_ms_; }
    // What the trial of a file that was opened took a frame to cost, ms; 0: not known.
    double expected_ms() { return known_ ? known_->expected_ms : trial_.poll().expected_ms; }

    // Makes fed programs ready for a text that is shown, in the background, once a text; asked for
    // when there is nothing else to do.
    bool wants_preparing() const { return standby_ && prepared_text_ != text_; }
    void prepare(const Preset& shown, glm::ivec2 size, double time);
    // Hears that process, and goes on. To be called again and again.
    void follow_standby(Renderer& drawn);

    // Whether fed programs at hand draw this text as well, by other numbers.
    bool draw(const Preset& text) const { return standby_ && standby_->draws(text, shelf_); }
    bool has_fed() const { return standby_ && standby_->has_scene(); }
    // Programs whose tweaks are uniforms, for the text on the screen. Nothing where none are at
    // hand and the text takes too long to compile here.
    std::optional<CompiledScene> take_fed(const Preset& shown);

    // These are drawn from now on, in the place of `before`, which may be null and which the tweaks
    // were fed to or not. Fed programs of the shown text stay at hand, whichever are drawn.
    void note_drawn(Programs programs, bool is_text, Renderer* before, bool was_fed);
    // Forgets programs that are neither drawn nor at hand, once the fed ones are, or will never be.
    void tidy(const Renderer& drawn);

    // Fed programs are at hand: a slider or a number can move without a compiler.
    bool is_prepared() const { return standby_ && standby_->is_ready(); }
    // Nothing is compiled or linked but what is tried by fed programs.
    bool is_at_rest() const {
        return !trial_.is_running() &&
               !(standby_ && (standby_->is_preparing() || standby_->is_loading()));
    }
    // Programs are being linked here; of what is tried, or at standby.
    bool is_linking_tried() const { return loader_.is_loading(); }
    bool is_linking_standby() const { return standby_ && standby_->is_loading(); }
    // What the trial does, in words such as "compiling image".
    std::string work() const;
    // For ::poll(): readable when there is something to follow.
    std::vector<int> descriptors() const {
        return {trial_.descriptor(), standby_ ? standby_->descriptor() : -1};
    }

    // What the processes say that nobody has asked, such as that they are ready: unheard, it would
    // wake the window for ever.
    void hear() {
        trial_.poll();
        if (standby_) standby_->trial().poll();
    }

private:
    // They are at standby some day, and may be on the shelf in part.
    bool awaits_fed() const { return standby_ && !standby_->is_ready() && !standby_->is_refused(); }
    Candidate candidate() const;
    const Verdict& follow_known();

    ProgramShelf shelf_;
    Trial& trial_;
    std::optional<Standby> standby_;  // where constants are wanted
    ProgramLoader loader_;            // of what was tried
    KeptVerdicts verdicts_;
    std::optional<Verdict> known_;  // of what was tried last, since an earlier run
    std::optional<Preset> tried_;
    Programs tried_programs_ = Programs::constants;
    glm::ivec2 tried_size_{1};
    double tried_time_ = 0.0;
    bool tried_is_text_ = false, tried_is_linking_ = false, tried_by_standby_ = false;
    std::size_t text_ = 0, prepared_text_ = 0;  // texts that were shown, counted
    double longest_compile_ms_ = 0.0;
};

}  // namespace glint
