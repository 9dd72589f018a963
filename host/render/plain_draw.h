// How a triangle is drawn so that software drivers compile its pass once.
#pragma once

#include "gl/context.h"

#include <epoxy/gl.h>

namespace glint {

// llvmpipe makes two machine codes of a pass that writes its pixels plainly, one of them for tiles
// that the triangle covers whole, and takes twice as long; of one with a logical operation it makes
// the other one alone. "Copy" writes the same pixels, and means nothing where they are floats.
class PlainDraw {
public:
    PlainDraw() {
        if (is_wanted_) glEnable(GL_COLOR_LOGIC_OP);  // GL_COPY
    }
    ~PlainDraw() {
        if (is_wanted_) glDisable(GL_COLOR_LOGIC_OP);
    }
    PlainDraw(const PlainDraw&) = delete;
    PlainDraw& operator=(const PlainDraw&) = delete;

private:
    const bool is_wanted_ = draws_in_software() && glIsEnabled(GL_BLEND) == GL_FALSE;
};

}  // namespace glint
