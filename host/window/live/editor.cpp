#include "window/live/editor.h"

#include "base/canonical_name.h"
#include "base/launch.h"
#include "window/live/neovim.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

namespace glint {
namespace {

constexpr const char* kDesktopsChoice = "xdg-open";

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

std::string program_name(const std::vector<std::string>& command) {
    return std::filesystem::path(command.front()).filename().string();
}

bool needs_terminal(const std::vector<std::string>& command) {
    const std::string name = program_name(command);
    const bool asks = is_one_of(name, {"emacs", "emacsclient"}) &&
                      std::any_of(command.begin(), command.end(), [](const std::string& word) {
                          return is_one_of(word, {"-nw", "--no-window-system", "-t", "--tty"});
                      });
    return asks || is_one_of(name, {"vi", "vim", "nvim", "nano", "micro", "hx", "helix", "kak",
                                    "joe", "ne"});
}

std::string chosen_editor() {
    for (const char* variable : {"VISUAL", "EDITOR"}) {
        const char* value = std::getenv(variable);
        if (value && *value) return value;
    }
    return kDesktopsChoice;
}

// What follows --server; "" where that is not said.
std::string neovim_address(const std::vector<std::string>& command) {
    const auto option = std::ranges::find(command, "--server");
    return option == command.end() || option + 1 == command.end() ? "" : *(option + 1);
}

// As a shell looks for it.
bool is_found(const std::string& program) {
    const auto runs = [](const std::string& file) { return ::access(file.c_str(), X_OK) == 0; };
    if (program.find('/') != std::string::npos) return runs(program);
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/bin:/usr/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (runs((folder.empty() ? "." : folder) + "/" + program)) return true;
    }
    return false;
}

// An installed Glint may be what the desktop opens scenes with.
bool desktop_chooses_us() {
    if (!is_found("xdg-mime")) return false;
    const Launched child =
        launch({.words = {"xdg-mime", "query", "default", "text/x-glint-scene"}, .output = kPipe});
    if (child.process == 0) return false;
    const std::string choice = read_to_end(child.pipe);
    wait_for(child.process);
    return choice.starts_with("glint.desktop");
}

// The words of a command, with a shell's quotes and backslashes; nothing else of a shell, and
// nothing is run. A quote that is not closed reaches to the end.
std::vector<std::string> shell_words(std::string_view line) {
    std::vector<std::string> words;
    char quote = '\0';
    bool in_word = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        const bool is_space = quote == '\0' && std::string_view(" \t\n").find(c) != line.npos;
        if (!is_space && !std::exchange(in_word, true)) words.emplace_back();
        const bool has_next = c == '\\' && i + 1 < line.size();
        const bool may_escape =
            quote == '\0' ||
            (quote == '"' && has_next && std::string_view("\"\\$`").find(line[i + 1]) != line.npos);
        if (is_space)
            in_word = false;
        else if (has_next && may_escape)
            words.back() += line[++i];
        else if (quote == '\0' && (c == '\'' || c == '"'))
            quote = c;
        else if (c == quote)
            quote = '\0';
        else
            words.back() += c;
    }
    return words;
}

}  // namespace

std::vector<std::string> editor_command(const std::string& editor, const Place& place) {
    std::vector<std::string> command = shell_words(editor);
    if (command.empty()) command.push_back(kDesktopsChoice);
    const std::string name = program_name(command);
    const int line = std::max(place.line, 1), column = std::max(place.column, 1);
    // No name is taken for an option.
    const std::string file = place.file.starts_with('-') ? "./" + place.file : place.file;
    const std::string at = fmt::format("{}:{}:{}", file, line, column);
    if (is_one_of(name, {"code", "codium", "code-insiders"})) {
        command.push_back("--goto");
        command.push_back(at);
    } else if (is_one_of(name, {"subl", "zed", "hx", "helix"})) {
        command.push_back(at);
    } else if (is_one_of(name, {"emacs", "emacsclient", "gedit", "kak", "micro"})) {
        command.push_back(fmt::format("+{}:{}", line, column));
        command.push_back(file);
    } else if (name == "nano") {
        command.push_back(fmt::format("+{},{}", line, column));
        command.push_back(file);
    } else if (name == "kate") {
        command.insert(command.end(), {"-l", std::to_string(line), "-c", std::to_string(column)});
        command.push_back(file);
    } else {
        if (name != kDesktopsChoice) command.push_back(fmt::format("+{}", line));
        command.push_back(file);
    }
    return command;
}

Editor::Editor() {
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, sockets_) != 0)
        throw std::runtime_error("There is no socket.");
}

Editor::~Editor() {
    for (const int socket : sockets_) ::close(socket);
}

std::string Editor::open(const Place& place) {
    std::vector<std::string> command = editor_command(chosen_editor(), place);
    const std::string name = program_name(command);
    if (name == "nvim") {
        const std::string address = neovim_address(command);
        if (jump_in_neovim(address, place)) return "";
        if (!address.empty()) return fmt::format("No Neovim answers at {}; set $EDITOR.", address);
    }
    if (!is_found(command.front()))
        return fmt::format("No editor is found: there is no {}; set $EDITOR.", command.front());
    const bool is_preset = ending_of(place.file) == ".toml";
    if (name == kDesktopsChoice && !is_preset && desktop_chooses_us())
        return "The desktop opens scenes with Glint itself; set $EDITOR.";
    if (needs_terminal(command)) {
        command.insert(command.begin(), {"x-terminal-emulator", "-e"});
        if (!is_found(command.front()))
            return fmt::format("No terminal is found for {}: there is no {}; set $EDITOR.", name,
                               command.front());
    }
    // What we ignore is not ignored by others. In a session of its own: Ctrl+C in the terminal, or
    // its end, takes no unsaved text along.
    const Launched launched = launch({.words = command,
                                      .input = kOurs,
                                      .output = kOurs,
                                      .messages = kOurs,
                                      .group = Launch::Group::session,
                                      .ends_with_us = false,
                                      .default_signals = true});
    if (launched.error != 0) {
        return fmt::format("cannot start {}: {}; set $EDITOR", command.front(),
                           std::strerror(launched.error));
    }
    // Nobody waits for the editor, but it must not stay behind as a zombie. What editors end with
    // is their own affair; the desktop's choice tells so that there is none.
    const int told = ::fcntl(sockets_[1], F_DUPFD_CLOEXEC, 0);
    std::thread([process = launched.process, told, chooses = name == kDesktopsChoice] {
        const int code = wait_for(process);
        if (chooses && code != 0) ::send(told, "", 1, MSG_NOSIGNAL);
        ::close(told);
    }).detach();
    return "";
}

std::string Editor::problem() {
    char byte = 0;
    if (::recv(sockets_[0], &byte, 1, 0) != 1) return "";
    return fmt::format("No editor is found: {} knows none for this file; set $EDITOR.",
                       kDesktopsChoice);
}

}  // namespace glint
