// What the panels remember from one run to the next: sides, widths, and which are open.
#pragma once

#include "window/ui/layout.h"
#include "window/ui/panels.h"

#include <string>

namespace glint {

struct Memory {
    Places places;
    // tweaks, transport, passes, browser, study, check, source
    std::array<bool, 7> open{true, true, false, false, false, false, false};
    bool read = false;  // the file had something to say
    bool recalled = false;
};

// Lets ImGui read and write `memory` in its own file; "" remembers nothing. Both must outlive the
// context.
void remember(Memory& memory, const std::string& file);

// In the first frame: what was read takes effect. Later: nothing.
void recall(Memory& memory, Places& places, PanelSettings& settings);

// After a frame: what has changed will be written.
void note(Memory& memory, const Places& places, const PanelSettings& settings);

// The io of every context of ours.
void configure_io();

// What each frame's io needs before NewFrame.
void before_frame();

}  // namespace glint
