// Whether what happens to a file is a save, and when it is worth telling: at once where nothing
// more is to come, after a short quiet where more may.
//
// These are the watcher's decisions alone: it asks no system and no clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace glint {

// What tells one state of a file from another; `inode` 0: there is none.
struct FileStamp {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0;                        // bytes
    std::int64_t modified_ns = 0, status_ns = 0;  // since 1970
    std::uint32_t mode = 0;
    bool operator==(const FileStamp&) const = default;

    bool is_gone() const { return inode == 0; }
    bool is_empty() const { return size == 0; }
};

// Whether a file that was looked at, and not heard of, is another than when it was last reported.
// Where the system tells of changes (`told_of_names`), one of rights or owner is none: editors do
// that after a save, and it was heard.
bool is_another(const FileStamp& reported, FileStamp now, bool told_of_names);

// What the system tells of a file, or of the names and links on the way to it.
enum class FileEvent {
    closed,      // by one who could write
    written,     // and still open
    readable,    // rights have changed, so that it may be readable at last
    came,        // its name is new: what will be written to it is to come
    moved_in,    // a file came to its name by a move: it is whole
    led_away,    // a link on the way leads elsewhere
    went,        // deleted, or moved away
    folder_went  // a folder on the way was moved or deleted
};

class SaveNotice {
public:
    using Time = std::chrono::steady_clock::time_point;

    // `now` is what stands at the end of the way afterwards.
    void heard(FileEvent event, const FileStamp& now, Time at);
    // The system lost count of what it had to tell.
    void lost_count(const FileStamp& now, Time at);
    // Nobody told, but it is another (is_another).
    void found(const FileStamp& now, Time at);
    // Nobody would tell of more: it was looked at once again when it was due, and is another still.
    void grew(Time at);

    // Whether anything has happened that was not reported.
    bool is_pending() const { return ready_ || due_; }
    // Whether nothing more is to come, as far as can be told: it is to be reported at once.
    bool is_whole() const { return ready_; }
    // Whether it is to be reported by now.
    bool is_due(Time now) const { return ready_ || (due_ && *due_ <= now); }
    // When it will be; nothing when nothing is pending.
    std::optional<Time> due() const { return ready_ ? Time() : due_; }
    // It was: what happens from now on is another save.
    void reported() { *this = {}; }

private:
    void saved(const FileStamp& now, Time at);
    void wait(std::chrono::milliseconds quiet, Time at);

    bool ready_ = false;         // at once
    std::optional<Time> due_;    // then, if nothing more happens
    std::optional<Time> since_;  // when what `due_` waits for began
};

}  // namespace glint
