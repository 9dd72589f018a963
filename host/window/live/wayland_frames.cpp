#include "window/live/wayland_frames.h"

#include <dlfcn.h>

#include <cstdint>

struct wl_interface;

namespace glint {
namespace {

// libwayland-client is there only where GLFW has loaded it. wayland-client.h makes its requests of
// these.
struct Library {
    using Marshal = wl_proxy* (*)(wl_proxy*, std::uint32_t opcode, const wl_interface*,
                                  std::uint32_t version, std::uint32_t flags, ...);
    using Listen = int (*)(wl_proxy*, void (**listener)(), void* data);
    using Version = std::uint32_t (*)(wl_proxy*);
    using Destroy = void (*)(wl_proxy*);

    Marshal marshal = nullptr;
    Listen listen = nullptr;
    Version version = nullptr;
    Destroy destroy = nullptr;
    const wl_interface* callback = nullptr;

    bool is_there() const { return marshal && listen && version && destroy && callback; }
};

Library find_library() {
    Library found;
    void* library = ::dlopen("libwayland-client.so.0", RTLD_LAZY | RTLD_NOLOAD);
    if (!library) return found;
    const auto find = [&]<class Function>(Function& function, const char* name) {
        function = reinterpret_cast<Function>(::dlsym(library, name));
    };
    find(found.marshal, "wl_proxy_marshal_flags");
    find(found.listen, "wl_proxy_add_listener");
    find(found.version, "wl_proxy_get_version");
    find(found.destroy, "wl_proxy_destroy");
    find(found.callback, "wl_callback_interface");
    ::dlclose(library);  // GLFW keeps it
    return found;
}

const Library& library() {
    static const Library found = find_library();
    return found;
}

}  // namespace

WaylandFrames::WaylandFrames(GLFWwindow* window) {
    using Get = wl_proxy* (*)(GLFWwindow*);
    const auto get = reinterpret_cast<Get>(::dlsym(RTLD_DEFAULT, "glfwGetWaylandWindow"));
    if (get && library().is_there()) surface_ = get(window);
}

WaylandFrames::~WaylandFrames() {
    if (asked_) library().destroy(asked_);
}

void WaylandFrames::ask() {
    if (!surface_ || asked_) return;
    constexpr std::uint32_t kSurfaceFrame = 3;  // wl_surface.frame
    asked_ = library().marshal(surface_, kSurfaceFrame, library().callback,
                               library().version(surface_), 0, nullptr);
    if (!asked_) return;
    since_asked_.restart();
    using Done = void (*)(void* frames, wl_proxy* callback, std::uint32_t ms);
    static Done done = [](void* frames, wl_proxy* callback, std::uint32_t) {
        library().destroy(callback);
        static_cast<WaylandFrames*>(frames)->asked_ = nullptr;
    };
    library().listen(asked_, reinterpret_cast<void (**)()>(&done), this);
}

}  // namespace glint
