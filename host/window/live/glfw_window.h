// A window with a GL context, through GLFW.
#pragma once

#include "gl/context.h"
#include "window/live/glx_context.h"
#include "window/live/wayland_frames.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct GLFWwindow;

namespace glint {

// Something that a person did to the window, in the order in which it happened.
struct WindowEvent {
    enum class Kind { key, text, mouse_button, mouse_move, scroll, drop, resize, focus, close };
    Kind kind = Kind::resize;
    int code = 0;              // key: GLFW's key; text: a character; mouse_button: 0: left
    int modifiers = 0;         // GLFW_MOD_…
    bool down = false;         // key, mouse_button, focus
    bool repeat = false;       // key: the keyboard's own repetition
    glm::dvec2 position{0.0};  // pixels of the framebuffer, y up; scroll: lines
    std::vector<std::filesystem::path> files;  // drop
};

// The library itself, which is one for the process: on while any of these lives.
class Glfw {
public:
    Glfw();  // throws NoContext when there is no display
    ~Glfw();
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;

    // What a window on the first monitor will most likely have.
    float content_scale() const;
};

class Window final : public Context {
public:
    // `size` is in pixels of a screen of scale 1; on a HiDPI screen the window has more. Where the
    // screen is too small for it, the window is smaller and keeps the aspect. The least is 320x180.
    // Throws NoContext when there is no display or no driver.
    Window(glm::ivec2 size, const std::string& title);
    ~Window() override;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    glm::ivec2 size() const;      // pixels of the framebuffer; 0x0 when minimised
    float content_scale() const;  // 2 on a HiDPI screen
    double refresh_rate() const;  // Hz; 60 when the monitor does not tell
    bool is_visible() const;      // false while minimised, or not shown by a Wayland compositor
    bool should_close() const;
    void close();  // at once; what a person closes arrives as an event
    void show();   // it is hidden at first, and may be minimised
    void set_title(const std::string& title);
    bool set_full_screen(bool full_screen);  // false where it cannot be had
    bool is_full_screen() const;

    // Handles what has arrived and returns it. Waits for at most this long until something arrives
    // or one of the descriptors is readable (-1 is passed over); 0 does not wait.
    std::vector<WindowEvent> events(double wait_seconds, std::span<const int> descriptors = {});

    // Shows what was drawn into framebuffer 0.
    void swap();

    // A Wayland compositor has gone, and the window should close.
    bool has_lost_display() const { return has_lost_display_; }

    // Called where X11's display goes away, right before the process ends: nothing can be drawn any
    // more, and no window can be asked. May be empty.
    static inline std::function<void()> on_lost_display;

    GLFWwindow* handle() const { return window_; }

private:
    const Glfw glfw_;
    GLFWwindow* window_ = nullptr;
    std::unique_ptr<GlxContext> glx_;  // null where GLFW made the context
    std::vector<WindowEvent> events_;
    // Where the mouse was at the event in hand; GLFW tells only where it has come to since.
    glm::dvec2 cursor_{0.0};
    int display_ = -1;  // readable when the display has something to say; -1: nobody can tell
    bool is_wayland_ = false, has_lost_display_ = false;
    std::optional<WaylandFrames> wayland_frames_;
    int held_keys_ = 0;
    glm::ivec4 windowed_{0};  // position and size to return to from full screen

    void make(glm::ivec2 size, const std::string& title);
    void listen();
    void take_events();
    void push(WindowEvent event) { events_.push_back(std::move(event)); }
    void count_key(bool down) { held_keys_ = std::max(0, held_keys_ + (down ? 1 : -1)); }
    glm::dvec2 to_pixels(double x, double y) const;
};

}  // namespace glint
