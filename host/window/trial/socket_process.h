// A process of this program that is spoken with through a socket.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace glint {

// Starts `program VERB [DEVICE]` with a socket as its standard input and nothing else of ours: no
// other descriptor, no blocked or ignored signal, and no terminal, so that Ctrl+C is not for it.
// Returns an errno, or 0.
int spawn_on_socket(const std::filesystem::path& program, std::string verb, std::string device,
                    int socket, pid_t& process);

// For that process: it ends with the one that has started it, even in the middle of a draw, and
// leaves no core file behind. Throws UsageError when it has no socket.
void depend_on_parent(const char* verb);

}  // namespace glint
