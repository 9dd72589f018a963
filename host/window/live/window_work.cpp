// No work is lost: saving, and what is asked before unsaved work would go.
#include "base/canonical_name.h"
#include "base/temporary_file.h"
#include "base/terminal.h"
#include "glsl/raw_text.h"
#include "media/image.h"
#include "offline/examples.h"
#include "offline/import.h"
#include "offline/new_scene.h"
#include "scene/preset_writer.h"
#include "scene/toml_text.h"
#include "window/live/playground_window.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
    std::string why_not;
    return read_bytes(file, why_not).value_or("");
}

}  // namespace

// What the work on the screen is work on: the look of its file. Null while there is none, and while
// a file that was opened is drawn for the first time.
const Preset* PlaygroundWindow::written() const {
    if (const Preset* file = playground_.as_written()) return values_known_ ? file : nullptr;
    return left_ ? &left_->look : nullptr;
}

// That the scene on the screen was opened by.
fs::path PlaygroundWindow::shown_file() const {
    return values_known_ || !playground_.is_open() ? file_ : playground_.preset()->file;
}

std::vector<Event> PlaygroundWindow::unsaved_events() const {
    const Recorder& recorder = playground_.recorder;
    return records_ ? with_written_events(recorder.events(), recorder.end()) : recorded_;
}

// Between those of the file that go before and after; while it lasted the file's own were recorded,
// too. Nothing where nothing happened.
std::vector<Event> PlaygroundWindow::with_written_events(std::span<const Event> recorded,
                                                         double end) const {
    if (recorded.size() <= recorded_at_start_ || !written()) return {};
    const std::vector<Event>& own = written()->events;
    const auto before =
        own.begin() + static_cast<std::ptrdiff_t>(std::min(written_before_, own.size()));
    const auto after = std::ranges::upper_bound(before, own.end(), end, {}, &Event::time);
    std::vector<Event> all(own.begin(), before);
    all.insert(all.end(), recorded.begin(), recorded.end());
    all.insert(all.end(), after, own.end());
    std::ranges::stable_sort(all, {}, &Event::time);  // what is let go comes behind the last frame
    return all;
}

void PlaygroundWindow::start_recording() {
    recorded_.clear();
    const auto before =
        written() ? events_between(written()->events, -std::numeric_limits<double>::infinity(),
                                   playground_.instant().time)
                  : std::span<const Event>();
    written_before_ = before.size();
    playground_.start_recording(before);
    recorded_at_start_ = playground_.recorder.events().size();
    records_ = true;
    notice("Recording mouse and keys");
}

// What undo does not take back, beside recorded events.
bool PlaygroundWindow::is_unsaved_but_values() const {
    const Preset& file = *written();
    return playground_.has_fills() || watch() != file.watch ||
           start_time_.value_or(file.time) != file.time ||
           !std::ranges::is_permutation(playground_.current_preset().locked, file.locked);
}

bool PlaygroundWindow::is_unsaved() const {
    return written() && (has_worked(playground_.tweaks.shown()) || !unsaved_events().empty() ||
                         is_unsaved_but_values());
}

// A set in which nobody has worked may be what the file was before it was saved from the other.
bool PlaygroundWindow::has_worked(TweakSet set) const {
    const std::vector<TweakValue> values = playground_.tweaks.values(set);
    return values != written()->values && values != at_rest_[place_of(set)];
}

// What there is to save or to revert.
bool PlaygroundWindow::differs_from_file() const {
    return is_unsaved() || (written() && playground_.tweaks.values() != written()->values);
}

// Of the other set of tweaks, A or B: what a person made there before flipping. One that was never
// worked in may differ too, since the file was saved from this one.
bool PlaygroundWindow::hides_work() const {
    const TweakSet hidden = other_set(playground_.tweaks.shown());
    const std::vector<TweakValue> values = playground_.tweaks.values(hidden);
    return written() && worked_in_[place_of(hidden)] && values != written()->values &&
           values != playground_.tweaks.values();
}

// So that a question is about what is seen.
void PlaygroundWindow::show_hidden_work() {
    if (is_unsaved() || !hides_work()) return;
    playground_.tweaks.show(other_set(playground_.tweaks.shown()));
    playground_.tweaks_changed();
}

bool PlaygroundWindow::takes_away(Leaving::For what) const {
    if (what == Leaving::For::quit || what == Leaving::For::open) return is_unsaved();
    // Undo takes back what a revert does to the values; what is being recorded goes on.
    const bool reverts = what == Leaving::For::revert && written();
    return !recorded_.empty() || (reverts && is_unsaved_but_values());
}

// Does what would take unsaved work away, or asks first.
void PlaygroundWindow::leave(const Leaving& leaving) {
    dirty_ = true;
    if (leaving.what == Leaving::For::quit || leaving.what == Leaving::For::open)
        show_hidden_work();
    if (!takes_away(leaving.what)) return go(leaving);
    leaving_ = leaving;
    window_.show();
}

void PlaygroundWindow::go(Leaving leaving) {
    leaving_.reset();
    switch (leaving.what) {
        case Leaving::For::quit:
            let_go_of_work();
            keep_picture();
            values_known_ = false;
            left_.reset();
            return window_.close();
        case Leaving::For::open:
            return leaving.new_from.empty() ? import_or_open(leaving.file) : open_new(leaving);
        case Leaving::For::revert:
            return revert();
        case Leaving::For::record:
            return start_recording();
    }
}

// Written once nothing is in the way: a question that is cancelled leaves no file.
void PlaygroundWindow::open_new(const Leaving& leaving) {
    try {
        import_or_open(write_new_scene(leaving.file, leaving.new_from));
    } catch (const std::runtime_error& error) {
        notice(error.what());
    }
}

// Where a path was asked for on the way out, the way goes on.
void PlaygroundWindow::save_as(const fs::path& file) {
    const std::optional<Leaving> leaving = std::exchange(leaving_, std::nullopt);
    if (save(file) && leaving) leave(*leaving);
}

void PlaygroundWindow::take_answer(Answer answer) {
    dirty_ = true;
    if (overwriting_) {
        const std::optional<Leaving> then = std::exchange(overwriting_, std::nullopt)->then;
        if (answer == Answer::save && save(file_, Over::anything) && then) leave(*then);
        return;
    }
    if (offer_ && !leaving_) {
        if (answer == Answer::restore) restore();
        unsaved_work_.discard_found();
        return find_unsaved();
    }
    if (!leaving_) return;
    const Leaving leaving = *leaving_;
    leaving_.reset();
    if (answer == Answer::save && save(file_)) leave(leaving);
    if (answer == Answer::save && settings_.save_as) leaving_ = leaving;
    if (overwriting_) overwriting_->then = leaving;
    if (answer == Answer::discard) discard(leaving);
}

// What a person has seen and does not want: of the other set they are asked next.
void PlaygroundWindow::discard(const Leaving& leaving) {
    playground_.tweaks.forget_waiting();
    const bool is_way_out =
        leaving.what == Leaving::For::quit || leaving.what == Leaving::For::open;
    if (!is_way_out || !hides_work()) return go(leaving);
    revert();
    leave(leaving);
}

void PlaygroundWindow::open(const fs::path& file) {
    keep_picture();
    let_go_of_work();
    if (file != file_ && !file_.empty()) {
        options_.size.clear();
        options_.tweaks.clear();
        options_.quality.clear();
    }
    stay_with_scene();
    file_ = file;
    values_known_ = false;
    settings_.probe = {};
    probe_.stop();
    overwriting_.reset();
    unsaved_work_.leave_found();
    restored_.clear();
    offer_.reset();
    study_.clear();
    check_.clear();
    settings_.shown = Shown::scene;
    settings_.free_aspect = false;
    place_ = canonical_name(file);
    crash_mark_.set(place_);
    resolution_begun_ = false;
    begin_start();
    playground_.open(file);
    folder_ = file.has_parent_path() ? file.parent_path() : ".";
    list_files();
    dirty_ = true;
}

// It is drawn on, and may be worked on, until what is opened can be shown.
void PlaygroundWindow::stay_with_scene() {
    if (!playground_.is_open()) return;
    const bool is_files = values_known_ || playground_.as_written() || !left_;
    left_ = Left{is_files ? place_ : left_->place, preset_to_save()};
    begin_work();
    for (const TweakSet set : kTweakSets) at_rest_[place_of(set)] = playground_.tweaks.values(set);
}

// Another scene is about to take its place, unasked: what was done to it since it was left waits
// for who opens it again.
void PlaygroundWindow::leave_scene() {
    stop_recording();
    bool has_any = false;
    for (const TweakSet set : kTweakSets) {
        if (!has_work(set)) continue;
        keep_now(set);
        has_any = true;
    }
    unsaved_work_.leave();
    if (has_any)
        notice(fmt::format("What was changed in {} is kept, and offered where that is opened again",
                           left_->place.filename().string()));
    left_.reset();
    begin_work();
}

// On what nobody has worked on yet.
void PlaygroundWindow::begin_work() {
    worked_in_ = {};
    at_rest_ = {};
    kept_ = {};
    recorded_.clear();
    start_time_.reset();
    watch_.reset();
}

// Shows what there is to choose from. What is open stays.
void PlaygroundWindow::browse(const fs::path& folder) {
    folder_ = folder;
    if (!file_.empty()) settings_.browser = true;  // else it fills the window
    list_files();
    dirty_ = true;
}

void PlaygroundWindow::list_files() {
    constexpr std::size_t kMostRecent = 6;
    std::vector<fs::path> recent = recent_.files();
    std::erase(recent, place_);
    recent.resize(std::min(recent.size(), kMostRecent));
    std::vector<fs::path> near = nearby_files(folder_ / "file"), shipped;
    // Who names neither a file nor a folder may have none yet.
    if (options_.file.empty() && file_.empty()) shipped = examples();
    std::erase_if(shipped, [&](const fs::path& example) {
        return std::ranges::any_of(near, [&](const fs::path& file) {
            return canonical_name(file) == canonical_name(example);
        });
    });
    browser_.list(
        {{"Recent", std::move(recent)}, {"Examples", std::move(shipped)}, {"", std::move(near)}});
}

void PlaygroundWindow::make_new_scene(const NewScene& wanted) {
    leave({Leaving::For::open, wanted.file, wanted.from});
}

// What is no text is no scene, and takes no scene's place.
void PlaygroundWindow::take_dropped(const fs::path& file) {
    std::error_code error;
    const std::string name = file.filename().string();
    if (!fs::exists(file, error)) return notice(fmt::format("There is no {}.", name));
    if (!fs::is_directory(file, error) && read_text(file).find('\0') != std::string::npos)
        return notice(
            fmt::format("{} is no scene; a scene's text names its pictures and sounds.", name));
    leave({Leaving::For::open, file});
}

void PlaygroundWindow::import_or_open(const fs::path& file) {
    std::error_code error;
    if (!is_shadertoy(file) && fs::is_directory(file, error)) return browse(file);
    if (!is_shadertoy(file)) return open(file);
    const ImportedBeside imported = import_beside(file);
    notice(imported.notice);
    if (!imported.scene.empty()) open(imported.scene);
}

// What is on the screen: where the picture fills the window, its size is the window's.
Preset PlaygroundWindow::preset_to_save() const {
    Preset preset = playground_.current_preset();
    preset.time = start_time_.value_or((written() ? written() : playground_.preset())->time);
    preset.watch = watch();
    const std::optional<glm::ivec2> frame = frame_size();
    const bool is_free = !frame || settings_.free_aspect;
    const double scale = static_cast<double>(window_.content_scale());
    preset.size =
        is_free ? glm::max(glm::ivec2(glm::round(glm::dvec2(window_.size()) / scale)), 1) : *frame;
    if (std::vector<Event> events = unsaved_events(); !events.empty())
        preset.events = std::move(events);
    return preset;
}

// False where it could not be done, or is asked for first; the notice says why.
bool PlaygroundWindow::save(const fs::path& file, Over over) {
    if (!playground_.is_open()) return false;
    // What is on the screen is another scene's, or an older text's.
    if (file == file_ && !is_gone() && (!values_known_ || playground_.shows_older_text())) {
        notice(fmt::format(
            "{} is not saved while it, or its scene, has errors; Save as\u2026 takes another name.",
            file.filename().string()));
        return false;
    }
    std::error_code unknown;
    if (file == file_ && over == Over::nothing_unread && fs::exists(file, unknown) &&
        !playground_.is_as_read(read_text(file))) {
        overwriting_ = Overwriting();
        return false;
    }
    stop_recording();
    const Preset preset = preset_to_save();
    if (!write_look(preset, file)) return false;
    if (file == file_) unsaved_work_.forget_aside();
    notice(fmt::format("{} saved", file.filename().string()));
    recorded_.clear();
    start_time_.reset();
    watch_.reset();
    if (file == file_)
        playground_.note_saved(preset);
    else if (values_known_)  // of an older text, too: the newest one, once mended, goes on from it
        go_on_in(file, preset);
    else
        open(file);
    return true;
}

// Deleted, as others see it; the work that is on the screen is all that is left of it.
bool PlaygroundWindow::is_gone() const {
    std::error_code unknown;
    return values_known_ && playground_.as_written() && !fs::exists(file_, unknown);
}

// Into what the file holds of the same scene, or else into a copy of the preset that is open.
bool PlaygroundWindow::write_look(const Preset& preset, const fs::path& file) {
    const fs::path from = shown_file();
    std::string model = read_text(file);
    if (!names_scene(model, file, preset.scene)) model = is_preset(from) ? read_text(from) : "";
    const PresetText text = write_preset(preset, file, model);
    if (!text.text) {
        notice(text.diagnostics.empty() ? "The preset cannot be saved."
                                        : to_string(text.diagnostics.front()));
        return false;
    }
    try {
        write_whole_file(file, std::as_bytes(std::span(*text.text)), Haste::no);
    } catch (const std::runtime_error& error) {
        notice(error.what());
        settings_.save_as = true;  // some other place will take it
        return false;
    }
    return true;
}

// The same scene, on the screen as it is, under another file's name.
void PlaygroundWindow::go_on_in(const fs::path& file, const Preset& preset) {
    options_.size.clear();
    options_.tweaks.clear();
    options_.quality.clear();
    file_ = file;
    place_ = canonical_name(file);
    crash_mark_.set(place_);
    recent_.add(file);
    unsaved_work_.forget();
    kept_ = {};
    settings_.free_aspect = false;
    folder_ = file.has_parent_path() ? file.parent_path() : ".";
    list_files();
    playground_.go_on_in(file, preset);
    dirty_ = true;
}

void PlaygroundWindow::revert() {
    if (!written()) return;
    const bool is_undone = playground_.tweaks.values() != written()->values;
    playground_.tweaks.set_all(written()->values);
    playground_.tweaks_changed();
    playground_.tweaks.set_locks(written()->locked);
    playground_.forget_fills();
    recorded_.clear();
    start_time_.reset();
    watch_.reset();
    unsaved_work_.forget_aside();
    const std::string how =
        is_undone ? fmt::format("; {} takes it back", keys_of(Action::undo)) : "";
    notice(fmt::format("Reverted to {}{}", shown_file().filename().string(), how));
}

void PlaygroundWindow::tell_overruled() {
    const std::vector<std::string> names = playground_.take_overruled();
    if (names.empty()) return;
    // Undo has what stood here; the next window offers it where nothing is saved before.
    const std::size_t shown = place_of(playground_.tweaks.shown());
    if (kept_[shown]) unsaved_work_.set_aside(shown);
    kept_[shown].reset();
    notice(fmt::format("{} was edited, and says otherwise of {}; {} brings back what stood here",
                       file_.filename().string(), fmt::join(names, ", "), keys_of(Action::undo)));
}

void PlaygroundWindow::toggle_recording() {
    if (!playground_.is_open()) return notice("Nothing is open.");
    if (!records_) return leave({Leaving::For::record, {}});
    stop_recording();
    tell_recorded();
}

void PlaygroundWindow::tell_recorded() {
    notice(recorded_.empty()
               ? "Nothing was done, and nothing is recorded"
               : fmt::format("Recorded, {} events in all; save the preset to keep them",
                             recorded_.size()));
}

void PlaygroundWindow::stop_recording() {
    if (!std::exchange(records_, false)) return;
    const double end = playground_.recorder.end();
    recorded_ = with_written_events(playground_.recorder.stop(), end);
    kept_ = {};
}

// Where time goes back, a recording has ended with what was done until then.
void PlaygroundWindow::follow_recording() {
    if (!records_ || playground_.recorder.recording()) return;
    stop_recording();
    tell_recorded();
}

// The command line's tweaks, and the values that it names by --quality, are changes like those by
// hand: unsaved, and undo takes them back.
void PlaygroundWindow::lay_options_over() {
    if (options_.tweaks.empty() && options_.quality.empty()) return;
    Preset preset = playground_.current_preset();
    try {
        for (const std::string& clamped : lay_over(preset, options_)) {
            say_warning(clamped);
            notice(clamped);
        }
    } catch (const UsageError& error) {
        return notice(error.what());  // a text that had no such tweak at the start could not tell
    }
    playground_.tweaks.set_all(preset.values);
    playground_.tweaks_changed();
}

}  // namespace glint
