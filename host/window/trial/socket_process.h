// A process of this program that is spoken with through a socket.
#pragma once

#include "base/launch.h"

#include <filesystem>
#include <string>

namespace glint {

// Starts `program VERB [DEVICE]` with a socket as its standard input, whose other end is the pipe,
// and nothing else of ours: no blocked or ignored signal, and no terminal, so that Ctrl+C is not
// for it; as its standard output, a descriptor of ours. It ends with us, even in the middle of a
// draw.
Launched launch_on_socket(const std::filesystem::path& program, const std::string& verb,
                          const std::string& device, int niceness = 0, int output = kNothing);

// For that process. Throws UsageError when it has no socket.
void require_socket(const char* verb);

}  // namespace glint
