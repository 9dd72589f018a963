#include "modes/crash_mark.h"

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace glint {

namespace fs = std::filesystem;

CrashMark::CrashMark(fs::path file) : file_(std::move(file)) {}

CrashMark::~CrashMark() {
    std::error_code error;
    fs::remove(file_, error);
}

bool CrashMark::names(const fs::path& scene) const {
    std::ifstream stream(file_, std::ios::binary);
    const std::string kept{std::istreambuf_iterator<char>(stream), {}};
    return kept == fs::absolute(scene).string();
}

void CrashMark::set(const fs::path& scene) {
    std::error_code error;
    fs::create_directories(file_.parent_path(), error);
    std::ofstream(file_, std::ios::binary) << fs::absolute(scene).string();
}

}  // namespace glint
