#include "scene/tweak_values.h"

#include "base/words.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

namespace glint {

namespace {

bool is_float_type(const Tweak& tweak) {
    return tweak.type != TweakType::int1 && tweak.type != TweakType::bool1;
}

bool same_bits(const TweakValue& a, const TweakValue& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    });
}

// The double with the shortest decimal that rounds to this float.
double shortest(float value) {
    char text[32];
    const char* end = std::to_chars(text, text + sizeof text, value).ptr;
    double number = value;
    std::from_chars(text, end, number);
    return number;
}

double tidy_component(const Tweak& tweak, double value) {
    const auto seen = static_cast<float>(value);
    if (!std::isfinite(seen)) return value;
    const double byte = std::round(value * 255.0) / 255.0;
    const bool is_byte = tweak.is_colour && byte >= 0.0 && byte <= 1.0;
    return is_byte && static_cast<float>(byte) == seen ? byte : shortest(seen);
}

std::optional<std::size_t> option_index(const Tweak& menu, std::string_view option) {
    const auto found = std::ranges::find(menu.names, option);
    if (found == menu.names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - menu.names.begin());
}

// "" if the tweak is no menu.
std::string option_of(const Tweak& tweak, const TweakValue& value) {
    const bool is_option = value[0] >= 0.0 && value[0] < static_cast<double>(tweak.names.size());
    return is_option ? tweak.names[static_cast<std::size_t>(value[0])] : std::string();
}

// O'Neill's PCG, RXS-M-XS with 32 bits of state (HMC-CS-2014-0905), as a hash of one step.
std::uint32_t pcg(std::uint32_t input) {
    const std::uint32_t state = input * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// FNV-1a.
std::uint32_t hash(std::string_view name) {
    std::uint32_t sum = 2166136261u;
    for (const char c : name) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619u;
    return sum;
}

// `share` of the way from one end of the range to the other; below 1.
double at_share(const Tweak& tweak, double share) {
    const double min = *tweak.min, max = *tweak.max;
    if (tweak.log && min > 0.0) {
        const double value = std::exp(std::lerp(std::log(min), std::log(max), share));
        return tweak.type == TweakType::int1 ? std::round(value) : value;
    }
    if (tweak.type == TweakType::int1) return min + std::floor(share * (max - min + 1.0));
    return std::lerp(min, max, share);
}

double random_component(const Tweak& tweak, double share) {
    if (tweak.type == TweakType::bool1) return share < 0.5 ? 0.0 : 1.0;
    if (!tweak.names.empty()) return std::floor(share * static_cast<double>(tweak.names.size()));
    if (tweak.is_colour && !tweak.min) return std::floor(share * 256.0) / 255.0;
    const double value = at_share(tweak, share);
    if (tweak.step <= 0.0) return value;
    return *tweak.min + std::round((value - *tweak.min) / tweak.step) * tweak.step;
}

}  // namespace

TweakValue tidy(const Tweak& tweak, const TweakValue& value) {
    TweakValue plain = value;
    if (is_float_type(tweak))
        for (double& component : plain) component = tidy_component(tweak, component);
    return clamp_to_range(tweak, plain);
}

bool is_changed(const Tweak& tweak, const TweakValue& value) {
    if (!is_float_type(tweak)) return value[0] != tweak.initial[0];
    return !std::equal(value.begin(), value.end(), tweak.initial.begin(), [](double a, double b) {
        return static_cast<float>(a) == static_cast<float>(b);
    });
}

TweakValue rebased(const Tweak& before, const TweakValue& value, const Tweak& after) {
    if (before.type != after.type || !is_changed(before, value)) return after.initial;
    if (before.names.empty() || after.names.empty()) return clamp_to_range(after, value);
    const auto index = option_index(after, option_of(before, value));
    return index ? TweakValue{static_cast<double>(*index)} : after.initial;
}

bool takes_random(const Tweak& tweak) {
    const bool has_range =
        tweak.min || tweak.is_colour || !tweak.names.empty() || tweak.type == TweakType::bool1;
    return has_range && !tweak.quality && !tweak.no_random && tweak.group != "Camera";
}

TweakValue random_value(const Tweak& tweak, const TweakValue& value, std::uint32_t seed) {
    if (!takes_random(tweak)) return value;
    const std::uint32_t first = pcg(seed ^ pcg(hash(tweak.name)));
    TweakValue random = value;
    // How opaque a colour is, is no matter of taste.
    const int components = tweak.is_colour ? 3 : component_count(tweak.type);
    for (int i = 0; i < components; ++i) {
        const double share = pcg(first + static_cast<std::uint32_t>(i)) * 0x1p-32;
        random[static_cast<std::size_t>(i)] = random_component(tweak, share);
    }
    return tidy(tweak, random);
}

TweakValues::TweakValues(std::span<const Tweak> tweaks, std::span<const TweakValue> values) {
    assert(values.empty() || values.size() == tweaks.size());
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const TweakValue value = values.empty() ? tweaks[i].initial : values[i];
        held_.push_back({tweaks[i], {value, value}, value});
    }
}

std::vector<TweakValue> TweakValues::values(TweakSet set) const {
    std::vector<TweakValue> values;
    for (const Held& held : held_) values.push_back(held.values[place_of(set)]);
    return values;
}

const TweakValue& TweakValues::value(std::size_t index) const {
    return held_[index].values[place_of(shown_)];
}

bool TweakValues::changed(std::size_t index) const {
    return is_changed(held_[index].tweak, value(index));
}

bool TweakValues::any_changed() const {
    for (std::size_t i = 0; i < held_.size(); ++i)
        if (changed(i)) return true;
    return false;
}

void TweakValues::set_written(std::span<const TweakValue> values) {
    assert(values.size() == held_.size());
    for (std::size_t i = 0; i < held_.size(); ++i) held_[i].written = values[i];
}

bool TweakValues::is_as_written(std::size_t index) const {
    return same_bits(value(index), held_[index].written);
}

void TweakValues::begin() {
    commit();
    history_.begin(shown_);
}

void TweakValues::commit() {
    if (!is_open()) return;
    HistoryEntry& entry = history_.entry();
    for (HistoryEntry::Change& change : entry.changes) {
        Held& held = *find(change.name);
        change.after = keep(held.tweak, slot(held, entry.set));
    }
    std::erase_if(entry.changes, [](const HistoryEntry::Change& change) {
        return change.before.type != change.after.type ||
               same_bits(change.before.value, change.after.value);
    });
    history_.commit();
}

void TweakValues::cancel() {
    if (!is_open()) return;
    const HistoryEntry entry = history_.cancel();
    for (const HistoryEntry::Change& change : entry.changes)
        restore(*find(change.name), entry.set, change.before);
}

template <typename Changes>
void TweakValues::as_one_entry(const Changes& changes) {
    const bool alone = !is_open();
    if (alone) begin();
    changes();
    if (alone) commit();
}

void TweakValues::set(std::size_t index, const TweakValue& value) {
    as_one_entry([&] { change(shown_, index, tidy(held_[index].tweak, value)); });
}

void TweakValues::set_all(std::span<const TweakValue> values) {
    assert(values.size() == held_.size());
    as_one_entry([&] {
        for (std::size_t i = 0; i < held_.size(); ++i)
            change(shown_, i, clamp_to_range(held_[i].tweak, values[i]));
    });
}

void TweakValues::reset(std::size_t index) {
    if (is_as_written(index)) return reset_to_default(index);
    as_one_entry([&] { change(shown_, index, held_[index].written); });
}

void TweakValues::reset_to_default(std::size_t index) {
    as_one_entry([&] { change(shown_, index, held_[index].tweak.initial); });
}

void TweakValues::change_all_to(const TweakValue& (*wanted)(const Held&)) {
    as_one_entry([&] {
        for (std::size_t i = 0; i < held_.size(); ++i) change(shown_, i, wanted(held_[i]));
    });
}

void TweakValues::reset_all() {
    for (std::size_t i = 0; i < held_.size(); ++i)
        if (!is_as_written(i))
            return change_all_to(
                [](const Held& held) -> const TweakValue& { return held.written; });
    reset_all_to_defaults();
}

void TweakValues::reset_all_to_defaults() {
    change_all_to([](const Held& held) -> const TweakValue& { return held.tweak.initial; });
}

void TweakValues::randomise(std::uint32_t seed) {
    as_one_entry([&] {
        for (std::size_t i = 0; i < held_.size(); ++i)
            if (!held_[i].locked) change(shown_, i, random_value(held_[i].tweak, value(i), seed));
    });
}

void TweakValues::lock(std::size_t index, bool locked) {
    held_[index].locked = locked;
}

bool TweakValues::locked(std::size_t index) const {
    return held_[index].locked;
}

std::vector<std::string> TweakValues::locks() const {
    std::vector<std::string> names;
    for (const Held& held : held_)
        if (held.locked) names.push_back(held.tweak.name);
    return names;
}

void TweakValues::set_locks(std::span<const std::string> names) {
    for (Held& held : held_) held.locked = std::ranges::find(names, held.tweak.name) != names.end();
}

bool TweakValues::undo() {
    while (const HistoryEntry* entry = history_.undo())
        if (put_back(*entry, &HistoryEntry::Change::before)) return true;
    return false;
}

bool TweakValues::redo() {
    while (const HistoryEntry* entry = history_.redo())
        if (put_back(*entry, &HistoryEntry::Change::after)) return true;
    return false;
}

void TweakValues::show(TweakSet set) {
    commit();
    shown_ = set;
}

void TweakValues::copy_to_other() {
    commit();
    const TweakSet other = other_set(shown_);
    history_.begin(other);
    for (std::size_t i = 0; i < held_.size(); ++i) change(other, i, value(i));
    commit();
}

void TweakValues::follow_hidden(std::size_t index, const TweakValue& was, const TweakValue& now) {
    TweakValue& value = slot(held_[index], other_set(shown_));
    if (value == was) value = clamp_to_range(held_[index].tweak, now);
}

bool TweakValues::apply(const TweakEdit& edit) {
    const auto stand = [this] {
        return std::tuple(values(TweakSet::a), values(TweakSet::b), shown_);
    };
    const auto before = stand();
    obey(edit);
    return stand() != before;
}

void TweakValues::obey(const TweakEdit& edit) {
    using What = TweakEdit::What;
    switch (edit.what) {
        case What::set:
            return set(edit.index, edit.value);
        case What::reset:
            return reset(edit.index);
        case What::reset_to_default:
            return reset_to_default(edit.index);
        case What::reset_all:
            return reset_all();
        case What::reset_all_to_defaults:
            return reset_all_to_defaults();
        case What::randomise:
            return randomise(edit.seed);
        case What::lock:
        case What::unlock:
            return lock(edit.index, edit.what == What::lock);
        case What::begin:
            return begin();
        case What::commit:
            return commit();
        case What::undo:
            undo();
            return;
        case What::redo:
            redo();
            return;
        case What::show:
            return show(edit.shown);
        case What::copy_to_other:
            return copy_to_other();
    }
}

void TweakValues::rebase(std::span<const Tweak> tweaks, std::span<const TweakValue> written) {
    assert(written.empty() || written.size() == tweaks.size());
    std::vector<Held> held;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const Tweak& tweak = tweaks[i];
        const TweakValue& says = written.empty() ? tweak.initial : written[i];
        held.push_back({tweak, {says, says}, says});
        const Held* old = find(tweak.name);
        if (!old) continue;
        held.back().locked = old->locked;
        if (old->tweak.type != tweak.type) continue;
        // What comes back untouched has what the file says by now. What never went is moved by who
        // knows what the file said before, in a step that can be undone.
        const bool was_gone = old >= absent_.data() && old < absent_.data() + absent_.size();
        for (std::size_t set = 0; set < 2; ++set)
            if (written.empty() || !was_gone || !same_bits(old->values[set], old->written))
                held.back().values[set] = rebased(old->tweak, old->values[set], tweak);
    }
    std::move(absent_.begin(), absent_.end(), std::back_inserter(held_));
    absent_ = std::exchange(held_, std::move(held));
    std::erase_if(absent_, [&](const Held& old) {
        return std::ranges::any_of(
            tweaks, [&](const Tweak& tweak) { return tweak.name == old.tweak.name; });
    });
}

std::vector<TweakValues::Waiting> TweakValues::waiting() const {
    std::vector<Waiting> list;
    for (const Held& held : absent_) {
        const TweakValue& value = held.values[place_of(shown_)];
        if (value != held.written) list.push_back({held.tweak, value, held.written});
    }
    return list;
}

KeptValue TweakValues::keep(const Tweak& tweak, const TweakValue& value) {
    return {value, tweak.type, option_of(tweak, value)};
}

// Puts a value back, as far as type, options and range admit it; whether that changed anything.
bool TweakValues::restore(Held& held, TweakSet set, const KeptValue& kept) {
    if (kept.type != held.tweak.type) return false;
    TweakValue value = kept.value;
    if (!kept.option.empty() && !held.tweak.names.empty()) {
        const auto index = option_index(held.tweak, kept.option);
        if (!index) return false;
        value[0] = static_cast<double>(*index);
    }
    value = clamp_to_range(held.tweak, value);
    return !same_bits(std::exchange(slot(held, set), value), value);
}

TweakValue& TweakValues::slot(Held& held, TweakSet set) {
    return held.values[place_of(set)];
}

TweakValues::Held* TweakValues::find(std::string_view name) {
    const auto is_it = [name](const Held& held) { return held.tweak.name == name; };
    for (std::vector<Held>* list : {&held_, &absent_}) {
        const auto found = std::ranges::find_if(*list, is_it);
        if (found != list->end()) return &*found;
    }
    return nullptr;
}

void TweakValues::change(TweakSet set, std::size_t index, const TweakValue& value) {
    Held& held = held_[index];
    if (same_bits(slot(held, set), value)) return;
    history_.note(held.tweak.name, keep(held.tweak, slot(held, set)));
    slot(held, set) = value;
}

// Whether anything that is there has changed.
bool TweakValues::put_back(const HistoryEntry& entry, KeptValue HistoryEntry::Change::*side) {
    bool visible = false;
    for (const HistoryEntry::Change& change : entry.changes) {
        Held& held = *find(change.name);
        const bool restored = restore(held, entry.set, change.*side);
        visible =
            visible || (restored && &held >= held_.data() && &held < held_.data() + held_.size());
    }
    if (visible) shown_ = entry.set;
    return visible;
}

}  // namespace glint
