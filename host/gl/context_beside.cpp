#include "gl/context_beside.h"

#include "gl/egl_context.h"

#include <epoxy/egl.h>
#include <sys/resource.h>

namespace glint {
namespace {

// By `ulimit -v`: where drivers run out of addresses on a thread of their own they end the process,
// and what is compiled beside needs more of them than what is compiled in turn.
bool addresses_are_rationed() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace

ContextBeside::ContextBeside() {
    if (addresses_are_rationed()) return;
    display_ = eglGetCurrentDisplay();
    beside_ = eglGetCurrentContext();
}

ContextBeside::~ContextBeside() {
    if (context_) eglDestroyContext(display_, context_);
}

ContextBeside::Current::~Current() {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglReleaseThread();
}

std::unique_ptr<ContextBeside::Current> ContextBeside::make_current() {
    if (!eglBindAPI(EGL_OPENGL_API)) return nullptr;
    if (!context_) {
        EGLint id = 0, count = 0;
        EGLConfig config = EGL_NO_CONFIG_KHR;
        if (eglQueryContext(display_, beside_, EGL_CONFIG_ID, &id) && id != 0) {
            const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
            eglChooseConfig(display_, wanted, &config, 1, &count);
        }
        context_ = create_context(display_, config, beside_);
    }
    if (!context_ || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        return nullptr;
    return std::make_unique<Current>(display_);
}

}  // namespace glint
