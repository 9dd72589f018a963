// What `bench` is asked for.
#pragma once

#include "offline/options.h"

namespace glint {

struct BenchOptions {
    ViewOptions view;
    int frames = 60;
    bool compare = false;  // alternate specialised and uniform-fed frames and print the ratio
};

}  // namespace glint
