// The values of all tweaks as they stand now. Nobody else keeps them: the renderer is told, panels
// wish, files and other processes are given a copy of the moment.
#pragma once

#include "scene/history.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// The shortest number that the shader, which counts in floats, cannot tell from this one: 0.3 for
// 0.30000001192092896; a colour's component becomes a whole 255th. In range stays in range.
TweakValue tidy(const Tweak& tweak, const TweakValue& value);

// Whether the shader sees a value other than the default.
bool is_changed(const Tweak& tweak, const TweakValue& value);

// The value of `before`, taken over to the same name in a new text of the scene: a value at the old
// default becomes the new default; another type becomes the default; a menu's value follows the
// option's name; all else is kept, clamped to the new range.
TweakValue rebased(const Tweak& before, const TweakValue& value, const Tweak& after);

// Whether a random look may move it: what has a range, a menu or a colour; not quality, the eye
// (the group "Camera"), nor what its line calls `norandom`.
bool takes_random(const Tweak& tweak);

// A random value in the range, the same for the same seed and name: even in the logarithm for log
// tweaks, on the steps for stepped ones. What takes none keeps `value`.
TweakValue random_value(const Tweak& tweak, const TweakValue& value, std::uint32_t seed);

// What a person does to the values in one go; panels wish for it.
struct TweakEdit {
    enum class What {
        set,
        reset,
        reset_to_default,
        reset_all,
        reset_all_to_defaults,
        randomise,
        lock,
        unlock,
        begin,  // of what shall be one entry of the undo list
        commit,
        undo,
        redo,
        show,
        copy_to_other,
    } what = What::set;
    std::size_t index = 0;         // set, reset…, lock, unlock: which of the scene's tweaks
    TweakValue value{};            // set
    std::uint32_t seed = 0;        // randomise
    TweakSet shown = TweakSet::a;  // show
};

// Holds two sets of values, A and B, of which one is shown and changed, and what was done to them.
// Indices are those of the scene's tweaks, and must be below size().
class TweakValues {
public:
    // Both sets start with these values, or with the defaults where there are none. They are what
    // the file says.
    explicit TweakValues(std::span<const Tweak> tweaks, std::span<const TweakValue> values = {});

    std::size_t size() const { return held_.size(); }
    // One for each tweak, within its range.
    std::vector<TweakValue> values() const { return values(shown_); }
    std::vector<TweakValue> values(TweakSet set) const;
    const TweakValue& value(std::size_t index) const;
    bool changed(std::size_t index) const;  // from its default
    bool any_changed() const;

    // What the file says: the preset, or the scene's defaults. One for each tweak.
    void set_written(std::span<const TweakValue> values);
    const TweakValue& written(std::size_t index) const { return held_[index].written; }
    bool is_as_written(std::size_t index) const;

    // What happens from begin to commit is one entry of the undo list: the drag of a slider. A
    // change outside is an entry by itself; what changes nothing is none.
    void begin();
    void commit();
    void cancel();  // takes back what was changed since begin
    bool is_open() const { return history_.is_open(); }

    void set(std::size_t index, const TweakValue& value);  // tidied and clamped
    void set_all(std::span<const TweakValue> values);      // a preset: exact, only clamped
    // To what the file says; what stands there goes on to the scene's default.
    void reset(std::size_t index);
    void reset_to_default(std::size_t index);
    void reset_all();  // the same, of all at once
    void reset_all_to_defaults();
    void randomise(std::uint32_t seed);  // all that are not locked

    void lock(std::size_t index, bool locked);  // keeps it from randomise; not undone
    bool locked(std::size_t index) const;
    // Their names, in the order of the scene. Names that the scene does not have are passed over.
    std::vector<std::string> locks() const;
    void set_locks(std::span<const std::string> names);

    // Restores values bit for bit, in the set in which they were changed, and shows that set.
    // False, and nothing happens, when there is nothing left or between begin and commit.
    bool undo();
    bool redo();
    bool can_undo() const { return history_.can_undo(); }
    bool can_redo() const { return history_.can_redo(); }

    TweakSet shown() const { return shown_; }
    void show(TweakSet set);  // commits what is open
    void copy_to_other();     // the shown values; undo takes it back
    // In the set that is not shown, what stands at `was` becomes `now`; no entry of the undo list.
    void follow_hidden(std::size_t index, const TweakValue& was, const TweakValue& now);

    // Does what a person wished for. Whether any value is another now, or another set is shown.
    bool apply(const TweakEdit& edit);

    // After a reload. Values and undo list are kept by name (see rebased); those of a tweak that
    // has gone wait for its return. Undo passes over what no longer exists or has another type.
    // `written` is what the file says now; the defaults where it is empty.
    void rebase(std::span<const Tweak> tweaks, std::span<const TweakValue> written = {});

    // Of tweaks that have gone those whose value, in the set that is shown, no file has.
    struct Waiting {
        Tweak tweak;
        TweakValue value, written;
        bool operator==(const Waiting& other) const {
            return tweak.name == other.tweak.name && value == other.value;
        }
    };
    std::vector<Waiting> waiting() const;
    void forget_waiting() { absent_.clear(); }

private:
    struct Held {
        Tweak tweak;
        std::array<TweakValue, 2> values;
        TweakValue written{};  // in the file
        bool locked = false;
    };

    static KeptValue keep(const Tweak& tweak, const TweakValue& value);
    static bool restore(Held& held, TweakSet set, const KeptValue& kept);
    static TweakValue& slot(Held& held, TweakSet set);
    Held* find(std::string_view name);  // also among the absent
    void change(TweakSet set, std::size_t index, const TweakValue& value);
    void change_all_to(const TweakValue& (*wanted)(const Held&));
    bool put_back(const HistoryEntry& entry, KeptValue HistoryEntry::Change::*side);
    void obey(const TweakEdit& edit);
    template <typename Changes>
    void as_one_entry(const Changes& changes);

    std::vector<Held> held_;    // in the order of the scene
    std::vector<Held> absent_;  // of earlier texts
    History history_;
    TweakSet shown_ = TweakSet::a;
};

}  // namespace glint
