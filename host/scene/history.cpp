#include "scene/history.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kMostEntries = 1000;

}  // namespace

void History::begin(TweakSet set) {
    assert(!open_);
    open_ = true;
    entry_ = {set, {}};
}

void History::note(const std::string& name, const KeptValue& before) {
    assert(open_);
    const auto known = std::ranges::find(entry_.changes, name, &HistoryEntry::Change::name);
    if (known == entry_.changes.end()) entry_.changes.push_back({name, before, {}});
}

void History::commit() {
    const HistoryEntry entry = cancel();
    if (entry.changes.empty()) return;
    entries_.resize(done_);
    entries_.push_back(entry);
    if (entries_.size() > kMostEntries) entries_.erase(entries_.begin());
    done_ = entries_.size();
}

HistoryEntry History::cancel() {
    assert(open_);
    open_ = false;
    return std::exchange(entry_, {});
}

const HistoryEntry* History::undo() {
    return can_undo() ? &entries_[--done_] : nullptr;
}

const HistoryEntry* History::redo() {
    return can_redo() ? &entries_[done_++] : nullptr;
}

}  // namespace glint
