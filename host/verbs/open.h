// `glint FILE`: shows a scene or preset in a window. Without a display it writes NAME.png instead.
#pragma once

#include "offline/common.h"

namespace glint {

void run_open(const ViewOptions& options, const Stopwatch& since_start);

}  // namespace glint
