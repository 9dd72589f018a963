#include "modes/open.h"

#include "modes/still.h"

#include <fmt/format.h>

namespace glint {

void run_open(const ViewOptions& options, const Stopwatch& since_start) {
    StillOptions still{.view = options, .output = options.file.stem().string() + ".png"};
    fmt::print(stderr, "There is no window yet; the picture goes to {}.\n", still.output.string());
    run_still(still, since_start);
}

}  // namespace glint
