#include "gl/context.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace glint {
namespace {

// GL has one debug callback a context, and we make one context a process. The callback may not
// throw through the driver, so it records the first complaint for finish() to throw. What the
// shader compiler says is no failed call; it stands in the log of the program.
thread_local std::string first_complaint;

void GLAPIENTRY hear(GLenum source, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
                     const void*) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER || type != GL_DEBUG_TYPE_ERROR) return;
    if (first_complaint.empty()) first_complaint = text;
}

const char* reset_reason(GLenum status) {
    switch (status) {
        case GL_GUILTY_CONTEXT_RESET:
            return "the scene made the GPU hang";
        case GL_INNOCENT_CONTEXT_RESET:
            return "another program made the GPU hang";
        default:
            return "the GPU was reset";
    }
}

std::string renderer_name() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name ? name : "unknown";
}

}  // namespace

bool draws_in_software() {
    const std::string name = renderer_name();
    return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

void start_context() {
    glDisable(GL_DITHER);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);  // always on in GLSL ES
}

std::string take_complaint() {
    constexpr int kMost = 16;  // errors; a context that is lost may never run out of them
    std::string first = std::exchange(first_complaint, {});
    // A driver need not call back in a context that is not for debugging.
    GLenum code = glGetError();
    for (int i = 0; i < kMost && code != GL_NO_ERROR; ++i, code = glGetError())
        if (first.empty())
            first = code == GL_OUT_OF_MEMORY ? "GL_OUT_OF_MEMORY" : fmt::format("{:#x}", code);
    return first;
}

// An option of Mesa's, which the environment overrides, and which Mesa tells on stderr unless
// silent.
void Context::start_variables_at_zero() {
    ::setenv("glsl_zero_init", "true", 0);
    ::setenv("MESA_DEBUG", "silent", 0);
}

void Context::spare_full_disk() {
    constexpr std::uintmax_t kLeast = 16u << 20;  // bytes; the index has 1.3 MB
    const auto value = [](const char* name) {
        const char* text = std::getenv(name);
        return std::filesystem::path(text ? text : "");
    };
    std::filesystem::path folder = value("MESA_SHADER_CACHE_DIR");
    if (folder.empty()) folder = value("XDG_CACHE_HOME");
    if (folder.empty()) folder = value("HOME") / ".cache";
    std::error_code error;
    while (!std::filesystem::exists(folder, error) && folder.has_relative_path())
        folder = folder.parent_path();
    const auto space = std::filesystem::space(folder, error);
    if (!error && space.available < kLeast) ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

std::string Context::renderer() const {
    return renderer_name();
}

std::string Context::driver() const {
    return renderer() + ", " + reinterpret_cast<const char*>(glGetString(GL_VERSION));
}

void Context::finish() {
    glFinish();
    check();
}

void Context::check() {
    if (const GLenum status = glGetGraphicsResetStatus(); status != GL_NO_ERROR) {
        throw ContextLost(
            fmt::format("The picture was lost: {}. Try fewer iterations, a smaller "
                        "--size, or --tile.",
                        reset_reason(status)));
    }
    if (const std::string text = take_complaint(); !text.empty()) {
        throw std::runtime_error(text.starts_with("GL_OUT_OF_MEMORY")
                                     ? "There is not enough video memory: use smaller buffers, "
                                       "noise or a smaller picture."
                                     : "The GL driver refused a call: " + text);
    }
}

void Context::start() {
    if (epoxy_gl_version() < 45 || !epoxy_has_gl_extension("GL_ARB_ES3_compatibility")) {
        throw NoContext(fmt::format(
            "The driver ({}) offers OpenGL {}.{}; glint needs 4.5 with ARB_ES3_compatibility.",
            renderer(), epoxy_gl_version() / 10, epoxy_gl_version() % 10));
    }
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(hear, nullptr);
}

}  // namespace glint
