#include "modes/open.h"

#include "gl/context.h"
#include "modes/still.h"
#include "modes/window.h"

#include <fmt/format.h>

#include <cstdlib>

namespace glint {
namespace {

bool has_display() {
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        const char* value = std::getenv(variable);
        if (value && *value) return true;
    }
    return false;
}

}  // namespace

void run_open(const ViewOptions& options, const Stopwatch& since_start) {
    if (has_display()) {
        try {
            return run_window(options);
        } catch (const NoContext& error) {
            fmt::print(stderr, "{}\n", error.what());
        }
    }
    StillOptions still;
    still.view = options;
    still.output = options.file.stem().string() + ".png";
    fmt::print(stderr, "There is no display; the picture goes to {}.\n", still.output.string());
    run_still(still, since_start);
}

}  // namespace glint
