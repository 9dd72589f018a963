// The panels' icons, drawn as lines and shapes: no icon font is needed.
#pragma once

#include "window/ui/theme.h"

namespace glint {

enum class Icon {
    play,
    pause,
    step,
    reset,
    undo,
    redo,
    dice,
    locked,
    unlocked,
    copy,
    flip,
    wipe,
    close,
    clear,
    search,
    tweaks,
    passes,
    browser,
    study,
    check,
    source,
    clock,
    screen,
    camera,
    record,
    full_screen,
    help,
    loop,
    sound,
    muted,
    revert,
    save,
};

// Draws into the square of this side, in screen units, round the centre. Lines are a tenth of it
// thick, and at least one unit.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float side, ImU32 colour);

}  // namespace glint
