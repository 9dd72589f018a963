// What was done to the tweaks, so that it can be taken back. It knows no current value: those are
// TweakValues', which tells it what stood before a change and asks it what to put back.
//
// Changes are kept by name, and say enough of the tweak to be put back into another text of the
// scene.
#pragma once

#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace glint {

// Two sets of values, of which one is shown.
enum class TweakSet { a, b };
inline constexpr std::array kTweakSets = {TweakSet::a, TweakSet::b};
constexpr std::size_t place_of(TweakSet set) {
    return set == TweakSet::a ? 0 : 1;
}
constexpr TweakSet other_set(TweakSet set) {
    return set == TweakSet::a ? TweakSet::b : TweakSet::a;
}

// A value that outlives its tweak.
struct KeptValue {
    TweakValue value{};
    TweakType type = TweakType::float1;
    std::string option{};  // the name that stands for it in a menu; "" in others
};

// One thing that a person has done: the drag of a slider, a random look.
struct HistoryEntry {
    struct Change {
        std::string name;  // of the tweak
        KeptValue before, after;
    };
    TweakSet set = TweakSet::a;
    std::vector<Change> changes;
};

// A list of entries with a place in it, and the entry that is being made.
class History {
public:
    // Begins an entry. One must not be open.
    void begin(TweakSet set);
    bool is_open() const { return open_; }
    // The entry that is open.
    HistoryEntry& entry() { return entry_; }
    // A tweak has had this value until now; only its first change in an entry counts.
    void note(const std::string& name, const KeptValue& before);
    // Ends the entry, whose `after` is filled; an empty one leaves no trace. What was undone before
    // cannot be redone any more. The last 1000 entries are kept.
    void commit();
    // Ends the entry and forgets it.
    HistoryEntry cancel();

    // One step back or on: the entry to be put back, valid until the next call; null where there is
    // none left, or while one is open.
    const HistoryEntry* undo();
    const HistoryEntry* redo();
    bool can_undo() const { return done_ > 0 && !open_; }
    bool can_redo() const { return done_ < entries_.size() && !open_; }

private:
    std::vector<HistoryEntry> entries_;
    std::size_t done_ = 0;  // how many of the entries are not undone
    HistoryEntry entry_;    // while open
    bool open_ = false;
};

}  // namespace glint
