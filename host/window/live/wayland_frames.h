// Whether a Wayland compositor shows a window.
#pragma once

#include "base/stopwatch.h"

struct GLFWwindow;
struct wl_proxy;

namespace glint {

// A compositor says when a picture of a window has been shown and another one is welcome, and says
// nothing of a window that nobody sees: on another workspace, behind a tab, under a lock screen.
// A swap that waits for that word would wait as long, deaf to signals and to the window's close.
class WaylandFrames {
public:
    explicit WaylandFrames(GLFWwindow* window);  // does nothing where that is one of X11
    ~WaylandFrames();
    WaylandFrames(const WaylandFrames&) = delete;
    WaylandFrames& operator=(const WaylandFrames&) = delete;

    // Right before a swap, which asks for the word with its picture.
    void ask();
    // No word has come for long. What comes is heard among the window's events.
    bool is_unseen() const { return asked_ && since_asked_.ms() > kLong; }

private:
    static constexpr double kLong = 250.0;  // ms

    wl_proxy* surface_ = nullptr;
    wl_proxy* asked_ = nullptr;
    Stopwatch since_asked_;
};

}  // namespace glint
