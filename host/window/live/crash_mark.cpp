// A mark is locked while its process runs: the kernel lifts the lock, however that ends.
#include "window/live/crash_mark.h"

#include "base/readable_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <string>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

// What a process that is over has left; empty for one that still runs.
std::string left_in(const fs::path& mark) {
    const int descriptor = ::open(mark.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return {};
    const bool is_over = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    ::close(descriptor);
    try {
        return is_over ? read_whole_file(mark, 1 << 16) : "";
    } catch (const Unreadable&) {
        return {};
    }
}

}  // namespace

CrashMark::~CrashMark() {
    if (descriptor_ < 0) return;
    if (std::uncaught_exceptions() == 0) clear();
    ::close(descriptor_);
}

void CrashMark::clear() const {
    std::error_code error;
    if (descriptor_ >= 0) fs::remove(file_, error);
}

bool CrashMark::take(const fs::path& scene) {
    bool found = false;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
        if (left_in(entry.path()) != scene.string()) continue;
        found = true;
        fs::remove(entry.path(), error);
    }
    return found;
}

// Where it cannot be written there is none: a crash is then not remembered.
void CrashMark::set(const fs::path& scene) {
    if (descriptor_ < 0) {
        std::error_code error;
        fs::create_directories(folder_, error);
        std::string name = (folder_ / "XXXXXX").string();
        descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
        if (descriptor_ < 0) return;
        file_ = name;
        ::flock(descriptor_, LOCK_EX | LOCK_NB);
    }
    const std::string text = scene.string();
    const bool is_written =
        ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, text.data(), text.size(), 0) >= 0;
    (void)is_written;
}

}  // namespace glint
