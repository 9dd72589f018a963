// From the command line to the window, where there is one to be had.
#pragma once

#include "offline/common.h"

namespace glint {

// Runs the window until it is closed. False where there is none: without a display, which is said
// on stderr only if there should be one, and in a glint that was built without it. Throws as
// run_window().
bool show_in_window(const ViewOptions& options);

// What `glint` alone, or with a folder, says where it cannot show its browser: three commands to
// try.
void say_first_commands(const std::filesystem::path& folder);

// The name under which this program was called, as it can be typed again here.
std::string own_name();

}  // namespace glint
