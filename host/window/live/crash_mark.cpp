#include "window/live/crash_mark.h"

#include "glsl/raw_text.h"

#include <unistd.h>

#include <exception>
#include <fstream>
#include <string>
#include <system_error>

namespace glint {

namespace fs = std::filesystem;

CrashMark::CrashMark(fs::path folder)
    : folder_(std::move(folder)), file_(folder_ / std::to_string(::getpid())) {}

CrashMark::~CrashMark() {
    if (std::uncaught_exceptions() > 0) return;
    std::error_code error;
    fs::remove(file_, error);
}

bool CrashMark::take(const fs::path& scene) {
    const std::string wanted = fs::absolute(scene).string();
    bool found = false;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
        // A process that still runs has not crashed.
        if (fs::exists(fs::path("/proc") / entry.path().filename(), error)) continue;
        std::string why_not;
        found |= read_bytes(entry.path(), why_not) == wanted;
        fs::remove(entry.path(), error);
    }
    return found;
}

void CrashMark::set(const fs::path& scene) {
    std::error_code error;
    fs::create_directories(folder_, error);
    std::ofstream(file_, std::ios::binary) << fs::absolute(scene).string();
}

}  // namespace glint
