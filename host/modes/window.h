// `glint FILE` with a display: the playground's window.
#pragma once

#include "modes/common.h"

namespace glint {

// Runs until the window is closed. Throws NoContext when there is no display.
void run_window(const ViewOptions& options);

}  // namespace glint
