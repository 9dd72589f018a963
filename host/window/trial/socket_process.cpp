#include "window/trial/socket_process.h"

#include "offline/common.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace glint {

Launched launch_on_socket(const std::filesystem::path& program, const std::string& verb,
                          const std::string& device, int niceness, int output) {
    Launch wanted{.words = {program.string(), verb},
                  .input = kSocket,
                  .output = output,
                  .group = Launch::Group::session,
                  .default_signals = true,
                  .core_files = false,
                  .niceness = niceness};
    if (!device.empty()) wanted.words.push_back(device);
    return launch(wanted);
}

void require_socket(const char* verb) {
    struct stat status {};
    if (::fstat(STDIN_FILENO, &status) == 0 && S_ISSOCK(status.st_mode)) return;
    throw UsageError(fmt::format("`glint {}` is for the window to start, not for people.", verb));
}

}  // namespace glint
