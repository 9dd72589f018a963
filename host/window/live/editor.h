// Opens the user's own editor at a place in a file.
#pragma once

#include "base/diagnostic.h"

#include <string>
#include <vector>

namespace glint {

// The command of an editor such as "vim" or "code -w" for a place, in that editor's own way of
// naming lines.
std::vector<std::string> editor_command(const std::string& editor, const Place& place);

class Editor {
public:
    // Throws std::runtime_error when the process has no descriptor left.
    Editor();
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    // Starts $VISUAL, $EDITOR or the desktop's choice at the place, and does not wait for it: it
    // outlives the program. An editor for terminals gets a terminal of its own, but for Neovim
    // where one runs that has the file (window/live/neovim.h). Returns what went wrong as a
    // sentence, or "".
    std::string open(const Place& place);

    // Readable when problem() has something to tell.
    int descriptor() const { return sockets_[0]; }

    // What went wrong since: the desktop has no editor for such a file. "" otherwise.
    std::string problem();

private:
    int sockets_[2];
};

}  // namespace glint
