// A GL context, current on the thread that made it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace glint {

// No driver gave a usable context: exit code 5.
struct NoContext : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The GPU hung, was reset or was taken away: exit code 7. Every GL object of the context is gone.
struct ContextLost : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Whether the current context draws on the processor, and so takes the system's memory.
bool draws_in_software();

// Of the current context: the state in which all is drawn.
void start_context();

// The first of what the driver has refused since this or Context::check() was called; empty:
// nothing. For those who tell of it in words of their own.
std::string take_complaint();

class Context {
public:
    virtual ~Context() = default;

    // The driver's name of the GPU, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer() const;
    // With the version of the driver: what draws the same pixels.
    std::string driver() const;

    // Draws on the processor: timer queries lie there, and loops end after 65,535 iterations a
    // pixel.
    bool is_software() const { return draws_in_software(); }

    // Waits until all drawing is done, and does what check() does.
    void finish();

    // Throws ContextLost after a reset, and std::runtime_error with the driver's words when a GL
    // call failed since the last time.
    void check();

    // Before a driver is loaded: variables without a first value start at 0, as in every browser,
    // where golfed shaders count on it. That is a net below the zeros that are written into texts
    // (glsl/zeros.h), for what these leave alone: Mesa can be told, and then forgets arrays,
    // structs and scalars that are assigned in one place alone; other drivers do what they do.
    static void start_variables_at_zero();

    // Before a driver is loaded, too: Mesa maps the index of what it keeps into memory, and where
    // the disk has no room for it the process would die at a write. It keeps nothing there then.
    static void spare_full_disk();

protected:
    // For implementations, once current: checks the version and hears the driver's complaints.
    void start();
};

// A context without a screen: OpenGL 4.5 core through EGL, first on a device (a real GPU before a
// software one), then on Mesa's surfaceless platform. `device` chooses: "" for this order, a number
// for the device of that index, "surfaceless", or a part of a device's name. Throws NoContext with
// what was tried.
std::unique_ptr<Context> make_egl_context(std::string_view device = "");

}  // namespace glint
