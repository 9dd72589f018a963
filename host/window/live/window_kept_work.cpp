// What is kept of unsaved work, of both sets of tweaks, for the run after a crash, and its offer.
#include "base/canonical_name.h"
#include "scene/look_changes.h"
#include "scene/preset_writer.h"
#include "scene/toml_text.h"
#include "window/live/playground_window.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

bool same(std::span<const Event> a, std::span<const Event> b) {
    return std::ranges::equal(a, b, [](const Event& x, const Event& y) {
        return x.time == y.time && x.key == y.key && x.down == y.down && x.mouse == y.mouse;
    });
}

// The channels as a preset spells them.
std::vector<std::string> channel_texts(const Preset& preset) {
    std::vector<std::string> texts;
    for (const Sampler& channel : preset.channels)
        texts.push_back(
            toml_braces(toml_channel(channel, preset.scene, preset.file.parent_path())));
    return texts;
}

// Unsaved work reads and writes its text as if it stood here.
fs::path place_beside(const fs::path& place) {
    return place.parent_path() / "unsaved.toml";
}

}  // namespace

// In the set that is shown, or behind it. What waits for its tweak is no change that could be
// saved, and none that may be lost.
bool PlaygroundWindow::has_work(TweakSet set) const {
    if (set != playground_.tweaks.shown()) return hides_work();
    return is_unsaved() || (values_known_ && !playground_.tweaks.waiting().empty());
}

bool PlaygroundWindow::is_keeping_due(TweakSet set) const {
    const std::optional<Kept>& kept = kept_[place_of(set)];
    return has_work(set) ? kept != work(set) : kept.has_value();
}

bool PlaygroundWindow::is_keeping_due() const {
    if (!written()) return false;
    return std::ranges::any_of(kTweakSets, [&](TweakSet set) { return is_keeping_due(set); });
}

// Where a person has been asked, or nothing is left to ask of.
void PlaygroundWindow::let_go_of_work() {
    unsaved_work_.forget();
    if (values_known_ && !playground_.tweaks.waiting().empty())
        keep_now(playground_.tweaks.shown());
    unsaved_work_.leave();
}

PlaygroundWindow::Kept PlaygroundWindow::work(TweakSet set) const {
    const Preset now = preset_to_save();
    return {playground_.tweaks.values(set),
            written()->values,
            unsaved_events().size(),
            channel_texts(*playground_.preset()),
            now.locked,
            now.watch,
            now.time,
            playground_.tweaks.waiting()};
}

// Whether the set that is shown has work that would be lost once it is hidden.
void PlaygroundWindow::note_work() {
    if (!written()) return;
    const std::vector<TweakValue>& file = written()->values;
    for (const TweakSet set : kTweakSets) {
        const std::vector<TweakValue> values = playground_.tweaks.values(set);
        std::vector<TweakValue>& at_rest = at_rest_[place_of(set)];
        // Another text may have more tweaks, or fewer.
        const bool is_other_text = !at_rest.empty() && values.size() != at_rest.size();
        if (at_rest.empty()) at_rest = file;
        const bool has_rested = is_other_text && !worked_in_[place_of(set)];
        if (values == file || has_rested) at_rest = values;
    }
    // What waits for a tweak to come back is work, too.
    const TweakSet shown = playground_.tweaks.shown();
    worked_in_[place_of(shown)] =
        has_worked(shown) || (values_known_ && !playground_.tweaks.waiting().empty());
}

// As soon as something changes, and before the frame that shows it, which may be the last one.
void PlaygroundWindow::keep_unsaved() {
    note_work();
    if (!written()) return;
    for (const TweakSet set : kTweakSets) keep_unsaved(set);
}

void PlaygroundWindow::keep_unsaved(TweakSet set) {
    if (!is_keeping_due(set)) return;
    std::optional<Kept>& kept = kept_[place_of(set)];
    if (!has_work(set)) {
        unsaved_work_.forget(place_of(set));
        return kept.reset();
    }
    if (!kept || since_kept_.ms() >= kKeepPeriod * 1000.0) keep_now(set);
}

void PlaygroundWindow::keep_now(TweakSet set) {
    since_kept_.restart();
    kept_[place_of(set)] = work(set);
    Preset preset = preset_to_save();
    preset.values = playground_.tweaks.values(set);
    const fs::path& place = left_ ? left_->place : place_;
    Preset file = left_ ? left_->look : playground_.without_fills();
    for (const TweakValues::Waiting& one : playground_.tweaks.waiting()) {
        preset.scene.tweaks.push_back(one.tweak);
        preset.values.push_back(one.value);
        file.scene.tweaks.push_back(one.tweak);
        file.values.push_back(one.written);
    }
    const PresetText text = write_preset(preset, place_beside(place));
    const PresetText says = write_preset(file, place_beside(place));
    try {
        if (!text.text) throw std::runtime_error(to_string(text.diagnostics.front()));
        unsaved_work_.keep(place, {*text.text, says.text}, place_of(set));
    } catch (const std::runtime_error& error) {
        notice(fmt::format("Unsaved work cannot be kept for the next start. {}", error.what()));
    }
}

// Nobody can be asked any more.
void PlaygroundWindow::keep_at_end() {
    stop_recording();
    if (!written()) return;
    for (const TweakSet set : kTweakSets)
        if (has_work(set)) keep_now(set);
}

// The set that has it once it is restored: what was restored before stays, for of the last run's
// two sets this is the other one.
TweakSet PlaygroundWindow::offered_set() const {
    return restored_.empty() ? playground_.tweaks.shown() : other_set(restored_.front());
}

// The work that is offered, as a look of the text on the screen, which may change meanwhile: laid
// over what the file says by now.
ReadPreset PlaygroundWindow::read_offer() const {
    const Preset& shown = *playground_.preset();
    const Preset& now = *playground_.as_written();
    ReadPreset read = parse_preset(offer_->text, place_beside(place_), shown.scene);
    if (!read.preset || !offer_->written) return read;
    const std::optional<Preset> then =
        parse_preset(*offer_->written, place_beside(place_), shown.scene).preset;
    if (!then) return read;
    Preset& look = *read.preset;
    TweakValues tweaks(shown.scene.tweaks, playground_.tweaks.values(offered_set()));
    tweaks.set_locks(playground_.tweaks.locks());
    lay_changes_over(*then, look, tweaks);
    look.values = tweaks.values();
    look.locked = tweaks.locks();
    std::ranges::copy(locks_without_tweak(now), std::back_inserter(look.locked));
    if (same(look.events, then->events)) look.events = now.events;
    if (look.watch == then->watch) look.watch = now.watch;
    if (look.time == then->time) look.time = now.time;
    const std::vector<std::string> found = channel_texts(look), before = channel_texts(*then);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i] == before[i]) look.channels[i] = shown.channels[i];
    return read;
}

// Whether nobody would see that it was restored.
bool PlaygroundWindow::says_what_stands(const Preset& look) const {
    const TweakValues& tweaks = playground_.tweaks;
    const Preset& written = *playground_.as_written();
    const bool has_values =
        look.values == tweaks.values() || look.values == tweaks.values(offered_set());
    return has_values && same(look.events, playground_.preset()->events) &&
           std::ranges::is_permutation(look.locked, written.locked) && look.watch == watch() &&
           look.time == written.time && channel_texts(look) == channel_texts(*playground_.preset());
}

// The newest work that a run has left on this file, unless it is what the file says anyway. Where
// both sets have some already, the next start offers it.
void PlaygroundWindow::find_unsaved() {
    offer_.reset();
    if (restored_.size() == kTweakSets.size()) return;
    while ((offer_ = unsaved_work_.find(place_))) {
        const ReadPreset read = read_offer();
        if (read.preset && !says_what_stands(*read.preset)) return;
        if (!read.preset)
            notice(fmt::format("The work that was kept of {} is damaged; it stays in {}.",
                               place_.filename().string(), unsaved_work_.found_folder().string()));
        // Tweaks that the text lacks today it may have again tomorrow.
        if (!read.diagnostics.empty())
            unsaved_work_.pass_found();
        else
            unsaved_work_.discard_found();
    }
}

void PlaygroundWindow::restore() {
    const ReadPreset read = read_offer();
    if (!read.preset) return;
    playground_.tweaks.show(offered_set());
    restored_.push_back(playground_.tweaks.shown());
    if (!same(read.preset->events, playground_.as_written()->events))
        recorded_ = read.preset->events;
    const std::vector<std::string> mine = channel_texts(*playground_.preset());
    const std::vector<std::string> found = channel_texts(*read.preset);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i] != mine[i]) playground_.fill(read.preset->channels[i]);
    playground_.tweaks.set_all(read.preset->values);
    playground_.tweaks.set_locks(read.preset->locked);
    if (read.preset->watch != watch()) watch_ = read.preset->watch;
    if (read.preset->time != playground_.as_written()->time) start_time_ = read.preset->time;
    playground_.tweaks_changed();
    if (is_unsaved()) keep_now(playground_.tweaks.shown());  // before what was found goes
}

}  // namespace glint
