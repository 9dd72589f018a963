// How contexts of EGL are made here.
#pragma once

#include <epoxy/egl.h>

namespace glint {

// One that tells of a reset, where the driver can; a plain one elsewhere; EGL_NO_CONTEXT where
// there is none of OpenGL 4.5. `shared`: whose objects it sees.
EGLContext create_context(EGLDisplay display, EGLConfig config, EGLContext shared = EGL_NO_CONTEXT);

}  // namespace glint
