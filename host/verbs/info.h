// `glint info`: what a scene consists of, and what was left out.
#pragma once

#include "offline/common.h"

namespace glint {

struct InfoOptions {
    ViewOptions view;
    std::string source;  // print the GLSL text that the driver sees for this pass instead
};

void run_info(const InfoOptions& options);

}  // namespace glint
