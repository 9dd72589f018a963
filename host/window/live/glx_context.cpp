#include "window/live/glx_context.h"

#include <X11/Xlib.h>
#include <epoxy/glx.h>

namespace glint {
namespace {

// X11 tells of what it refuses through one function for the whole process, which ends it otherwise.
class Refusals {
public:
    explicit Refusals(Display* display) : display_(display) {
        any_ = false;
        before_ = XSetErrorHandler([](Display*, XErrorEvent*) {
            any_ = true;
            return 0;
        });
    }
    ~Refusals() {
        XSync(display_, False);
        XSetErrorHandler(before_);
    }
    Refusals(const Refusals&) = delete;
    Refusals& operator=(const Refusals&) = delete;

    bool any() const {
        XSync(display_, False);
        return any_;
    }

private:
    static inline bool any_ = false;
    Display* const display_;
    XErrorHandler before_;
};

// The configuration of the visual that the window has; null where none draws and swaps.
GLXFBConfig configuration_of(Display* display, const XWindowAttributes& window) {
    const int wanted[] = {GLX_DRAWABLE_TYPE,
                          GLX_WINDOW_BIT,
                          GLX_RENDER_TYPE,
                          GLX_RGBA_BIT,
                          GLX_X_VISUAL_TYPE,
                          GLX_TRUE_COLOR,
                          GLX_RED_SIZE,
                          8,
                          GLX_GREEN_SIZE,
                          8,
                          GLX_BLUE_SIZE,
                          8,
                          GLX_DOUBLEBUFFER,
                          True,
                          None};
    int count = 0;
    GLXFBConfig* all =
        glXChooseFBConfig(display, XScreenNumberOfScreen(window.screen), wanted, &count);
    GLXFBConfig found = nullptr;
    for (int i = 0; i < count && !found; ++i) {
        int visual = 0;
        glXGetFBConfigAttrib(display, all[i], GLX_VISUAL_ID, &visual);
        if (static_cast<VisualID>(visual) == XVisualIDFromVisual(window.visual)) found = all[i];
    }
    if (all) XFree(all);
    return found;
}

GLXContext make_context(Display* display, int screen, GLXFBConfig configuration) {
    const auto has = [&](const char* name) {
        return epoxy_has_glx_extension(display, screen, name);
    };
    if (!has("GLX_ARB_create_context_profile")) return nullptr;
    const bool tells_of_loss = has("GLX_ARB_create_context_robustness");
    const int attributes[] = {GLX_CONTEXT_MAJOR_VERSION_ARB,
                              4,
                              GLX_CONTEXT_MINOR_VERSION_ARB,
                              5,
                              GLX_CONTEXT_PROFILE_MASK_ARB,
                              GLX_CONTEXT_CORE_PROFILE_BIT_ARB,
                              tells_of_loss ? GLX_CONTEXT_FLAGS_ARB : 0,
                              GLX_CONTEXT_ROBUST_ACCESS_BIT_ARB,
                              GLX_CONTEXT_RESET_NOTIFICATION_STRATEGY_ARB,
                              GLX_LOSE_CONTEXT_ON_RESET_ARB,
                              None};
    return glXCreateContextAttribsARB(display, configuration, nullptr, True, attributes);
}

void keep_in_step(Display* display, int screen, ::Window window) {
    if (epoxy_has_glx_extension(display, screen, "GLX_EXT_swap_control"))
        glXSwapIntervalEXT(display, window, 1);
    else if (epoxy_has_glx_extension(display, screen, "GLX_MESA_swap_control"))
        glXSwapIntervalMESA(1);
}

}  // namespace

struct GlxContext::Handles {
    Display* display;
    ::Window window;
    GLXContext context;
};

std::unique_ptr<GlxContext> GlxContext::make(_XDisplay* display, unsigned long window) {
    const Refusals refusals(display);
    XWindowAttributes attributes{};
    int error = 0, event = 0;
    if (!XGetWindowAttributes(display, window, &attributes) ||
        !glXQueryExtension(display, &error, &event)) {
        return nullptr;
    }
    const int screen = XScreenNumberOfScreen(attributes.screen);
    GLXFBConfig configuration = configuration_of(display, attributes);
    GLXContext context = configuration ? make_context(display, screen, configuration) : nullptr;
    if (!context) return nullptr;
    std::unique_ptr<GlxContext> made(new GlxContext({display, window, context}));
    if (refusals.any() || !glXMakeCurrent(display, window, context)) return nullptr;
    keep_in_step(display, screen, window);
    return refusals.any() ? nullptr : std::move(made);
}

GlxContext::GlxContext(const Handles& handles) : handles_(new Handles(handles)) {}

GlxContext::~GlxContext() {
    if (glXGetCurrentContext() == handles_->context)
        glXMakeCurrent(handles_->display, None, nullptr);
    glXDestroyContext(handles_->display, handles_->context);
}

void GlxContext::swap() const {
    glXSwapBuffers(handles_->display, handles_->window);
}

}  // namespace glint
