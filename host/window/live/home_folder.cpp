#include "window/live/home_folder.h"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Anybody may have made what has this name: it is ours where it is a folder of ours that others
// cannot open.
fs::path home_of_the_homeless() {
    const std::string place = fmt::format("/tmp/glint-{}", ::getuid());
    ::mkdir(place.c_str(), 0700);
    struct stat found {};
    const bool is_ours = ::lstat(place.c_str(), &found) == 0 && S_ISDIR(found.st_mode) &&
                         found.st_uid == ::getuid() && (found.st_mode & 077) == 0;
    return is_ours ? place : "/dev/null";
}

fs::path home() {
    const char* told = std::getenv("HOME");
    const passwd* user = told && *told ? nullptr : ::getpwuid(::getuid());
    if (user) told = user->pw_dir;
    return told && *told ? fs::path(told) : home_of_the_homeless();
}

}  // namespace

// A path that is not absolute is to be ignored, as the XDG Base Directory Specification has it.
fs::path home_folder(const char* variable, const char* fallback) {
    const char* told = std::getenv(variable);
    const fs::path folder = told ? told : "";
    return (folder.is_absolute() ? folder : home() / fallback) / "glint";
}

}  // namespace glint
