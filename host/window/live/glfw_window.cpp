#include "window/live/glfw_window.h"

#include "base/say.h"
#include "gl/resample.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <utility>

namespace glint {
namespace {

int glfw_users = 0;

std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

// Xlib ends the process when this returns; nothing can be drawn any more.
int hear_lost_display(Display*) {
    say("The display is gone; Glint ends.\n");
    if (Window::on_lost_display) Window::on_lost_display();
    std::_Exit(1);
}

// A function of a library that may be another one, or lack it, where this program runs.
template <class Function>
Function find_function(const char* name, void* library = RTLD_DEFAULT) {
    return reinterpret_cast<Function>(::dlsym(library, name));
}

// GLFW 3.3 is built for X11 or for Wayland, under one file name; 3.4 knows both, and gives null for
// the one that it does not run on.
template <class Connection>
Connection* find_display(const char* function) {
    const auto get = find_function<Connection* (*)()>(function);
    Connection* display = get ? get() : nullptr;
    if (!display) glfwGetError(nullptr);  // that it is the other one is no error of ours
    return display;
}

int x11_descriptor() {
    auto* display = find_display<Display>("glfwGetX11Display");
    return display ? XConnectionNumber(display) : -1;
}

int wayland_descriptor() {
    auto* display = find_display<struct wl_display>("glfwGetWaylandDisplay");
    void* library = display ? ::dlopen("libwayland-client.so.0", RTLD_LAZY | RTLD_NOLOAD) : nullptr;
    if (!library) return -1;
    const auto get = find_function<int (*)(struct wl_display*)>("wl_display_get_fd", library);
    ::dlclose(library);  // GLFW keeps it
    return get ? get(display) : -1;
}

// Debian 12 has a package of GLFW for each.
std::string advice_on_wayland() {
    const bool speaks_it = find_function<void* (*)()>("glfwGetWaylandDisplay") != nullptr;
    if (speaks_it || !std::getenv("WAYLAND_DISPLAY")) return {};
    return " Under Wayland this GLFW needs Xwayland; that of libglfw3-wayland needs none.";
}

struct X11Window {
    Display* display;
    ::Window window;
};

// Nothing where GLFW runs on Wayland.
std::optional<X11Window> x11_window(GLFWwindow* window) {
    auto* display = find_display<Display>("glfwGetX11Display");
    const auto get = find_function<::Window (*)(GLFWwindow*)>("glfwGetX11Window");
    if (!display || !get) return std::nullopt;
    return X11Window{display, get(window)};
}

// What X11 shows of a window before its first picture, in place of black.
void set_ground(GLFWwindow* window) {
    constexpr unsigned long kGround = 0x36404e;
    if (const auto x11 = x11_window(window))
        XSetWindowBackground(x11->display, x11->window, kGround);
}

// GLFW makes the window larger by the scale of the monitor.
glm::ivec2 fitted_to_screen(glm::ivec2 size) {
    constexpr glm::ivec2 kLeast{320, 180};  // less would leave no room for a panel
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor) return glm::max(size, kLeast);
    glm::ivec2 corner{0}, room{0};
    glm::vec2 scale{1.0f};
    glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
    glfwGetMonitorContentScale(monitor, &scale.x, &scale.y);
    const glm::dvec2 ratio = glm::dvec2(room) / (glm::dvec2(size) * glm::dvec2(scale));
    const double fit = std::min(ratio.x, ratio.y);
    if (fit >= 1.0 || fit <= 0.0) return glm::max(size, kLeast);
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * fit)), kLeast);
}

Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

}  // namespace

Glfw::Glfw() {
    if (glfw_users > 0) {
        ++glfw_users;
        return;
    }
    Context::start_variables_at_zero();
    Context::spare_full_disk();
    if (!glfwInit())
        throw NoContext(
            fmt::format("There is no display: {}.{}", last_error(), advice_on_wayland()));
    XSetIOErrorHandler(hear_lost_display);
    ++glfw_users;
}

Glfw::~Glfw() {
    if (--glfw_users == 0) glfwTerminate();
}

float Glfw::content_scale() const {
    float x = 1.0f, y = 1.0f;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorContentScale(monitor, &x, &y);
    return std::max(x, y);
}

Window::Window(glm::ivec2 size, const std::string& title) {
    size = fitted_to_screen(size);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    make(size, title);
    try {
        start();
    } catch (...) {
        glx_.reset();
        glfwDestroyWindow(window_);
        throw;
    }
    display_ = x11_descriptor();
    is_wayland_ = display_ < 0;
    if (display_ < 0) display_ = wayland_descriptor();
    // No swap is to wait for what WaylandFrames hears.
    if (!glx_) glfwSwapInterval(is_wayland_ ? 0 : 1);
    if (is_wayland_) wayland_frames_.emplace(window_);
    listen();
    set_ground(window_);
}

// Where one way to a context is missing another may be there.
void Window::make(glm::ivec2 size, const std::string& title) {
    if (find_display<Display>("glfwGetX11Display")) {
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
        if (const auto x11 = window_ ? x11_window(window_) : std::nullopt)
            glx_ = GlxContext::make(x11->display, x11->window);
        if (glx_) return;
        if (window_) glfwDestroyWindow(window_);
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    for (const int api : {GLFW_NATIVE_CONTEXT_API, GLFW_EGL_CONTEXT_API}) {
        glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
        window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
        if (window_) break;
    }
    if (!window_) throw NoContext(fmt::format("No window: {}.", last_error()));
    glfwMakeContextCurrent(window_);
}

Window::~Window() {
    forget_resampling();
    wayland_frames_.reset();
    glx_.reset();
    glfwDestroyWindow(window_);
}

glm::ivec2 Window::size() const {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

float Window::content_scale() const {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max(x, y);
}

double Window::refresh_rate() const {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    return mode && mode->refreshRate > 0 ? mode->refreshRate : 60.0;
}

bool Window::is_visible() const {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_FALSE &&
           glfwGetWindowAttrib(window_, GLFW_VISIBLE) == GLFW_TRUE &&
           !(wayland_frames_ && wayland_frames_->is_unseen());
}

bool Window::should_close() const {
    return glfwWindowShouldClose(window_) != 0;
}
void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}
void Window::show() {
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) glfwRestoreWindow(window_);
    glfwShowWindow(window_);
}
void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}
bool Window::is_full_screen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

bool Window::set_full_screen(bool full_screen) {
    if (full_screen == is_full_screen()) return true;
    // GLFW before 3.4 counts the frame that it draws under Wayland as part of a full screen, for
    // which compositors end the program. Their own ways to fill the screen are left.
    int major = 0, minor = 0;
    glfwGetVersion(&major, &minor, nullptr);
    if (is_wayland_ && major == 3 && minor < 4) return false;
    if (!full_screen) {
        glfwSetWindowMonitor(window_, nullptr, windowed_.x, windowed_.y, windowed_.z, windowed_.w,
                             GLFW_DONT_CARE);
        return true;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return false;
    glfwGetWindowPos(window_, &windowed_.x, &windowed_.y);
    glfwGetWindowSize(window_, &windowed_.z, &windowed_.w);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    return true;
}

// A Wayland compositor that goes while events of it wait to be handled leaves GLFW in a loop for
// ever: it cannot handle them, and does not wait while there are any. Nobody can be asked any more.
void Window::take_events() {
    pollfd display{.fd = is_wayland_ ? display_ : -1, .events = 0, .revents = 0};
    ::poll(&display, 1, 0);
    has_lost_display_ |= (display.revents & (POLLHUP | POLLERR)) != 0;
    if (has_lost_display_) return close();
    glfwPollEvents();
}

// GLFW can wait for the display alone. Its way to end that wait from another thread touches Xlib
// there and has lost wake-ups (GLFW before 3.4), so the display's descriptor and the others are
// waited for together, on this thread. Polling first takes what Xlib has read already and keeps to
// itself.
std::vector<WindowEvent> Window::events(double wait_seconds, std::span<const int> descriptors) {
    take_events();
    if (events_.empty() && wait_seconds > 0.0) {
        // Under Wayland a key that is held repeats by a clock of GLFW's own, which wakes nobody.
        constexpr double kFrame = 1.0 / 60.0;
        if (display_ < 0 || (is_wayland_ && held_keys_ > 0))
            wait_seconds = std::min(wait_seconds, kFrame);
        std::vector<pollfd> polled = {{.fd = display_, .events = POLLIN, .revents = 0}};
        for (const int fd : descriptors)
            polled.push_back({.fd = fd, .events = POLLIN, .revents = 0});
        const auto seconds = static_cast<std::time_t>(wait_seconds);
        const timespec wait{seconds,
                            std::lround((wait_seconds - static_cast<double>(seconds)) * 1e9)};
        ::ppoll(polled.data(), polled.size(), &wait, nullptr);
        take_events();
    }
    return std::exchange(events_, {});
}

void Window::swap() {
    if (wayland_frames_) wayland_frames_->ask();
    if (glx_)
        glx_->swap();
    else
        glfwSwapBuffers(window_);
}

// GLFW counts points from the top left; scenes count pixels from the bottom left.
glm::dvec2 Window::to_pixels(double x, double y) const {
    int width = 1, height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const glm::dvec2 pixels(size());
    return {x * pixels.x / std::max(width, 1), (1.0 - y / std::max(height, 1)) * pixels.y};
}

void Window::listen() {
    glfwSetWindowUserPointer(window_, this);
    glm::dvec2 cursor{0.0};
    glfwGetCursorPos(window_, &cursor.x, &cursor.y);
    cursor_ = to_pixels(cursor.x, cursor.y);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        if (action != GLFW_REPEAT) self(w).count_key(action == GLFW_PRESS);
        self(w).push({.kind = WindowEvent::Kind::key,
                      .code = key,
                      .modifiers = modifiers,
                      .down = action != GLFW_RELEASE,
                      .repeat = action == GLFW_REPEAT,
                      .files = {}});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
        self(w).push(
            {.kind = WindowEvent::Kind::text, .code = static_cast<int>(character), .files = {}});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int modifiers) {
        self(w).push({.kind = WindowEvent::Kind::mouse_button,
                      .code = button,
                      .modifiers = modifiers,
                      .down = action == GLFW_PRESS,
                      .position = self(w).cursor_,
                      .files = {}});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        self(w).cursor_ = self(w).to_pixels(x, y);
        self(w).push(
            {.kind = WindowEvent::Kind::mouse_move, .position = self(w).cursor_, .files = {}});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
        self(w).push({.kind = WindowEvent::Kind::scroll, .position = {x, y}, .files = {}});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** names) {
        WindowEvent event{.kind = WindowEvent::Kind::drop, .files = {}};
        event.files.assign(names, names + count);
        self(w).push(std::move(event));
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) {
        self(w).push({.kind = WindowEvent::Kind::resize, .files = {}});
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) {
        self(w).push({.kind = WindowEvent::Kind::resize, .files = {}});
    });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);
        self(w).push({.kind = WindowEvent::Kind::close, .files = {}});
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
        self(w).push({.kind = WindowEvent::Kind::focus, .down = focused != 0, .files = {}});
    });
}

}  // namespace glint
