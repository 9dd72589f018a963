#include "base/save_notice.h"

#include <algorithm>

namespace glint {
namespace {

using namespace std::chrono_literals;

// A write with no close behind it: an editor that keeps the file open, or a save in two chunks.
constexpr auto kWriteQuiet = 5ms;
// An empty file is one that was just cut off, far more often than one that shall be empty; who cut
// it off may have to wait for a processor.
constexpr auto kEmptyQuiet = 100ms;
// Nothing there: deleted, to be created again.
constexpr auto kGoneQuiet = 100ms;
// A file that is written to all the time is reported this often all the same.
constexpr auto kLongestQuiet = 250ms;

}  // namespace

bool is_another(const FileStamp& reported, FileStamp now, bool told_of_names) {
    if (told_of_names) {
        now.status_ns = reported.status_ns;
        now.mode = reported.mode;
    }
    return now != reported;
}

void SaveNotice::heard(FileEvent event, const FileStamp& now, Time at) {
    switch (event) {
        case FileEvent::closed:
        case FileEvent::moved_in:
        case FileEvent::led_away:
            return saved(now, at);
        case FileEvent::written:
        case FileEvent::readable:
        case FileEvent::came:
            return wait(kWriteQuiet, at);
        case FileEvent::went:
            return wait(kGoneQuiet, at);
        case FileEvent::folder_went:
            return wait(now.is_gone() ? kGoneQuiet : kWriteQuiet, at);
    }
}

void SaveNotice::lost_count(const FileStamp& now, Time at) {
    saved(now, at);
}

void SaveNotice::found(const FileStamp& now, Time at) {
    wait(now.is_gone() ? kGoneQuiet : now.is_empty() ? kEmptyQuiet : 2 * kWriteQuiet, at);
}

void SaveNotice::grew(Time at) {
    wait(2 * kWriteQuiet, at);
}

// Nothing more is to come, as far as can be told.
void SaveNotice::saved(const FileStamp& now, Time at) {
    if (now.is_gone()) return wait(kGoneQuiet, at);
    if (now.is_empty()) return wait(kEmptyQuiet, at);
    ready_ = true;
    due_.reset();
}

void SaveNotice::wait(std::chrono::milliseconds quiet, Time at) {
    if (!since_) since_ = at;
    ready_ = false;
    due_ = std::min(at + quiet, *since_ + kLongestQuiet);
}

}  // namespace glint
