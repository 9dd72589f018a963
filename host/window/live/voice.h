// `glint voice`: the process that plays the sound of the scene in the window, so that no library of
// the system's sound stands in the window, and no sound holds up a picture.
#pragma once

#include <string>

namespace glint {

// Takes orders from standard input, which is a socket, until it is closed. Answers there, in lines:
// `plays`, or `silent CAUSE`. Throws UsageError when it is no socket.
void run_voice(const std::string& device);

}  // namespace glint
