// OpenGL 4.5 without a screen, through EGL.
#include "gl/context.h"
#include "gl/egl_context.h"
#include "gl/resample.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace glint {
namespace {

// EGL_EXT_device_query_name, which libepoxy 1.5.10 does not know yet.
constexpr EGLint kEglRenderer = 0x335F;

class EglContext final : public Context {
public:
    // Makes a context on `display` and makes it current; throws NoContext. Owns the display.
    explicit EglContext(EGLDisplay display) : display_(display) {
        try {
            create();
            Context::start();
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~EglContext() override { destroy(); }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

private:
    void create();
    void destroy();

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

void EglContext::create() {
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display_, &major, &minor)) throw NoContext("the display does not start");
    if (!eglBindAPI(EGL_OPENGL_API)) throw NoContext("the driver has no desktop OpenGL");
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    // Drawing goes to our own textures, so a driver without any configuration will do as well.
    if (!eglChooseConfig(display_, wanted, &config, 1, &count) || count == 0) {
        config = EGL_NO_CONFIG_KHR;
    }
    context_ = create_context(display_, config);
    if (context_ == EGL_NO_CONTEXT) throw NoContext("the driver has no OpenGL 4.5 core context");
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
        throw NoContext("the driver cannot draw without a surface");
    }
}

void EglContext::destroy() {
    if (context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_) forget_resampling();
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

// One way to a display, not opened yet.
struct Candidate {
    std::string name;  // for messages and for --device
    bool software = false;
    EGLenum platform = 0;
    EGLDeviceEXT device = nullptr;
};

std::string device_name(EGLDeviceEXT device, std::size_t index, bool software) {
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    const auto has = [&](std::string_view name) {
        return extensions && std::string_view(extensions).find(name) != std::string_view::npos;
    };
    const char* detail = nullptr;
    if (has("EGL_EXT_device_query_name")) {
        detail = eglQueryDeviceStringEXT(device, kEglRenderer);
    }
    if (!detail && has("EGL_EXT_device_drm")) {
        detail = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT);
    }
    return fmt::format("device {} ({})", index, detail ? detail : software ? "software" : "GPU");
}

// In the order of trying: GPUs, software devices, Mesa's surfaceless platform.
std::vector<Candidate> candidates() {
    std::vector<Candidate> list;
    EGLint count = 0;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        eglQueryDevicesEXT(0, nullptr, &count) && count > 0) {
        std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
        eglQueryDevicesEXT(count, devices.data(), &count);
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
            const bool software =
                extensions && std::string_view(extensions).find("EGL_MESA_device_software") !=
                                  std::string_view::npos;
            list.push_back({.name = device_name(devices[i], i, software),
                            .software = software,
                            .platform = EGL_PLATFORM_DEVICE_EXT,
                            .device = devices[i]});
        }
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        list.push_back(
            {.name = "surfaceless", .software = true, .platform = EGL_PLATFORM_SURFACELESS_MESA});
    }
    return list;
}

bool is_chosen(const Candidate& candidate, std::string_view device) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(device.data(), device.data() + device.size(), index);
    if (error == std::errc() && end == device.data() + device.size()) {
        return candidate.name.starts_with(fmt::format("device {} ", index));
    }
    return candidate.name.find(device) != std::string::npos;
}

std::string names_of(const std::vector<Candidate>& candidates) {
    std::string names;
    for (const Candidate& candidate : candidates)
        names += (names.empty() ? " " : ", ") + candidate.name;
    return names;
}

// libepoxy ends the process when there is no libEGL at all, so ask first.
void require_libegl() {
    void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!library) throw NoContext("There is no libEGL.so.1; install libegl1 and a GL driver.");
    dlclose(library);
}

}  // namespace

EGLContext create_context(EGLDisplay display, EGLConfig config, EGLContext shared) {
    std::vector<EGLint> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,       4,
        EGL_CONTEXT_MINOR_VERSION,       5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    std::vector<EGLint> robust = attributes;
    robust.insert(robust.end(),
                  {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                   EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    for (auto* list : {&robust, &attributes}) {
        list->push_back(EGL_NONE);
        const EGLContext context = eglCreateContext(display, config, shared, list->data());
        if (context != EGL_NO_CONTEXT) return context;
    }
    return EGL_NO_CONTEXT;
}

std::unique_ptr<Context> make_egl_context(std::string_view device) {
    require_libegl();
    Context::start_variables_at_zero();
    Context::spare_full_disk();
    std::vector<Candidate> order = candidates();
    std::ranges::stable_sort(order, {}, &Candidate::software);
    std::string tried;
    for (const Candidate& candidate : order) {
        if (!is_chosen(candidate, device)) {
            tried += fmt::format("\n  {}: not asked for", candidate.name);
            continue;
        }
        const EGLDisplay display = eglGetPlatformDisplayEXT(
            candidate.platform,
            candidate.device ? candidate.device : static_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
        if (display == EGL_NO_DISPLAY) {
            tried += fmt::format("\n  {}: no display", candidate.name);
            continue;
        }
        try {
            return std::make_unique<EglContext>(display);
        } catch (const NoContext& error) {
            tried += fmt::format("\n  {}: {}", candidate.name, error.what());
        }
    }
    if (!order.empty() && std::ranges::none_of(order, [&](const Candidate& candidate) {
            return is_chosen(candidate, device);
        }))
        throw NoContext(fmt::format("There is no device '{}' for --device; there are:{}", device,
                                    names_of(order)));
    throw NoContext(
        fmt::format("No OpenGL 4.5 context{}; install a GL driver (Debian: "
                    "libgl1-mesa-dri).{}",
                    device.empty() ? "" : fmt::format(" on device '{}'", device),
                    tried.empty() ? " EGL knows no device." : " Tried:" + tried));
}

}  // namespace glint
