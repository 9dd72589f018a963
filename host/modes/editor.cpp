#include "modes/editor.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

namespace glint {
namespace {

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

std::string program_name(const std::vector<std::string>& command) {
    return std::filesystem::path(command.front()).filename().string();
}

bool needs_terminal(const std::string& name) {
    return is_one_of(name,
                     {"vi", "vim", "nvim", "nano", "micro", "hx", "helix", "kak", "joe", "ne"});
}

std::string chosen_editor() {
    for (const char* variable : {"VISUAL", "EDITOR"}) {
        const char* value = std::getenv(variable);
        if (value && *value) return value;
    }
    return "xdg-open";
}

}  // namespace

std::vector<std::string> editor_command(const std::string& editor, const Place& place) {
    std::istringstream words(editor);
    std::vector<std::string> command;
    for (std::string word; words >> word;) command.push_back(word);
    if (command.empty()) command.push_back("xdg-open");
    const std::string name = program_name(command);
    const int line = std::max(place.line, 1), column = std::max(place.column, 1);
    const std::string at = fmt::format("{}:{}:{}", place.file, line, column);
    if (is_one_of(name, {"code", "codium", "code-insiders"})) {
        command.push_back("--goto");
        command.push_back(at);
    } else if (is_one_of(name, {"subl", "zed", "hx", "helix"})) {
        command.push_back(at);
    } else if (is_one_of(name, {"emacs", "emacsclient", "gedit", "kak", "micro"})) {
        command.push_back(fmt::format("+{}:{}", line, column));
        command.push_back(place.file);
    } else if (name == "nano") {
        command.push_back(fmt::format("+{},{}", line, column));
        command.push_back(place.file);
    } else if (name == "kate") {
        command.insert(command.end(), {"-l", std::to_string(line), "-c", std::to_string(column)});
        command.push_back(place.file);
    } else {
        if (name != "xdg-open") command.push_back(fmt::format("+{}", line));
        command.push_back(place.file);
    }
    return command;
}

std::string open_editor(const Place& place) {
    std::vector<std::string> command = editor_command(chosen_editor(), place);
    if (needs_terminal(program_name(command))) {
        command.insert(command.begin(), {"x-terminal-emulator", "-e"});
    }
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawnattr_t attributes;  // signals that we ignore are not to be ignored by others
    posix_spawnattr_init(&attributes);
    sigset_t all;
    sigfillset(&all);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t process = 0;
    const int error =
        posix_spawnp(&process, arguments[0], nullptr, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        return fmt::format("cannot start {}: {}; set $EDITOR", command.front(),
                           std::strerror(error));
    }
    // Nobody waits for the editor, but it must not stay behind as a zombie.
    std::thread([process] { waitpid(process, nullptr, 0); }).detach();
    return "";
}

}  // namespace glint
