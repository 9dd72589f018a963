// A GL context on a window of X11 that GLFW made without one.
#pragma once

#include <memory>

struct _XDisplay;

namespace glint {

// GLFW finds a context by asking GLX for each attribute of each configuration, and Mesa looks the
// configuration up in a list each time: a fifth of the time until a window's first picture. This
// one takes the configuration of the window's own visual.
class GlxContext {
public:
    // OpenGL 4.5 core, current, whose loss is told. Null where GLX has no such context: GLFW has
    // other ways then.
    static std::unique_ptr<GlxContext> make(_XDisplay* display, unsigned long window);
    ~GlxContext();
    GlxContext(const GlxContext&) = delete;
    GlxContext& operator=(const GlxContext&) = delete;

    // Shows what was drawn, in step with the screen.
    void swap() const;

private:
    struct Handles;
    const std::unique_ptr<const Handles> handles_;
    explicit GlxContext(const Handles& handles);
};

}  // namespace glint
