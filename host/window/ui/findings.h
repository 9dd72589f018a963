// How far a study and a check are that run beside the window, and which of their pictures is seen.
#pragma once

#include <string>

namespace glint {

// Work that another process does for the window.
struct WorkFact {
    bool running = false;
    long done = 0, of = 0;  // pictures or cases; `of` is 0 until it is known
    std::string problem{};  // why it has found nothing, or not all
    bool stale = false;     // the scene or its tweaks have changed since it began
};

// What stands in the view: the scene itself, or a picture that a study or a check has left.
enum class Shown { scene, wipe, map, failure };

}  // namespace glint
