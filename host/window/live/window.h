// `glint FILE` with a display: the playground's window.
#pragma once

#include "offline/common.h"

namespace glint {

// Runs until the window is closed. SIGINT, SIGTERM and SIGHUP end the process in order, by the same
// signal. Throws NoContext when there is no display, and UsageError.
void run_window(const ViewOptions& options);

}  // namespace glint
