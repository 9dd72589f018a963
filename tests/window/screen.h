// A screen of our own (Xvfb), and the hands and eyes of a person before it. Positions are pixels
// from the top left of the screen; the window stands there, since nobody manages windows.
#pragma once

#include <glm/vec2.hpp>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

struct _XDisplay;

namespace glint::window {

struct Colour {
    int r = 0, g = 0, b = 0;  // 0 to 255
    bool operator==(const Colour&) const = default;
};

std::ostream& operator<<(std::ostream& stream, const Colour& colour);

// s; what comes is not waited for longer than it takes, and a machine may have much else to do.
constexpr double kPatience = 120.0;

// Asks every millisecond until it is true; false when it never was.
bool eventually(const std::function<bool()>& is_true, double seconds = kPatience);

class Screen {
public:
    // Throws std::runtime_error when Xvfb does not start.
    explicit Screen(glm::ivec2 size = {1280, 720}, bool with_glx = true);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    const std::string& name() const { return name_; }  // for $DISPLAY
    void kill();                                       // as when the power goes

    Colour pixel(glm::ivec2 at) const;
    // Rows top down, 0x00rrggbb.
    std::vector<std::uint32_t> picture(glm::ivec2 corner, glm::ivec2 size) const;

    void move(glm::ivec2 to);
    void button(bool down, int which = 1);
    void click(glm::ivec2 at, int which = 1);
    void drag(glm::ivec2 from, glm::ivec2 to);
    // Keys by X's names: "a", "Up", "Control_L", "F12", "period".
    void key(const char* name, bool down);
    // "Control_L+Shift_L+z": pressed in this order, released backwards.
    void tap(std::string_view chord);
    void type(std::string_view text);

    // The one window. 0 until it is shown.
    unsigned long window() const;
    std::string title() const;
    glm::ivec2 window_size() const;
    void resize_window(glm::ivec2 size);
    void minimise(bool minimised);
    void focus(bool focused);
    void close_window();  // as its frame's button does: the window is asked
    // A file is dragged from elsewhere and let go over the window. Whether the window took it.
    bool drop(const std::string& path);
    // As desktops tell programs that start from now on; 2 on a HiDPI screen.
    void set_content_scale(int scale);

private:
    void share();  // makes pixels_, of the whole screen

    glm::ivec2 size_;
    pid_t process_ = 0;
    _XDisplay* display_ = nullptr;
    std::string name_;
    unsigned long segment_ = 0;        // X's name of the memory that it shares with us
    std::uint32_t* pixels_ = nullptr;  // what the server writes there when it is asked
};

}  // namespace glint::window
